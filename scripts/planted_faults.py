#!/usr/bin/env python3
"""Does `clusterbench check` find what is wrong with light lists? scripts/planted_faults.py CLUSTERBENCH [--scenes NAMES] [--docs FILE]

Takes exact lists of a few scenes, writes them in several layouts with its own code, plants one fault in each, and holds what
`check` says against what was planted: the very pairs of a cell and a light, or the description that is right. Prints a table,
and puts it into FILE. Exit code 1 if a fault was not found.
"""

import argparse
import copy
import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

SCENES = ["street", "hall-512", "rooms"]
LAYOUTS = ["packed", "fixed", "bits", "linked", "runs", "ends"]
MARKS = ("<!-- planted faults -->", "<!-- end of planted faults -->")


class Frame:
    """A dump of exact lists, which `clusterbench run --write-dump` wrote as `packed`."""

    def __init__(self, path):
        self.dump = json.loads(path.read_text())
        self.folder = path.parent
        self.buffers = {name: (self.folder / given["file"]).read_bytes() for name, given in self.dump["buffers"].items()}
        self.lights = sum(rows["count"] for rows in self.dump["lights"]["rows"])
        self.cells = [*self.dump["grid"]["tiles"]["count"], len(self.dump["grid"]["slices"]["boundaries_m"]) - 1]
        self.lists = self.packed_lists()

    def packed_lists(self):
        given = self.dump["lists"][0]
        kinds = {"u8": "B", "u16": "H", "u32": "I"}
        entry = kinds[given["entries"]["type"]]
        entries = [value for (value,) in struct.iter_unpack("<" + entry, self.buffers["indices"])]
        rows, stride = self.buffers["headers"], given["rows"]["stride"]
        lists = []
        for row in range(0, len(rows), stride):
            (offset,) = struct.unpack_from("<I", rows, row)
            count = sum(struct.unpack_from("<" + kinds[f["type"]], rows, row + f["at"])[0] for f in given["counts"])
            lists.append(entries[offset : offset + count])
        return lists

    def number(self, x, y, z):
        return x + self.cells[0] * (y + self.cells[1] * z)

    def deepest_pair(self):
        """A light whose centre is in a cell: none reaches in deeper than that. As (cell, light)."""
        camera = self.dump["camera"]
        m, (left, right, bottom, top) = camera["view_to_world"], camera["sides"]
        ends = self.dump["grid"]["slices"]["boundaries_m"]
        for light in range(self.lights):
            p = struct.unpack_from("<3d", self.buffers["lights"], 64 * light)
            away = [p[i] - m[12 + i] for i in range(3)]
            x, y, z = (sum(away[i] * m[4 * axis + i] for i in range(3)) for axis in range(3))
            column = math.floor((x / -z - left) / (right - left) * self.cells[0]) if z < 0 else -1
            row = math.floor((top - y / -z) / (top - bottom) * self.cells[1]) if z < 0 else -1
            if not (0 <= column < self.cells[0] and 0 <= row < self.cells[1] and ends[0] < -z < ends[-1]):
                continue
            cell = self.number(column, row, max(i for i, end in enumerate(ends) if end <= -z))
            if light in self.lists[cell]:
                return cell, light
        raise SystemExit("no light of the scene is in view")


# --- The layouts, without any code of clusterbench ---


def u32(values):
    return struct.pack(f"<{len(values)}I", *values)


def packed(lists, lights):
    rows, entries = [], []
    for cell in lists:
        rows += [len(entries), len(cell)]
        entries += cell
    return {"cells": u32(rows), "indices": u32(entries)}, {
        "layout": "packed",
        "rows": {"buffer": "cells", "stride": 8},
        "offset": {"at": 0, "type": "u32"},
        "counts": [{"at": 4, "type": "u32"}],
        "entries": {"buffer": "indices", "type": "u32"},
    }


def fixed(lists, lights):
    room = max(map(len, lists)) + 3
    values = [value for cell in lists for value in [len(cell), *cell, *[0xFFFFFFFF] * (room - len(cell))]]
    return {"cells": u32(values)}, {
        "layout": "fixed",
        "rows": {"buffer": "cells", "stride": 4 * (room + 1)},
        "counts": [{"at": 0, "type": "u32"}],
        "per_cell": room,
        "entries": {"at": 4, "type": "u32"},
    }


