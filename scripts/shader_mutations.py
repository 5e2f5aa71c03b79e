#!/usr/bin/env python3
"""Checks that the tests of the layer gpu find wrong shaders: scripts/shader_mutations.py [--only NAME...] [--modes MODE...] [--list]
[--table] [--write] [--jobs N].

Makes each wrong change of scripts/shader_mutation_table.py in a copy of the tree (build/mutations) and runs the tests of every
mode of ctest (tests/gpu/drivers.cmake) until one fails. A shader is only compiled again and swapped. A change
that no mode finds has survived: exit code 1. Names may be patterns (--only 'group-*'). --table prints what the last runs found
as Markdown, --write puts it into tests/gpu/README.md.
"""
import argparse
import fnmatch
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

import mutations as plain
import shader_modules
from shader_mutation_table import MUTATIONS

ROOT, TREE, BUILD = plain.ROOT, plain.TREE, plain.BUILD
SWAPPED = TREE / "swapped"  # with a folder for each set of words that shaders are compiled with
VERDICTS = ROOT / "build" / "shader_mutations.json"
DOCUMENT = ROOT / "tests" / "gpu" / "README.md"
PROGRAM = "test_gpu"
MODULES = "shaders"  # the mode that only reads the SPIR-V
LEAST_TIMEOUT_S = 60
TIMEOUT_RUNS = 10  # so many times as long as without a change: the program hangs
FOUND = ("found", "crash", "hang")


def mutated(mutation, text):
    parts = text.split(mutation.old)
    count, place = len(parts) - 1, mutation.place or 1
    if (count != 1 and mutation.place == 0) or place > count:
        raise plain.Broken(f"src/gpu/{mutation.file} has the old text {count} times, not once")
    return mutation.old.join(parts[:place]) + mutation.new + mutation.old.join(parts[place:])


def is_shader(mutation):
    return mutation.file.startswith("shaders/")


def modes_of_ctest():
    """For each mode its environment and the filter of its tests, as ctest has them."""
    listed = plain.run(["ctest", "--test-dir", str(BUILD), "--show-only=json-v1", "-R", r"^gpu\."])
    modes = {}
    for test in json.loads(listed.stdout)["tests"]:
        name = test["name"].split(".")
        if len(name) != 4:
            continue
        properties = {entry["name"]: entry["value"] for entry in test["properties"]}
        mode = modes.setdefault(name[1], {"environment": dict(pair.split("=", 1) for pair in properties["ENVIRONMENT"]), "tests": []})
        mode["tests"].append(f"{name[2]}.{name[3]}")
    if not modes:
        raise plain.Broken("ctest has no tests of the layer gpu on a driver")
    return modes


