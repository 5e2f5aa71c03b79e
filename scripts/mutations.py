#!/usr/bin/env python3
"""Checks that the tests find wrong code: scripts/mutations.py [--only NAME...] [--list] [--table] [--write] [--jobs N].

Makes each wrong change of scripts/mutation_table.py in a copy of the tree (build/mutations), builds the one test program
that should find it and runs the one test that the table names. A change that its test passes has survived: exit code 1.
Names may be patterns (--only 'cone-*'). --table prints the table for docs/accuracy.md, --write puts it there.
"""
import argparse
import collections
import fnmatch
import os
import pathlib
import re
import subprocess
import sys
import time

from mutation_table import MUTATIONS

ROOT = pathlib.Path(__file__).resolve().parent.parent
TREE = ROOT / "build" / "mutations"
BUILD = TREE / "build"
FOLDERS = ["cmake", "configs", "scenes", "src", "tests"]  # tests read scenes and configurations
ACCURACY = ROOT / "docs" / "accuracy.md"
BEGIN, END = "<!-- mutations -->", "<!-- /mutations -->"
TEST_TIMEOUT_S = 300


class Broken(Exception):
    """Nothing can be said about a mutation: the table, the build or a test without mutation is wrong."""


def program_of(mutation):
    return "test_" + mutation.test.split(".")[0]


def filter_of(mutation):
    test = mutation.test.split(".", 1)[1]
    return f"{test}:*/{test}/*"  # the second is what a test with parameters is called


def mutated(mutation, text):
    count = text.count(mutation.old)
    if count != 1:
        raise Broken(f"src/{mutation.file} has the old text {count} times, not once")
    return text.replace(mutation.old, mutation.new)


def test_exists(mutation, root=ROOT):
    layer, suite, name = mutation.test.split(".")
    declared = re.compile(rf"^TEST(_F|_P)?\({suite}, {name}\)", re.M)
    return any(declared.search(path.read_text()) for path in (root / "tests" / layer).glob("*.cpp"))


# --- The copy of the tree ---

def files_of(root):
    paths = [root / "CMakeLists.txt", root / "LICENSE", root / "CONTRIBUTING.md"]
    for folder in FOLDERS:
        paths += [path for path in sorted((root / folder).rglob("*")) if path.is_file() and path.suffix != ".pyc"]
    return {path.relative_to(root) for path in paths}


def copy_tree():
    """Touches only files that differ, so that what was built stays built."""
    wanted = files_of(ROOT)
    for path in files_of(TREE) - wanted if TREE.exists() else []:
        (TREE / path).unlink()
    for path in wanted:
        text, target = (ROOT / path).read_bytes(), TREE / path
        if not target.exists() or target.read_bytes() != text:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(text)


def run(command, **options):
    # With paths relative to the tree ccache finds what was built elsewhere.
    environment = dict(os.environ, CCACHE_BASEDIR=str(TREE), CCACHE_NOHASHDIR="1")
    return subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", **options)


def build(programs, jobs):
    done = run(["cmake", "--build", str(BUILD), "-j", str(jobs), "--target", *programs])
    if done.returncode != 0:
        raise Broken("does not build:\n" + done.stdout[-4000:])


def failure_of(program, test_filter):
    """How the tests failed, or None if they passed."""
    try:
        done = run([str(BUILD / "tests" / program), f"--gtest_filter={test_filter}", "--gtest_brief=1"],
                   timeout=TEST_TIMEOUT_S, cwd=TREE)
    except subprocess.TimeoutExpired:
        raise Broken(f"{test_filter} does not end") from None
    if "[==========] 0 tests" in done.stdout:
        raise Broken(f"{program} has no test {test_filter}")
    if done.returncode == 0:
        return None
    return "caught" if "[  FAILED  ]" in done.stdout else f"crashed ({done.returncode})"


def prepare(mutations, jobs):
    copy_tree()
    configured = run(["cmake", "-S", str(TREE), "-B", str(BUILD), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                      "-DCLUSTERBENCH_BENCHMARKS=OFF", "-DCLUSTERBENCH_WERROR=OFF"])
    if configured.returncode != 0:
        raise Broken("cannot be configured:\n" + configured.stdout)
    tests = collections.defaultdict(set)
    for mutation in mutations:
        tests[program_of(mutation)].add(filter_of(mutation))
    build(sorted(tests), jobs)
    for program, filters in tests.items():
        if failure_of(program, ":".join(sorted(filters))):
            raise Broken(f"{program} fails without any mutation")


def verdict_on(mutation, jobs):
    target = TREE / "src" / mutation.file
    text = target.read_text()
    target.write_text(mutated(mutation, text))
    try:
        build([program_of(mutation)], jobs)
        return failure_of(program_of(mutation), filter_of(mutation)) or "SURVIVED"
    except Broken as broken:
        return f"BROKEN: {broken}"
    finally:
        target.write_text(text)


def check(mutations, jobs):
    """The mutations that were not caught."""
    begin = time.monotonic()
    print(f"Building and testing without mutations in {TREE.relative_to(ROOT)}", flush=True)
    prepare(mutations, jobs)
    uncaught = []
    for mutation in mutations:
        start = time.monotonic()
        verdict = verdict_on(mutation, jobs)
        print(f"{mutation.name:<36} {verdict:<10} {time.monotonic() - start:5.1f} s  {mutation.test}", flush=True)
        if verdict.split(" ")[0] not in ("caught", "crashed"):
            uncaught.append(mutation.name)
    minutes = (time.monotonic() - begin) / 60
    print(f"{len(mutations) - len(uncaught)} of {len(mutations)} caught in {minutes:.1f} minutes")
    return uncaught


# --- The table ---

def table():
    def cell(text):
        return text.replace("|", "\\|")

    lines = ["| change | in | found by | what it would do to a user |", "|---|---|---|---|"]
    lines += [f"| {m.name} | `{m.file}` | `{m.test}` | {cell(m.harm)} |" for m in MUTATIONS]
    return "\n".join(lines) + "\n"


def with_table(text):
    head, rest = text.split(BEGIN)
    return f"{head}{BEGIN}\n{table()}{END}{rest.split(END)[1]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", metavar="NAME", default=["*"], help="only these changes")
    parser.add_argument("--list", action="store_true", help="names of all changes")
    parser.add_argument("--table", action="store_true", help="the table in Markdown")
    parser.add_argument("--write", action="store_true", help="put the table into docs/accuracy.md")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers at once")
    asked = parser.parse_args()
    chosen = [m for m in MUTATIONS if any(fnmatch.fnmatchcase(m.name, name) for name in asked.only)]
    if not chosen:
        parser.error(f"no change is called {' or '.join(asked.only)}; --list names all")
    if asked.list:
        print("\n".join(m.name for m in chosen))
    elif asked.write:
        ACCURACY.write_text(with_table(ACCURACY.read_text()))
    elif asked.table:
        print(table(), end="")
    else:
        try:
            return 1 if check(chosen, asked.jobs) else 0
        except Broken as broken:
            print(broken, file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
