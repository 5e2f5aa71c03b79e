#!/usr/bin/env python3
"""The table of scripts/mutations.py fits the code, its tests exist, and docs/accuracy.md shows it. Builds nothing."""
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import mutations  # noqa: E402


class Table(unittest.TestCase):
    def test_every_change_can_be_made(self):
        for mutation in mutations.MUTATIONS:
            with self.subTest(mutation.name):
                text = (ROOT / "src" / mutation.file).read_text()
                self.assertNotEqual(mutations.mutated(mutation, text), text)

    def test_every_named_test_exists(self):
        for mutation in mutations.MUTATIONS:
            with self.subTest(mutation.name):
                self.assertTrue(mutations.test_exists(mutation), mutation.test)

    def test_names_differ(self):
        names = [mutation.name for mutation in mutations.MUTATIONS]
        self.assertEqual(sorted(names), sorted(set(names)))

    def test_the_document_shows_it(self):
        text = mutations.ACCURACY.read_text()
        self.assertEqual(mutations.with_table(text), text, "run scripts/mutations.py --write")


class Script(unittest.TestCase):
    mutation = mutations.MUTATIONS[0]._replace(old="a < b", new="a <= b")

    def test_an_old_text_that_is_gone_or_not_alone_is_refused(self):
        self.assertEqual(mutations.mutated(self.mutation, "if (a < b)"), "if (a <= b)")
        for text in ["if (b > a)", "a < b && a < b"]:
            with self.assertRaises(mutations.Broken):
                mutations.mutated(self.mutation, text)

    def test_a_test_that_is_gone_is_noticed(self):
        self.assertTrue(mutations.test_exists(self.mutation))
        self.assertFalse(mutations.test_exists(self.mutation._replace(test="geom.BallTouchesBox.touching")))
        self.assertFalse(mutations.test_exists(self.mutation._replace(test=self.mutation.test.replace("geom", "grid"))))


if __name__ == "__main__":
    unittest.main()
