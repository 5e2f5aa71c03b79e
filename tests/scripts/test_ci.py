#!/usr/bin/env python3
"""The sanitized parts of `.ci/run` have, together, the tests of every layer once and every input that is fuzzed."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CI = (ROOT / ".ci/run").read_text(encoding="utf-8")
TESTS = (ROOT / "tests/CMakeLists.txt").read_text(encoding="utf-8")


def words(name):
    return " ".join(re.findall(rf'^ *{name}="([^"]*)"$', CI, re.MULTILINE)).split()


class SanitizedParts(unittest.TestCase):
    def test_have_each_layer_once(self):
        layers = re.search(r"foreach\(LAYER (.*)\)", TESTS).group(1).split()
        self.assertEqual(sorted(words("layers")), sorted([*layers, "own_threads"]))

    def test_add_only_layers_that_there_are(self):
        self.assertLessEqual(set(words("also")), {path.name for path in (ROOT / "src").iterdir() if path.is_dir()})

    def test_are_as_many_as_the_seed_chooses_from(self):
        parts = int(re.search(r"case \$\(\(seed % (\d+)\)\)", CI).group(1))
        cases = re.findall(r"^  (\d+)\)$", CI, re.MULTILINE)
        self.assertEqual(cases, [str(part) for part in range(parts)])
        self.assertIn(f"seed / {parts} % 8", CI)

    def test_have_every_fuzzed_input(self):
        inputs = {path.stem for path in (ROOT / "tests/fuzz").glob("*.cpp")}
        self.assertEqual(set(words("inputs")), inputs)


if __name__ == "__main__":
    unittest.main()
