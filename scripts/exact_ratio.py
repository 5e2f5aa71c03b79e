#!/usr/bin/env python3
"""How long exact-fast takes beside sphere-refinement-fast, map by map: scripts/exact_ratio.py CLUSTERBENCH [SCENE...].

CLUSTERBENCH is a built program. Without scenes: all of scenes/ and, where CLUSTERBENCH_SCENE_LIBRARY names the scene
library, all of that. Each map is one run of both methods, timed in turns, on a frustum grid of tiles of 64 pixels and 16
slices at 1920 x 1080. Prints a table, the worst ratio first: lights of points and spots, both times, their ratio with
its 95 % interval, and what exact-fast asked exact arithmetic on the path's frames. Maps without lights are left out."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
REFERENCE, METHOD = "sphere-refinement-fast", "exact-fast"


def config(scene):
    return {
        "scenes": [{"path": str(scene), "frames": 8}],
        "viewport": [1920, 1080],
        "grids": [{"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices": {"scheme": "exponential-first", "count": 16}}],
        "assigners": [REFERENCE, METHOD],
        "accuracy": {"check": False},
        "shading": {"samples": 0},
        "timing": {"rounds": 31, "min_time_ms": 1, "frames": 8},
    }


def measured(program, scene, folder):
    """The map's result, or None where there is nothing to measure."""
    given, found = folder / "config.json", folder / "result.json"
    given.write_text(json.dumps(config(scene)))
    run = subprocess.run([program, "run", str(given), "-q", "-o", str(found)], capture_output=True, text=True)
    if run.returncode == 0:
        return json.loads(found.read_text())
    print(f"{scene}: left out: {run.stderr.strip()}", file=sys.stderr)
    return None


def rows(result, name):
    lights = result["scenes"][0]["lights"]
    if lights["point"] + lights["spot"] == 0:
        return
    cases = {}
    for case in result["cases"]:
        cases.setdefault(case["camera"], {})[case["assigner"]["label"]] = case
    for camera, methods in cases.items():
        if REFERENCE not in methods or METHOD not in methods:
            continue
        us = {label: case["timing"]["assign_ns"]["median"] / 1e3 for label, case in methods.items()}
        # Of the reference's times to the method's, as runs have it.
        versus = methods[METHOD]["timing"]["against_first"]
        low, high = sorted(1 / end for end in versus["ci95"]) if versus["assigner"] == METHOD else versus["ci95"]
        ratio = 1 / versus["ratio"] if versus["assigner"] == METHOD else versus["ratio"]
        label = name if len(cases) == 1 else f"{name} ({camera})"
        yield (ratio, f"| {label} | {lights['point']} | {lights['spot']} | {us[METHOD]:.2f} | {us[REFERENCE]:.2f} | "
               f"{ratio:.2f} ({low:.2f} to {high:.2f}) | {methods[METHOD]['fallbacks']} |")


def scenes():
    folders = [ROOT / "scenes"]
    if library := os.environ.get("CLUSTERBENCH_SCENE_LIBRARY"):
        folders.append(pathlib.Path(library))
    for folder in folders:
        for path in sorted(folder.rglob("*")):
            if path.suffix in (".glb", ".gltf"):
                yield path, str(path.relative_to(folder).with_suffix(""))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    program = sys.argv[1]
    wanted = [(pathlib.Path(path), pathlib.Path(path).stem) for path in sys.argv[2:]] or scenes()
    table = []
    with tempfile.TemporaryDirectory() as folder:
        for path, name in wanted:
            if result := measured(program, path, pathlib.Path(folder)):
                table += rows(result, name)
    print(f"| map | points | spots | `{METHOD}`, µs | `{REFERENCE}`, µs | ratio | exact decisions |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    for _, line in sorted(table, key=lambda row: -row[0]):
        print(line)
    ratios = [ratio for ratio, _ in table]
    print(f"\n{len(ratios)} cases, {sum(ratio > 1.3 for ratio in ratios)} above 1.3.")


if __name__ == "__main__":
    main()
