#!/usr/bin/env python3
"""Puts the peers' workloads into docs/performance.md: scripts/peers_table.py FOLDER.

FOLDER holds peers-*.json, results of configs/peers/. How many times faster than `brute-force` a method is comes from
rounds that were measured side by side: the median of the rounds' ratios, and the 95 % interval of that median. It holds
within that run alone: compilers and machines differ by more than 2 in that same loop."""
import json
import pathlib
import re
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
UNIT = "brute-force"
# Fast methods with the algorithm and the arithmetic of their reference; others have its lists only.
SIMD_VARIANTS = {"bounds-fast", "sphere-refinement-fast"}


def timing_of(case):
    """What was measured of a case's time; a result of `run --no-timing` has none."""
    if "timing" not in case:
        sys.exit(f"{case['name']}: has no times; measure again without --no-timing")
    return case["timing"]


def rounds(case):
    return timing_of(case)["assign_ns"]["samples"]


def interval_of_median(values):
    """Order statistics around the median: the binomial 95 % interval, by its normal approximation."""
    ordered, n = sorted(values), len(values)
    half = 0.98 * n**0.5
    low, high = max(0, int(n / 2 - half)), min(n - 1, int(n / 2 + half))
    return ordered[low], ordered[high]


def times_faster(case, than):
    ratios = [slow / fast for slow, fast in zip(rounds(than), rounds(case))]
    return statistics.median(ratios), interval_of_median(ratios)


def load(folder):
    """Workload -> assigner -> case, in the order of the results."""
    workloads = {}
    for path in sorted(folder.glob("peers-*.json")):
        for case in json.loads(path.read_text())["cases"]:
            workloads.setdefault(case["scene"], {})[case["assigner"]["label"]] = case
    if not workloads:
        sys.exit(f"{folder}: no peers-*.json")
    return dict(sorted(workloads.items()))


def short(value):
    return f"{value:,.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def table(workloads, cell):
    names = list(dict.fromkeys(name for cases in workloads.values() for name in cases))
    lines = ["| | " + " | ".join(workloads) + " |", "|---|" + "---:|" * len(workloads)]
    for name in names:
        lines.append(f"| `{name}` | " + " | ".join(
            cell(cases[name], cases) if name in cases else "" for cases in workloads.values()) + " |")
    return "\n".join(lines)


def speed(case, cases):
    ratio, (low, high) = times_faster(case, cases[UNIT])
    microseconds = short(timing_of(case)["assign_ns"]["median"] / 1e3)
    return microseconds if case is cases[UNIT] else f"{microseconds} ({short(ratio)}×, {short(low)}–{short(high)})"


def cost(case, _):
    timing = timing_of(case)
    return f"{short(timing['ns_per_pair'])} / {short(timing['floor_ratio'])}"


def error(case, _):
    excess = case["error"]["false_positives"] / max(1, case["error"]["true_pairs"])
    return f"{100 * excess:.1f} % / {case['error']['false_negatives']}"


def variant(case, cases):
    name = case["assigner"]["name"]
    reference = cases.get(name.removesuffix("-fast"))
    if reference is None or reference is case:
        return ""
    ratio, (low, high) = times_faster(case, reference)
    return f"{short(ratio)}× ({short(low)}–{short(high)})"


def variant_table(workloads):
    """Fast methods by how many times faster than their references they are."""
    fast = {name: {k: c for k, c in cases.items() if k.endswith("-fast") or k.removesuffix("-fast") + "-fast" in cases}
            for name, cases in workloads.items()}
    lines = [line for line in table(fast, variant).splitlines() if re.search(r"\d|---|^\| \| ", line.split("|", 2)[-1])]
    names = [re.match(r"\| `([^`]+)` ", line) for line in lines]
    return "\n".join(line if name is None or name[1] in SIMD_VARIANTS else line.replace("` |", "`, another algorithm |", 1)
                     for line, name in zip(lines, names))


def put(path, name, text):
    page = path.read_text()
    begin, end = f"<!-- {name} -->", f"<!-- /{name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.S)
    if not pattern.search(page):
        sys.exit(f"{path.name}: no place marked {begin}")
    path.write_text(pattern.sub(lambda _: f"{begin}\n{text}\n{end}", page))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    workloads = load(pathlib.Path(sys.argv[1]))
    performance = ROOT / "docs" / "performance.md"
    put(performance, "peers-speed", table(workloads, speed))
    put(performance, "peers-cost", table(workloads, cost))
    put(performance, "peers-error", table(workloads, error))
    put(performance, "peers-variants", variant_table(workloads))


if __name__ == "__main__":
    main()
