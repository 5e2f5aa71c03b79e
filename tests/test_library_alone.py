#!/usr/bin/env python3
"""Does the library for engines build with its own needs alone? tests/test_library_alone.py CMAKE CXX

Configures with CLUSTERBENCH_LIBRARY_ONLY where all other packages are hidden, looks at what each of its files includes, and compiles
one of each layer. (Compiling all of them takes some minutes: scripts/test_library_alone.)"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
HIDDEN = ["TBB", "OpenSSL", "glm", "Boost", "nlohmann_json", "CLI11", "embree", "PNG", "NLopt", "meshoptimizer", "draco", "GTest", "Vulkan",
          "benchmark", "Python3"]
ALLOWED = ("hwy/", "intrin.h")  # that of Microsoft's compiler, for Windows alone
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
# Compiled: small files that include much.
COMPILED = ["core/text.cpp", "core/own_threads.cpp", "scene/boxes.cpp", "view/frame.cpp", "depth/depth_image.cpp",
            "geom/shapes/rational_cell.cpp", "grid/grid.cpp", "assign/contract/registry.cpp", "library/light_lists.cpp"]


def compiled_code(text):
    """What the compiler sees of headers that have GLM otherwise."""
    return re.sub(r"#else\n.*?#endif", "", text, flags=re.DOTALL) if "#if CLUSTERBENCH_OWN_" in text else text


def foreign_includes(sources):
    found, seen, open_files = [], set(), list(sources)
    while open_files:
        path = open_files.pop()
        if path in seen:
            continue
        seen.add(path)
        for kind, name in INCLUDE.findall(compiled_code(path.read_text())):
            if kind == '"':
                open_files.append(ROOT / "src" / name)
            elif ("/" in name or name.endswith((".h", ".hpp"))) and not name.startswith(ALLOWED):
                found.append(f"{path.relative_to(ROOT)} includes <{name}>")
    return found


def main():
    cmake, cxx = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        hidden = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in HIDDEN]
        subprocess.run([cmake, "-G", "Ninja", "-S", ROOT, "-B", folder, "-DCLUSTERBENCH_LIBRARY_ONLY=ON", "-DCLUSTERBENCH_WERROR=ON",
                        f"-DCMAKE_CXX_COMPILER={cxx}", *hidden], check=True, capture_output=True)
        commands = json.loads((pathlib.Path(folder) / "compile_commands.json").read_text())
        sources = [pathlib.Path(command["file"]) for command in commands if command["file"].startswith(str(ROOT / "src"))]
        assert len(sources) > 100, len(sources)
        faults = foreign_includes(sources)
        assert not faults, "\n".join(faults)
        for command in commands:
            name = os.path.relpath(command["file"], ROOT / "src")
            if name in COMPILED:
                plain = re.sub(r"-Winvalid-pch|-include \S+cmake_pch\S+|-fpch-preprocess", "", command["command"])
                plain = re.sub(r" -o \S+", " -fsyntax-only", plain)
                subprocess.run(plain, shell=True, check=True, cwd=command["directory"])


if __name__ == "__main__":
    sys.exit(main())
