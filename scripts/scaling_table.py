#!/usr/bin/env python3
"""Puts the scaling curves into docs/performance.md and draws them: scripts/scaling_table.py FOLDER OUT.svg.

FOLDER holds scaling-lights.json, scaling-cells.json and scaling-radius.json, results of configs/scaling/."""
import json
import math
import pathlib
import sys

from peers_table import put, short
from speed_error_chart import COLOURS, mark

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
    return case["timing"]["assign_ns"]["median"] / 1e3


def cost(case):
    timing = case["timing"]
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


WIDTH, PANEL_W, PANEL_H, LEFT, TOP, GAP = 1100, 300, 300, 70, 50, 50


def powers(values):
    return math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))


def power_text(power, units):
    step = min(max(0, power // 3), len(units) - 1)
    return f"{10.0 ** (power - 3 * step):g}{units[step]}"


def panel(methods, heading, x0, y0, y_powers):
    x_lo, x_hi = powers(sizes_of(methods))
    y_lo, y_hi = y_powers
    at_x = lambda size: x0 + PANEL_W * (math.log10(size) - x_lo) / max(1, x_hi - x_lo)
    at_y = lambda us: y0 + PANEL_H * (1 - (math.log10(us) - y_lo) / (y_hi - y_lo))
    out = [f'<text x="{x0}" y="{y0 - 12}" font-weight="bold">{heading}</text>',
           f'<rect x="{x0}" y="{y0}" width="{PANEL_W}" height="{PANEL_H}" fill="none" stroke="#bbb"/>']
    for power in range(x_lo, x_hi + 1):
        x = at_x(10.0 ** power)
        out.append(f'<line x1="{x:.1f}" y1="{y0}" x2="{x:.1f}" y2="{y0 + PANEL_H}" stroke="#e5e5e5"/>')
        out.append(f'<text x="{x:.1f}" y="{y0 + PANEL_H + 16}" text-anchor="middle">{power_text(power, ("", "k", "M"))}</text>')
    for power in range(y_lo, y_hi + 1):
        y = at_y(10.0 ** power)
        out.append(f'<line x1="{x0}" y1="{y:.1f}" x2="{x0 + PANEL_W}" y2="{y:.1f}" stroke="#e5e5e5"/>')
        if x0 == LEFT:
            out.append(f'<text x="{x0 - 6}" y="{y + 4:.1f}" text-anchor="end">{power_text(power, (" µs", " ms", " s"))}</text>')
    for name, cases in methods.items():
        places = [(at_x(size), at_y(microseconds(case))) for size, case in sorted(cases.items())]
        dash = ' stroke-dasharray="4 3"' if name.endswith("-fast") else ""
        colour = COLOURS.get(name.removesuffix("-fast"), "#333")
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="1.5"{dash}/>')
        out += [mark(name, x, y, f"<title>{name}</title>") for x, y in places]
    return out


def draw(curves, out):
    times = [microseconds(case) for methods in curves.values() for cases in methods.values() for case in cases.values()]
    body = [f'<text x="{LEFT}" y="20">time per frame, by lights, cells and range (both axes logarithmic)</text>']
    for place, (axis, methods) in enumerate(curves.items()):
        body += panel(methods, CURVES[axis][1], LEFT + place * (PANEL_W + GAP), TOP, powers(times))
    names = list(dict.fromkeys(name for methods in curves.values() for name in methods))
    for place, name in enumerate(names):
        x, y = LEFT + 220 * (place % 4), TOP + PANEL_H + 50 + 20 * (place // 4)
        body.append(mark(name, x, y) + f'<text x="{x + 12}" y="{y + 4}">{name}</text>')
    height = TOP + PANEL_H + 50 + 20 * ((len(names) + 3) // 4)
    pathlib.Path(out).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" font-family="sans-serif" font-size="12">'
        f'<rect width="100%" height="100%" fill="white"/>' + "".join(body) + "</svg>\n")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    curves = {axis: load(pathlib.Path(sys.argv[1]), axis) for axis in CURVES}
    page = ROOT / "docs" / "performance.md"
    for axis, methods in curves.items():
        heading = CURVES[axis][1]
        put(page, f"scaling-{axis}", "\n\n".join([
            "Time per frame in µs:", table(methods, heading, lambda case: short(microseconds(case))),
            "Nanoseconds per pair / assignment time by the time to copy the finished lists once:",
            table(methods, heading, cost),
            "Bytes of scratch memory / of lists and headers:", table(methods, heading, memory)]))
    draw(curves, sys.argv[2])


if __name__ == "__main__":
    main()
