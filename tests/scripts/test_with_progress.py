#!/usr/bin/env python3
"""scripts/with_progress and scripts/run: what somebody sees while a build goes on. Usage: test_with_progress.py"""
import os
import pathlib
import pty
import subprocess
import sys
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEPS = "for i in 1 2 3 4 5 6; do echo \"[$i/12] Building x\"; sleep 0.4; done; "


def run(script, seconds="1"):
    return subprocess.run(
        [ROOT / "scripts/with_progress", "Building", "bash", "-c", script],
        env=os.environ | {"CLUSTERBENCH_PROGRESS_SECONDS": seconds}, capture_output=True, text=True, timeout=60)


class WithProgress(unittest.TestCase):
    def test_a_log_gets_lines_that_say_what_is_done_and_what_is_left(self):
        result = run(STEPS)
        self.assertEqual((result.returncode, result.stdout), (0, ""))
        self.assertRegex(result.stderr, r"Building, \d+ s so far: \d+ of 12 steps done, \d+ left, about \d+ s\n")
        self.assertEqual(len(result.stderr.splitlines()), 2)

    def test_a_command_without_steps_still_says_that_it_goes_on(self):
        self.assertRegex(run("sleep 1.5").stderr, r"\A(Building, \d s so far\n)+\Z")

    def test_what_succeeds_within_the_interval_says_nothing(self):
        self.assertEqual(run("echo much; echo more >&2", "30").stderr, "")

    def test_what_fails_shows_its_output_without_the_steps_and_keeps_its_code(self):
        result = run("echo '[1/2] Building x'; echo 'x.cpp:1: error: no'; exit 3", "30")
        self.assertEqual((result.returncode, result.stderr), (3, "x.cpp:1: error: no\n"))

    def test_a_reader_of_its_output_does_not_wait_after_it_ends(self):
        begin = time.monotonic()
        run("true", "30")
        self.assertLess(time.monotonic() - begin, 10)

    def test_a_terminal_gets_one_line_that_is_wiped_at_the_end(self):
        parent, child = pty.openpty()
        subprocess.run([ROOT / "scripts/with_progress", "Building", "bash", "-c", STEPS], stderr=child, timeout=60, check=True)
        os.close(child)
        shown = b""
        try:
            while chunk := os.read(parent, 4096):
                shown += chunk
        except OSError:  # all was read
            pass
        self.assertNotIn(b"\n", shown)
        self.assertRegex(shown, rb"\rBuilding, \d+ s so far: ")
        self.assertTrue(shown.endswith(b"\r\033[K"))


if __name__ == "__main__":
    sys.exit(unittest.main())
