#!/usr/bin/env python3
"""docs/methods.md has each method's paragraph, picture and row, and they are what the program does: test_methods_page.py PROGRAM."""
import copy
import importlib.util
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
spec = importlib.util.spec_from_file_location("methods_page", ROOT / "scripts" / "methods_page.py")
methods_page = importlib.util.module_from_spec(spec)
spec.loader.exec_module(methods_page)

PROGRAM = None
RESULTS = sorted((ROOT / "results").glob("*/methods.json"))
PAGE = (ROOT / "docs" / "methods.md").read_text()


def run(*arguments):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "result.json"
        subprocess.run([PROGRAM, "run", *arguments, "-q", "-o", path], check=True, stderr=subprocess.DEVNULL)
        return json.loads(path.read_text())


def counted(result):
    """What a row shows of each case, but for its time."""
    # Results of earlier versions have "own" and "no lists" for what is "no lists" or "own lists" now.
    return {re.sub("/(own lists|no lists|own)$", "/own", case["name"]): (case.get("error"), case["buffers"]["bytes"]["high_water"], case["samples"]["opaque"]["evaluated"],
                           case["samples"]["opaque"]["read_bytes"],
                           case["samples"]["opaque"]["missed"]) for case in result["cases"]}


class MethodsPage(unittest.TestCase):
    def test_each_method_has_a_section_and_each_section_is_filled_from_a_committed_result(self):
        listed = json.loads(subprocess.run([PROGRAM, "list", "--json"], check=True, capture_output=True).stdout)["assigners"]
        # Methods on a device make the lists of others; docs/gpu.md is about them.
        names = {method["name"] for method in listed if not method["on_device"]}
        heads = {name for name in names if not (name.endswith("-fast") and name.removesuffix("-fast") in names)}
        self.assertEqual(set(methods_page.places(PAGE)), heads)
        for name in heads:
            self.assertIn(f"\n### `{name}`\n", PAGE)
            self.assertIn(f"[`{name}`](#", PAGE)
        self.assertIn(PAGE, [methods_page.page_with(PAGE, json.loads(path.read_text())) for path in RESULTS])

    def test_the_committed_results_count_what_the_program_counts_now(self):
        self.assertTrue(RESULTS)
        now = counted(run(ROOT / "configs" / "methods.json", "--no-timing"))
        for path in RESULTS:
            self.assertEqual(counted(json.loads(path.read_text())), now, path.parent.name)

    def test_the_pictures_are_what_the_program_exports(self):
        with tempfile.TemporaryDirectory() as folder:
            made = pathlib.Path(folder)
            methods_page.make_pictures(PROGRAM, made)
            kept = {path.name: path for path in methods_page.PICTURES.glob("*.*")}
            self.assertEqual({path.name for path in made.glob("*.*")}, set(kept))
            for path in made.glob("*.svg"):
                self.assertEqual(path.read_text(), kept[path.name].read_text(), path.name)

    def test_a_picture_shows_mistakes_before_what_is_right(self):
        def kinds(true, extra, lost):
            cells = {"indices": "5", "true": str(true), "false_positives": str(extra), "false_negatives": str(lost)}
            case = {"grid": {"cells": [4, 2, 1]}, "details": {"frames": [{"cells": cells}]}}
            return methods_page.colours_of(case)

        self.assertEqual(kinds(2, 0, 0), {(1, 1, 0): "true"})
        self.assertEqual(kinds(2, 1, 0), {(1, 1, 0): "false_positives"})
        self.assertEqual(kinds(2, 1, 1), {(1, 1, 0): "false_negatives"})

    def test_pictures_of_methods_that_lose_lights_show_where(self):
        for name, loses in (("naive-refinement", True), ("bevy-refinement", True), ("naive-bounds", True), ("sphere-refinement", False)):
            picture = (methods_page.PICTURES / f"{name}.svg").read_text()
            self.assertEqual(methods_page.COLOURS["false_negatives"] + '" d="M' in picture.split("<text")[0], loses, name)

    def test_another_figure_makes_another_page(self):
        result = copy.deepcopy(json.loads(RESULTS[0].read_text()))
        result["cases"][0]["error"]["excess_ratio"] += 0.01
        self.assertNotEqual(methods_page.page_with(PAGE, result), PAGE)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
