#!/usr/bin/env python3
"""Draws speed against error from a result, one panel per scene: scripts/speed_error_chart.py RESULT OUT.svg."""
import json
import math
import sys
from xml.sax.saxutils import escape

WIDTH, PANEL_W, PANEL_H, LEFT, TOP, GAP_X, GAP_Y = 960, 360, 190, 64, 40, 100, 80
COLOURS = {  # Okabe and Ito's palette
    "brute-force": "#999999", "bounds": "#E69F00", "planes": "#D55E00", "aabb": "#56B4E9",
    "sphere-refinement": "#009E73", "distance": "#0072B2", "cascades": "#CC79A7", "world-grid": "#000000",
    "exact": "#882255",
}


def mark(name, x, y, title=""):
    """A disc in the method's colour; of a SIMD variant a ring in its reference's."""
    colour = COLOURS.get(name.removesuffix("-fast"), "#333")
    paint = f'fill="white" stroke="{colour}" stroke-width="3"' if name.endswith("-fast") else f'fill="{colour}"'
    radius = 5 if name.endswith("-fast") else 6
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" {paint}>{title}</circle>'


def points(result, scene):
    for case in result["cases"]:
        if case["scene"] == scene and case.get("timing") and case.get("error", {}).get("excess_ratio") is not None:
            timing = case["timing"]
            time = timing.get("frame_ns", timing["assign_ns"])  # older results tell the assignment alone
            yield (case["assigner"]["name"], time["median"] / 1e3,
                   100.0 * case["error"]["excess_ratio"])


def panel(result, scene, x0, y0):
    found = list(points(result, scene))
    lo = math.floor(math.log10(min(us for _, us, _ in found)))
    hi = math.ceil(math.log10(max(us for _, us, _ in found)))
    top = 10.0 * math.ceil(max(excess for _, _, excess in found) / 10.0 + 0.3)
    at_x = lambda us: x0 + PANEL_W * (math.log10(us) - lo) / max(1, hi - lo)
    at_y = lambda excess: y0 + PANEL_H * (1 - excess / top)
    out = [f'<text x="{x0}" y="{y0 - 12}" font-weight="bold">{escape(scene)}</text>',
           f'<rect x="{x0}" y="{y0}" width="{PANEL_W}" height="{PANEL_H}" fill="none" stroke="#bbb"/>']
    for power in range(lo, hi + 1):
        x = at_x(10.0 ** power)
        out.append(f'<line x1="{x:.1f}" y1="{y0}" x2="{x:.1f}" y2="{y0 + PANEL_H}" stroke="#e5e5e5"/>')
        out.append(f'<text x="{x:.1f}" y="{y0 + PANEL_H + 16}" text-anchor="middle">{10 ** power:g} µs</text>')
    for share in (0.0, 0.5, 1.0):
        y = at_y(top * share)
        out.append(f'<line x1="{x0}" y1="{y:.1f}" x2="{x0 + PANEL_W}" y2="{y:.1f}" stroke="#e5e5e5"/>')
        out.append(f'<text x="{x0 - 6}" y="{y + 4:.1f}" text-anchor="end">{top * share:g} %</text>')
    for name, us, excess in found:
        out.append(mark(name, at_x(us), at_y(excess),
                        f"<title>{escape(name)}: {us:.1f} µs, {excess:.1f} % excess</title>"))
    return out


def legend(names, y):
    out = []
    for place, name in enumerate(names):
        x = LEFT + 220 * (place % 4)
        row = y + 20 * (place // 4)
        out.append(mark(name, x, row) + f'<text x="{x + 12}" y="{row + 4}">{escape(name)}</text>')
    return out


def main():
    result = json.load(open(sys.argv[1]))
    scenes = [scene["name"] for scene in result["scenes"]]
    names = list(dict.fromkeys(case["assigner"]["name"] for case in result["cases"]))
    rows = (len(scenes) + 1) // 2
    height = TOP + rows * (PANEL_H + GAP_Y) + 60
    body = ['<text x="64" y="20">time per frame (left is faster) against false positives in % of the true pairs (lower is tighter)</text>']
    for place, scene in enumerate(scenes):
        body += panel(result, scene, LEFT + (place % 2) * (PANEL_W + GAP_X), TOP + 20 + (place // 2) * (PANEL_H + GAP_Y))
    body += legend(names, TOP + rows * (PANEL_H + GAP_Y) + 20)
    open(sys.argv[2], "w").write(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" font-family="sans-serif" font-size="12">'
        f'<rect width="100%" height="100%" fill="white"/>' + "".join(body) + "</svg>\n")


if __name__ == "__main__":
    main()
