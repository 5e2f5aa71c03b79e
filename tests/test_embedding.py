#!/usr/bin/env python3
"""The library as an engine gets it: tests/test_embedding.py CMAKE BUILD_FOLDER PROGRAM CXX

Installs the component `library`, moves the tree, builds the example of docs/embedding.md against it and runs it, by CMake where no
other package is found, and by pkg-config with the flags of other engines; compares lists with those of the program."""

import json
import os
import pathlib
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
OTHERS = ["TBB", "OpenSSL", "glm", "Boost", "nlohmann_json", "CLI11", "embree", "PNG", "NLopt", "meshoptimizer", "draco", "GTest"]
# Flags of the engine's own code.
FLAGS = [["-std=c++20", "-O2"], ["-std=c++2b", "-O0", "-fno-exceptions", "-fno-rtti"], ["-std=gnu++20", "-O3", "-ffast-math", "-march=native"],
         ["-std=c++20", "-D_GLIBCXX_DEBUG", "-D_GLIBCXX_ASSERTIONS"]]
PLUGIN_HEADERS = [name for name in ("clusterbench_plugin.h", "clusterbench_plugin.hpp") if (ROOT / "src" / "plugin" / name).exists()]
# Columns, rows, slices, slicing of print_lists, and the same as flags of the program.
GRIDS = [(16, 9, 24, 1, 0, {"kind": "frustum", "tiles": {"count": [16, 9]}, "slices": {"scheme": "exponential", "count": 24}}),
         (31, 5, 12, 2, 0, {"kind": "frustum", "tiles": {"count": [31, 5]}, "slices": {"scheme": "exponential-first", "count": 12}}),
         (8, 8, 6, 0, 0, {"kind": "frustum", "tiles": {"count": [8, 8]}, "slices": {"scheme": "linear", "count": 6}}),
         (12, 7, 9, 1, 1, {"kind": "distance", "tiles": {"count": [12, 7]}, "slices": {"scheme": "exponential", "count": 9}})]


def run(command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, timeout=300, **options)
    assert done.returncode == 0, f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}"
    return done.stdout


def blocks_of_page():
    page = (ROOT / "docs" / "embedding.md").read_text(encoding="utf-8")
    return {kind: re.search(rf"^```{kind}\n(.*?)^```", page, re.DOTALL | re.MULTILINE)[1] for kind in ("cmake", "cpp", "text")}


def installed_tree(cmake, build, folder):
    first, moved = folder / "first", folder / "moved"
    run([cmake, "--install", build, "--prefix", first, "--component", "library"])
    first.rename(moved)
    names = {str(path.relative_to(moved)) for path in moved.rglob("*") if path.is_file()}
    headers = {name for name in names if name.startswith("include/")}
    assert headers == {"include/clusterbench/assign.h"} | {f"include/{name}" for name in PLUGIN_HEADERS}, headers
    for name in names - headers:
        assert name.endswith((".a", ".cmake", ".pc")), names
        assert name.endswith(".a") or str(folder) not in (moved / name).read_text(), f"{name} names the folder of the installation"
    return moved


def check_example_by_cmake(cmake, cxx, prefix, folder):
    blocks = blocks_of_page()
    project = folder / "engine"
    project.mkdir()
    (project / "CMakeLists.txt").write_text(blocks["cmake"])
    (project / "engine.cpp").write_text(blocks["cpp"])
    run([cmake, "-G", "Ninja", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_CXX_COMPILER={cxx}"]
        + [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in OTHERS])
    run([cmake, "--build", project / "build"])
    printed = run([project / "build" / "engine"])
    assert printed == blocks["text"], f"docs/embedding.md says\n{blocks['text']}and it prints\n{printed}"


def check_plugin_target(cmake, cxx, prefix, folder):
    """clusterbench::plugin gives the headers, and asks for no library."""
    project = folder / "plugin"
    project.mkdir()
    (project / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(plugin LANGUAGES CXX)\nfind_package(clusterbench 0.1 REQUIRED)\n"
        "add_library(plugin MODULE plugin.cpp)\ntarget_link_libraries(plugin PRIVATE clusterbench::plugin)\n")
    (project / "plugin.cpp").write_text("".join(f'#include "{name}"\n' for name in PLUGIN_HEADERS))
    run([cmake, "-G", "Ninja", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={prefix}",
         f"-DCMAKE_CXX_COMPILER={cxx}"])
    run([cmake, "--build", project / "build"])
    linked = run(["ninja", "-C", project / "build", "-t", "commands"])
    assert "plugin.cpp" in linked, linked
    assert "clusterbench_assign" not in linked and "hwy" not in linked, linked


def check_version(cmake, prefix, folder):
    """A later minor version is refused by CMake."""
    project = folder / "later"
    project.mkdir()
    (project / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(later NONE)\nfind_package(clusterbench 0.2 REQUIRED)\n")
    done = subprocess.run([cmake, "-G", "Ninja", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={prefix}"], capture_output=True,
                          text=True, check=False)
    assert done.returncode != 0 and 'requested version "0.2"' in done.stderr, done.stderr


def built_by_pkg_config(cxx, flags, prefix, source, out):
    pkg_config = {**os.environ, "PKG_CONFIG_PATH": ":".join(str(path.parent) for path in prefix.rglob("*.pc"))}
    found = run(["pkg-config", "--cflags", "--libs", "clusterbench-assign", "clusterbench-plugin"], env=pkg_config).split()
    run([cxx, *flags, "-Wall", "-Wextra", "-Wpedantic", "-Werror", source, *found, "-o", out])
    return out


def lights(count):
    draw = random.Random(5)

    def single(lo, hi):
        return struct.unpack("f", struct.pack("f", draw.uniform(lo, hi)))[0]
    points = [[single(-30, 30), single(-8, 8), single(-60, 5), single(0.5, 9)] for _ in range(count)]
    spots = [[single(-30, 30), single(-8, 8), single(-60, 5), single(2, 15), 0, 0, -1, single(0.1, 1.4)] for _ in range(count // 2)]
    return points, spots


def write_scene(path, points, spots):
    """The same lights as glTF. Spots look along -z, as nodes without a rotation do."""
    definitions, nodes = [], []
    for light in points + spots:
        kind = {"type": "point"} if len(light) == 4 else {"type": "spot", "spot": {"innerConeAngle": 0, "outerConeAngle": light[7]}}
        nodes.append({"translation": light[:3], "extensions": {"KHR_lights_punctual": {"light": len(definitions)}}})
        definitions.append({**kind, "range": light[3]})
    nodes.append({"translation": [1, 2, 3], "camera": 0})
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1.1, "znear": 0.1, "zfar": 80, "aspectRatio": 16 / 9}}],
        "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": definitions}}}))


