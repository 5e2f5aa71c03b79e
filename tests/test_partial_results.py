#!/usr/bin/env python3
"""Gives every command that reads results some that the schema allows and this program would not write: each optional key left out
in turn, each value that may be null set to null, lists emptied; with --zero also each number that may be 0 set to 0. A command may refuse
one with a clear message (exit codes 1 to 4); it must not crash, nor end with an error of its own (70). With --together N so many changes
are made to one result; where a command refuses it, which hides the rest, each is tried alone. With --every N one of N changes is tried.

usage: test_partial_results.py PROGRAM SCENE [--zero] [--together N] [--every N]"""

import concurrent.futures
import copy
import json
import os
import pathlib
import subprocess
import sys
import tempfile

CONFIGURATION = {
    "viewport": [320, 180],
    "grids": [
        {"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices": {"scheme": "exponential", "count": 8, "far": 100}},
        {"kind": "world"},
    ],
    "assigners": ["aabb", "bounds", "world-grid", "bvh", "naive-bounds"],
    "storages": ["packed", {"name": "fixed", "cap": 2}],
    "precision": ["float32", "half"],
    "limits": {"dropped_pairs": None},
    "timing": {"sweep_mib": 4, "rounds": 6, "frames": 2, "launches": 1, "min_time_ms": 0.1},
    "shading": {"samples": 64},
    "samples": {"fog": {"froxels": [4, 4, 4]}, "mirror": {"count": 64}},
    "lookup": {"samples": 64},
    "stability": {"steps": 4},
    "details": {"frames": "worst"},
}


def measured(program, folder, scene):
    configuration = dict(CONFIGURATION, scenes=[{"path": str(scene), "frames": 2}])
    (folder / "config.json").write_text(json.dumps(configuration), encoding="utf-8")
    done = subprocess.run([program, "run", "config.json", "-q", "-o", "result.json", "--baseline-binary", program, "--baseline-launches", "2",
                           "--baseline-most-launches", "2"],
                          cwd=folder, capture_output=True, text=True, check=False)
    if not (folder / "result.json").exists():
        sys.exit(f"no result was measured: {done.stderr}")
    return json.loads((folder / "result.json").read_text(encoding="utf-8"))


def reduced(result):
    """Few cases, all kinds of them: what they have tells them apart."""
    kept = {}
    for case in result["cases"]:
        kept.setdefault((tuple(sorted(case)), case["grid"]["kind"], case["storage"]), case)
    result["cases"] = list(kept.values())
    for case in result["cases"][1:]:
        case.pop("details", None)
    # As `--count=perf` has it, which few machines can.
    result["cases"][0]["count"] = {
        "source": "perf", "simd_target": "AVX2", "frames": 2, "instructions_per_build": 700,
        "instructions_per_frame": {"assign": 20000, "convert": 1500}, "cycles_per_frame": {"assign": 9000, "convert": 800}}
    ids = {case["id"] for case in result["cases"]}
    for front in result["pareto_front"]:
        front["ids"] = [one for one in front["ids"] if one in ids]
    return result


def resolved(schema, root):
    while "$ref" in schema:
        schema = root["definitions"][schema["$ref"].rsplit("/", 1)[1]]
    return schema


def places(schema, root, path=()):
    """(path, what) of everything that a valid result may lack: a key ("drop"), a value ("null"), items of a list ("empty")."""
    schema = resolved(schema, root)
    if "null" in schema.get("type", []):
        yield path, "null"
    if schema.get("type") == "array" and schema.get("minItems", 0) == 0:
        yield path, "empty"
    if {"integer", "number"} & set([schema.get("type")] if isinstance(schema.get("type"), str) else schema.get("type", [])):
        if schema.get("minimum", 0) <= 0 and "exclusiveMinimum" not in schema:
            yield path, "zero"
    for key, value in schema.get("properties", {}).items():
        if key not in schema.get("required", []):
            yield path + (key,), "drop"
        yield from places(value, root, path + (key,))
    if isinstance(schema.get("items"), dict):
        yield from places(schema["items"], root, path + ("*",))


def holders(value, path):
    """What holds the last step of the path, wherever the result has it."""
    if len(path) == 1:
        return [value] if isinstance(value, (dict, list)) else []
    children = value if isinstance(value, list) and path[0] == "*" else []
    if isinstance(value, dict) and path[0] in value:
        children = [value[path[0]]]
    return [one for child in children for one in holders(child, path[1:])]


