"""`cmake --install` into an empty prefix: test_install.py CMAKE BUILD_FOLDER."""

import glob
import os
import re
import subprocess
import sys
import tempfile

PARTS = {
    "bin/clusterbench": b"\x7fELF",
    "share/doc/clusterbench/LICENSE": b"MIT License",
    "share/doc/clusterbench/README.md": b"# clusterbench",
    "share/doc/clusterbench/CHANGELOG.md": b"# Changelog",
    "share/clusterbench/configs/quick.json": b"{",
    "share/clusterbench/scenes/street.glb": b"glTF",
    "share/clusterbench/slurm/merge": b"#!/bin/bash",
    "share/clusterbench/slurm/shard": b"#!/bin/bash",
    "share/clusterbench/slurm/submit": b"#!/bin/bash",
    "share/doc/clusterbench/docs/configuration.md": b"# Writing a configuration",
    "share/doc/clusterbench/docs/third-party.md": b"# ",
    "share/man/man1/clusterbench.1": b".TH CLUSTERBENCH 1",
    "share/bash-completion/completions/clusterbench": b"# bash completion",
    "share/zsh/site-functions/_clusterbench": b"#compdef clusterbench",
    "share/fish/vendor_completions.d/clusterbench.fish": b"# fish completion",
    "include/clusterbench/assign.h": b"#pragma once",
}
# Folders of which a file or two stand for all.
MANY = ("share/doc/clusterbench/docs/", "share/clusterbench/configs/", "share/clusterbench/scenes/")
# The library, whose own test is test_embedding.py.
LIBRARY = (".a", ".cmake", ".pc", "include/clusterbench_plugin.h", "include/clusterbench_plugin.hpp")


def main():
    cmake, build = sys.argv[1:]
    with tempfile.TemporaryDirectory() as prefix:
        subprocess.run([cmake, "--install", build, "--prefix", prefix], check=True, capture_output=True)
        found = sorted(os.path.relpath(os.path.join(folder, name), prefix)
                       for folder, _, names in os.walk(prefix) for name in names)
        found = [part for part in found if part in PARTS or not part.startswith(MANY)]
        found = [part for part in found if not part.endswith(LIBRARY)]
        assert found == sorted(PARTS), found
        for part, start in PARTS.items():
            with open(os.path.join(prefix, part), "rb") as file:
                assert file.read().startswith(start), part
        for config in glob.glob(os.path.join(prefix, "share/clusterbench/configs/*.json")):
            with open(config) as file:
                paths = re.findall(r'"([^"$]+[.](?:glb|gltf))"', file.read())
            for path in paths:  # others are named by variables of the environment
                assert os.path.exists(os.path.join(os.path.dirname(config), path)), f"{config} names {path}"
        version = subprocess.run([os.path.join(prefix, "bin/clusterbench"), "--version"], check=True, capture_output=True)
        assert version.stdout.startswith(b"clusterbench "), version.stdout


if __name__ == "__main__":
    sys.exit(main())