def program_dumps(program, folder, points, spots):
    """Camera, viewport and lists of each grid and method, as the program writes them."""
    write_scene(folder / "level.gltf", points, spots)
    config = {"scenes": [{"path": "level.gltf", "frames": 1}], "viewport": [1280, 720], "grids": [grid[-1] for grid in GRIDS],
              "assigners": ["brute-force", "exact-fast", "distance"], "storages": [{"name": "packed", "index_bits": "16"}]}
    (folder / "config.json").write_text(json.dumps(config))
    run([program, "run", "config.json", "--no-timing", "-q", "--write-dump", "dumps"], cwd=folder)
    dumps = {}
    for path in (folder / "dumps").glob("*.json"):
        dump = json.loads(path.read_text())
        _, _, grid, method, _ = dump["name"].split(",")[0].split("/")
        dumps[grid, method] = (dump, path.parent)
    return dumps


def lists_of(dump, folder):
    words = {name: (folder / buffer["file"]).read_bytes() for name, buffer in dump["buffers"].items()}
    indices = struct.unpack(f"<{len(words['indices']) // 2}H", words["indices"])
    return [list(indices[offset:offset + points + spots]) for offset, points, spots in struct.iter_unpack("<IHH", words["headers"])]


def input_of(threads, grid, method, dump, points, spots):
    camera = dump["camera"]
    numbers = [threads, *grid[:5], method, *dump["viewport"], *camera["view_to_world"][12:15], *camera["sides"], camera["near_m"],
               camera["far_m"], len(points), len(spots)]
    return " ".join(number if isinstance(number, str) else repr(number) for number in numbers + sum(points + spots, []))


def check_lists(engine, dumps, points, spots, threads):
    compared = 0
    for grid in GRIDS:
        start = f"{grid[-1]['kind']} {grid[0]}x{grid[1]} x {grid[2]}"
        for (name, method), (dump, folder) in dumps.items():
            if not name.startswith(start):
                continue
            printed = run([engine], input=input_of(threads if method == "exact-fast" else 1, grid, method, dump, points, spots))
            begins, indices = ([int(number) for number in line.split()] for line in printed.splitlines())
            made = [sorted(indices[begin:end]) for begin, end in zip(begins, begins[1:])]
            expected = [sorted(cell) for cell in lists_of(dump, folder)]
            assert made == expected, f"{engine}: {name}, {method}: lists differ from the program's"
            assert sum(map(len, made)) > 500, (name, method)
            compared += 1
    assert compared == 7, sorted(dumps)


def main():
    cmake, build, program, cxx = sys.argv[1:]
    program = os.path.abspath(program)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prefix = installed_tree(cmake, build, folder)
        check_example_by_cmake(cmake, cxx, prefix, folder)
        check_plugin_target(cmake, cxx, prefix, folder)
        check_version(cmake, prefix, folder)
        points, spots = lights(1200)
        dumps = program_dumps(program, folder, points, spots)
        compilers = [cxx] + [other for other in ("clang++-14", "clang++") if shutil.which(other)][:1]
        for number, flags in enumerate(FLAGS):
            compiler = compilers[number % len(compilers)]
            engine = built_by_pkg_config(compiler, flags, prefix, ROOT / "tests" / "embedding" / "print_lists.cpp",
                                         folder / f"engine_{number}")
            check_lists(engine, dumps, points, spots, 1 + number % 3)


if __name__ == "__main__":
    sys.exit(main())
