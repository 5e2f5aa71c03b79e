#!/usr/bin/env python3
"""Puts measured rows and pictures into docs/methods.md: scripts/methods_page.py FOLDER [--pictures PROGRAM] [--check].

FOLDER holds methods.json, a result of configs/methods.json; its cases are the rows. With --pictures the program runs
configs/method-pictures.json and results/methods/ is made anew: a slice of cells as SVG, or, of a method without cells of
a grid, false positives per pixel as the program draws them. --check writes nothing and fails where a file would change.

A method has its place on the page between <!-- NAME --> and <!-- /NAME -->. To add one: a line in each of the two
configurations, a section with such a place, and a run of this script."""
import argparse
import collections
import itertools
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE, PICTURES = ROOT / "docs" / "methods.md", ROOT / "results" / "methods"

# What a picture shows of a grid's cells: a slice or a shell as the camera sees it, or a layer of boxes from above, of
# cascades that of one level.
View = collections.namedtuple("View", "caption layer level", defaults=(None,))
VIEWS = {
    "frustum": View("the slice from 8.7 to 10.8 m, as the camera sees it", 10),
    "distance": View("the shell from 8.7 to 10.8 m, as the camera sees it", 10),
    "cascades": View("boxes of 0.5 m at the height of the sphere's centre, from above; the eye is below", 16, 1),
    "world": View("boxes at the height of the sphere's centre, from above; the eye is below", 4),
}
# Methods whose mistake shows only where something is lost: scene, part of the grid's name, and the view.
LOST = ("methods-lost", "12x12", View("the slice from 35.9 to 50.8 m of 12 × 12 tiles and a sphere that reaches one more", 17))
BOXES = ("methods-boxes", "32x18", View("the slice from 8.7 to 10.8 m, with a turned box beside the two lights", 10))
SPECIAL = {"naive-refinement": LOST, "bevy-refinement": LOST, "box-bounds": BOXES, "box-refined": BOXES, "box-separating-axis": BOXES}
# Which form of a method is drawn, where not the first.
DRAWN = {"naive-bounds": "naive-bounds(flaw=padded-tiles)"}

COLOURS = {"true": "#3b7dd8", "false_positives": "#f5b942", "false_negatives": "#d4145a"}
WORDS = {"true": "true", "false_positives": "false positive", "false_negatives": "missed"}


def numbers(text):
    return [int(number) for word in text.split() for number, _, times in [word.partition("*")] for _ in range(int(times or 1))]


