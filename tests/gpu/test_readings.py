#!/usr/bin/env python3
"""What samples pay for their lights (key `reading`), through the program on the driver of the environment.

  tests/gpu/test_readings.py CLUSTERBENCH SCENES [NAME...]

NAME: Readings (what each driver reads), ReadingRuns (what the program does with it) or WithoutDevice; without any, all.
No test asserts a time. Counts of readings are held against those that the first pass over the frames takes on the
processor. Without a device all tests but those of its absence are skipped (exit code 77).
"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, SCENES = map(os.path.abspath, sys.argv[1:3])
FRUSTUM = {"kind": "frustum", "tiles": {"pixels": 16}, "slices": {"scheme": "exponential", "count": 8}}


def config(**keys):
    return {"scenes": [{"path": f"{SCENES}/mix.glb", "frames": 2}], "viewport": [80, 45], "grids": [FRUSTUM],
            "assigners": ["exact-fast", "aabb-fast", "z-binning", "bvh", "gpu-cells"],
            "storages": ["packed", "bitfield", "linked", "runs", {"name": "fixed", "cap": 200}],
            "samples": {"opaque": {"divisor": 1}, "fog": {"froxels": [16, 9, 8]}},
            "timing": {"rounds": 6, "launches": 1, "min_time_ms": 0.05, "frames": 2, "cold": False},
            "reading": {"sets": ["opaque", "fog"], "walks": ["lane", "light"], "rounds": 6, "async": 0.25},
            **keys}


def run(document, *flags, environment=None):
    with tempfile.TemporaryDirectory() as folder:
        path, out = f"{folder}/config.json", f"{folder}/result.json"
        with open(path, "w") as file:
            json.dump(document, file)
        done = subprocess.run([PROGRAM, "run", path, "-o", out, *flags], capture_output=True, text=True,
                              env={**os.environ, **(environment or {})})
        result = None
        if os.path.exists(out):
            with open(out) as file:
                result = json.load(file)
        return result, done


def has_device():
    return subprocess.run([PROGRAM, "list", "devices"], capture_output=True).returncode == 0


class Readings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result, cls.done = run(config())

    def test_each_structure_is_read_and_counted_as_on_the_processor(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        cases = self.result["cases"]
        self.assertEqual(len(cases), 4 * 5 + 2)
        for case in cases:
            reading = case["reading"]
            self.assertEqual([one["set"] for one in reading["sets"]], ["opaque", "fog"], case["name"])
            for one in reading["sets"]:
                counted = case["samples"][one["set"]]
                self.assertEqual(one["differing"], 0, case["name"])
                self.assertAlmostEqual(one["samples"], counted["samples"] / 2, 5, case["name"])
                for key, counts in (("lights", "evaluated"), ("reads", "reads"), ("read_bytes", "read_bytes")):
                    self.assertAlmostEqual(one[key], counted[counts] / counted["samples"], 4, f"{case['name']} {key}")
                self.assertGreaterEqual(one["divergence"], 1.0)

    def test_walks_have_times_beside_exact_lists_and_nothing(self):
        for case in self.result["cases"]:
            for one in case["reading"]["sets"]:
                self.assertEqual([walk["walk"] for walk in one["walks"]], ["lane", "light"], case["name"])
                self.assertEqual(len(one["nothing_ns"]["samples"]), 6)
                for walk in one["walks"]:
                    for key in ("read_ns", "cold_ns", "exact_ns"):
                        self.assertEqual(len(walk[key]["samples"]), 6, f"{case['name']} {key}")
                    ratios = sorted(a / b for a, b in zip(walk["read_ns"]["samples"], walk["exact_ns"]["samples"]))
                    self.assertAlmostEqual(walk["exact_ratio"], (ratios[2] + ratios[3]) / 2, 3)

    def test_exact_lists_are_those_of_the_same_storage(self):
        by_storage = {case["storage"]: case["reading"] for case in self.result["cases"] if case["assigner"]["name"] == "exact-fast"}
        self.assertEqual(len(by_storage), 5)
        for case in self.result["cases"]:
            exact = by_storage["packed" if case["storage"] == "own" else case["storage"]]
            self.assertEqual(case["reading"]["exact"]["bytes"], exact["structure_bytes"], case["name"])
            for one, other in zip(case["reading"]["sets"], exact["sets"]):
                self.assertEqual(one["exact_lights"], other["lights"], case["name"])
        self.assertEqual(len({one["structure_bytes"] for one in by_storage.values()}), 5, "no two storages are alike")

    def test_frames_are_assignment_upload_and_reading(self):
        upload_gb_per_s = self.result["config"]["cost"]["upload_gb_per_s"]
        for case in self.result["cases"]:
            read = case["reading"]["sets"][0]["walks"][0]["read_ns"]["median"]
            if "device" in case and case["storage"] != "packed":  # the host has made it of the device's lists
                self.assertNotIn("frame_ns", case["reading"], case["name"])
                continue
            if "device" in case:
                lists, upload = case["device"]["run_ns"]["median"], case["device"]["upload_ns"]["median"]
            else:
                lists = case["timing"]["frame_ns"]["median"]
                upload = case["buffers"]["upload_bytes"]["mean"] / upload_gb_per_s
            whole = 0.75 * lists + upload + read
            self.assertLess(abs(case["reading"]["frame_ns"] / whole - 1), 1e-3, case["name"])

    def test_the_table_marks_software(self):
        self.assertTrue(all(case["reading"]["software"] for case in self.result["cases"]))
        self.assertIn("A software device: these times are a processor's and no GPU's", self.done.stderr)
        self.assertNotIn("Exact lists in the same storage would save", self.done.stderr)

    def test_behind_a_pre_cull_and_with_packed_lights_the_device_walks_what_the_structure_has(self):
        document = config(assigners=["aabb-fast", "z-binning"], storages=["packed", "bitfield"],
                          pre_cull=["none", "frustum"], precision=["float32", "half"])
        result, done = run(document)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(result["cases"]), 12)
        for case in result["cases"]:
            self.assertEqual([one["differing"] for one in case["reading"]["sets"]], [0, 0], case["name"])
            self.assertGreater(case["reading"]["sets"][0]["lights"], 0)

    def test_other_grids_and_scenes_without_triangles_are_read(self):
        grids = [{"kind": "world", "cells": [8, 4, 8]}, {"kind": "cascades", "levels": 2, "cells": [8, 8, 8], "finest": 0.5},
                 {"kind": "distance", "tiles": {"pixels": 32}, "slices": {"scheme": "exponential", "count": 8}}]
        document = config(grids=grids, scenes=[{"path": f"{SCENES}/street.glb", "frames": 2}], storages=["packed"],
                          assigners=["world-grid-fast", "cascades-fast", "distance-fast"])
        document["reading"]["walks"] = ["lane", "cell"]
        result, done = run(document)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(result["cases"]), 3)
        for case in result["cases"]:
            self.assertEqual([one["differing"] for one in case["reading"]["sets"]], [0, 0], case["name"])
            self.assertEqual(len(case["reading"]["sets"][0]["walks"]), 2, case["name"])

    def test_prices_of_a_software_device_are_refused_and_those_of_a_card_taken(self):
        with tempfile.TemporaryDirectory() as folder:
            path = f"{folder}/readings.json"
            with open(path, "w") as file:
                json.dump(self.result, file)
            _, done = run(config(), "--cost-from", path, "--no-timing")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("computes on the processor", done.stderr)
            doctored = json.loads(json.dumps(self.result))
            for case in doctored["cases"]:
                case["reading"]["software"] = False
                for one in case["reading"]["sets"]:  # as if a card had these prices
                    for walk in one["walks"]:
                        walk["read_ns"]["median"] = one["nothing_ns"]["median"] + one["samples"] * one["divergence"] * (
                            0.03 * one["lights"] + 0.004 * one["reads"] + one["read_bytes"] / 1500)
            with open(path, "w") as file:
                json.dump(doctored, file)
            result, done = run(config(), "--cost-from", path, "--no-timing")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("is a small attenuation", done.stderr)
            cost = result["config"]["cost"]
            self.assertLess(abs(cost["ns_per_light"] / 0.03 - 1), 1e-3)
            self.assertLess(abs(cost["ns_per_read"] / 0.004 - 1), 1e-2)
            self.assertLess(abs(cost["read_gb_per_s"] / 1500 - 1), 1e-2)


class ReadingRuns(unittest.TestCase):
    def test_of_a_part_of_the_pixels_have_no_frame(self):
        document = config(assigners=["gpu-cells"], storages=["packed"])
        document["reading"].update(divisor=2, sets=["opaque"])
        result, done = run(document)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("frame_ns", result["cases"][0]["reading"])
        self.assertIn("Samples of a part of the pixels (reading.divisor)", done.stderr)

    def test_without_async_only_methods_on_the_device_have_whole_frames(self):
        document = config(assigners=["aabb-fast", "gpu-cells"], storages=["packed"])
        del document["reading"]["async"]
        result, done = run(document)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(["frame_ns" in case["reading"] for case in result["cases"]], [False, True])

    def test_a_walk_that_a_structure_does_not_allow_is_no_other_ones_figure(self):
        document = config(assigners=["aabb-fast", "bvh"], storages=["packed"])
        document["reading"].update(walks=["cell", "lane"], sets=["opaque"])
        result, done = run(document, "--fail-if", "own: reading_us >= 0")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("no case has reading_us", done.stderr)
        walks = {case["storage"]: [walk["walk"] for walk in case["reading"]["sets"][0]["walks"]] for case in result["cases"]}
        self.assertEqual(walks, {"packed": ["cell", "lane"], "own": ["lane"]})
        self.assertEqual({case["reading"]["walk"] for case in result["cases"]}, {"cell"})

    def test_below_the_memory_limit_what_fits_is_read_and_the_rest_has_the_reason(self):
        document = config(assigners=["aabb-fast"], storages=["packed", {"name": "fixed", "cap": 2000}], limits={"memory_mib": 1})
        document["reading"]["sets"] = ["opaque"]
        result, done = run(document)
        self.assertEqual(done.returncode, 0, done.stderr)
        read = {case["storage"]: "reading" in case for case in result["cases"]}
        self.assertTrue(read["packed"], result["cases"][0].get("unread"))

    def test_readings_stop_when_they_are_interrupted(self):
        document = config(assigners=["aabb-fast"], storages=["packed"])
        document["reading"]["rounds"] = 100000
        with tempfile.TemporaryDirectory() as folder:
            path = f"{folder}/config.json"
            with open(path, "w") as file:
                json.dump(document, file)
            running = subprocess.Popen([PROGRAM, "run", path, "-o", f"{folder}/result.json", "-q"], stderr=subprocess.PIPE)
            time.sleep(2)
            running.send_signal(signal.SIGINT)
            running.communicate(timeout=60)
            self.assertNotEqual(running.returncode, 0)

    def test_each_case_has_a_reading_or_the_reason(self):
        with tempfile.TemporaryDirectory() as folder:
            path, out = f"{folder}/config.json", f"{folder}/result.json"
            with open(path, "w") as file:
                json.dump(config(assigners=["aabb-fast", "deferred"], storages=["packed"]), file)
            subprocess.run([PROGRAM, "run", path, "-o", out, "-q"], check=True, capture_output=True)
            with open(out) as file:
                cases = json.load(file)["cases"]
            self.assertEqual([sorted({"reading", "unread"} & set(case)) for case in cases], [["reading"], ["unread"]])

    def test_cases_are_the_same_with_and_without_readings(self):
        document = config(assigners=["aabb-fast"], storages=["packed"])
        del document["samples"]  # only readings need the scene's triangles
        ids = []
        for flags in [], ["--no-timing"], ["--set", "reading=null"]:
            result, done = run(document, *flags)
            self.assertEqual(done.returncode, 0, done.stderr)
            ids.append([case["id"] for case in result["cases"]])
        self.assertEqual(ids[0], ids[1])
        self.assertEqual(ids[0], ids[2])

    def test_what_is_read_twice_is_refused(self):
        for key, twice in ("sets", ["fog", "fog"]), ("walks", ["lane", "lane"]):
            document = config(assigners=["aabb-fast"], storages=["packed"])
            document["reading"][key] = twice
            _, done = run(document)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"/reading/{key}/1: '{twice[0]}' stands here twice", done.stderr)

    def test_without_times_nothing_is_read(self):
        result, done = run(config(), "--no-timing")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse(any("reading" in case for case in result["cases"]))


class WithoutDevice(unittest.TestCase):
    def test_cases_are_measured_without_readings_and_the_reason_is_told(self):
        none = {"VK_DRIVER_FILES": "no-such-driver.json", "VK_ICD_FILENAMES": "no-such-driver.json"}
        result, done = run(config(assigners=["aabb-fast"], storages=["packed"]), environment=none)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("reading", result["cases"][0])
        self.assertIn("frame_ns", result["cases"][0]["timing"])
        self.assertTrue(result["cases"][0]["unread"])
        self.assertIn("not read on a device: 1 case: ", done.stderr)


if __name__ == "__main__":
    if not has_device():
        print("skipped: there is no device")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
