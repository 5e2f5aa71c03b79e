#!/usr/bin/env python3
"""Checks the structure that CONTRIBUTING.md describes: scripts/check_layers.py [ROOT].

Fails on an #include against the order of layers, or of the folders within a layer (FOLDERS), on a library included outside
of its one home, on a file of src/assign/assigners without its line in registry.inc (or a line without its file), and on a
circle of includes.
"""
import pathlib
import re
import sys

# A file includes only its own layer and those before it.
LAYERS = ["core", "os", "result", "geom", "scene", "view", "depth", "grid", "cull", "assign", "library", "plugin", "layout", "gpu", "measure", "config", "dump", "run", "pictures", "stress", "acceptance",
          "search", "report", "cli"]

# The same for the folders of a layer. Those that stand side by side do not include each other. ".": the files beside the
# folders; where it is not named they stand above all folders.
FOLDERS = {
    "result": [["."], ["figures"], ["documents"]],
    "os": [["."], ["posix", "windows"], ["linux", "mac"]],
    "geom": [["numbers"], ["shapes"], ["ball", "box", "search", "certificate", "single_precision", "projection"], ["filter"],
             ["spot"]],
    "scene": [["."], ["gltf_document"], ["gltf_scene", "writers"], ["generators"]],
    "assign": [["simd"], ["contract"], ["lists"], ["grid_cull"], ["rows"], ["cone"], ["pipeline"], ["bounds"],
               ["box_grid", "depth_bins", "distance", "exact", "raster", "storages"], ["occupied"], ["assigners"]],
    "gpu": [["device"], ["vulkan"], ["methods", "reading"], ["user_shaders"]],
    "measure": [["truth", "statistics"], ["lists", "samples"], ["shadows", "light_maps"]],
    "config": [["schema"], ["presets"]],
    "run": [["cases"], ["timing"], ["counters"], ["findings"], ["passes", "records"]],
    "report": [["cases"], ["comparing", "documents", "presets", "searches"], ["gates", "sizing", "tables", "exports", "page"],
               ["shader_code"], ["choosing", "history", "size_report"], ["results"]],
    "cli": [["command_line", "output", "processes"], ["completion", "options"], ["running", "sizing"], ["commands"]],
}

# Library header -> the only layers that include it.
HOMES = {
    "oneapi/tbb": ["core"],
    "tbb/": ["core"],
    "openssl/": ["core"],
    "re2/": ["core"],
    "boost/": ["measure"],
    "meshoptimizer.h": ["scene"],
    "draco/": ["scene"],
    "embree": ["depth"],
    "hwy/": ["assign"],
    "png.h": ["pictures"],
    "volk.h": ["gpu"],
    "vulkan/": ["gpu"],
    "spirv-tools/": ["gpu"],
    "valijson/": ["config"],
    "nlopt": ["search"],
    "valgrind/": ["run"],
    "CLI/": ["cli"],
    # The operating system. SYSTEM_FOLDERS says where in it.
    "unistd.h": ["os"],
    "fcntl.h": ["os"],
    "poll.h": ["os"],
    "stdlib.h": ["os"],
    "signal.h": ["os"],
    "csignal": ["os"],
    "pthread.h": ["os"],
    "sched.h": ["os"],
    "termios.h": ["os"],
    "dirent.h": ["os"],
    "spawn.h": ["os"],
    "dlfcn.h": ["os"],
    "elf.h": ["os"],
    "sys/": ["os"],
    "linux/": ["os"],
    "malloc": ["os"],
    "mach/": ["os"],
    "mach-o/": ["os"],
    "libproc.h": ["os"],
    "crt_externs.h": ["os"],
    "windows.h": ["os"],
    "psapi.h": ["os"],
    "shellapi.h": ["os"],
    "io.h": ["os"],
}

