#!/usr/bin/env python3
"""The SPIR-V that the build embeds is valid, and leaves no decision to a driver: tests/gpu/test_shaders.py FOLDER, where FOLDER
has the headers that the build made (build/release/spirv). That the check would notice is shown on changed shaders."""
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import shader_modules  # noqa: E402

HEADERS = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else ROOT / "build" / "release" / "spirv"
SHADERS = sorted(path.stem for path in shader_modules.SHADERS.glob("*.comp"))
TOOLS = ["glslangValidator", "spirv-dis", "spirv-val"]


class Embedded(unittest.TestCase):
    def modules(self):
        with tempfile.TemporaryDirectory() as folder:
            for shader in SHADERS:
                for variant in shader_modules.VARIANTS:
                    words = shader_modules.words_of_header(HEADERS / f"{shader}_{variant}.h")
                    yield shader, variant, shader_modules.written(words, folder, f"{shader}_{variant}")

    def test_every_shader_is_valid_rounds_as_it_says_and_has_no_arithmetic_that_a_driver_may_change(self):
        for shader, variant, module in self.modules():
            with self.subTest(shader=shader, variant=variant):
                self.assertEqual(shader_modules.faults_of(module, shader, variant), [])

    def test_both_variants_have_the_same_instructions(self):
        def instructions(module):
            lines = shader_modules.disassembled(module).splitlines()
            return [re.sub(r"%\d+", "%", line) for line in lines
                    if not re.search(r"^;|OpCapability|OpExtension|OpExecutionMode|OpSource|OpString|OpName", line)]

        modules = {(shader, variant): instructions(module) for shader, variant, module in self.modules()}
        for shader in SHADERS:
            self.assertEqual(modules[shader, "plain"], modules[shader, "to_nearest"], shader)

    def test_how_shaders_round_is_said_in_one_file(self):
        files = [file.name for file in shader_modules.SHADERS.iterdir() if "spirv_execution_mode" in file.read_text()]
        self.assertEqual(files, ["rounding.glsl"])

    def test_names_of_those_that_decide_nothing_are_shaders_with_a_reason(self):
        for shader, reason in shader_modules.DECIDE_NOTHING.items():
            self.assertTrue(any(name.startswith(shader) for name in SHADERS), shader)
            self.assertGreater(len(reason), 20)


class Changed(unittest.TestCase):
    """Copies of the shaders with one change each."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.shaders = pathlib.Path(self.folder.name) / "shaders"
        shutil.copytree(shader_modules.SHADERS, self.shaders)

    def compile(self, shader):
        module = self.shaders / f"{shader}.spv"
        self.assertEqual(shader_modules.compiled(self.shaders / f"{shader}.comp", "to_nearest", module), "")
        return module

    def users_of(self, file):
        """The shaders to look at after a change of this file."""
        return [file.stem] if file.suffix == ".comp" else [{"around": "bounds", "tile": "tile_lights", "apart": "group"}.get(file.stem, "cells")]

    def test_a_precise_that_is_missing_is_found(self):
        for file in sorted(self.shaders.glob("*.*")):
            text = file.read_text()
            if file.stem.startswith("read") or "precise " not in text:
                continue
            found = []
            for place in re.finditer(r"^\s*precise ", text, re.M):
                file.write_text(text[:place.start()] + text[place.end():])
                for shader in self.users_of(file):
                    found.append(shader_modules.faults_of(self.compile(shader), shader, "to_nearest") != [])
            file.write_text(text)
            # glslang hands `precise` on to what a result is computed from, so that some of them say nothing new.
            self.assertGreaterEqual(sum(found), len(found) / 3, f"{file.name}: {found}")

    def test_a_function_without_any_precise_is_found(self):
        text = (self.shaders / "common.glsl").read_text()
        for function in ("ball_touches_box", "size_of", "cone_touches_ball"):
            begin = text.index(f"{function}(")
            end = text.index("\n}", begin)
            body = text[begin:end]
            self.assertIn("precise", body)
            (self.shaders / "common.glsl").write_text(text[:begin] + body.replace("precise ", "") + text[end:])
            module = self.compile("cells")
            self.assertNotEqual(shader_modules.faults_of(module, "cells", "to_nearest"), [], function)

    def test_functions_whose_error_is_the_drivers_are_found(self):
        common = self.shaders / "common.glsl"
        text = common.read_text()
        old = "squared <= reach;"
        self.assertEqual(text.count(old), 1)
        for new, name in (("sqrt(squared) <= ball.w;", "Sqrt"), ("squared / ball.w <= ball.w;", "OpFDiv"),
                          ("length(vec3(x, y, z)) <= ball.w;", "Length"), ("dot(ball.xyz, ball.xyz) <= reach;", "OpDot"),
                          ("fma(x, x, squared) <= reach;", "Fma"), ("inversesqrt(squared) >= ball.w;", "InverseSqrt"),
                          ("distance(lo, hi) <= reach;", "Distance"), ("normalize(hi).x <= reach;", "Normalize"),
                          ("mix(x, y, z) <= reach;", "FMix"), ("exp2(x) <= reach;", "Exp2"), ("x + y <= reach;", "OpFAdd")):
            common.write_text(text.replace(old, new))
            faults = shader_modules.faults_of(self.compile("cells"), "cells", "to_nearest")
            self.assertTrue(any(name in fault for fault in faults), f"{new} gave {faults}")

    def test_bits_that_are_set_without_an_atomic_operation_are_found(self):
        for shader, old, new in (("mask", "atomicOr(bits[first / 32], ballot.x << (first % 32));", "bits[first / 32] |= ballot.x << (first % 32);"),
                                 ("group", "atomicOr(kept_bits[lane / 32], 1u << (lane % 32));", "kept_bits[lane / 32] |= 1u << (lane % 32);"),
                                 ("lights", "atomicOr(masks[cell.index * frame.words + light / 32], 1u << (light % 32));",
                                  "masks[cell.index * frame.words + light / 32] |= 1u << (light % 32);")):
            file = self.shaders / f"{shader}.comp"
            self.assertIn(old, file.read_text())
            file.write_text(file.read_text().replace(old, new))
            faults = shader_modules.faults_of(self.compile(shader), shader, "to_nearest")
            self.assertTrue(any("atomicOr" in fault for fault in faults), f"{shader}: {faults}")

    def test_rounding_that_is_not_asked_for_is_found(self):
        file = self.shaders / "rounding.glsl"
        text = file.read_text()
        file.write_text(re.sub(r"^spirv_execution_mode.*4462.*\n", "", text, flags=re.M))
        for shader in ("cells", "read_packed"):
            faults = shader_modules.faults_of(self.compile(shader), shader, "to_nearest")
            self.assertTrue(any("RoundingModeRTE" in fault for fault in faults), faults)


if __name__ == "__main__":
    missing = [name for name in TOOLS if shutil.which(name) is None]
    if missing or not HEADERS.is_dir():
        print(f"skipped: this machine lacks {', '.join(missing) or HEADERS} (Debian: glslang-tools, spirv-tools)")
        sys.exit(77)
    unittest.main()
