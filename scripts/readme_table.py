#!/usr/bin/env python3
"""Puts measured tables and figures into README.md, docs/results.md and docs/sizing.md: scripts/readme_table.py FOLDER.

FOLDER holds quick.json and quick.txt, result and table of configs/quick.json; street.json and street.txt, those of
`clusterbench run scenes/street.glb`; and street-size.txt, what `clusterbench size scenes/street.glb` says of one case. Examples in
docs/results.md whose output is marked are run on street.json, with the program of build/release."""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap

from peers_table import put, timing_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRESS = re.compile(r"^(\[\d+/\d+\]|Building|Installing)")
GRID = "frustum 16x9 x 24 exponential"  # of the README's second table, which has these columns where the program does
COLUMNS = ["", "assigner", "frame us", "frame", "assign us", "excess", "missed", "unlit", "dropped", "bytes", "entries"]


def block(lines):
    return "```text\n" + "\n".join(line.rstrip() for line in lines).strip("\n") + "\n```"


def table_of(path):
    return [line for line in path.read_text().splitlines() if not PROGRESS.match(line)]


def frame_us(case):
    return timing_of(case)["frame_ns"]["median"] / 1e3


def best_of_grids(result):
    """Of each grid the fastest method that fills lists; apart from them what samples search for their lights."""
    best = {}
    for case in result["cases"]:
        lists = case["storage"] != "own"
        key = (case["grid"]["name"] if lists else "", "" if lists else case["assigner"]["label"])
        if key not in best or (lists and frame_us(case) < frame_us(best[key])):
            best[key] = case
    return [case for key, case in best.items() if key[0]] + [case for key, case in best.items() if not key[0]]


def grids(result):
    rows = ["| grid | method | µs to make the lists | overshade | unlit | kB with reserve |",
            "|---|---|---:|---:|---:|---:|"]
    for case in best_of_grids(result):
        size = case["buffers"]["bytes"]["recommended"] / 1e3
        shading = case["shading"]
        missing = f"{100 * shading['missed'] / shading['needed']:.2f} %" if shading["missed"] else "0"
        grid = case["grid"]["name"] if "occupancy" in case else "none"
        read = f", no lists: a sample reads {shading['read_bytes'] / shading['samples']:.0f} bytes" if case["storage"] == "own" else ""
        rows.append(f"| {grid} | `{case['assigner']['label']}`{read} | "
                    f"{frame_us(case):.0f} | {shading['overshade']:.2f} | {missing} | {size:.0f} |")
    return "\n".join(rows)


def columns_of(heading):
    """Heading -> where its column begins and ends. All but the assigner's are aligned to the right."""
    found = [(match[0], match.end()) for match in re.finditer(r"\S+(?: \S+)*", heading)]
    begin, spans = len(heading) - len(heading.lstrip()), {"": (0, 4)}
    for place, (name, end) in enumerate(found):
        if place == 0:  # up to where the next column's cells can begin: at least two blanks before its heading
            end = found[1][1] - len(found[1][0]) - 2
        spans[name] = (begin, end)
        begin = end
    return spans


def methods(lines):
    start = next(at for at, line in enumerate(lines) if line.strip().startswith(GRID + ","))
    rows = [lines[start + 1]]
    for line in lines[start + 2:]:
        if not re.match(r"^ {2}[* ] \S", line):
            break
        rows.append(line)
    names = {row.split()[0 if row[2] == " " else 1] for row in rows[1:]}
    shown = [f"{row[4:].split()[0]}-fast" not in names for row in rows]  # the fast forms speak for those
    # "~" speaks of the row above, which may be one that is left out.
    rows = [row if shown[at - 1] else row.replace("~", " ", 1) for at, row in enumerate(rows) if shown[at]]
    spans = columns_of(rows[0])
    has_frame = "frame us" in spans or "frame" in spans
    wanted = [name for name in COLUMNS if name in spans and not (name == "assign us" and has_frame)]
    return block("".join(row[slice(*spans[name])] for name in wanted) for row in rows)


def with_exact(name, result):
    """Of each scene and frustum grid the case of a method and that of `exact-fast`."""
    groups = {}
    for case in result["cases"]:
        if case["assigner"]["label"] in (name, "exact-fast") and case["grid"]["kind"] == "frustum":
            groups.setdefault((case["scene"], case["grid"]["name"]), {})[case["assigner"]["label"]] = case
    return [(group[name], group["exact-fast"]) for group in groups.values()]


def times_as_long(pairs):
    return [frame_us(exact) / frame_us(other) for other, exact in pairs]


