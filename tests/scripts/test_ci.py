#!/usr/bin/env python3
"""The sanitized parts of `.ci/run` have, together, the tests of every layer once and every input that is fuzzed."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CI = (ROOT / ".ci/run").read_text(encoding="utf-8")
BUILD = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
TESTS = (ROOT / "tests/CMakeLists.txt").read_text(encoding="utf-8")
FUZZ = (ROOT / "tests/fuzz/CMakeLists.txt").read_text(encoding="utf-8")


def words(name, text=CI):
    return " ".join(re.findall(rf'^ *{name}="([^"]*)"$', text, re.MULTILINE)).split()


def parts():
    return re.split(r"^  \d+\)$", CI.split("\ncase ")[1].split("\nesac")[0], flags=re.MULTILINE)[1:]


class SanitizedParts(unittest.TestCase):
    def test_have_each_layer_once(self):
        layers = re.search(r"foreach\(LAYER (.*)\)", TESTS).group(1).split()
        self.assertEqual(sorted(words("layers")), sorted([*layers, "own_threads"]))

    def test_build_each_layer_with_sanitizers_in_some_part(self):
        layers = re.findall(r"^clusterbench_(?:layer|program)\((\w+)", BUILD, re.MULTILINE)
        self.assertLessEqual(set(layers), set(words("layers") + words("also")))

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

    def test_fuzz_inputs_where_the_layer_that_reads_them_is_sanitized(self):
        reader = dict(re.findall(r"(\w+):(\w+)", FUZZ))
        traced = re.search(r"foreach\(LAYER (.*)\)", BUILD).group(1).split()
        for part in parts():
            layers = words("layers", part) + words("also", part)
            for name in words("inputs", part):
                self.assertIn(reader[name], layers, name)
                self.assertIn(reader[name], traced, name)


if __name__ == "__main__":
    unittest.main()
