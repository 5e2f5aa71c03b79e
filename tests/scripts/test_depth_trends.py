#!/usr/bin/env python3
"""What papers say of depth and clusters holds on the committed results, and scripts/depth_trends notices where not."""
import copy
import importlib.machinery
import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "depth_trends"
loader = importlib.machinery.SourceFileLoader("depth_trends", str(SCRIPT))
depth_trends = importlib.util.module_from_spec(importlib.util.spec_from_loader("depth_trends", loader))
sys.dont_write_bytecode = True
loader.exec_module(depth_trends)

RESULTS = sorted((ROOT / "results").glob("*/depth.json"))


def failing(result):
    return {letter for letter, _, _, _, holds in depth_trends.checked(result) if not holds}


class DepthTrends(unittest.TestCase):
    def test_all_hold_on_the_committed_results_of_all_own_scenes(self):
        self.assertTrue(RESULTS)
        for path in RESULTS:
            with self.subTest(path.parent.name):
                lines = depth_trends.checked(json.loads(path.read_text()))
                self.assertEqual({line[0] for line in lines}, set("abcde"))
                self.assertEqual({line[2] for line in lines}, {"steps", "slope", "mix"})
                self.assertEqual([line for line in lines if not line[-1]], [])

    def test_each_is_noticed_where_it_does_not_hold(self):
        result = json.loads(RESULTS[0].read_text())

        def with_change(slices, label, pointer, factor):
            changed = copy.deepcopy(result)
            for case in changed["cases"]:
                if case["grid"]["cells"][2] == slices and case["assigner"]["label"] == label:
                    *way, last = pointer
                    inner = case
                    for key in way:
                        inner = inner[key]
                    inner[last] *= factor
            return failing(changed)

        lists = ("occupancy", "lights_per_cell")
        self.assertIn("a", with_change(256, "exact-fast", (*lists, "mean"), 100))
        self.assertIn("b", with_change(64, "tiled-2.5d", ("samples", "opaque", "evaluated"), 3))
        self.assertIn("b", with_change(64, "exact-fast", ("samples", "opaque", "evaluated"), 30))
        self.assertIn("c", with_change(16, "sphere-refinement(spot=ball)", ("error", "reported_pairs"), 3))
        self.assertIn("d", with_change(64, "aabb", ("error", "reported_pairs"), 1.2))
        self.assertIn("e", with_change(256, "aabb", (*lists, "p99"), 20))

    def test_the_script_prints_each_and_fails_with_the_first_that_does_not_hold(self):
        good = subprocess.run([SCRIPT, RESULTS[0]], capture_output=True, text=True)
        self.assertEqual(good.returncode, 0, good.stdout + good.stderr)
        for letter in "abcde":
            self.assertIn(f"({letter}) ", good.stdout)
        result = json.loads(RESULTS[0].read_text())
        for case in result["cases"]:
            case["error"] and case["error"].update(false_positives=1) if "error" in case else None
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            json.dump(result, file)
            file.flush()
            bad = subprocess.run([SCRIPT, file.name], capture_output=True, text=True)
        self.assertEqual(bad.returncode, 1)
        self.assertIn("NO ", bad.stdout)


if __name__ == "__main__":
    unittest.main()