def bits(lists, lights):
    words = (lights + 31) // 32
    rows = bytearray()
    for cell in lists:
        rows += sum(1 << light for light in set(cell)).to_bytes(4 * words, "little")
    return {"words": bytes(rows)}, {"layout": "bits", "rows": {"buffer": "words", "stride": 4 * words}}


def linked(lists, lights):
    heads, nodes = [], []
    for cell in lists:
        heads.append(len(nodes) // 2 if cell else 0xFFFFFFFF)
        for i, light in enumerate(cell):
            nodes += [light, len(nodes) // 2 + 1 if i + 1 < len(cell) else 0xFFFFFFFF]
    return {"heads": u32(heads), "nodes": u32(nodes)}, {
        "layout": "linked",
        "rows": {"buffer": "heads", "stride": 4},
        "head": {"at": 0, "type": "u32"},
        "nodes": {"buffer": "nodes", "stride": 8, "light": {"at": 0, "type": "u32"}, "next": {"at": 4, "type": "u32"}},
    }


def runs(lists, lights):
    rows, entries = [], []
    for cell in lists:
        begin = len(entries) // 2
        for light in cell:
            if len(entries) // 2 > begin and entries[-2] + entries[-1] + 1 == light:
                entries[-1] += 1
            else:
                entries += [light, 0]
        rows += [begin, len(entries) // 2 - begin]
    buffers, given = packed([], 0)
    given["layout"] = "runs"
    return {"cells": u32(rows), "indices": u32(entries)}, given


def ends(lists, lights):
    """As packed, with the offset of the next cell as the end of a list."""
    begins = [0]
    for cell in lists:
        begins.append(begins[-1] + len(cell))
    buffers, given = packed(lists, lights)
    given["rows"]["stride"] = 4
    given["end"] = given.pop("counts")[0]
    return {**buffers, "cells": u32(begins)}, given


WRITERS = {"packed": packed, "fixed": fixed, "bits": bits, "linked": linked, "runs": runs, "ends": ends}


class Planted:
    """A dump with a fault: the lists as the engine would have them, and changes of buffers and description."""

    def __init__(self, frame, layout, lists):
        self.frame, self.lists = frame, lists
        self.dump = copy.deepcopy(frame.dump)
        self.files, self.dump["lists"] = self.written(layout)
        self.files["lights"] = frame.buffers["lights"]

    def written(self, layout):
        files, given = WRITERS[layout](self.lists, self.frame.lights)
        return files, [given]

    def part(self):
        return self.dump["lists"][0]

    def lost(self):
        return sum(len(set(exact) - set(listed)) for exact, listed in zip(self.frame.lists, self.lists))

    def check(self, program, folder):
        self.dump["buffers"] = {name: {"file": name + ".bin"} for name in self.files}
        for name, data in self.files.items():
            (folder / (name + ".bin")).write_bytes(data)
        (folder / "dump.json").write_text(json.dumps(self.dump))
        out = folder / "out.json"
        out.unlink(missing_ok=True)
        command = [program, "check", "--methods", "none", folder / "dump.json", "--json", out, "--most-lost", "1"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120)
        found = json.loads(out.read_text())["frames"][0]["sets"][0] if out.exists() else None
        return done, found


# --- Faults: plant(frame, layout) gives a Planted, or None where the layout has no such fault; found(...) whether it was told ---


def changed(frame, layout, change):
    return Planted(frame, layout, change([list(cell) for cell in frame.lists]))


def remove_deepest(frame, layout):
    cell, light = frame.deepest_pair()
    planted = changed(frame, layout, lambda lists: lists[:cell] + [[i for i in lists[cell] if i != light]] + lists[cell + 1 :])
    planted.pair = cell, light
    return planted


def is_deepest(planted, found, done):
    first = found["lost"][0] if found and found["lost"] else {}
    return (
        found["verdict"] == "lost"
        and found["error"]["lost_pairs"] == 1
        and (first["row"], first["light"]) == planted.pair
        and abs(first["reach_percent"] - 100) < 1e-6
    )


def loses_as_planted(planted, found, done):
    return found is not None and found["verdict"] == "lost" and found["error"]["lost_pairs"] == planted.lost() > 0


def loses_or_tells_the_first_index(planted, found, done):
    other = found["other_reading"]
    is_told = other is not None and other["lists"] == "indices that count from 1 (entries.first_light)" and other["lost_pairs"] == 0
    return found["error"]["lost_pairs"] == planted.lost() > 0 and found["verdict"] == ("misread" if is_told else "lost")


def index_off_by_one(frame, layout):
    lights = frame.lights
    return changed(frame, layout, lambda lists: [sorted((light + 1) % lights for light in cell) for cell in lists])


def one_index_off_by_one(frame, layout):
    def change(lists):
        for cell in lists:
            for i, light in enumerate(cell):
                if light + 1 < frame.lights and light + 1 not in cell:
                    cell[i] = light + 1
                    return lists
        return lists

    return changed(frame, layout, change)


def slice_shifted(frame, layout):
    def change(lists):
        tiles = frame.cells[0] * frame.cells[1]
        z = frame.deepest_pair()[0] // tiles
        z = min(z, frame.cells[2] - 2)
        begin, middle, end = z * tiles, (z + 1) * tiles, (z + 2) * tiles
        return lists[:begin] + lists[middle:end] + lists[begin:middle] + lists[end:]

    return changed(frame, layout, change)


def axes_transposed(frame, layout):
    nx, ny, nz = frame.cells
    order = [frame.number(x, y, z) for x in range(nx) for y in range(ny) for z in range(nz)]
    planted = changed(frame, layout, lambda lists: [lists[cell] for cell in order])
    planted.wanted = {"axes": "zyx", "lost_pairs": 0}
    return planted


def rows_upside_down(frame, layout):
    nx, ny, nz = frame.cells
    order = [frame.number(x, ny - 1 - y, z) for z in range(nz) for y in range(ny) for x in range(nx)]
    planted = changed(frame, layout, lambda lists: [lists[cell] for cell in order])
    planted.wanted = {"first_row": "bottom", "lost_pairs": 0}
    return planted


def is_other_reading(planted, found, done):
    other = found["other_reading"] if found else None
    return found["verdict"] == "misread" and all(other[key] == value for key, value in planted.wanted.items())


def handedness_swapped(frame, layout):
    planted = Planted(frame, layout, frame.lists)
    planted.dump["camera"]["forward"] = "+z"
    planted.wanted = {"camera": "camera.forward: the other way", "lost_pairs": 0}
    return planted


def grown(frame):
    """The lists as of an engine that culls coarsely: each light in all cells of its columns and rows, and of those beside them."""
    nx, ny, nz = frame.cells
    columns = {}
    for z in range(nz):
        for y in range(ny):
            for x in range(nx):
                for light in frame.lists[frame.number(x, y, z)]:
                    columns.setdefault((x, y), set()).add(light)
    lists = []
    for _z in range(nz):
        for y in range(ny):
            for x in range(nx):
                beside = [columns.get((x + dx, y + dy), set()) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
                lists.append(sorted(set().union(*beside)))
    return lists


def rows_upside_down_in_loose_lists(frame, layout):
    planted = Planted(frame, layout, grown(frame))
    planted.dump["grid"]["first_row"] = "bottom"
    planted.wanted = {"order": "grid.first_row 'top'"}
    return planted


def mirrored_in_loose_lists(frame, layout):
    planted = Planted(frame, layout, grown(frame))
    matrix = planted.dump["camera"]["view_to_world"]
    matrix[0:3] = [-number for number in matrix[0:3]]
    planted.wanted = {"camera": "camera: the x row of world_to_view negated"}
    return planted


def inverse_matrix(frame, layout):
    planted = Planted(frame, layout, frame.lists)
    camera = planted.dump["camera"]
    camera["world_to_view"] = camera.pop("view_to_world")
    planted.wanted = {
        "camera": "camera.view_to_world and camera.world_to_view: the other of the two (the matrix is the inverse)",
        "lost_pairs": 0,
    }
    return planted


def lights_in_view_space(frame, layout):
    planted = Planted(frame, layout, frame.lists)
    m = planted.dump["camera"]["view_to_world"]
    lights = bytearray(planted.files["lights"])
    for row in range(0, len(lights), 64):
        for at, origin in ((0, m[12:15]), (32, [0, 0, 0])):  # position and direction
            away = [number - begin for number, begin in zip(struct.unpack_from("<3d", lights, row + at), origin)]
            turned = [sum(away[i] * m[4 * axis + i] for i in range(3)) for axis in range(3)]
            struct.pack_into("<3d", lights, row + at, *turned)
    planted.files["lights"] = bytes(lights)
    planted.wanted = {"camera": "lights.space 'view'", "lost_pairs": 0}
    return planted


def lists_cut(frame, layout):
    most = max(map(len, frame.lists)) // 2
    return changed(frame, layout, lambda lists: [cell[:most] for cell in lists])


def tells_the_limit(planted, found, done):
    error = found["error"]
    is_counted = error["lost_in_longest_lists"] == error["lost_pairs"] == planted.lost() > 0
    return found["verdict"] == "lost" and is_counted and "does the engine take no more lights for a cell?" in done.stdout


def with_ranges(frame, layout, change, wanted):
    planted = Planted(frame, layout, frame.lists)
    lights = bytearray(planted.files["lights"])
    for at in range(24, len(lights), 64):
        struct.pack_into("<d", lights, at, change(*struct.unpack_from("<d", lights, at)))
    planted.files["lights"] = bytes(lights)
    planted.wanted = {"lights": wanted}
    return planted


def ranges_squared(frame, layout):
    return with_ranges(frame, layout, lambda r: r * r, "lights.rows range.is 'squared'")


def diameters(frame, layout):
    half = "ranges half as large (the number is a diameter, or the engine culls with half the range)"
    return with_ranges(frame, layout, lambda r: 2 * r, half)


def wrong_width(frame, layout):
    if layout not in ("packed", "fixed", "runs", "ends"):
        return None
    planted = Planted(frame, layout, frame.lists)
    planted.part()["entries"]["type"] = "u16"
    return planted


def names_the_width(planted, found, done):
    if found["verdict"] == "unreadable":
        return "entries as u32" in (found["reading"]["likely_reading"] or "")
    return found["verdict"] == "misread" and found["other_reading"]["lists"] == "entries as u32"


def count_taken_for_end(frame, layout):
    if layout != "packed":
        return None
    planted = Planted(frame, layout, frame.lists)
    planted.part()["end"] = planted.part().pop("counts")[0]
    planted.reading = "the end as a count of entries (counts)"
    return planted


def names_the_reading(planted, found, done):
    likely, other = found["reading"]["likely_reading"] or "", found["other_reading"]
    return planted.reading in likely or (other is not None and other["lists"] == planted.reading)


def offset_off_by_one(frame, layout):
    planted = Planted(frame, layout, frame.lists)
    if layout in ("packed", "runs", "ends"):
        stride = 8 if layout == "runs" else 4
        planted.files["indices"] += bytes(stride)
        planted.part()["entries"]["at"] = stride
    elif layout == "fixed":
        planted.files["cells"] += bytes(4)
        planted.part()["entries"]["at"] += 4
        planted.part()["rows"]["stride"] = planted.part()["rows"]["stride"]
        planted.part()["per_cell"] -= 1
    elif layout == "bits":
        planted.files["words"] += bytes(4)
        planted.part()["rows"]["at"] = 4
    else:
        planted.files["heads"] += struct.pack("<I", 0xFFFFFFFF)
        planted.part()["rows"]["at"] = 4
    return planted


def is_not_right(planted, found, done):
    return found is not None and found["verdict"] in ("lost", "misread", "unreadable") and done.returncode == 1


def buffer_truncated(frame, layout):
    planted = Planted(frame, layout, frame.lists)
    last = list(WRITERS[layout](frame.lists, frame.lights)[0])[-1]
    planted.files[last] = planted.files[last][: len(planted.files[last]) * 3 // 4]
    planted.cut = last
    return planted


def names_the_buffer(planted, found, done):
    if found is None:
        return done.returncode == 2 and f"'{planted.cut}'" in done.stderr and done.stderr.count("\n") == 1
    return found["verdict"] == "unreadable" and any(f"'{planted.cut}'" in fault["message"] for fault in found["reading"]["faults"])


def light_twice(frame, layout):
    if layout in ("bits", "runs"):
        return None
    cell, light = frame.deepest_pair()
    planted = changed(frame, layout, lambda lists: lists[:cell] + [[*lists[cell], light]] + lists[cell + 1 :])
    planted.pair = cell, light
    return planted


def names_the_light_that_is_twice(planted, found, done):
    fault = found["reading"]["twice"][0]
    x, y, z = fault["cell"]
    name = f"light {planted.pair[1]} is twice in its list"
    same_cell = planted.frame.number(x, y, z) == planted.pair[0]
    return found["verdict"] == "twice" and found["reading"]["twice_count"] == 1 and same_cell and name in fault["message"]


FAULTS = [
    ("a light removed from the cell where it reaches deepest", remove_deepest, is_deepest),
    ("one index off by one", one_index_off_by_one, loses_as_planted),
    ("all indices off by one", index_off_by_one, loses_or_tells_the_first_index),
    ("two slices in each other's place", slice_shifted, loses_as_planted),
    ("axes transposed: `zyx` for `xyz`", axes_transposed, is_other_reading),
    ("rows counted from the bottom", rows_upside_down, is_other_reading),
    ("handedness swapped", handedness_swapped, is_other_reading),
    ("rows counted from the bottom, of loose lists", rows_upside_down_in_loose_lists, is_other_reading),
    ("x axis mirrored, of loose lists", mirrored_in_loose_lists, is_other_reading),
    ("the inverse of the view matrix", inverse_matrix, is_other_reading),
    ("lights in view space called those of the world", lights_in_view_space, is_other_reading),
    ("half as many lights for a cell at most as are in the longest list", lists_cut, tells_the_limit),
    ("squares of ranges read as ranges", ranges_squared, is_other_reading),
    ("diameters read as ranges", diameters, is_other_reading),
    ("indices of 32 bits read as 16", wrong_width, names_the_width),
    ("counts read as ends of lists", count_taken_for_end, names_the_reading),
    ("lists begin one entry too late", offset_off_by_one, is_not_right),
    ("a buffer cut off", buffer_truncated, names_the_buffer),
    ("a light twice in a list", light_twice, names_the_light_that_is_twice),
]


def told(done):
    """The first line of `check` on what is wrong, without its numbers of one frame's own."""
    lines = (done.stdout if done.returncode == 1 else done.stderr).splitlines()
    lines = [line.strip() for line in lines if not re.search(r": frustum grid of ", line)]
    return re.sub(r"^clusterbench: \S*/", "", lines[0])


def exact_frame(program, repository, scene, folder):
    folder.mkdir()
    grid = {"kind": "frustum", "tiles": {"count": [12, 7]}, "slices": {"scheme": "exponential", "count": 10}}
    command = [program, "run", repository / "scenes" / (scene + ".glb"), "--assigner", "exact-fast"]
    grid = ["--set", "grids=" + json.dumps([grid])]
    done = subprocess.run(
        [*command, *grid, "--write-dump", folder, "--dump-frames", "1"], capture_output=True, text=True, timeout=300
    )
    if done.returncode != 0:
        raise SystemExit(f"{scene}: {done.stderr}")
    return Frame(next(folder.glob("*.json")))


def table(rows):
    lines = ["| planted | found | what `check` says first (street, the first layout) |", "|---|---|---|"]
    lines += [f"| {name} | {found} of {tried} | {message} |" for name, found, tried, message in rows]
    return "\n".join(lines) + "\n"


def plant_all(program, frames, folder):
    rows, missed = [], []
    for name, plant, is_found in FAULTS:
        found = tried = 0
        message = ""
        for scene, frame in frames.items():
            for layout in LAYOUTS:
                planted = plant(frame, layout)
                if planted is None:
                    continue
                done, answer = planted.check(program, folder)
                tried += 1
                message = message or told(done)
                try:
                    is_right = is_found(planted, answer, done)
                except (KeyError, IndexError, TypeError) as problem:
                    is_right = False
                    done.stderr += repr(problem)
                found += is_right
                if not is_right:
                    missed.append(f"{name}, {scene}, {layout}: {done.stdout}{done.stderr}")
        rows.append((name, found, tried, message))
    return rows, missed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--scenes", default=",".join(SCENES))
    parser.add_argument("--docs", type=pathlib.Path)
    flags = parser.parse_args()
    program = pathlib.Path(flags.program).resolve()
    repository = pathlib.Path(__file__).resolve().parent.parent
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        frames = {scene: exact_frame(program, repository, scene, folder / scene) for scene in flags.scenes.split(",")}
        for scene, frame in frames.items():
            for layout in LAYOUTS:
                done, found = Planted(frame, layout, frame.lists).check(program, folder)
                if done.returncode != 0 or found["error"]["false_positives"] != 0:
                    raise SystemExit(f"{scene}, {layout}: exact lists are not right: {done.stdout}{done.stderr}")
        rows, missed = plant_all(program, frames, folder)
    print(table(rows), end="")
    for line in missed:
        print("not found: " + line, file=sys.stderr)
    if flags.docs:
        text = flags.docs.read_text()
        begin, end = text.index(MARKS[0]) + len(MARKS[0]), text.index(MARKS[1])
        flags.docs.write_text(text[:begin] + "\n" + table(rows) + text[end:])
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
