#!/usr/bin/env python3
"""scripts/renderdoc/dump_buffers.py: test_renderdoc.py CLUSTERBENCH [LIGHT_GRID]. A program that clusters lights (tests/renderdoc)
is captured on lavapipe, and its buffers go from the capture to a verdict; and a stand-in for later versions of RenderDoc."""

import contextlib
import glob
import io
import json
import os
import pathlib
import re
import runpy
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from types import SimpleNamespace

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "renderdoc" / "dump_buffers.py"
SYSTEM_PYTHON = "/usr/bin/python3"  # the one that Debian's module is for
PROGRAM = LIGHT_GRID = None


def run(command, **environment):
    return subprocess.run(command, env={**os.environ, **environment}, capture_output=True, text=True, timeout=120)


def run_with_renderdoc(command, **environment):
    """RenderDoc itself, with a driver that computes on all processors, has been ended by a signal once in thousands of runs: such a
    run is made again."""
    for _ in range(3):
        done = run(command, PYTHONFAULTHANDLER="1", **environment)
        if done.returncode >= 0:
            break
        print(f"{command[0]} was ended by signal {-done.returncode}\n{done.stderr}", file=sys.stderr)
    return done


def with_comments(path):
    """The JSON of a dump whose comments stand at the end of lines."""
    return json.loads(re.sub(r"//[^\n]*", "", path.read_text()))


def obstacle():
    """Why nothing can be captured here; None: it can."""
    drivers = glob.glob("/usr/share/vulkan/icd.d/lvp_icd*.json")
    if LIGHT_GRID is None:
        return "tests/renderdoc/light_grid.cpp was not built: Vulkan's headers, volk or glslangValidator are missing"
    if shutil.which("renderdoccmd") is None or run([SYSTEM_PYTHON, "-c", "import renderdoc"]).returncode != 0:
        return "renderdoc and python3-renderdoc are not installed"
    return None if drivers else "lavapipe is not installed"


def lavapipe():
    driver = glob.glob("/usr/share/vulkan/icd.d/lvp_icd*.json")[0]
    return {"VK_DRIVER_FILES": driver, "VK_ICD_FILENAMES": driver}


