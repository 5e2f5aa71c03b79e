#!/usr/bin/env python3
"""Shaders of users (--shader) through the program, on the driver of the environment: those of configs/shaders, which are
held against their sources, and all layouts of lists and conventions of cameras.

  tests/gpu/test_user_shaders.py CLUSTERBENCH CHECKOUT
"""
import json
import os
import shutil
import subprocess
import unittest

from own_shader import CHECKOUT, COUNTED, GRID, LOOP, METHOD, PROGRAM, SHADERS, TUTORIAL_GRID, Folder, case_of, changed, compiled, configuration, main


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
        self.assertRegex(done.stderr, r"lost [0-9]+ of [0-9]+ true pairs.*it fails nothing, since the shader's JSON has no \"conservative\": true")

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
    main()
