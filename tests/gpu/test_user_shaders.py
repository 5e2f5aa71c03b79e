#!/usr/bin/env python3
"""Shaders of users (--shader) through the program, on the driver of the environment.

  tests/gpu/test_user_shaders.py CLUSTERBENCH CHECKOUT

Modules are compiled here, so that those that come with configs/shaders are held against their sources. Without a device
or glslangValidator all tests are skipped (exit code 77).
"""
import copy
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM, CHECKOUT = map(os.path.abspath, sys.argv[1:3])
SHADERS = f"{CHECKOUT}/configs/shaders"
TUTORIAL_GRID = {"kind": "frustum", "tiles": {"count": [12, 12]}, "slices": {"scheme": "exponential", "count": 24, "near": 0.1, "far": 400}}
GRID = {"kind": "frustum", "tiles": {"pixels": 32}, "slices": {"scheme": "exponential", "count": 8}}

# A loop over all lights and cells, with holes for what a test changes.
LOOP = """#version 450
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Lights { vec4 lights[]; };
layout(std430, set = 0, binding = 1) readonly buffer Boundaries { float boundaries[]; };
layout(std430, set = 0, binding = 2) buffer Lists { uint lists[]; };
layout(push_constant) uniform Frame { uvec3 grid; uint lights; } frame;
vec2 span(float a, float b, float near, float far) {
  return vec2(min(min(a * near, a * far), min(b * near, b * far)), max(max(a * near, a * far), max(b * near, b * far)));
}
bool touches(uint light, uint cell) {
  uint x = cell % frame.grid.x, y = cell / frame.grid.x % frame.grid.y, z = cell / frame.grid.x / frame.grid.y;
  uint row = frame.grid.x + 1 + y, slice = frame.grid.x + frame.grid.y + 2 + z;
  float near = boundaries[slice], far = boundaries[slice + 1];
  vec2 h = span(boundaries[x], boundaries[x + 1], near, far), v = span(boundaries[row + 1], boundaries[row], near, far);
  vec3 apart = lights[light].xyz - clamp(lights[light].xyz, vec3(h.x, v.x, -far), vec3(h.y, v.y, -near));
  return dot(apart, apart) <= lights[light].w * lights[light].w * 1.00001;
}
void main() {
  uint cell = gl_GlobalInvocationID.x;
  if (cell >= frame.grid.x * frame.grid.y * frame.grid.z) return;
  BODY
}
"""
COUNTED = """uint count = 0;
  for (uint light = 0; light < frame.lights; ++light)
    if (touches(light, cell)) { if (count < 199) lists[cell * 200 + 1 + count] = light; ++count; }
  lists[cell * 200] = COUNT;"""
METHOD = {
    "shader_version": 1, "name": "mine", "summary": "a test",
    "buffers": {
        "lights": {"bytes": "lights * 16"},
        "boundaries": {"bytes": "4 * (columns + rows + slices + 3)", "values": [
            {"at": 0, "type": "f32", "is": "column_boundaries"},
            {"at": "4 * (columns + 1)", "type": "f32", "is": "row_boundaries"},
            {"at": "4 * (columns + rows + 2)", "type": "f32", "is": "slice_boundaries"}]},
        "lists": {"bytes": "cells * 800"}},
    "lights": {"rows": [{"buffer": "lights", "stride": 16, "fields": [{"at": 0, "type": "f32", "is": "position"},
                                                                       {"at": 12, "type": "f32", "is": "range"}]}]},
    "passes": [{"module": "mine.spv", "invocations": ["cells"],
                "bindings": [{"binding": 0, "buffer": "lights"}, {"binding": 1, "buffer": "boundaries"},
                             {"binding": 2, "buffer": "lists"}],
                "push": [{"at": 0, "type": "u32", "is": "grid_size"}, {"at": 12, "type": "u32", "is": "lights"}]}],
    "lists": [{"layout": "fixed", "per_cell": 199, "rows": {"buffer": "lists", "stride": 800},
               "counts": [{"at": 0, "type": "u32"}], "entries": {"at": 4, "type": "u32"}}]}


def compiled(source, path):
    with open(path + ".comp", "w") as file:
        file.write(source)
    done = subprocess.run(["glslangValidator", "-V", "--quiet", "--target-env", "vulkan1.2", "-o", path, path + ".comp"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stdout)


def configuration(**keys):
    return {"scenes": [{"path": f"{CHECKOUT}/scenes/mix.glb", "frames": 2}], "viewport": [320, 180], "grids": [GRID],
            "assigners": ["brute-force"], "storages": ["packed"],
            "timing": {"rounds": 2, "launches": 1, "min_time_ms": 0.05, "frames": 1, "cold": False}, **keys}


class Folder:
    """A folder with a method and what it names."""

    def __init__(self):
        self.path = tempfile.mkdtemp()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.path)

    def file(self, name, content):
        with open(f"{self.path}/{name}", "wb" if isinstance(content, bytes) else "w") as file:
            file.write(content)
        return f"{self.path}/{name}"

    def method(self, record, body=None, source=LOOP):
        compiled(source.replace("BODY", body or COUNTED.replace("COUNT", "count")), f"{self.path}/mine.spv")
        return self.file("mine.json", json.dumps(record))

    def run(self, document, *flags):
        config, out = self.file("config.json", json.dumps(document)), f"{self.path}/result.json"
        done = subprocess.run([PROGRAM, "run", config, "-o", out, *flags], capture_output=True, text=True)
        if not os.path.exists(out):
            return None, done
        with open(out) as file:
            return json.load(file), done


