#!/usr/bin/env python3
"""What papers say of depth and clusters holds on the committed results, and scripts/trends notices where not."""
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
SCRIPT = ROOT / "scripts" / "trends"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPT.parent))
loader = importlib.machinery.SourceFileLoader("trends", str(SCRIPT))
trends = importlib.util.module_from_spec(importlib.util.spec_from_loader("trends", loader))
loader.exec_module(trends)
depth_trends = trends.depth_trends

RESULTS = sorted((ROOT / "results").glob("*/depth.json"))
# One machine's results that are counted alone: all that scripts/trends can speak of.
COUNTED = [path for name in trends.CLAIMS for path in sorted((ROOT / "results").glob(f"*/{name}.json"))[:1]]


def failing(result):
    return {letter for letter, _, _, _, holds in depth_trends.checked(result) if not holds}


class Published(unittest.TestCase):
    """Figures that papers and engines publish."""

    def rows(self, **changes):
        """Keys and scenes of the rows that are not as WHY_NOT has them. changes: of a result's cases, by its name."""
        results = [trends.Result(path) for path in COUNTED]
        for result in results:
            for case in result.json["cases"]:
                changes.get(result.name.replace("-", "_"), lambda case: None)(case)
        return {(row.key, row.scene) for row in trends.rows_of(results) if not trends.is_expected(row)}

    def test_all_are_on_the_committed_results_as_the_page_says(self):
        self.assertEqual(len(COUNTED), len(trends.CLAIMS))
        self.assertEqual(self.rows(), set())
        page = (ROOT / "docs" / "trends.md").read_text()
        self.assertIn("\n" + trends.table(trends.rows_of([trends.Result(path) for path in COUNTED])) + "\n", page)

    def test_each_reason_belongs_to_a_figure(self):
        rows = trends.rows_of([trends.Result(path) for path in COUNTED])
        self.assertEqual(set(trends.WHY_NOT) - {(row.key, row.scene) for row in rows}, set())

    def test_each_is_noticed_where_it_does_not_hold(self):
        def scaled(scene, grid, label, *way, by):
            def change(case):
                if case["scene"] == scene and grid in case["grid"]["name"] and depth_trends.current(case["assigner"]["label"]) == label:
                    inner = case
                    for key in way[:-1]:
                        inner = inner[key]
                    inner[way[-1]] *= by
            return change

        pairs, evaluated = ("error", "reported_pairs"), ("samples", "opaque", "evaluated")
        dense = ("rig-2400-r30", "x 64 ", "exact-fast")
        for key, scene, result, change in (
                ("cube-aabb", "open-world", "trends", scaled("open-world", "64px", "aabb(spot=sphere)", *pairs, by=1.2)),
                ("cube-refinement", "open-world", "trends", scaled("open-world", "64px", "sphere-refinement(spot=sphere)", *pairs, by=0.5)),
                ("cube-planes", "hall-512", "trends", scaled("hall-512", "64px", "planes(spot=sphere)", *pairs, by=0.99)),
                ("upload", "hall-2048", "trends", scaled("hall-2048", "64px", "sphere-refinement", "buffers", "upload_bytes", "mean", by=2)),
                ("cubical", "open-world", "trends", scaled("open-world", "128px", "aabb", *pairs, by=1.3)),
                ("linear", "hall-*", "trends", scaled("hall-2048", "12x12", "brute-force", "tests_done", by=2)),
                ("shading", "hall-*", "trends", scaled("hall-2048", "12x12", "brute-force", "shading", "evaluated", by=2)),
                ("slices-mean", "rig-2400-r30", "trends_dense", scaled(*dense, "occupancy", "pairs", "mean", by=2)),
                ("slices-max", "rig-2400-r30", "trends_dense", scaled(*dense, "occupancy", "lights_per_cell", "max", by=2)),
                ("slices-pairs", "rig-2400-r30", "trends_dense", scaled(*dense, *pairs, by=0.2)),
                ("cone-references", "rig-2400-r30-s1", "trends_dense", scaled("rig-2400-r30-s1", "x 64 ", "aabb", *pairs, by=0.1)),
                ("cone-mean", "rig-2400-r30-s1", "trends_dense", scaled("rig-2400-r30-s1", "x 64 ", "aabb", *pairs, by=2)),
                ("mask", "steps", "depth", scaled("steps", "x 64 ", "tiled-2.5d", *evaluated, by=1.4)),
                ("olsson", "steps", "depth", scaled("steps", "x 64 ", "exact-fast", *evaluated, by=5)),
                ("half", "mix", "depth", scaled("mix", "x 64 ", "exact-fast", *evaluated, by=1.4)),
                ("naive", "mix", "depth", scaled("mix", "x 64 ", "tiled", *evaluated, by=30)),
                ("raster", "mix", "methods", scaled("mix", "frustum", "conservative-raster", "error", "excess_ratio", by=3))):
            with self.subTest(key):
                self.assertIn((key, scene), self.rows(**{result: change}))


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
                if case["grid"]["cells"][2] == slices and depth_trends.current(case["assigner"]["label"]) == label:
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
        self.assertIn("c", with_change(16, "sphere-refinement(spot=sphere)", ("error", "reported_pairs"), 3))
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