class Folders(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def check(self, dump):
        path = self.folder / "filled.json"
        path.write_text(json.dumps(dump))
        out = self.folder / "out.json"
        done = run([PROGRAM, "check", path, "--json", out])
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return json.loads(out.read_text())["frames"][0]["sets"][0]


class OfACapture(Folders):
    def setUp(self):
        super().setUp()
        if obstacle():
            self.skipTest(obstacle())

    def captured(self):
        # As `renderdoccmd capture` does, which fails where the program ends before it has looked for it.
        capture = {"ENABLE_VULKAN_RENDERDOC_CAPTURE": "1", "RENDERDOC_CAPFILE": str(self.folder / "grid")}
        done = run_with_renderdoc([LIGHT_GRID], **lavapipe(), **capture)
        found = list(self.folder.glob("*.rdc"))
        self.assertEqual(len(found), 1, done.stdout + done.stderr)
        return found[0]

    def script(self, *options):
        return run_with_renderdoc([SYSTEM_PYTHON, SCRIPT, *options], **lavapipe())

    def filled(self, path):
        """What the script leaves to the user, as the program has it."""
        dump = with_comments(path)
        dump["viewport"] = [1280, 720]
        dump["camera"] = {"sides": [-1, 1, -0.5625, 0.5625], "near_m": 0.25, "far_m": 40}
        dump["grid"] = {"tiles": {"count": [16, 9]}, "slices": {"scheme": "exponential", "count": 12}}
        dump["lights"]["space"] = "view"
        return dump

    def test_lists_come_from_a_capture_to_the_verdict_that_none_is_lost(self):
        capture = self.captured()
        listed = self.script(capture)
        self.assertEqual(listed.returncode, 0, listed.stderr)
        event = int(re.search(r"event (\d+): vkCmdDispatch", listed.stdout)[1])
        self.assertRegex(listed.stdout, r"storage 'Lights\w*': buffer 'lights in view space', 960 bytes")
        written = self.script(capture, "--event", str(event), "-o", self.folder / "frame.json")
        self.assertEqual(written.returncode, 0, written.stderr)
        dump = self.filled(self.folder / "frame.json")
        found = self.check(dump)
        self.assertEqual(found["verdict"], "right", found)
        self.assertEqual(found["error"]["lost_pairs"], 0)
        self.assertGreater(found["error"]["true_pairs"], 1000)
        pairs = int(run([LIGHT_GRID], **lavapipe()).stdout)
        self.assertEqual(found["error"]["listed_pairs"], pairs, "as the program itself counts them")

        cells = self.folder / dump["buffers"][dump["lists"][0]["rows"]["buffer"]]["file"]
        rows = bytearray(cells.read_bytes())
        longest = max(range(0, len(rows), 132), key=lambda at: struct.unpack_from("<I", rows, at)[0])
        struct.pack_into("<I", rows, longest, 0)
        cells.write_bytes(rows)
        lost = self.check(dump)
        self.assertEqual(lost["verdict"], "lost")
        self.assertTrue(all(row["row"] == longest // 132 for row in lost["lost"]))

    def test_methods_of_ours_lose_none_in_their_captures(self):
        for method in ("gpu-cells", "gpu-group", "gpu-lights", "gpu-mask"):
            with self.subTest(method):
                self.judge_captured(method)

    def judge_captured(self, method):
        """The lists that lie in the device's buffers, held against the camera, the grid and the lights that the program writes."""
        folder = self.folder / method
        done = run_with_renderdoc(
            [PROGRAM, "run", ROOT / "scenes" / "street.glb", "--assigner", method, "--grid", "frustum", "--tiles", "16x9t", "--slices", "24",
             "--scheme", "exponential", "--set", "scenes.*.frames=1", "--no-timing", "--write-dump", folder],
            **lavapipe(), ENABLE_VULKAN_RENDERDOC_CAPTURE="1", RENDERDOC_CAPFILE=str(self.folder / f"{method}-gpu"))
        self.assertEqual(done.returncode, 0, done.stderr)
        told = re.findall(r"RenderDoc's capture of (.+): (.+\.rdc)", done.stderr)
        self.assertEqual({file for _, file in told}, {str(file) for file in self.folder.glob(f"{method}-gpu*.rdc")}, done.stderr)
        shaders, capture = told[-1]  # those before are of probes
        self.assertIn(method.removeprefix("gpu-"), shaders)
        listed = self.script(capture)
        self.assertEqual(listed.returncode, 0, listed.stderr)
        event = int(re.findall(r"event (\d+): vkCmdDispatch", listed.stdout)[-1])
        written = self.script(capture, "--event", str(event), "-o", self.folder / f"{method}.json")
        self.assertEqual(written.returncode, 0, written.stderr)
        captured = {name.split("_")[0]: row for name, row in with_comments(self.folder / f"{method}.json")["buffers"].items()}
        ours = json.loads(next(folder.glob("*.json")).read_text())
        as_written = self.check({**ours, "buffers": {name: {"file": str(folder / row["file"])} for name, row in ours["buffers"].items()}})
        dump = dict(ours)
        dump["buffers"] = {"lights": {"file": str(folder / ours["buffers"]["lights"]["file"])}, "Begins": captured["Begins"],
                           "Lists": captured["Lists"]}
        field = {"type": "u32"}
        dump["lists"] = [{"layout": "packed", "rows": {"buffer": "Begins", "stride": 4}, "offset": {"at": 0, **field},
                          "end": {"at": 4, **field}, "entries": {"buffer": "Lists", **field}}]
        found = self.check(dump)
        self.assertEqual((found["verdict"], found["error"]["lost_pairs"]), ("right", 0), found)
        self.assertGreater(found["error"]["true_pairs"], 1000)
        self.assertEqual(found["error"], as_written["error"], "in the capture as in what was read back")

    def test_what_cannot_be_is_a_sentence(self):
        capture = self.captured()
        other = self.folder / "other.rdc"
        other.write_text("no capture")
        rows = [
            ([self.folder / "nowhere.rdc"], "nowhere.rdc: does not exist"),
            ([other], "other.rdc: is no capture that this RenderDoc opens"),
            ([capture, "--event", "1", "-o", self.folder / "x.json"], "--event: 1 is no dispatch or draw of "),
            ([capture, "--event", "8", "-o", self.folder / "no" / "x.json"], "No such file or directory"),
            ([capture, "--event", "8"], "--event and -o stand together"),
        ]
        for options, wanted in rows:
            done = self.script(*options)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(wanted, done.stderr)
            self.assertNotIn("Traceback", done.stderr)


class OfLaterVersions(Folders):
    def script(self, *options, module="newer"):
        return run([sys.executable, SCRIPT, *options], PYTHONPATH=str(ROOT / "tests" / "renderdoc" / module))

    def test_buffers_are_found_by_their_descriptors(self):
        capture = self.folder / "frame.rdc"
        capture.write_bytes(b"RDOC")
        listed = self.script(capture)
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertIn("event 4: vkCmdDispatch(1, 1, 1)\n", listed.stdout)
        self.assertIn("compute read only 'Lights': buffer 'lights', 32 bytes from byte 32 on", listed.stdout)
        self.assertNotIn("picture", listed.stdout)
        written = self.script(capture, "--event", "4", "-o", self.folder / "frame.json")
        self.assertEqual(written.returncode, 0, written.stderr)
        text = (self.folder / "frame.json").read_text()
        self.assertIn("2 rows of 16 bytes", text)
        self.assertIn("//   byte 0: view, f32 x 16", text)
        dump = with_comments(self.folder / "frame.json")
        dump["viewport"] = [64, 64]
        dump["camera"] = {"sides": [-1, 1, -1, 1], "near_m": 1, "far_m": 20}
        dump["grid"] = {"tiles": {"count": [1, 1]}, "slices": {"boundaries_m": [1, 8, 20]}}
        dump["lights"]["space"] = "view"
        found = self.check(dump)
        self.assertEqual(found["verdict"], "lost", "light 1 begins at 6 m, and is listed from 8 m on")
        self.assertEqual([(row["light"], row["row"]) for row in found["lost"]], [(1, 0)])

    def test_in_renderdocs_window_the_selected_event_is_written_beside_the_capture(self):
        sys.path.insert(0, str(ROOT / "tests" / "renderdoc" / "newer"))
        import renderdoc

        def window(event):
            replay = SimpleNamespace(BlockInvoke=lambda call: call(renderdoc.Controller()))
            name = str(self.folder / "frame.rdc")
            return SimpleNamespace(GetCaptureFilename=lambda: name, CurEvent=lambda: event, Replay=lambda: replay)

        with contextlib.redirect_stdout(io.StringIO()) as said:
            runpy.run_path(str(SCRIPT), {"pyrenderdoc": window(4)}, "__main__")
            runpy.run_path(str(SCRIPT), {"pyrenderdoc": window(5)}, "__main__")
        self.assertEqual(with_comments(self.folder / "frame.event-4.json")["lists"][0]["rows"]["stride"], 12)
        self.assertIn("--event: 5 is no dispatch or draw of ", said.getvalue())

    def test_without_the_module_it_says_what_to_install(self):
        done = self.script(self.folder / "x.rdc", module="nowhere")
        if done.returncode != 2 or "does not exist" in done.stderr:
            self.skipTest("this python3 has RenderDoc's module")
        self.assertIn("install python3-renderdoc", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv[1]).resolve()
    if len(sys.argv) > 2 and os.path.exists(sys.argv[2]):
        LIGHT_GRID = pathlib.Path(sys.argv[2]).resolve()
    unittest.main(argv=sys.argv[:1])
