#!/usr/bin/env python3
"""scripts/gpu_check in a folder that --pack made: which libraries it puts before the machine's. The program is a stand-in."""
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
  run) echo "libraries: $LD_LIBRARY_PATH";;
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

    def libraries(self, **environment):
        own = {name: value for name, value in os.environ.items() if name != "LD_LIBRARY_PATH"}
        done = subprocess.run([self.folder / "gpu_check"], env={**own, **environment}, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout.strip().removeprefix("libraries: ").split(":")

    def test_the_machines_own_runtime_of_cpp_comes_first(self):
        self.assertEqual(self.libraries(), [str(self.folder / "lib")])
        self.assertEqual(self.libraries(LD_LIBRARY_PATH="/opt/x"), [str(self.folder / "lib"), "/opt/x"])

    def test_ours_does_where_the_machines_is_too_old_for_the_program(self):
        self.assertEqual(self.libraries(TOO_OLD="yes"), [str(self.folder / "lib/runtime"), str(self.folder / "lib")])


if __name__ == "__main__":
    unittest.main()
