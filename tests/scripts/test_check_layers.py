#!/usr/bin/env python3
"""scripts/check_layers.py finds each kind of fault, and nothing in a clean tree."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_layers.py"


class CheckLayers(unittest.TestCase):
    def check(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder) / "src" / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            done = subprocess.run([sys.executable, str(SCRIPT), folder], capture_output=True, text=True)
            return done.returncode, done.stdout

    def test_a_clean_tree_passes(self):
        code, out = self.check({
            "geom/a.h": '#include "core/error.h"\n',
            "assign/assigners/aabb.cpp": '#include "geom/a.h"\n',
            "assign/contract/registry.inc": "CLUSTERBENCH_ASSIGNER(aabb)\n",
        })
        self.assertEqual((code, out), (0, ""))

    def test_an_include_of_a_later_layer_is_found(self):
        code, out = self.check({"geom/a.h": '#include "grid/grid.h"\n'})
        self.assertEqual(code, 1)
        self.assertIn("geom/a.h: includes grid/grid.h", out)

    def test_an_include_of_a_folder_that_is_not_below_is_found(self):
        code, out = self.check({"assign/rows/a.h": '#include "assign/pipeline/b.h"\n', "assign/rows/b.h": "",
                                "assign/exact/c.h": '#include "assign/distance/d.h"\n#include "assign/rows/b.h"\n'})
        self.assertEqual(code, 1)
        self.assertEqual(out, "src/assign/exact/c.h: includes assign/distance/d.h, but assign/exact is not above "
                              "assign/distance\nsrc/assign/rows/a.h: includes assign/pipeline/b.h, but assign/rows is "
                              "not above assign/pipeline\n")

    def test_an_include_of_a_file_beside_the_folders_is_found(self):
        code, out = self.check({"geom/spot/a.h": '#include "geom/answer.h"\n', "geom/answer.h": ""})
        self.assertEqual(code, 1)
        self.assertEqual(out, "src/geom/spot/a.h: includes geom/answer.h, but the files beside the folders of geom are "
                              "above them\n")

    def test_a_header_of_one_system_is_found_outside_of_its_folder(self):
        code, out = self.check({"os/windows/a.cpp": "#include <windows.h>\n", "os/linux/b.cpp": "#include <elf.h>\n",
                                "os/posix/c.cpp": "#include <unistd.h>\n"})
        self.assertEqual((code, out), (0, ""))
        code, out = self.check({"os/a.h": "#include <unistd.h>\n", "os/linux/b.cpp": "#include <windows.h>\n"})
        self.assertEqual(code, 1)
        self.assertEqual(out, "src/os/a.h: includes unistd.h, which belongs into src/os/posix or src/os/linux or src/os/mac\n"
                              "src/os/linux/b.cpp: includes windows.h, which belongs into src/os/windows\n")

    def test_files_beside_the_folders_may_be_below_them(self):
        code, out = self.check({"scene/scene.h": "", "scene/gltf_document/a.h": '#include "scene/scene.h"\n'})
        self.assertEqual((code, out), (0, ""))
        code, out = self.check({"scene/scene.h": '#include "scene/gltf_document/a.h"\n', "scene/gltf_document/a.h": ""})
        self.assertEqual((code, out), (1, "src/scene/scene.h: includes scene/gltf_document/a.h, but the files beside the folders "
                                          "of scene are not above scene/gltf_document\n"))

    def test_a_folder_of_geom_includes_only_those_below(self):
        code, out = self.check({"geom/numbers/a.h": '#include "geom/shapes/b.h"\n', "geom/shapes/b.h": "",
                                "geom/spot/c.h": '#include "geom/filter/d.h"\n#include "geom/numbers/a.h"\n'})
        self.assertEqual(code, 1)
        self.assertEqual(out, "src/geom/numbers/a.h: includes geom/shapes/b.h, but geom/numbers is not above geom/shapes\n")

    def test_a_header_of_the_system_outside_of_os_is_found(self):
        for header in ("unistd.h", "sys/wait.h", "linux/perf_event.h", "csignal"):
            code, out = self.check({"cli/a.cpp": f"#include <{header}>\n", "os/linux/b.cpp": f"#include <{header}>\n"})
            self.assertEqual((code, out), (1, f"src/cli/a.cpp: includes {header}, whose home is os\n"))

    def test_a_library_outside_its_home_is_found(self):
        for layer, header, home in (("geom", "boost/x.hpp", "measure"), ("grid", "hwy/x.h", "assign")):
            code, out = self.check({f"{layer}/a.cpp": f"#include <{header}>\n"})
            self.assertEqual(code, 1)
            self.assertIn(f"whose home is {home}\n", out)

    def test_an_assigner_without_registry_line_is_found(self):
        code, out = self.check({"assign/assigners/mine.cpp": "", "assign/contract/registry.inc": ""})
        self.assertEqual(code, 1)
        self.assertIn("CLUSTERBENCH_ASSIGNER(mine)", out)

    def test_a_registry_line_without_file_is_found(self):
        code, out = self.check({"assign/contract/registry.inc": "CLUSTERBENCH_ASSIGNER(gone)\n"})
        self.assertEqual(code, 1)
        self.assertIn("names gone", out)

    def test_a_circle_of_includes_is_found(self):
        code, out = self.check({"grid/a.h": '#include "grid/b.h"\n', "grid/b.h": '#include "grid/a.h"\n'})
        self.assertEqual(code, 1)
        self.assertIn("circle of includes", out)


if __name__ == "__main__":
    unittest.main()
