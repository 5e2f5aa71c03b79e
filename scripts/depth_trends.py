"""What papers say of depth and clusters, on a result of configs/depth.json or another one with its methods and slices; for
scripts/trends.

(a) more slices: lists get shorter, references (pairs) more
(b) a list per tile costs most where depth is long; a mask of 32 parts (2.5D) helps at discontinuities, hardly on slopes
(c) planes alone leave the box of clusters as it is, boxes and sphere refinement take some off, exact lists all; which of
    the two takes more depends on the scene, and on these they are within a few percent
(d) cone tests pay off where cells are nearly as deep as they are wide: much more than in long ones, hardly less than in flat
(e) the longest list says little of what pixels pay; the 99th percentile follows it
"""
import math

LONG, CUBICAL, FLAT = 16, 64, 256  # slices of the grids


def current(label):
    """The name of a method as it is now, of a result of an earlier version."""
    return label.replace("(spot=ball)", "(spot=sphere)")


class Scene:
    def __init__(self, scene, cases):
        self.name = scene["name"]
        self.spots = scene["lights"]["spot"]
        self.cases = {(case["grid"]["cells"][2], current(case["assigner"]["label"])): case for case in cases}

    def case(self, slices, label):
        return self.cases[(slices, label)]

    def lists(self, slices, label, figure):
        return self.case(slices, label)["occupancy"]["lights_per_cell"][figure]

    def pairs(self, slices, label):
        return self.case(slices, label)["error"]["reported_pairs"]

    def true_pairs(self, slices):
        return self.case(slices, "exact-fast")["error"]["true_pairs"]

    def at_surfaces(self, slices, label):
        """Lights that a visible pixel loops over."""
        opaque = self.case(slices, label)["samples"]["opaque"]
        return opaque["evaluated"] / opaque["samples"]

    def jumps(self):
        """Share of the visible pixels in tiles where depth jumps."""
        ranges = self.case(LONG, "exact-fast")["depth_ranges"]
        slopes, jumps = ranges["slopes"]["pixels"], ranges["discontinuities"]["pixels"]
        return jumps / (slopes + jumps)


def row(figures):
    return "  ".join(f"{figure:10.2f}" for figure in figures)


def more_slices(scene):
    means = [scene.lists(slices, "exact-fast", "mean") for slices in (LONG, CUBICAL, FLAT)]
    pairs = [scene.pairs(slices, "exact-fast") for slices in (LONG, CUBICAL, FLAT)]
    yield f"lights per cell {row(means)}", means[0] > means[1] > means[2]
    yield f"pairs           {row(pairs)}", pairs[0] < pairs[1] < pairs[2]


def tiles_and_depth(scene):
    tiled, masked, clustered = (scene.at_surfaces(CUBICAL, label) for label in ("tiled", "tiled-2.5d", "exact-fast"))
    helps = tiled / masked
    text = f"lights per pixel: tiled {tiled:.2f}, 2.5D {masked:.2f}, clustered {clustered:.2f}; depth jumps in {100 * scene.jumps():.0f} %"
    yield text, tiled >= masked and tiled > clustered
    if scene.jumps() > 0.5:
        yield f"discontinuities: the mask takes {100 * (1 - 1 / helps):.0f} % off (at least 30)", helps > 1 / 0.7
    elif scene.jumps() < 0.1:
        yield f"slopes: the mask takes {100 * (1 - 1 / helps):.0f} % off (less than 15)", helps < 1 / 0.85


def tests(scene):
    cube = scene.pairs(LONG, "bounds(spot=sphere)")
    planes, boxes, refinement, exact = off = [
        100 * (1 - scene.pairs(LONG, label) / cube)
        for label in ("planes(spot=sphere)", "aabb(spot=sphere)", "sphere-refinement(spot=sphere)", "exact-fast")]
    yield (f"% off the box of clusters: planes, boxes, refinement, exact {row(off)}",
           planes < 1 and boxes > 10 and exact > max(boxes, refinement) and refinement > boxes - 3)
    excess = scene.case(LONG, "exact-fast")["error"]["false_positives"]
    yield f"false positives of exact lists {excess}", excess == 0


def cones(scene):
    if scene.spots == 0:
        return

    def gain(slices):
        return 100 * (scene.pairs(slices, "aabb(spot=sphere)") - scene.pairs(slices, "aabb")) / scene.true_pairs(slices)

    long, cubical, flat = gains = [gain(slices) for slices in (LONG, CUBICAL, FLAT)]
    yield f"pairs that cones take off, in % of the true ones {row(gains)}", cubical > long and flat - cubical < cubical - long


def longest(scene):
    falls = [scene.lists(LONG, "aabb", figure) / scene.lists(FLAT, "aabb", figure) for figure in ("p99", "max")]
    pixels = scene.at_surfaces(LONG, "aabb") / scene.at_surfaces(FLAT, "aabb")
    by_p99, by_longest = (abs(math.log(pixels / fall)) for fall in falls)
    text = f"from {LONG} to {FLAT} slices by a factor of: lights per pixel, p99, longest {row([pixels, *falls])}"
    yield text, by_p99 < by_longest


TRENDS = [("a", f"more slices ({LONG}, {CUBICAL}, {FLAT})", more_slices), ("b", "tiles and depth", tiles_and_depth),
          ("c", f"tests ({LONG} slices)", tests), ("d", f"cones ({LONG}, {CUBICAL}, {FLAT} slices)", cones),
          ("e", "the longest list", longest)]


def scenes_of(result, names):
    return [Scene(scene, [case for case in result["cases"] if case["scene"] == scene["name"]])
            for scene in result["scenes"] if not names or scene["name"] in names]


def checked(result, names=()):
    """Lines (trend, scene, text, whether it holds)."""
    return [(letter, title, scene.name, text, holds) for letter, title, trend in TRENDS
            for scene in scenes_of(result, names) for text, holds in trend(scene)]