def changed(record, **paths):
    """The record with values at paths as a__b__0."""
    record = copy.deepcopy(record)
    for path, value in paths.items():
        at, steps = record, [int(step) if step.isdigit() else step for step in path.split("__")]
        for step in steps[:-1]:
            at = at[step]
        if value is None:
            del at[steps[-1]]
        else:
            at[steps[-1]] = value
    return record


def case_of(result, name):
    return next(case for case in result["cases"] if case["assigner"]["name"] == name)


def has_device():
    return subprocess.run([PROGRAM, "list", "devices"], capture_output=True).returncode == 0


class Examples(unittest.TestCase):
    def test_modules_are_those_of_their_sources(self):
        with Folder() as folder:
            for name in os.listdir(SHADERS):
                if name.endswith((".json", ".comp")):
                    shutil.copy(f"{SHADERS}/{name}", folder.path)
                if name.endswith(".comp"):
                    with open(f"{SHADERS}/{name}") as file:
                        compiled(file.read(), f"{folder.path}/{name[:-5]}.spv")
            results = []
            for place in (SHADERS, folder.path):
                result, done = folder.run(configuration(grids=[TUTORIAL_GRID]), "--shader", f"{place}/tutorial.json",
                                          "--shader", f"{place}/append.json",
                                          "--shader", f"{place}/counted.json", "--no-timing")
                self.assertEqual(done.returncode, 0, done.stderr)
                results.append(result)
            for one, other in zip(*(result["cases"] for result in results)):
                for key in ("occupancy", "error", "buffers"):
                    self.assertEqual(one[key], other[key], f"{one['name']}: glslangValidator -V --target-env vulkan1.2 -g0 X.comp -o X.spv")

    def test_tutorial_lists_what_the_twin_of_its_preset_lists(self):
        with Folder() as folder:
            twin = {"name": "gpu-cells-fixed", "cap": 100, "spot": "range"}
            result, done = folder.run(configuration(grids=[TUTORIAL_GRID], assigners=[twin, {"name": "brute-force", "spot": "range"}]),
                                      "--shader", f"{SHADERS}/tutorial.json", "--shader", f"{SHADERS}/append.json",
                                      "--shader", f"{SHADERS}/counted.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        pairs = {case["assigner"]["name"]: case["occupancy"]["pairs"]["mean"] for case in result["cases"]}
        self.assertEqual(len(pairs), 5)
        for name in ("tutorial-loop", "append", "counted", "gpu-cells-fixed"):
            self.assertLess(abs(pairs[name] / pairs["brute-force"] - 1), 1e-3, pairs)
            self.assertEqual(case_of(result, name)["error"]["false_negatives"], 0, name)
        mine = case_of(result, "tutorial-loop")
        self.assertEqual(mine["buffers"]["bytes"]["high_water"], 12 * 12 * 24 * 448)
        self.assertGreater(mine["device"]["run_ns"]["median"], 0)
        self.assertGreater(mine["device"]["build_ns"]["median"], 0)
        self.assertEqual(mine["assigner"]["file"], "tutorial.json")
        self.assertRegex(mine["assigner"]["sha256"], "^[0-9a-f]{64}$")
        self.assertNotIn("sha256", case_of(result, "brute-force")["assigner"])

    def test_truth_finds_what_the_tutorial_forgets_beyond_100_lights(self):
        with Folder() as folder:
            level = f"{folder.path}/many.glb"
            done = subprocess.run([PROGRAM, "scene", "generate", "mix", "--lights", "3000", "-o", level],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            document = configuration(grids=[TUTORIAL_GRID], scenes=[{"path": level, "frames": 1}])
            result, done = folder.run(document, "--shader", f"{SHADERS}/tutorial.json", "--no-timing")
        self.assertEqual(done.returncode, 0, done.stderr)
        mine, twin = case_of(result, "tutorial-loop"), case_of(result, "brute-force")
        self.assertGreater(twin["occupancy"]["lights_per_cell"]["max"], 100)
        self.assertEqual(mine["occupancy"]["lights_per_cell"]["max"], 100)
        self.assertGreater(mine["error"]["false_negatives"], 0)
        self.assertIn("lost_pairs", [warning["kind"] for warning in mine["warnings"]])

    def test_a_key_a_flag_and_the_other_commands_take_them(self):
        with Folder() as folder:
            shutil.copytree(SHADERS, f"{folder.path}/own")
            by_key, done = folder.run(configuration(shaders=["own/append.json"]), "--no-timing")
            self.assertEqual(done.returncode, 0, done.stderr)
            by_flag, done = folder.run(configuration(), "--no-timing", "--shader", f"{folder.path}/own/append.json")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(by_key["config"]["shaders"], by_flag["config"]["shaders"])
            self.assertEqual([case["id"] for case in by_key["cases"]], [case["id"] for case in by_flag["cases"]])
            axes = configuration(shaders=["own/append.json"], assigners=[{"name": "append", "group": [1, 64]}])
            result, done = folder.run(axes, "--no-timing")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(result["cases"]), 2)
            own = f"{folder.path}/own/append.json"
            listed = subprocess.run([PROGRAM, "list", "assigners", "--shader", own], capture_output=True, text=True)
            self.assertIn("append: a group per cell", listed.stdout)
            stress = subprocess.run([PROGRAM, "stress", "--shader", own, "--cases", "H5", "--tries", "0", "-q"],
                                    capture_output=True, text=True)
            self.assertEqual(stress.returncode, 0, stress.stderr)
            self.assertIn('"append"', stress.stdout)
            stress = subprocess.run([PROGRAM, "stress", "--shader", f"{SHADERS}/tutorial.json", "--cases", "H5|H6", "--tries", "200", "-q"],
                                    capture_output=True, text=True)
            self.assertEqual(stress.returncode, 0, f"grids that it cannot have are no fault: {stress.stderr}")
            size = subprocess.run([PROGRAM, "size", f"{CHECKOUT}/scenes/mix.glb", "--shader", own, "--assigner", "append",
                                   "--grid", "frustum", "--tiles", "64", "--slices", "8", "--set", "scenes.*.frames=2"],
                                  capture_output=True, text=True)
            self.assertEqual(size.returncode, 0, size.stderr)
            recommend = subprocess.run([PROGRAM, "recommend", f"{CHECKOUT}/scenes/mix.glb", "--shader", own],
                                       capture_output=True, text=True)
            self.assertEqual(recommend.returncode, 2)
            self.assertIn("runs on a device, whose times do not compare", recommend.stderr)

    def test_wrong_words_about_the_tutorial_lose_lights(self):
        with open(f"{SHADERS}/tutorial.json") as file:
            record = json.load(file)
        for change in ({"cells": {}}, {"cells": {"axes": "yxz", "first_row": "bottom"}}, {"cells__first_slice": "far"},
                       {"camera": {"forward": "+z"}}, {"lights__space": "view"}, {"camera__order": "rows"},
                       {"lights__rows__0__fields__1__is": "range-inverse"}):
            with self.subTest(change), Folder() as folder:
                for name in ("tutorial_bounds.spv", "tutorial_cull.spv"):
                    shutil.copy(f"{SHADERS}/{name}", folder.path)
                own = folder.file("mine.json", json.dumps(changed(record, **change)))
                result, done = folder.run(configuration(grids=[TUTORIAL_GRID]), "--shader", own, "--no-timing")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertGreater(case_of(result, "tutorial-loop")["error"]["miss_ratio"], 0.1)

    def test_validate_reads_all_of_it(self):
        for name in ("tutorial", "append", "counted"):
            done = subprocess.run([PROGRAM, "validate", f"{SHADERS}/{name}.json"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, r"valid, method '.*' with \d pass(es)?, \d buffers$")
        with Folder() as folder:
            path = folder.method(changed(METHOD, passes__0__entry="none"))
            done = subprocess.run([PROGRAM, "validate", path], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn("/passes/0/entry: is 'none'", done.stderr)
            for change, message in (({"name": "aabb"}, "/name: is 'aabb', the name of another method"),
                                    ({"shader_version": None}, "/shader_version: is missing"),
                                    ({"parameters": [{"name": "n", "summary": "x", "default": 0.5, "min": 0, "max": 2}]}, "/parameters/0/default: is 0.5"),
                                    ({"lights__rows__0__fields__1__at": 8}, "/lights/rows/0/fields/1/at: is 8: byte 8 is one of /lights/rows/0/fields/0, too"),
                                    ({"passes__0__push__1__type": "f32"}, "/passes/0/push/1/type: is f32; byte 12 of the push constants of mine.spv is u32")):
                path = folder.method(changed(METHOD, **change))
                done = subprocess.run([PROGRAM, "validate", path], capture_output=True, text=True)
                self.assertEqual(done.returncode, 2, message)
                self.assertIn(message, done.stderr)

    def test_bits_that_a_module_casts_may_be_of_another_type(self):
        source = LOOP.replace("uvec3 grid; uint lights; } frame;", "uvec3 grid; float lights; } told;\n#define frame Told(told.grid, floatBitsToUint(told.lights))\nstruct Told { uvec3 grid; uint lights; };")
        with Folder() as folder:
            result, done = folder.run(configuration(), "--shader", folder.method(METHOD, source=source), "--no-timing")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(case_of(result, "mine")["error"]["false_negatives"], 0)

    def test_slices_of_its_own_skip_other_grids_before_the_run(self):
        with Folder() as folder:
            cut = {"kind": "frustum", "tiles": {"pixels": 60}, "slices": {"scheme": "exponential", "count": 4}}
            linear = {"kind": "frustum", "tiles": {"pixels": 64}, "slices": {"scheme": "linear", "count": 4}}
            result, done = folder.run(configuration(grids=[GRID, linear, cut], viewport=[320, 192]), "--shader", f"{SHADERS}/tutorial.json", "--no-timing")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([case["assigner"]["name"] for case in result["cases"]], ["brute-force", "tutorial-loop", "brute-force", "brute-force"])
        self.assertEqual([one["reason"] for one in result["skipped"]], ["tutorial-loop has exponential slices; those of this grid are others",
                                                                            "tutorial-loop has tiles of equal size; the last ones of this grid are cut off"])
        self.assertNotIn("was not measured", done.stderr)

    def test_slices_without_a_formula_skip_what_is_told_one_before_the_run(self):
        told = changed(METHOD, buffers__formula={"bytes": 8, "values": [{"at": 0, "type": "f32", "is": "slice_scale"},
                                                                         {"at": 4, "type": "f32", "is": "1 + slice_bias"}]})
        listed = {"kind": "frustum", "tiles": {"pixels": 32}, "slices": {"scheme": "list", "boundaries": [0.1, 1, 4, 11, 37, 400]}}
        with Folder() as folder:
            path = folder.method(told)
            result, done = folder.run(configuration(grids=[GRID, listed]), "--shader", path, "--no-timing")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual([case["assigner"]["name"] for case in result["cases"]], ["brute-force", "mine", "brute-force"])
            self.assertEqual([one["reason"] for one in result["skipped"]],
                             ["mine is told slice_scale or slice_bias; the slices of this grid follow no formula"])
            stress = subprocess.run([PROGRAM, "stress", "--shader", folder.method(changed(told, counts_dropped=True)), "--cases", "H34",
                                     "--tries", "0", "-q"], capture_output=True, text=True)
            self.assertNotIn("follow no formula", stress.stdout + stress.stderr)

    def test_readings_and_launches(self):
        with Folder() as folder:
            document = configuration(reading={"rounds": 2, "divisor": 4})
            document["timing"]["launches"] = 2
            document["timing"]["cold"] = True
            result, done = folder.run(document, "--shader", f"{SHADERS}/append.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        mine = case_of(result, "append")
        self.assertEqual(mine["reading"]["sets"][0]["differing"], 0)
        self.assertGreater(mine["device"]["warm"]["run_ns"]["median"], 0)


class Faults(unittest.TestCase):
    def refused(self, record, message, body=None, source=LOOP, code=2):
        with Folder() as folder:
            result, done = folder.run(configuration(), "--shader", folder.method(record, body, source), "--no-timing")
        self.assertEqual(done.returncode, code, f"{message}: {done.stderr}")
        self.assertRegex(done.stderr.replace(folder.path, "."), message)
        self.assertLessEqual(len([line for line in done.stderr.splitlines() if "mine" in line]), 2, done.stderr)
        return result

    def test_json_that_cannot_be_right_is_refused_with_its_place(self):
        for change, message in (
            ({"shader_version": 2}, "/shader_version: is 2; this version reads 1"),
            ({"shader_version": None}, "/shader_version: is missing"),
            ({"name": "Mine!"}, "/name: is 'Mine!'; allowed"),
            ({"name": "aabb"}, "/name: is 'aabb', the name of another method"),
            ({"summary": ""}, "/summary: has 0 bytes"),
            ({"buffers__lists__bytes": "cels * 800"}, r"/buffers/lists/bytes: 'cels \* 800' names 'cels' \(did you mean 'cells'\?\)"),
            ({"buffers__lists__bytes": -1}, "/buffers/lists/bytes: is -1; allowed"),
            ({"buffers__lists__bytes": "cells *"}, "ends where a number is missing"),
            ({"buffers__boundaries__values__0__is": "collumn_boundaries"}, "did you mean 'column_boundaries'"),
            ({"buffers__boundaries__values__0__type": "f31"}, "values/0/type: found 'f31'"),
            ({"buffers__boundaries__clear": True}, "/buffers/boundaries/clear: is true"),
            ({"buffers__lights__clear": True}, "/buffers/lights/clear: is true"),
            ({"lights__rows__0__buffer": "light"}, "did you mean 'lights'"),
            ({"lights__rows__0__stride": 12}, "/lights/rows/0/fields/1/at: is 12: its 4 bytes end beyond the stride of 12"),
            ({"lights__rows__0__fields__0__is": "positions"}, "did you mean 'position'"),
            ({"passes__0__module": "other.spv"}, "/passes/0/module: names ./other.spv, which does not exist"),
            ({"passes__0__entry": "mian"}, r"/passes/0/entry: is 'mian' \(did you mean 'main'\?\)"),
            ({"passes__0__when": "build"}, "/passes: are all of the build"),
            ({"passes__0__groups": [1]}, "has to have one of groups and invocations"),
            ({"passes__0__invocations": None}, "has to have one of groups and invocations"),
            ({"passes__0__invocations": [1, 1, 1, 1]}, "/passes/0/invocations: has 4 elements"),
            ({"passes__0__bindings__2__binding": 1}, "/passes/0/bindings/2: is the second of set 0, binding 1"),
            ({"passes__0__bindings__2__binding": 7}, "set 0, binding 7, which mine.spv does not have; it has set 0, binding 0"),
            ({"passes__0__bindings__2": None}, "do not say which buffer is set 0, binding 2 .*of mine.spv"),
            ({"passes__0__push": None}, "/passes/0/push: is missing: mine.spv has 16 bytes of push constants"),
            ({"passes__0__constants": [{"id": 3, "is": "1"}]}, "/passes/0/constants/0/id: is 3, which mine.spv does not have"),
            ({"lists__0__layout": "inline"}, "/lists/0/layout: is inline"),
            ({"lists__0__layout": "fixd"}, r"/lists/0/layout: found 'fixd' \(did you mean 'fixed'\?\)"),
            ({"lists__0__rows__buffer": "list"}, "did you mean 'lists'"),
            ({"lists__0__per_cell": "per_cell"}, "/lists/0/per_cell: 'per_cell' names 'per_cell'.*, allowed: "),
            ({"lists__0__per_cell": "cells *"}, "/lists/0/per_cell: .*ends where a number is missing"),
            ({"lists__0__layout": "packed"}, "/lists/0/offset: is missing: layout 'packed' needs it"),
            ({"lists__0__counts__0__bits": [0, 33]}, r"/lists/0/counts/0/bits: is \[0,33\]; allowed: the first bit and how many, at least 1, within the 32 bits of u32"),
            ({"lists__0__counts__0__at": 798}, "/lists/0/counts/0/at: is 798: its 4 bytes end beyond the stride of 800"),
            ({"lists__0__rows__stride": 0}, "/lists/0/rows/stride: is 0; allowed: at least 1"),
            ({"lists__0__entries__at": 8}, "/lists/0/entries/at: is 8: 199 entries there end beyond the stride of 800"),
            ({"lists__0__rows__at": 4096, "buffers__lists__bytes": 4096}, "/lists/0/rows/at: is 4096; buffer 'lists' has 4096 bytes"),
            ({"buffers__lists__bytes": 0}, r"/buffers/lists/bytes: is 0; allowed: a whole number from 1"),
            ({"buffers__lists": {"bytes": 8, "values": [{"at": 0, "type": "f32", "is": "eye"}]}}, "/buffers/lists/values/0/at: is 0: its 12 bytes end beyond the 8"),
            ({"buffers__lists": {"bytes": 16, "values": [{"at": 8, "type": "u32", "is": "lights"}, {"at": 0, "type": "f32", "is": "eye"}]}},
             "/buffers/lists/values/1/at: is 0: byte 8 is one of /buffers/lists/values/0, too"),
            ({"passes__0__push__1__at": 16}, "/passes/0/push/1/at: is 16: its 4 bytes end beyond the 16"),
            ({"passes__0__push__1__at": 8}, "/passes/0/push/1/at: is 8: byte 8 is one of /passes/0/push/0, too"),
            ({"passes__0__push__1": None}, "/passes/0/push: say nothing of byte 12, which the push constants of mine.spv have"),
            ({"lists__0__peer_cell": 1}, r"/lists/0/peer_cell: is not known \(did you mean 'per_cell'\?\); allowed: set, layout"),
            ({"parameters": [{"name": "cells", "summary": "x", "default": 1, "min": 1, "max": 2}]}, "which is a known value or another parameter"),
            ({"parameters": [{"name": "n", "summary": "x", "default": 3, "min": 1, "max": 2}]}, "/parameters/0/default: is 3; allowed: whole numbers from min to max, here 1 to 2"),
        ):
            with self.subTest(message):
                self.refused(changed(METHOD, **change), message)

    def test_files_that_are_none_are_refused(self):
        with Folder() as folder:
            for name, content, message in (("empty.json", "", "is not JSON"), ("list.json", "[]", "/shader_version: is missing"),
                                           ("config.json", "{}", "/shader_version: is missing"),
                                           ("long.json", " " * (1 << 20) + "{}", "allowed: at most 1048576"),
                                           ("deep.json", "[" * 500, "deep|nested"), ("no.json", None, "does not exist")):
                path = folder.file(name, content) if content is not None else f"{folder.path}/no.json"
                _, done = folder.run(configuration(), "--shader", path)
                self.assertEqual(done.returncode, 2, name)
                self.assertRegex(done.stderr, message)
            _, done = folder.run(configuration(), "--shader", folder.path)
            self.assertIn("is a folder, not a file", done.stderr)

    def test_modules_that_are_none_are_refused(self):
        good = None
        with Folder() as folder:
            folder.method(METHOD)
            with open(f"{folder.path}/mine.spv", "rb") as file:
                good = file.read()
            swapped = struct.pack(f">{len(good) // 4}I", *struct.unpack(f"<{len(good) // 4}I", good))
            for content, message in ((b"", "is no SPIR-V: 0 bytes"), (b"#version 450\nvoid main() {}", "is GLSL"),
                                     (b"x" * 64, "begins with 03 02 23 07"), (swapped, "other byte order"),
                                     (good[:-8], "is no SPIR-V|breaks a rule"), (good + b"\0\0\0\0", "is no SPIR-V|breaks a rule")):
                folder.file("mine.spv", content)
                _, done = folder.run(configuration(), "--shader", f"{folder.path}/mine.json")
                self.assertEqual(done.returncode, 2, message)
                self.assertRegex(done.stderr, "mine.spv: .*(" + message + ")")

    def test_modules_that_take_more_than_buffers_are_refused(self):
        image = LOOP.replace("void main() {", "layout(set = 0, binding = 3, r32f) uniform image2D picture;\nvoid main() { imageStore(picture, ivec2(0), vec4(1));")
        self.refused(METHOD, r"has set 0, binding 3 \('picture'\), which is no buffer", source=image)
        arrays = LOOP.replace("buffer Lists { uint lists[]; };", "buffer Lists { uint lists[]; } many[2];").replace("BODY", "many[cell % 2].lists[cell] = 0;")
        self.refused(METHOD, "which is an array; methods have", source=arrays)
        with Folder() as folder:
            path = folder.method(METHOD)
            with open(f"{folder.path}/f.frag", "w") as file:
                file.write("#version 450\nlayout(location=0) out vec4 c;\nvoid main() { c = vec4(1); }\n")
            subprocess.run(["glslangValidator", "-V", "--quiet", "--target-env", "vulkan1.2", "-o", f"{folder.path}/mine.spv", f"{folder.path}/f.frag"], check=True)
            _, done = folder.run(configuration(), "--shader", path)
            self.assertIn("mine.spv has no entry point of a compute shader", done.stderr)

    def ended(self, record, message, body=None, source=LOOP, failed=False, flags=()):
        """The method's case ends with the reason, and the other one is measured."""
        with Folder() as folder:
            result, done = folder.run(configuration(), "--shader", folder.method(record, body, source), "--no-timing", *flags)
        self.assertIsNotNone(result, done.stderr)
        self.assertEqual([case["assigner"]["name"] for case in result["cases"]], ["brute-force"], done.stderr)
        ended = [one for one in result.get("broken" if failed else "skipped", []) if "/mine/" in one["name"] or one["name"].endswith("/mine")]
        self.assertEqual(len(ended), 1, done.stderr)
        self.assertRegex(ended[0]["reason"], message)
        self.assertEqual(done.returncode, 1 if failed else 0, done.stderr)
        self.assertIn("FAILED" if failed else "mine", done.stderr + ended[0]["name"])

    def test_what_no_device_can_do_ends_the_case_before_memory_is_taken(self):
        self.ended(changed(METHOD, buffers__lists__bytes="cells * 1000000000"), r"/buffers/lists/bytes: is \d+ here; .* allows \d+")
        self.ended(changed(METHOD, buffers__lists__bytes="1000000 * 60"), "60\\d+ bytes of a shader's buffers would take .* MiB", flags=("--set", "limits.memory_mib=40"))
        self.ended(changed(METHOD, passes__0__invocations=[2**40]), "makes 17179869184 groups; .* allows")
        self.ended(changed(METHOD, passes__0__constants=[{"id": 5, "is": "4096"}]), "has groups of 4096 x 1 x 1 invocations; .* allows",
                   source=LOOP.replace("local_size_x = 64", "local_size_x_id = 5"))
        more = copy.deepcopy(METHOD)
        more["passes"][0]["push"] += [{"at": 16 + 4 * i, "type": "u32", "is": "lights"} for i in range(100)]
        self.ended(more, "capability|push constants", source=LOOP.replace("uint lights; }", "uint lights; uint more[100]; }"))
        shared = LOOP.replace("void main() {", "shared uint much[1 << 20];\nvoid main() { much[gl_LocalInvocationIndex] = 1;")
        self.ended(METHOD, "has .* bytes for a group to share; mine.spv takes 4194304", source=shared)

    def test_a_description_that_does_not_fit_its_frame_fails_the_run(self):
        """What depends on numbers of the case cannot be refused before; it is no lack of the device."""
        for change, message in (
            ({"passes__0__invocations": ["cells / 7"]}, "allowed: a whole number"),
            ({"buffers__lists__bytes": "-cells"}, r"/buffers/lists/bytes: '-cells' is -\d+ here; allowed: a whole number"),
            ({"buffers__lists__bytes": "cells - cells"}, "/lists/0/rows.*do not fit into buffer 'lists' of 0 bytes"),
            ({"buffers__lights": {"bytes": "64 + lights * 16", "values": [{"at": "columns + 20", "type": "f32", "is": "near"}]}}, "/buffers/lights/values/0/at: is 30: byte 30 is one of /lights/rows/0/fields/\\d, too"),
            ({"buffers__boundaries__values__0__is": "(1 + cells) * 1e300"}, r"/buffers/boundaries/values/0/is: is .*e\+30\d here, which no f32 is"),
            ({"buffers__lights__bytes": 64}, "/lights/rows/0: take .* bytes for .* lights; buffer 'lights' has 64"),
            ({"buffers__boundaries__bytes": 64}, "/buffers/boundaries/values/.*/at: is .* end beyond the 64 that there are"),
            ({"buffers__boundaries__values__1__at": "4 * columns"}, r"/buffers/boundaries/values/1/at: is \d+: byte \d+ is one of /buffers/boundaries/values/0, too"),
            ({"lists__0__rows__stride": 1600}, "/lists/0/rows.*do not fit into buffer 'lists'"),
            ({"lists__0__rows__at": "cells * 900"}, "/lists/0/rows.*do not fit into buffer 'lists'"),
            ({"lists__0__counts__0__at": "slices * 100"}, "/lists/0/counts/0/at: is 800: its 4 bytes end beyond the stride"),
        ):
            with self.subTest(message):
                self.ended(changed(METHOD, **change), message, failed=True)
        big = LOOP.replace("readonly buffer Boundaries { float boundaries[]; }", "readonly buffer Boundaries { float boundaries[4096]; }")
        self.ended(METHOD, "/passes/0/bindings/1: mine.spv reads 16384 bytes there; buffer 'boundaries' has", source=big, failed=True)
        self.refused(changed(METHOD, buffers__boundaries__bytes=4096), "/passes/0/bindings/1: mine.spv reads 16384 bytes there; buffer 'boundaries' has 4096", source=big)

    def test_constants_of_another_type_than_the_modules_are_refused(self):
        source = LOOP.replace("vec2 span", "layout(constant_id = 7) const float scale = 1.0;\nvec2 span", 1).replace("* 1.00001", "* 1.00001 * scale")
        for constant, message in (({"id": 7, "is": "1", "type": "u32"}, "/passes/0/constants/0/type: is u32; constant 7 of mine.spv is f32"),
                                  ({"id": 7, "is": "1"}, "/passes/0/constants/0/type: is missing, which means u32; constant 7 of mine.spv is f32")):
            self.refused(changed(METHOD, passes__0__constants=[constant]), message, source=source)
        with Folder() as folder:
            record = changed(METHOD, passes__0__constants=[{"id": 7, "is": "1", "type": "f32"}])
            result, done = folder.run(configuration(), "--shader", folder.method(record, source=source), "--no-timing")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(case_of(result, "mine")["error"]["false_negatives"], 0)

    def test_formulas_of_lists_are_computed_for_each_case(self):
        """With 1 in place of every number they would not be whole, or below 0."""
        cap = [{"name": "cap", "summary": "x", "default": 796, "min": 64, "max": 1024}]
        for change in ({"parameters": cap, "lists__0__per_cell": "cap / 4"}, {"parameters": cap, "lists__0__per_cell": "cap - 597"},
                       {"lists__0__rows__at": "(slices - 8) * 4"}, {"lists__0__entries__at": "viewport_width / 80"}):
            with self.subTest(change), Folder() as folder:
                path = folder.method(changed(METHOD, **change))
                done = subprocess.run([PROGRAM, "validate", path], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                result, done = folder.run(configuration(), "--shader", path, "--no-timing")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(case_of(result, "mine")["error"]["false_negatives"], 0)

    def test_lists_that_cannot_be_right_fail_their_case_alone(self):
        self.ended(METHOD, r"buffer 'lists', byte \d+, cell \(\d+, \d+, \d+\): count 1000 is above per_cell, 199; \d+ values more",
                   COUNTED.replace("COUNT", "1000"), failed=True)
        self.ended(METHOD, r"byte \d+, cell \(.*\): index \d+ is not below the \d+ lights",
                   COUNTED.replace("COUNT", "count").replace("= light;", "= light + 5000;"), failed=True)

    def test_a_count_above_its_room_names_the_parameter_and_the_key(self):
        record = changed(METHOD, parameters=[{"name": "cap", "summary": "room", "default": 2, "min": 1, "max": 199}])
        record["lists"][0]["per_cell"] = "cap"
        self.ended(record, r"is above per_cell, 2; .*; per_cell is 'cap', of which a parameter can be larger; \"counts_dropped\": true",
                   COUNTED.replace("COUNT", "count"), failed=True)

    def test_writes_beyond_buffers_hurt_nobody(self):
        body = COUNTED.replace("COUNT", "count") + "\n  lists[cell * 200 + 100000000] = 7;\n  lists[0x3fffffff] = 9;"
        with Folder() as folder:
            result, done = folder.run(configuration(), "--shader", folder.method(METHOD, body), "--no-timing")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(case_of(result, "mine")["error"]["false_negatives"], 0)

    def test_lights_that_are_twice_in_a_list_are_counted_and_told(self):
        body = COUNTED.replace("COUNT", "count").replace("++count; }", "++count; if (light % 16 == 0) { lists[cell * 200 + 1 + count] = light; ++count; } }")
        with Folder() as folder:
            result, done = folder.run(configuration(), "--shader", folder.method(METHOD, body), "--no-timing")
        self.assertEqual(done.returncode, 0, done.stderr)
        mine = case_of(result, "mine")
        self.assertGreater(mine["buffers"]["repeated_pairs"], 0)
        self.assertIn("repeated_lights", [warning["kind"] for warning in mine["warnings"]])
        self.assertEqual(mine["error"]["false_negatives"], 0)

    def test_a_shader_that_loses_lights_warns_or_fails_as_it_promises(self):
        body = COUNTED.replace("COUNT", "count").replace("touches(light, cell)", "light % 2 == 0 && touches(light, cell)")
        for promise in (False, True):
            with Folder() as folder:
                result, done = folder.run(configuration(), "--shader",
                                          folder.method({**METHOD, "conservative": promise}, body), "--no-timing")
            mine = case_of(result, "mine")
            self.assertGreater(mine["error"]["false_negatives"], 0)
            self.assertEqual(mine["assigner"]["conservative"], promise)
            self.assertEqual(done.returncode, 1 if promise else 0)

    def test_counts_beyond_the_room_are_dropped_where_the_method_says_so(self):
        small = changed(METHOD, lists__0__per_cell=2, counts_dropped=True)
        with Folder() as folder:
            document = configuration(limits={"dropped_pairs": None})
            result, done = folder.run(document, "--shader", folder.method(small), "--no-timing")
        self.assertEqual(done.returncode, 0, done.stderr)
        mine = case_of(result, "mine")
        self.assertGreater(mine["buffers"]["overflow"]["dropped_pairs"], 0)
        self.assertEqual(mine["occupancy"]["lights_per_cell"]["max"], 2)

    def test_beside_presets_alone_it_runs_nowhere_and_says_so(self):
        done = subprocess.run([PROGRAM, "run", f"{CHECKOUT}/scenes/mix.glb", "--preset", "daveh355", "--shader",
                               f"{SHADERS}/append.json", "--dry-run"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("runs nowhere", done.stderr)


LAYOUTS = {
    "bits": ("""for (uint word = 0; word < (frame.lights + 31) / 32; ++word) {
    uint bits = 0;
    for (uint i = 0; i < 32 && word * 32 + i < frame.lights; ++i) if (touches(word * 32 + i, cell)) bits |= 1u << i;
    lists[cell * ((frame.lights + 31) / 32) + word] = bits;
  }""", {"buffers__lists__bytes": "cells * 4 * light_words",
         "lists": [{"layout": "bits", "rows": {"buffer": "lists", "stride": "4 * light_words"}}]}),
    "linked": ("""uint last = 0xffffffffu;
  for (uint light = 0; light < frame.lights; ++light)
    if (touches(light, cell)) {
      uint node = atomicAdd(lists[0], 1);
      lists[1 + frame.grid.x * frame.grid.y * frame.grid.z + 2 * node] = light;
      lists[2 + frame.grid.x * frame.grid.y * frame.grid.z + 2 * node] = last;
      last = node;
    }
  lists[1 + cell] = last;""", {"buffers__lists__bytes": "4 + cells * 4 + cells * 8 * 100", "buffers__lists__clear": True,
                              "lists": [{"layout": "linked", "rows": {"buffer": "lists", "at": 4, "stride": 4},
                                         "head": {"at": 0, "type": "u32"},
                                         "nodes": {"buffer": "lists", "at": "4 + 4 * cells", "stride": 8,
                                                   "light": {"at": 0, "type": "u32"}, "next": {"at": 4, "type": "u32"}}}]}),
}


class Layouts(unittest.TestCase):
    def test_parts_are_united(self):
        """Even lights in one fixed list, odd ones in another."""
        body = """uint counts[2] = {0, 0};
  for (uint light = 0; light < frame.lights; ++light) {
    uint part = light % 2;
    if (touches(light, cell) && counts[part] < 99) lists[cell * 200 + part * 100 + 1 + counts[part]++] = light;
  }
  lists[cell * 200] = counts[0];
  lists[cell * 200 + 100] = counts[1];"""
        half = {"layout": "fixed", "per_cell": 99, "rows": {"buffer": "lists", "stride": 800}, "counts": [{"at": 0, "type": "u32"}],
                "entries": {"at": 4, "type": "u32"}}
        with Folder() as folder:
            result, done = folder.run(configuration(reading={"rounds": 2, "divisor": 4}), "--shader",
                                      folder.method({**METHOD, "lists": [half, changed(half, counts__0__at=400, entries__at=404)]}, body))
        self.assertEqual(done.returncode, 0, done.stderr)
        mine = case_of(result, "mine")
        self.assertEqual(mine["error"]["false_negatives"], 0)
        self.assertEqual(mine["reading"]["sets"][0]["differing"], 0)

    def test_other_layouts_have_the_same_lists(self):
        for layout, (body, change) in LAYOUTS.items():
            with self.subTest(layout), Folder() as folder:
                record = changed(METHOD, **change)
                result, done = folder.run(configuration(assigners=[{"name": "brute-force", "spot": "range"}]), "--shader",
                                          folder.method(record, body), "--no-timing")
                self.assertEqual(done.returncode, 0, done.stderr)
                mine, twin = case_of(result, "mine"), case_of(result, "brute-force")
                self.assertEqual(mine["error"]["false_negatives"], 0)
                self.assertLess(abs(mine["occupancy"]["pairs"]["mean"] / twin["occupancy"]["pairs"]["mean"] - 1), 1e-3)

    def test_spots_have_an_axis_a_cone_and_a_type(self):
        """A light is listed only if all that is told of it fits together, and no light is lost."""
        told = LOOP.replace("layout(push_constant)", """struct Told { vec3 axis; float cosine; float sine, radians; uint type, index; float squared, inverse; };
layout(std430, set = 0, binding = 3) readonly buffer More { Told told[]; };
bool fits(uint light) {
  Told one = told[light];
  float range = lights[light].w;
  bool shared_part = one.index == light && abs(one.squared - range * range) <= 1e-3 * one.squared && abs(one.inverse * range - 1) < 1e-3;
  bool is_spot = light >= 225;
  if (!is_spot) return shared_part && one.type == 0 && one.axis == vec3(0) && one.cosine == -1;
  return shared_part && one.type == 1 && abs(length(one.axis) - 1) < 1e-3 && one.cosine >= 0 && one.cosine < 1 &&
         abs(one.sine - sin(one.radians)) < 1e-3 && abs(one.cosine - cos(one.radians)) < 1e-3;
}
layout(push_constant)""")
        body = COUNTED.replace("COUNT", "count").replace("touches(light, cell)", "fits(light) && touches(light, cell)")
        fields = [{"at": 0, "type": "f32", "is": "direction"}, {"at": 12, "type": "f32", "is": "cone-cosine"},
                  {"at": 16, "type": "f32", "is": "cone-sine"}, {"at": 20, "type": "f32", "is": "cone-radians"},
                  {"at": 24, "type": "u32", "is": "type"}, {"at": 28, "type": "u32", "is": "index"},
                  {"at": 32, "type": "f32", "is": "range-squared"}, {"at": 36, "type": "f32", "is": "range-inverse"}]
        record = changed(METHOD, buffers__more={"bytes": "lights * 48"})
        record["lights"]["rows"].append({"buffer": "more", "stride": 48, "fields": fields})
        record["passes"][0]["bindings"].append({"binding": 3, "buffer": "more"})
        for name, lost in (("direction", False), ("position", True)):
            record["lights"]["rows"][1]["fields"][0]["is"] = name
            with self.subTest(name), Folder() as folder:
                result, done = folder.run(configuration(), "--shader", folder.method(record, body, told), "--no-timing")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(case_of(result, "mine")["error"]["false_negatives"] > 0, lost)

    def test_conventions_of_space_order_and_depth(self):
        """World-space lights turned by the view matrix: by rows and looking along +z it is the same frame."""
        source = LOOP.replace("uint lights; } frame;", "uint lights; } frame;\nlayout(std140, set = 0, binding = 3) uniform View { mat4 view; };")
        source = source.replace("vec3 apart = lights[light].xyz - clamp(lights[light].xyz,", "vec3 center = CENTER;\n  vec3 apart = center - clamp(center,")
        for camera, center in (({}, "(view * vec4(lights[light].xyz, 1)).xyz"),
                               ({"order": "rows"}, "(vec4(lights[light].xyz, 1) * view).xyz"),
                               ({"forward": "+z"}, "(view * vec4(lights[light].xyz, 1)).xyz * vec3(1, 1, -1)"),
                               ({"forward": "+z"}, "lights[light].xyz * vec3(1, 1, -1) /* turned */ + 0 * view[0].xyz")):
            record = changed(METHOD, camera=camera, lights__space="view" if "turned" in center else "world",
                             buffers__view={"bytes": 64, "values": [{"at": 0, "type": "f32", "is": "world_to_view"}]})
            record["passes"][0]["bindings"].append({"binding": 3, "buffer": "view"})
            with self.subTest(camera), Folder() as folder:
                result, done = folder.run(configuration(), "--shader",
                                          folder.method(record, source=source.replace("CENTER", center)), "--no-timing")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(case_of(result, "mine")["error"]["miss_ratio"], 0)


if __name__ == "__main__":
    if not has_device() or shutil.which("glslangValidator") is None:
        print("skipped: no device, or no glslangValidator")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
