#!/usr/bin/env python3
"""Puts measured tables between the marks of docs/accuracy.md.

scripts/accuracy_page.py FOLDER, where inflation.json and lookup.json are results of the configurations of that name and
stress.json is what `clusterbench stress` wrote.
"""
import json
import pathlib
import sys

folder = pathlib.Path(sys.argv[1])
page = pathlib.Path(__file__).resolve().parent.parent / "docs" / "accuracy.md"


def load(name):
    return json.loads((folder / f"{name}.json").read_text())


def table(headings, rows):
    lines = ["| " + " | ".join(row) + " |" for row in [headings, ["---"] * len(headings), *rows]]
    return "\n".join(lines)


def per_cent(part, whole):
    return f"{100.0 * part / whole:.3g} %" if whole else "-"


def inflation():
    """Pairs with the derived padding beside pairs without, per method and scene."""
    scenes, cases = [], {}
    for case in load("inflation")["cases"]:
        if case["scene"] not in scenes:
            scenes.append(case["scene"])
        bare = case["assigner"]["params"]["inflation"] == 0
        cases.setdefault(case["assigner"]["name"], {})[(case["scene"], bare)] = case["error"]
    rows = []
    for name, found in cases.items():
        row = [f"`{name}`"]
        for scene in scenes:
            padded, bare = found[(scene, False)], found[(scene, True)]
            added = padded["reported_pairs"] - bare["reported_pairs"]
            row.append(f"{added} of {padded['reported_pairs']}, {bare['false_negatives']} lost without")
        rows.append(row)
    return table(["pairs added by the padding", *scenes], rows)


def lookup():
    rows = []
    for case in load("lookup")["cases"]:
        if case["assigner"]["name"] not in ("exact", "distance", "world-grid"):
            continue
        cells = [case["scene"], "/".join(case["name"].split("/")[2:-2]), f"`{case['assigner']['name']}`"]
        ways = {(way["logarithm"], way["depth"]): way for way in case["lookup"]}
        for logarithm in ("rounded", "glsl", "fast"):
            way = ways[(logarithm, "given")]
            cells.append(f"{per_cent(way['missed'], way['needed'])}, {way['safe_padding_ulps']} ulp")
        way = ways[("rounded", "d24")]
        cells.append(per_cent(way["missed"], way["needed"]))
        rows.append(cells)
    headings = ["scene", "grid", "lists", "rounded: missed, padding", "GLSL's 3 ulp", "fast, 0.005", "rounded, D24 depth"]
    return table(headings, rows)


def stress():
    """Conservative methods: trials, true pairs, losses and extra pairs over all hard cases."""
    found = load("stress")
    conservative = {method["label"] for method in found["methods"] if method["conservative"]}
    sums = {}
    for result in found["results"]:
        if result["method"] in conservative:
            keys = ("trials", "true_pairs", "misses", "extra_pairs")
            before = sums.get(result["method"], [0] * len(keys))
            sums[result["method"]] = [a + result[key] for a, key in zip(before, keys)]
    rows = [[f"`{name}`", str(trials), str(pairs), str(misses), per_cent(extra, pairs)]
            for name, (trials, pairs, misses, extra) in sums.items()]
    return table(["conservative method", "trials", "true pairs", "lost", "extra pairs"], rows)


def naive():
    found = load("stress")
    rows = []
    for method in found["methods"]:
        if method["conservative"]:
            continue
        losses = [result for result in found["results"] if result["method"] == method["label"] and result["misses"]]
        search = next((s for s in found["searches"] if s["method"] == method["label"]), None)
        deepest = max(losses, key=lambda loss: loss["deepest_miss"]["depth"], default=None)
        row = [f"`{method['label']}`", ", ".join(loss["case"] for loss in losses) or "-"]
        row.append(f"{100 * deepest['deepest_miss']['depth']:.3g} % of the range, {deepest['case']}" if deepest else "-")
        row.append(f"{100 * search['deepest_miss']['depth']:.3g} %" if search and search["deepest_miss"] else "none")
        name = method["label"].split("(")[0]
        row.append(f"`clusterbench stress --methods {name} --failures DIR`")
        rows.append(row)
    return table(["naive form", "loses lights in", "deepest", "deepest by the search", "command"], rows)


def search():
    rows = []
    found = load("stress")
    conservative = {method["label"] for method in found["methods"] if method["conservative"]}
    for one in found["searches"]:
        if one["method"] in conservative:
            rows.append([f"`{one['method']}`", f"{one['tries']:,}", str(one["misses"]),
                         f"{one['least_margin_roundoffs']:g}"])
    return table(["conservative method", "tries", "lost", "least margin found, roundoffs"], rows)


text = page.read_text()
for name, make in (("inflation", inflation), ("lookup", lookup), ("stress", stress), ("naive", naive), ("search", search)):
    begin, end = f"<!-- {name} -->", f"<!-- /{name} -->"
    head, rest = text.split(begin)
    text = head + begin + "\n" + make() + "\n" + end + rest.split(end)[1]
page.write_text(text)
