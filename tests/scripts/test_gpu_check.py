#!/usr/bin/env python3
"""scripts/gpu_check in a folder that --pack made: its runs, and the libraries that it puts before
the machine's. The program is a stand-in."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Does not start without a library of lib/runtime if the machine's is too old; `run` tells where libraries come from.
PROGRAM = """#!/bin/sh
case "$TOO_OLD:$LD_LIBRARY_PATH" in yes:*/lib/runtime*) ;; yes:*) echo "version GLIBCXX_9 not found" >&2; exit 1;; esac
case "$1" in
  run) shift; echo "run $* with $LD_LIBRARY_PATH"; sleep "${RUNS_S:-0}";;
  --version | list) ;;
  *) echo "no command '$1'" >&2; exit 2;;
esac
"""


class Packed(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("bin", "lib/runtime", "configs"):
            (self.folder / name).mkdir(parents=True)
        shutil.copy(ROOT / "scripts" / "gpu_check", self.folder / "gpu_check")
        program = self.folder / "bin" / "clusterbench"
        program.write_text(PROGRAM)
        program.chmod(0o755)

    def runs(self, *options, rc=0, **environment):
        own = {name: value for name, value in os.environ.items() if name != "LD_LIBRARY_PATH"}
        done = subprocess.run([self.folder / "gpu_check", *options], env={**own, **environment}, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, cwd=self.folder)
        self.assertEqual(done.returncode, rc, done.stdout)
        return [line.removeprefix("run ") for line in done.stdout.splitlines() if line.startswith("run ")]

    def libraries(self, **environment):
        (libraries,) = {run.split(" with ")[1] for run in self.runs(**environment)}
        return libraries.split(":")

    def test_both_configurations_are_run_with_the_options_that_are_given(self):
        configs = self.folder / "configs"
        for options, out in ([], "gpu"), (["-o", "a.json"], "a"), (["--output=b.json"], "b"):
            runs = [run.split(" with ")[0] for run in self.runs(*options, "--device", "RTX 4090")]
            self.assertEqual(runs, [f"{configs}/gpu.json -o {out}.json --device RTX 4090",
                                    f"{configs}/gpu-reading.json -o {out}-reading.json --device RTX 4090"])

    def test_the_time_is_that_of_both(self):
        self.assertEqual(len(self.runs(rc=124, TIMEOUT_S="1", RUNS_S="20")), 1)

    def test_the_machines_own_runtime_of_cpp_comes_first(self):
        self.assertEqual(self.libraries(), [str(self.folder / "lib")])
        self.assertEqual(self.libraries(LD_LIBRARY_PATH="/opt/x"), [str(self.folder / "lib"), "/opt/x"])

    def test_ours_does_where_the_machines_is_too_old_for_the_program(self):
        self.assertEqual(self.libraries(TOO_OLD="yes"), [str(self.folder / "lib/runtime"), str(self.folder / "lib")])


if __name__ == "__main__":
    unittest.main()
