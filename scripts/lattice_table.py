#!/usr/bin/env python3
"""Prints what ties cost, as a table: scripts/lattice_table.py RESULT, of configs/scaling/lattice.json."""
import json
import pathlib
import sys


def times(result, scene):
    return {
        (case["grid"]["name"], case["assigner"]["label"]): case["timing"]["assign_ns"]["median"] / 1e3
        for case in result["cases"]
        if case["scene"] == scene and case.get("timing")
    }


result = json.loads(pathlib.Path(sys.argv[1]).read_text())
on, off = times(result, "lattice"), times(result, "lattice-off")
print("| grid | method | on the lattice, µs | off it, µs | ratio |\n|---|---|---:|---:|---:|")
for key in sorted(on.keys() & off.keys()):
    print(f"| {key[0]} | `{key[1]}` | {on[key]:,.1f} | {off[key]:,.1f} | {on[key] / off[key]:.2f} |")
