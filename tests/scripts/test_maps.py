#!/usr/bin/env python3
"""The maps of layers (src/LAYER/README.md) name all of their headers, and nothing that is not there."""

import pathlib
import re
import unittest

SRC = pathlib.Path(__file__).resolve().parents[2] / "src"


def named_files(text):
    return set(re.findall(r"`(\w[\w/-]*\.(?:h|cpp))`", text))


class Maps(unittest.TestCase):
    def test_every_header_is_on_its_layers_map(self):
        for folder in (path for path in SRC.iterdir() if path.is_dir()):
            readme = folder / "README.md"
            named = {pathlib.Path(name).name for name in named_files(readme.read_text(encoding="utf-8"))}
            left_out = {path.name for path in folder.rglob("*.h") if "generators" not in path.parts} - named
            self.assertEqual(left_out, set(), f"src/{folder.name}/README.md does not name them")

    def test_maps_name_only_what_is_there(self):
        for readme in SRC.glob("*/README.md"):
            folder = readme.parent
            there = {path.name for path in SRC.rglob("*") if path.suffix in (".h", ".cpp")}
            named = {pathlib.Path(name).name for name in named_files(readme.read_text(encoding="utf-8"))}
            self.assertEqual({name for name in named - there if "NAME" not in name}, set(), f"src/{folder.name}/README.md")


if __name__ == "__main__":
    unittest.main()