def changed(result, path, what):
    """The result without that; None if it has none of it."""
    copied = copy.deepcopy(result)
    found = False
    for holder in holders(copied, path):
        keys = range(len(holder)) if path[-1] == "*" else [path[-1]] if path[-1] in holder else []
        for key in keys:
            found = True
            if what == "drop":
                del holder[key]
            else:
                holder[key] = {"null": None, "empty": [], "zero": 0}[what]
    return copied if found else None


def commands(program, folder, other):
    """What each that reads a result said of it; `other` is a whole one."""
    part = folder / "part.json"
    history = folder / "history.jsonl"
    history.unlink(missing_ok=True)
    formats = ("csv", "google-benchmark", "lnt", "markdown")
    for line in (
        ["validate", part], ["report", other, part, "-o", folder / "page.html"],
        ["compare", other, part, "--threshold", "1000"], ["compare", part, other, "--json", folder / "c.json", "--markdown", folder / "c.md"],
        ["compare", part, part, "--gate-separate"], ["merge", part, "-o", folder / "merged.json"], ["size", part],
        ["size", part, "--all", "--format", "json"], ["ratio", part], ["ratio", part, "--across-grids", "--csv", "-"],
        ["history", "add", part, history], ["history", "show", history, "--all", "-o", folder / "h.html"],
        *(["export", part, "--format", one, "--all"] for one in formats),
    ):
        yield [str(word) for word in line], subprocess.run([program, *line], cwd=folder, capture_output=True, text=True, check=False,
                                                            timeout=120)


def fault_of(line, done):
    if done.returncode not in range(0, 5) or "json.exception" in done.stderr or "Sanitizer" in done.stderr:
        return f"{' '.join(line)}: exit code {done.returncode}: {done.stderr.strip()[-600:]}"
    if line[0] == "validate" and done.returncode != 0:
        return f"the test made what is not valid: {done.stderr.strip()[:300]}"
    return ""


def faults_of(program, changes, whole):
    """How many commands fail on the result with these changes, a list of (path, what)."""
    part = whole
    for path, what in changes:
        part = changed(part, path, what)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "part.json").write_text(json.dumps(part), encoding="utf-8")
        (folder / "whole.json").write_text(json.dumps(whole), encoding="utf-8")
        done = list(commands(program, folder, folder / "whole.json"))
    if len(changes) > 1 and any(command.returncode > 1 for _, command in done):
        return sum(faults_of(program, [change], whole) for change in changes)
    told = [fault_of(line, command) for line, command in done]
    for fault in filter(None, told):
        print(f"{', '.join(f'{what} /' + '/'.join(path) for path, what in changes)}: {fault}", flush=True)
    return sum(map(bool, told))


def hides(path, other):
    """Whether a change at one of the places may leave nothing of the other."""
    return path[:len(other)] == other or other[:len(path)] == path


def groups(changes, size):
    """The changes, so many of different parts of the result at a time. Neighbours are kept apart: they are read together."""
    out = [[] for _ in range(-(-len(changes) // size))]
    for at, change in enumerate(changes):
        order = out[at % len(out):] + out[:at % len(out)]
        group = next((group for group in order if len(group) < size and not any(hides(change[0], other) for other, _ in group)), None)
        if group is None:
            out.append([change])
        else:
            group.append(change)
    return [group for group in out if group]


def option(name):
    return int(sys.argv[sys.argv.index(name) + 1]) if name in sys.argv else 1


def main():
    program, scene = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
    schema = json.loads(subprocess.run([program, "schema", "result"], capture_output=True, text=True, check=True).stdout)
    with tempfile.TemporaryDirectory() as name:
        whole = reduced(measured(program, pathlib.Path(name), scene))
    possible = [(path, what) for path, what in places(schema, schema)
                if path and (what != "zero" or "--zero" in sys.argv) and changed(whole, path, what) is not None]
    changes = possible[::option("--every")]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = sum(pool.map(lambda group: faults_of(program, group, whole), [[], *groups(changes, option("--together"))]))
    print(f"{len(changes)} of {len(possible)} changes, {faults} faults")
    return 1 if faults or len(possible) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