# System header -> the only folders of the layer os that include it. Headers of the layer, and the files beside its folders,
# are for every system.
SYSTEM_FOLDERS = {
    "windows.h": ["windows"],
    "psapi.h": ["windows"],
    "shellapi.h": ["windows"],
    "io.h": ["windows"],
    "mach": ["mac"],
    "libproc.h": ["mac"],
    "crt_externs.h": ["mac"],
    "linux/": ["linux"],
    "elf.h": ["linux"],
    "unistd.h": ["posix", "linux", "mac"],
    "fcntl.h": ["posix", "linux", "mac", "windows"],
    "signal.h": ["posix", "linux", "mac"],
    "poll.h": ["posix"],
    "dlfcn.h": ["posix"],
    "stdlib.h": ["posix", "mac"],
    "sys/": ["posix", "linux", "mac", "windows"],
    "malloc": ["linux", "mac", "windows"],
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
REGISTRY_LINE = re.compile(r"^\s*CLUSTERBENCH_ASSIGNER\((\w+)\)", re.M)


def includes_of(path):
    return [(kind, name) for kind, name in INCLUDE.findall(path.read_text())]


def layer_faults(name, layer, file_includes):
    for kind, included in file_includes:
        target = included.split("/")[0]
        if kind == '"' and target in LAYERS and LAYERS.index(target) > LAYERS.index(layer):
            yield f"{name}: includes {included}, but layer {layer} comes before layer {target}"
        for library, homes in HOMES.items():
            if included.startswith(library) and layer not in homes:
                yield f"{name}: includes {included}, whose home is {' and '.join(homes)}"


def system_faults(name, folder, file_includes):
    for kind, included in file_includes:
        for header, folders in SYSTEM_FOLDERS.items():
            if kind == "<" and included.startswith(header) and folder not in folders:
                yield f"{name}: includes {included}, which belongs into src/os/{' or src/os/'.join(folders)}"


def folder_of(parts):
    return parts[1] if len(parts) > 2 else "."


def floor_of(layer, folder):
    return next((i for i, floor in enumerate(FOLDERS[layer]) if folder in floor),
                len(FOLDERS[layer]) if folder == "." else None)


def folder_faults(name, layer, folder, file_includes):
    for kind, included in file_includes:
        parts = included.split("/")
        target = folder_of(parts)
        if kind != '"' or parts[0] != layer or target == folder:
            continue
        here, there = floor_of(layer, folder), floor_of(layer, target)
        if here is None or there is None:
            yield f"{name}: includes {included}, but {folder if here is None else target} is no folder of {layer} that FOLDERS knows"
        elif there < here:
            continue
        elif target == ".":
            yield f"{name}: includes {included}, but the files beside the folders of {layer} are above them"
        else:
            place = f"the files beside the folders of {layer} are" if folder == "." else f"{layer}/{folder} is"
            yield f"{name}: includes {included}, but {place} not above {layer}/{target}"


def registry_faults(src):
    folder = src / "assign" / "assigners"
    registry = src / "assign" / "contract" / "registry.inc"
    lines = REGISTRY_LINE.findall(registry.read_text()) if registry.exists() else []
    files = {path.stem for path in folder.glob("*.cpp")}
    for stem in sorted(files - set(lines)):
        yield f"src/assign/assigners/{stem}.cpp: has no line CLUSTERBENCH_ASSIGNER({stem}) in src/assign/contract/registry.inc"
    for stem in sorted(set(lines) - files):
        yield f"src/assign/contract/registry.inc: names {stem}, but src/assign/assigners/{stem}.cpp does not exist"


def circle_faults(graph):
    done, path = set(), []

    def visit(node):
        if node in path:
            yield "circle of includes: " + " -> ".join(path[path.index(node):] + [node])
            return
        if node in done or node not in graph:
            return
        path.append(node)
        for target in graph[node]:
            yield from visit(target)
        path.pop()
        done.add(node)

    for node in sorted(graph):
        yield from visit(node)


def faults(root):
    src = root / "src"
    graph = {}
    for path in sorted(list(src.rglob("*.h")) + list(src.rglob("*.cpp")) + list(src.rglob("*.inc"))):
        relative = path.relative_to(src)
        layer = relative.parts[0]
        if layer not in LAYERS:
            yield f"src/{relative}: is in no layer; layers are {', '.join(LAYERS)}"
            continue
        file_includes = includes_of(path)
        graph[str(relative)] = [name for kind, name in file_includes if kind == '"']
        yield from layer_faults(f"src/{relative}", layer, file_includes)
        if layer == "os":
            yield from system_faults(f"src/{relative}", folder_of(relative.parts), file_includes)
        if layer in FOLDERS:
            yield from folder_faults(f"src/{relative}", layer, folder_of(relative.parts), file_includes)
    yield from circle_faults(graph)
    yield from registry_faults(src)


def main():
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    found = list(faults(root))
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