def outcome(mode):
    """found, crash, hang, or "" where all tests of a mode pass; and the test."""
    environment = dict(mode["environment"])
    if "CLUSTERBENCH_SWAPPED_SHADERS" in environment:
        if (SWAPPED / "reversed").exists():
            environment["CLUSTERBENCH_SWAPPED_SHADERS"] = str(SWAPPED / "reversed")
    else:
        environment["CLUSTERBENCH_SWAPPED_SHADERS"] = str(SWAPPED / "usual")
    command = [str(BUILD / "tests" / PROGRAM), "--gtest_filter=" + ":".join(mode["tests"]), "--gtest_fail_fast"]
    try:
        done = subprocess.run(command, env={**os.environ, **environment},
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", timeout=mode.get("timeout_s"))
    except subprocess.TimeoutExpired as late:
        text = (late.stdout or b"").decode(errors="replace")
        return "hang", text.rsplit("[ RUN      ] ", 1)[-1].split("\n")[0]
    if done.returncode == 0:
        if "[  SKIPPED ]" in done.stdout or " 0 tests " in done.stdout:
            raise plain.Broken("tests were skipped: " + done.stdout[-2000:])
        return "", ""
    test = done.stdout.rsplit("[ RUN      ] ", 1)[-1].split("\n")[0]
    if "[  FAILED  ]" not in done.stdout:
        return "crash", test
    return "found", done.stdout.split("[  FAILED  ] ", 1)[1].split(" ", 1)[0].split("\n")[0]


def swapped_shaders(mutation):
    """Compiles what the change reaches into the folders; returns what the check of modules says."""
    folder = TREE / "src" / "gpu" / "shaders"
    reached = sorted(folder.glob("*.comp"))
    if mutation.file.endswith(".comp"):
        reached = [TREE / "src" / "gpu" / mutation.file]
    faults = []
    for words, options in (("usual", []), ("reversed", ["-DREVERSED_LANES"])):
        (SWAPPED / words).mkdir(parents=True)
        for shader in sorted(folder.glob("*.comp")) if words == "reversed" else reached:  # nothing else is in its place there
            for variant in shader_modules.VARIANTS:
                module = SWAPPED / words / f"{shader.stem}_{variant}.spv"
                complaint = shader_modules.compiled(shader, variant, module, options)
                if complaint:
                    raise plain.Broken(complaint)
                if words == "usual":
                    faults += shader_modules.faults_of(module, shader.stem, variant)
    return faults


def verdict_on(mutation, modes, jobs):
    """For each mode how it found the change."""
    target = TREE / "src" / "gpu" / mutation.file
    text = target.read_text()
    target.write_text(mutated(mutation, text))
    found = {}
    try:
        shutil.rmtree(SWAPPED, ignore_errors=True)
        if is_shader(mutation):
            if swapped_shaders(mutation):
                found[MODULES] = ["found", "gpu.shaders"]
        else:
            plain.build([PROGRAM], jobs)
        for name, mode in modes.items():
            found[name] = list(outcome(mode))
    finally:
        target.write_text(text)
    return found


def prepare(modes_wanted, jobs):
    plain.copy_tree()
    configured = plain.run(["cmake", "-S", str(TREE), "-B", str(BUILD), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DCLUSTERBENCH_BENCHMARKS=OFF", "-DCLUSTERBENCH_WERROR=OFF"])
    if configured.returncode != 0:
        raise plain.Broken("cannot be configured:\n" + configured.stdout)
    plain.build([PROGRAM], jobs)
    shutil.rmtree(SWAPPED, ignore_errors=True)
    modes = {name: mode for name, mode in modes_of_ctest().items()
             if any(fnmatch.fnmatchcase(name, wanted) for wanted in modes_wanted)}
    for name, mode in modes.items():
        start = time.monotonic()
        how, test = outcome(mode)
        if how:
            raise plain.Broken(f"without any mutation {name} fails: {how} {test}")
        seconds = time.monotonic() - start
        mode["timeout_s"] = max(LEAST_TIMEOUT_S, TIMEOUT_RUNS * seconds)
        print(f"{name}: {len(mode['tests'])} tests pass in {seconds:.0f} s", flush=True)
    return modes


def stored_verdicts():
    return json.loads(VERDICTS.read_text()) if VERDICTS.exists() else {}


def check(chosen, modes_wanted, jobs):
    print(f"Building and testing without mutations in {TREE.relative_to(ROOT)}", flush=True)
    modes = prepare(modes_wanted, jobs)
    uncaught = []
    for mutation in chosen:
        start = time.monotonic()
        try:
            found = verdict_on(mutation, modes, jobs)
        except plain.Broken as broken:
            print(f"{mutation.name:<36} BROKEN: {broken}", flush=True)
            uncaught.append(mutation.name)
            continue
        by = [f"{name}: {how} {test}" for name, (how, test) in found.items() if how]
        verdict = "; ".join(by) or (f"unseen: {mutation.unseen}" if mutation.unseen else "SURVIVED")
        print(f"{mutation.name:<36} {time.monotonic() - start:5.1f} s  {verdict}", flush=True)
        if not by and not mutation.unseen:
            uncaught.append(mutation.name)
        verdicts = stored_verdicts()
        verdicts.setdefault(mutation.name, {}).update(found)
        VERDICTS.write_text(json.dumps(verdicts, indent=1))
    print(f"{len(chosen) - len(uncaught)} of {len(chosen)} found, or known to be unseen" +
          (f"; not {', '.join(uncaught)}" if uncaught else ""))
    return uncaught


# --- The table ---

def table():
    verdicts = stored_verdicts()
    modes = list(dict.fromkeys(mode for found in verdicts.values() for mode in found if mode != MODULES)) + [MODULES]
    lines = ["| change | " + " | ".join(modes) + " |", "|---|" + "---|" * len(modes)]
    counts = dict.fromkeys(modes, 0)
    for mutation in MUTATIONS:
        found = verdicts.get(mutation.name)
        if found is None:
            continue
        cells = [found.get(mode, ["", ""])[0] for mode in modes]
        for mode, cell in zip(modes, cells):
            counts[mode] += cell in FOUND
        note = f" (unseen: {mutation.unseen})" if mutation.unseen else ""
        lines.append(f"| {mutation.name}{note} | " + " | ".join(cells) + " |")
    lines.append(f"| **of {len(lines) - 2}** | " + " | ".join(f"**{counts[mode]}**" for mode in modes) + " |")
    return "\n".join(lines) + "\n"


BEGIN, END = "<!-- shader mutations -->", "<!-- /shader mutations -->"


def with_table(text):
    head, rest = text.split(BEGIN)
    return f"{head}{BEGIN}\n{table()}{END}{rest.split(END)[1]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", metavar="NAME", default=["*"], help="only these changes")
    parser.add_argument("--modes", nargs="+", metavar="MODE", default=["*"], help="only these modes, as lavapipe")
    parser.add_argument("--list", action="store_true", help="names of all changes")
    parser.add_argument("--table", action="store_true", help="what the last runs found, in Markdown")
    parser.add_argument("--write", action="store_true", help="put that into tests/gpu/README.md")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers at once")
    asked = parser.parse_args()
    chosen = [m for m in MUTATIONS if any(fnmatch.fnmatchcase(m.name, name) for name in asked.only)]
    if not chosen:
        parser.error(f"no change is called {' or '.join(asked.only)}; --list names all")
    if asked.list:
        print("\n".join(m.name for m in chosen))
    elif asked.write:
        DOCUMENT.write_text(with_table(DOCUMENT.read_text()))
    elif asked.table:
        print(table(), end="")
    else:
        try:
            return 1 if check(chosen, asked.modes, asked.jobs) else 0
        except plain.Broken as broken:
            print(broken, file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