def colours_of(case):
    """(x, y, z) of a cell -> what it is: a key of COLOURS."""
    columns, rows, _ = case["grid"]["cells"]
    cells = case["details"]["frames"][0]["cells"]
    found = {}
    for index, *counts in zip(itertools.accumulate(numbers(cells["indices"])), *(numbers(cells[key]) for key in COLOURS)):
        # A cell with a mistake shows the mistake.
        kind = next(key for key, count in reversed(list(zip(COLOURS, counts))) if count > 0)
        found[index % columns, index // columns % rows, index // (columns * rows)] = kind
    return found


def flat(case, view):
    """Columns, rows and (column, row) -> kind of a view; row 0 is on top."""
    columns, rows, slices = case["grid"]["cells"]
    found = colours_of(case)
    if case["grid"]["kind"] in ("frustum", "distance"):
        return columns, rows, {(x, y): kind for (x, y, z), kind in found.items() if z == view.layer}
    if case["grid"]["kind"] == "world":
        return columns, slices, {(x, z): kind for (x, y, z), kind in found.items() if y == view.layer}
    deep = slices // case["grid"]["levels"]
    return columns, deep, {(x, deep - 1 - z % deep): kind for (x, y, z), kind in found.items()
                           if y == view.layer and z // deep == view.level}


def svg(case, view):
    columns, rows, cells = flat(case, view)
    if "true" not in cells.values():
        sys.exit(f"{case['name']}: nothing is in layer {view.layer}, choose another one in VIEWS")
    step = max(4, 384 // columns)
    width, height = columns * step, rows * step
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width + 2} {height + 22}" width="{width + 2}" '
             f'font-family="sans-serif" font-size="11"><path fill="#fff" d="M0 0h{width + 2}v{height + 22}H0z"/>']
    for kind, colour in COLOURS.items():
        runs = []
        for y in range(rows):
            xs = [x for x in range(columns) if cells.get((x, y)) == kind]
            for _, group in itertools.groupby(enumerate(xs), lambda pair: pair[1] - pair[0]):
                run = [x for _, x in group]
                runs.append(f"M{1 + run[0] * step} {1 + y * step}h{len(run) * step}v{step}h-{len(run) * step}z")
        if runs:
            parts.append(f'<path fill="{colour}" d="{"".join(runs)}"/>')
    lines = "".join(f"M{1 + x * step} 1v{height}" for x in range(columns + 1)) + "".join(
        f"M1 {1 + y * step}h{width}" for y in range(rows + 1))
    parts.append(f'<path stroke="#8884" fill="none" d="{lines}"/>')
    at = 1
    for kind, colour in COLOURS.items():
        count = sum(found == kind for found in cells.values())
        parts.append(f'<path fill="{colour}" d="M{at} {height + 8}h10v10h-10z"/><text x="{at + 14}" y="{height + 17}">{WORDS[kind]}: {count}</text>')
        at += width // 3
    return "\n".join(parts) + "</svg>\n"


def picture_case(name, cases):
    """The case that a method is drawn by, and the view; None where it has no cells of a grid."""
    scene, grid, view = SPECIAL.get(name, ("methods", "", None))
    for case in cases:
        if (case["assigner"]["label"] == DRAWN.get(name, name) and case["scene"] == scene and grid in case["grid"]["name"]
                and "details" in case):
            return case, view or VIEWS[case["grid"]["kind"]]
    return None


def make_pictures(program, folder):
    """Into the folder: NAME.svg or NAME.png of each method of the configuration."""
    with tempfile.TemporaryDirectory() as temporary:
        work = pathlib.Path(temporary)
        subprocess.run([program, "run", ROOT / "configs" / "method-pictures.json", "-q", "-o", work / "result.json", "--images", work,
                        "--image-kinds", "false-positives", "--image-divisor", "3"], check=True, stderr=subprocess.DEVNULL)
        result = json.loads((work / "result.json").read_text())
        images = json.loads((work / "pictures.json").read_text())
        for name in dict.fromkeys(case["assigner"]["name"] for case in result["cases"]):
            drawn = picture_case(name, result["cases"])
            if drawn:
                (folder / f"{name}.svg").write_text(svg(*drawn))
                continue
            ids = {case["id"] for case in result["cases"] if case["assigner"]["name"] == name and case["scene"] == "methods"}
            file = next(image["file"] for image in images["pictures"] if ids & set(image["cases"]))
            shutil.copyfile(work / file, folder / f"{name}.png")


def digits(value):
    return f"{value:.0f}" if value >= 100 else f"{value:.2g}"


def kept_in(case):
    """As the program's tables call it."""
    return "no lists" if case["storage"] == "own" else case["storage"]


def time_of(case, firsts):
    first = firsts[case["grid"]["name"]]
    if "timing" not in case:
        return ""
    base = f"{first['assigner']['label']}" + (f" / {kept_in(first)}" if first["assigner"]["name"] == "bvh" else "")
    return "this" if case is first else f"{digits(100 * case['timing']['against_first']['ratio'])} % of `{base}`"


def row(case, firsts):
    samples, error = case["samples"]["opaque"], case.get("error")
    label = case["assigner"]["label"]
    name = f"`{label}`" + (f" / {kept_in(case)}" if label == "bvh" else "")
    lists = ["none", ""] if error is None else [f"{100 * error['excess_ratio']:.1f} %", f"{error['false_negatives']:,}"]
    unlit = samples["missed"] / samples["needed"]
    return [name, case["grid"]["kind"], *lists, f"{samples['evaluated'] / samples['samples']:.2f}",
            f"{samples['read_bytes'] / samples['samples']:.0f}", f"{100 * unlit:.2g} %" if unlit else "0", f"{case['buffers']['bytes']['high_water'] / 1e3:.1f}", time_of(case, firsts)]


HEADS = ["method", "grid", "excess", "missed", "lights per pixel", "bytes read", "unlit", "kB", "frame time"]


def rows_of(name, result):
    firsts = {}
    for case in result["cases"]:
        firsts.setdefault(case["grid"]["name"], case)
    own = [case for case in result["cases"] if case["assigner"]["name"] in (name, f"{name}-fast")]
    if not own:
        sys.exit(f"{name}: is not in the result of configs/methods.json")
    own = [case for case in own if case["grid"]["name"] == own[0]["grid"]["name"]]
    lines = [HEADS, ["---", "---"] + ["---:"] * (len(HEADS) - 2)] + [row(case, firsts) for case in own]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def places(page):
    return re.findall(r"^<!-- ([\w.-]+) -->$", page, re.M)


def page_with(page, result):
    """The page with all its places filled."""
    for name in places(page):
        found = [path for path in PICTURES.glob("*.*") if path.stem == name]
        if len(found) != 1:
            sys.exit(f"{name}: no picture in results/methods; run with --pictures PROGRAM")
        label = DRAWN.get(name, name)
        caption = (f"Cells of `{label}`: {view_of(name, result).caption}" if found[0].suffix == ".svg"
                   else f"Pixels of which `{name}` evaluates a light that does not reach them")
        text = f"![{caption}](../results/methods/{found[0].name})\n\n{rows_of(name, result)}"
        page = re.sub(f"<!-- {re.escape(name)} -->.*?<!-- /{re.escape(name)} -->",
                      lambda _, name=name, text=text: f"<!-- {name} -->\n{text}\n<!-- /{name} -->", page, flags=re.S)
    return page


def view_of(name, result):
    if name in SPECIAL:
        return SPECIAL[name][2]
    return VIEWS[next(case["grid"]["kind"] for case in result["cases"] if case["assigner"]["name"] == name)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--pictures", metavar="PROGRAM")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    stale = []
    if options.pictures:
        with tempfile.TemporaryDirectory() as temporary:
            made = pathlib.Path(temporary)
            make_pictures(options.pictures, made)
            fresh, kept = ({path.name: path for path in folder.glob("*.*")} for folder in (made, PICTURES))
            # Another zlib packs the same pixels otherwise: of PNG files only that they are there is checked.
            stale += [name for name in sorted({*fresh, *kept}) if name not in fresh or name not in kept or
                      name.endswith(".svg") and fresh[name].read_bytes() != kept[name].read_bytes()]
            if not options.check:
                shutil.rmtree(PICTURES, ignore_errors=True)
                shutil.copytree(made, PICTURES)
    page = PAGE.read_text()
    filled = page_with(page, json.loads((options.folder / "methods.json").read_text()))
    if options.check:
        stale += ["docs/methods.md"] if filled != page else []
        if stale:
            print("to be made anew by scripts/methods_page.py: " + ", ".join(stale), file=sys.stderr)
        return 1 if stale else 0
    PAGE.write_text(filled)
    return 0


if __name__ == "__main__":
    sys.exit(main())
