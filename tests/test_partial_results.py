#!/usr/bin/env python3
"""Gives every command that reads results some that the schema allows and this program would not write: each optional key left out in
turn, each value that may be null set to null, lists emptied. A command may refuse one with a clear message (exit codes 1 to 4);
it must not crash, nor end with an error of its own (70).

usage: test_partial_results.py PROGRAM SCENE"""

import copy
import json
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
    "storages": ["packed", "own", {"name": "fixed", "max_per_cell": 2}],
    "precision": ["float32", "half"],
    "limits": {"dropped_pairs": None},
    "timing": {"rounds": 3, "frames": 2, "launches": 1, "min_time_ms": 0.1},
    "shading": {"samples": 64},
    "lookup": {"samples": 64},
    "stability": {"steps": 4},
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
                holder[key] = None if what == "null" else []
    return copied if found else None


def commands(program, folder, other):
    """Each that reads a result; `other` is a whole one."""
    part = folder / "part.json"
    history = folder / "history.jsonl"
    history.unlink(missing_ok=True)
    formats = ("bencher", "csv", "github-smaller", "google-benchmark", "lnt", "markdown")
    for line in (
        ["validate", part], ["report", part, "-o", folder / "page.html"], ["report", other, part, "-o", folder / "page.html"],
        ["compare", other, part, "--threshold", "1000"], ["compare", part, other, "--json", folder / "c.json", "--markdown", folder / "c.md"],
        ["compare", part, part, "--gate-separate"], ["merge", part, "-o", folder / "merged.json"], ["size", part], ["size", part, "--all"],
        ["size", part, "--format", "json"], ["size", part, "--format", "hlsl"], ["ratio", part], ["ratio", part, "--across-grids", "--csv", "-"],
        ["history", "add", part, history], ["history", "add", other, history], ["history", "show", history, "--all", "-o", folder / "h.html"],
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


def main():
    program, scene = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
    schema = json.loads(subprocess.run([program, "schema", "result"], capture_output=True, text=True, check=True).stdout)
    faults, tried = [], 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        whole = reduced(measured(program, folder, scene))
        (folder / "whole.json").write_text(json.dumps(whole), encoding="utf-8")
        for path, what in [((), "whole"), *places(schema, schema)]:
            part = whole if what == "whole" else changed(whole, path, what) if path else None
            if part is None:
                continue
            (folder / "part.json").write_text(json.dumps(part), encoding="utf-8")
            tried += 1
            for line, done in commands(program, folder, folder / "whole.json"):
                if fault := fault_of(line, done):
                    faults.append(f"{what} /{'/'.join(path)}: {fault}")
    for fault in faults:
        print(fault)
    print(f"{tried} results, {len(faults)} faults")
    return 1 if faults or tried < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
