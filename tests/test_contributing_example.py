#!/usr/bin/env python3
"""Does the assigner that CONTRIBUTING.md writes out compile? tests/test_contributing_example.py COMPILER [FLAG...]

--write FILE writes it there instead, for tests that run it.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def main():
    page = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    found = re.search(r"This is all of `src/(\S+\.cpp)`:\n\n```cpp\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    if not found:
        sys.exit("CONTRIBUTING.md has no example under 'This is all of `src/...cpp`:'")
    if sys.argv[1] == "--write":
        pathlib.Path(sys.argv[2]).write_text(found[2], encoding="utf-8")
        return
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / pathlib.Path(found[1]).name
        source.write_text(found[2], encoding="utf-8")
        command = [*sys.argv[1:], "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", f"-I{ROOT / 'src'}", source]
        sys.exit(subprocess.run(command, check=False).returncode)


if __name__ == "__main__":
    main()
