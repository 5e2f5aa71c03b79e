#!/usr/bin/env python3
"""Puts the scaling curves into docs/performance.md and draws them with the report's charts (page/charts.mjs):
scripts/scaling_table.py FOLDER OUT.svg.

FOLDER holds scaling-lights.json, scaling-cells.json and scaling-radius.json, results of configs/scaling/."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

from peers_table import put, short, timing_of

ROOT = pathlib.Path(__file__).resolve().parent.parent


def lights_of(case, scenes):
    return sum(scenes[case["scene"]]["lights"][kind] for kind in ("point", "spot"))


def radius_of(case, scenes):
    return scenes[case["scene"]]["rig"]["range"]


def cells_of(case, _):
    return math.prod(case["grid"]["cells"])


CURVES = {"lights": (lights_of, "lights"), "cells": (cells_of, "cells, about"), "radius": (radius_of, "metres")}


def column(size, axis):
    """Grids of different kinds have about as many cells: a column for each power of ten."""
    return 10 ** round(math.log10(size)) if axis == "cells" else size


def load(folder, axis):
    """Method -> size -> case, in the order of the result."""
    path = folder / f"scaling-{axis}.json"
    if not path.exists():
        sys.exit(f"{path}: is missing; it is the result of configs/scaling/{axis}.json")
    result = json.loads(path.read_text())
    scenes = {scene["name"]: scene for scene in result["scenes"]}
    methods = {}
    for case in result["cases"]:
        size = column(CURVES[axis][0](case, scenes), axis)
        methods.setdefault(case["assigner"]["label"], {})[size] = case
    return methods


def size_text(size):
    return f"{size:,.0f}" if size >= 1 else f"{size:g}"


def sizes_of(methods):
    return sorted({size for cases in methods.values() for size in cases})


def table(methods, heading, cell):
    sizes = sizes_of(methods)
    lines = [f"| {heading} | " + " | ".join(map(size_text, sizes)) + " |", "|---|" + "---:|" * len(sizes)]
    for name, cases in methods.items():
        lines.append(f"| `{name}` | " + " | ".join(cell(cases[s]) if s in cases else "" for s in sizes) + " |")
    return "\n".join(lines)


def microseconds(case):
    return timing_of(case)["assign_ns"]["median"] / 1e3


def cost(case):
    timing = timing_of(case)
    if timing["ns_per_pair"] is None:
        return f"- / {short(timing['floor_ratio'])}"
    return f"{short(timing['ns_per_pair'])} / {short(timing['floor_ratio'])}"


def bytes_text(count):
    for unit in ("", "K", "M"):
        if count < 1024:
            return f"{count:.0f}{unit}" if unit == "" or count >= 10 else f"{count:.1f}{unit}"
        count /= 1024
    return f"{count:.1f}G"


def memory(case):
    buffers = case["buffers"]
    return f"{bytes_text(buffers['scratch_bytes'])} / {bytes_text(buffers['bytes']['high_water'])}"


def draw(folder, curves, out):
    given = [{"label": CURVES[axis][1], "file": str(folder / f"scaling-{axis}.json"),
              "sizes": {case["id"]: size for cases in methods.values() for size, case in cases.items()}}
             for axis, methods in curves.items()]
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(given, file)
        file.flush()
        subprocess.run(["node", ROOT / "page" / "charts.mjs", "scaling", file.name, out], check=True)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    curves = {axis: load(folder, axis) for axis in CURVES}
    page = ROOT / "docs" / "performance.md"
    for axis, methods in curves.items():
        heading = CURVES[axis][1]
        put(page, f"scaling-{axis}", "\n\n".join([
            "Time per frame in µs:", table(methods, heading, lambda case: short(microseconds(case))),
            "Nanoseconds per pair / assignment time by the time to copy the finished lists once:",
            table(methods, heading, cost),
            "Bytes of scratch memory / of lists and headers:", table(methods, heading, memory)]))
    draw(folder, curves, sys.argv[2])


if __name__ == "__main__":
    main()
