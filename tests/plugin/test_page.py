#!/usr/bin/env python3
"""Is the plug-in that docs/plugins.md writes out the one that tests build? tests/plugin/test_page.py PROGRAM

Also: does the page name every test of `plugin check`, and every way to name a plug-in?"""
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGE = (ROOT / "docs" / "plugins.md").read_text(encoding="utf-8")
PROGRAM = sys.argv.pop(1)


class Page(unittest.TestCase):
    def test_the_example_is_the_one_that_tests_build(self):
        found = re.search(r"^```cpp\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)
        source = ROOT / "tests" / "plugin" / "examples" / "cell_boxes.cpp"
        self.assertEqual(found[1], source.read_text(encoding="utf-8"))

    def test_every_test_is_named(self):
        help_text = subprocess.run([PROGRAM, "plugin", "check", "--help"], capture_output=True, text=True, check=True).stdout
        names = re.findall(r"^  ([a-z-]+): ", help_text[help_text.index("Tests:"):], re.MULTILINE)
        self.assertGreater(len(names), 10)
        rows = set(re.findall(r"`([a-z-]+)`", PAGE[PAGE.index("| test | asks |"):PAGE.index("Exit code 0")]))
        self.assertEqual(set(names) - rows, set())
        self.assertEqual(rows - set(names) - {"create", "destroy", "stress", "--seconds", "--json", "incomplete"}, set())


if __name__ == "__main__":
    unittest.main()
