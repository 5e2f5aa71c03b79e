#!/usr/bin/env python3
"""Shaders of users (--shader) that cannot be right, on the driver of the environment: JSON, modules, sizes and lists.

  tests/gpu/test_shader_faults.py CLUSTERBENCH CHECKOUT
"""
import copy
import json
import struct
import subprocess
import unittest

from own_shader import CHECKOUT, COUNTED, LOOP, METHOD, PROGRAM, SHADERS, Folder, case_of, changed, configuration, main


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

    def test_work_that_goes_on_after_a_signal_is_left_behind(self):
        endless = "for (uint x = cell; lists[0] != 0xfffffff0u; ++x) lists[x % 800u] = x & 1u;"
        with Folder() as folder:
            config = folder.file("config.json", json.dumps(configuration(assigners=["brute-force"])))
            command = [PROGRAM, "run", config, "--shader", folder.method(METHOD, endless), "--no-timing", "-o", f"{folder.path}/result.json"]
            with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as run:
                try:
                    _, said = run.communicate(timeout=8)
                    self.assertIn(run.returncode, (0, 1), said)  # this driver ends loops itself
                    return
                except subprocess.TimeoutExpired:
                    run.terminate()
                try:
                    _, said = run.communicate(timeout=60)
                except subprocess.TimeoutExpired:
                    run.kill()
                    self.fail("goes on after the signal")
        self.assertEqual(run.returncode, 75, said)
        self.assertRegex(said, "interrupted")

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


if __name__ == "__main__":
    main()
