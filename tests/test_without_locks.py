#!/usr/bin/env python3
"""Runs that write to one file on a disk without locks, as some network disks are: one at a time, and the others say why.
flock() of the system is replaced by one that fails as there. Exit code 77 with a sentence without a C compiler.

usage: test_without_locks.py PROGRAM SCENE"""

import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

NO_LOCKS = """#include <errno.h>
int flock(int file, int how) { (void)file; (void)how; errno = ENOLCK; return -1; }
"""


def expect(holds, what):
    if not holds:
        sys.exit(f"FAILED: {what}")


class Runs:
    def __init__(self, folder, program, scene, preload):
        self.folder = folder
        self.command = [program, "run", scene, "-q", "--rounds", "3", "--filter", "64px x 16.*exact-fast", "-o", "r.json"]
        self.environment = {"LD_PRELOAD": str(preload), "PATH": "/usr/bin:/bin"}

    def start(self):
        return subprocess.Popen(self.command, cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True)

    def start_and_wait_for_lock(self):
        run = self.start()
        for _ in range(600):
            if (self.folder / "r.json.partial.lock").exists() or run.poll() is not None:
                break
            time.sleep(0.05)
        expect((self.folder / "r.json.partial.lock").exists(), "a lock stands beside the file")
        return run

    def run(self):
        run = self.start()
        _, said = run.communicate(timeout=300)
        return run.returncode, said


def main():
    compiler = shutil.which("cc")
    if compiler is None:
        print("skipped: no C compiler")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "no_locks.c").write_text(NO_LOCKS, encoding="utf-8")
        subprocess.run([compiler, "-shared", "-fPIC", "no_locks.c", "-o", "no_locks.so"], cwd=folder, check=True)
        runs = Runs(folder, pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), folder / "no_locks.so")
        lock = folder / "r.json.partial.lock"

        first = runs.start_and_wait_for_lock()
        code, said = runs.run()
        expect(code == 2, f"a second run is refused, and not {code}: {said}")
        expect(f"r.json.partial: another run is writing here: process {first.pid} on {socket.gethostname()}. This disk has no locks" in said,
               f"it says whose lock that is: {said}")
        expect(first.wait(timeout=300) == 0 and (folder / "r.json").exists(), "the first run ends well")
        expect(not lock.exists(), "it leaves no lock")

        killed = runs.start_and_wait_for_lock()
        killed.send_signal(signal.SIGKILL)
        killed.wait()
        expect(lock.exists(), "a killed run leaves its lock")
        code, said = runs.run()
        expect(code == 0 and not lock.exists(), f"the lock of a dead process of this host is taken over: {said}")

        lock.write_text("elsewhere 1\n", encoding="utf-8")
        code, said = runs.run()
        expect(code == 2 and "process 1 on elsewhere" in said, f"that of another host stays: {said}")
        expect(lock.read_text(encoding="utf-8") == "elsewhere 1\n", "and is left as it is")


if __name__ == "__main__":
    main()