def few_slices(pairs):
    return [pair for pair in pairs if pair[0]["grid"]["cells"][2] <= 4]


def many_slices(pairs):
    return [pair for pair in pairs if pair[0]["grid"]["cells"][2] >= 16]


def excess_percent(pairs):
    return [100 * other["error"]["excess_ratio"] for other, _ in pairs]


def span(values, form):
    low, high = (format(value, form) for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


NUMBERS = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"]


def headline(quick, street):
    """What the picture and the tables below it show, in words, and where it holds. Fails where the figures no longer say so."""
    loose, boxes = (with_exact(name, quick) + with_exact(name, street) for name in ("bounds-fast", "aabb-fast"))
    many = many_slices(loose + boxes)
    if max(times_as_long(many)) > 1.6 or any(exact["error"]["false_positives"] for _, exact in many):
        sys.exit("exact lists no longer cost little more than loose ones: write another conclusion below README.md's picture")
    levels = NUMBERS[len({case["scene"] for case, _ in many})]
    slices = sorted({case["grid"]["cells"][2] for case, _ in many})
    counts = ' or '.join(str(count) for count in slices)
    text = (f"**With {counts} slices, exact lists take at most {math.ceil(10 * max(times_as_long(many))) / 10} times as long as loose "
            f"ones.** On the {levels} levels of the picture, in grids of {counts} slices, `exact-fast` (no false positives) takes {span(times_as_long(many_slices(boxes)), '.2f')} "
            f"times as long as `aabb-fast` (sphere against the cell's box; {span(excess_percent(many_slices(boxes)), '.0f')} % false "
            f"positives), and {span(times_as_long(many_slices(loose)), '.2f')} times as long as `bounds-fast` (the light's extents "
            f"on the screen and in depth; {span(excess_percent(many_slices(loose)), '.0f')} %). With 1 to 4 slices it takes "
            f"{span(times_as_long(few_slices(loose + boxes)), '.0f')} times as long as either.")
    return textwrap.fill(text, 130, break_on_hyphens=False)


def conclusion(street):
    """What to take, against what; what it rests on stands behind that and is left out. As lines that a terminal holds."""
    text = street["conclusions"][0]["text"].split(". ")[0] + ". ..."
    return "```text\n" + textwrap.fill("conclusion: " + text, 130, break_on_hyphens=False, break_long_words=False) + "\n```"


def size(lines):
    """The first buffer's constant and the first lines of its comment, with marks where something is left out."""
    start = next(at for at, line in enumerate(lines) if line.startswith("//   indices"))
    end = next(at for at, line in enumerate(lines) if line.startswith("inline constexpr LightBuffer"))
    kept = [line for line in lines[start:end + 1] if not line.startswith("//     ") or line.split()[1] in ("frames", "allocate")]
    return "```cpp\n// ...\n" + "\n".join([*kept, "// ..."]) + "\n```"


def whole_case(lines):
    """From the case's name to the end of its constants."""
    start = next(at for at, line in enumerate(lines) if line.startswith("//   ")) - 1
    return "```cpp\n" + "\n".join(lines[start:lines.index("}", start) + 1]) + "\n```"


def example(name, result_path):
    """What the commands above a mark in docs/results.md print, with the result as result.json."""
    page = (ROOT / "docs" / "results.md").read_text()
    shell = re.search(r"```sh\n([^`]*)```\n\n<!-- " + name + " -->", page)[1]
    program = ROOT / "build" / "release"
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "result.json").write_text(result_path.read_text())
        done = subprocess.run(["bash", "-euc", shell], cwd=folder, env={**os.environ, "PATH": f"{program}:{os.environ['PATH']}"},
                              check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit(f"docs/results.md, the commands above <!-- {name} -->: {done.stdout}")
    return block(done.stdout.splitlines())


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    readme = ROOT / "README.md"
    quick, street = (json.loads((folder / f"{name}.json").read_text()) for name in ("quick", "street"))
    put(readme, "headline", headline(quick, street))
    put(readme, "grids", grids(street))
    put(readme, "conclusion", conclusion(street))
    put(readme, "methods", methods(table_of(folder / "street.txt")))
    constants = (folder / "street-size.txt").read_text().splitlines()
    put(readme, "size", size(constants))
    put(ROOT / "docs" / "sizing.md", "size", whole_case(constants))
    results = ROOT / "docs" / "results.md"
    for name in ("choice", "ratio"):
        put(results, name, example(name, folder / "street.json"))
    put(results, "quick", block(table_of(folder / "quick.txt")))


if __name__ == "__main__":
    main()
