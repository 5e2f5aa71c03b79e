#!/usr/bin/env python3
"""What a package says of its contents is what is in it: test_packaging.py [BUILD_FOLDER]."""

import json
import os
import pathlib
import shutil
import stat
import subprocess
import sys
import tarfile
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "packaging"))

import archive  # noqa: E402
import binaries  # noqa: E402
import debian  # noqa: E402
import notices  # noqa: E402
import pieces  # noqa: E402
import sbom  # noqa: E402
import stage  # noqa: E402
from facts import Facts, Refused  # noqa: E402

# Stands for readelf: the libraries that a file needs are its lines.
READELF = '#!/bin/sh\nwhile read name; do echo " 0x1 (NEEDED) Shared library: [$name]"; done <"$2"\n'


class Packages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.libraries = self.folder / "usr/lib/some-linux-gnu"
        self.libraries.mkdir(parents=True)
        readelf = self.folder / "readelf"
        readelf.write_text(READELF, encoding="utf-8")
        readelf.chmod(0o755)
        self.facts = Facts("1.2.3", "linux-some", "some-linux-gnu", ROOT, self.folder / "build", self.folder, "", str(readelf), "x <x@localhost>")

    def binary(self, path, *needed):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("".join(f"{name}\n" for name in needed), encoding="utf-8")
        return path

    def dpkg(self, name, source, files):
        """Records of one installed package."""
        admin = self.folder / "dpkg"
        (admin / "info").mkdir(parents=True)
        (admin / "info/format").write_text("1\n", encoding="utf-8")
        (admin / "status").write_text(f"Package: {name}\nStatus: install ok installed\nVersion: 1:2.0-3\nArchitecture: all\n"
                                      f"Source: {source}\nMaintainer: x <x@localhost>\nDescription: x\n", encoding="utf-8")
        (admin / f"info/{name}.list").write_text("".join(f"{file}\n" for file in ["/.", *files]), encoding="utf-8")
        self.facts.dpkg = str(admin)

    def test_libraries_that_only_libraries_need_are_packed_and_those_of_the_machine_are_not(self):
        program = self.binary(self.folder / "bin/clusterbench", "libone.so.1", "libc.so.6", "libstdc++.so.6")
        self.binary(self.libraries / "libone.so.1", "libtwo.so.2", "libm.so.6")
        self.binary(self.libraries / "libtwo.so.2", "libone.so.1", "ld-linux-x86-64.so.2")
        found = binaries.libraries(self.facts, program)
        self.assertEqual(list(found), ["libone.so.1", "libtwo.so.2"])

    def test_a_library_that_is_not_there_is_named(self):
        program = self.binary(self.folder / "bin/clusterbench", "libnone.so.1")
        with self.assertRaisesRegex(Refused, "needs libnone.so.1"):
            binaries.libraries(self.facts, program)

    @unittest.skipUnless(shutil.which("dpkg-query"), "this system has no dpkg")
    def test_a_file_is_found_in_its_package_also_by_its_name_without_usr(self):
        library = self.binary(self.libraries / "libone.so.1")
        self.dpkg("libone1", "one", ["/lib/some-linux-gnu/libone.so.1"])
        self.assertEqual(debian.owners(self.facts, [str(library)]), {str(library): "libone1"})
        self.assertEqual(debian.package(self.facts, "libone1"), debian.DebianPackage("libone1", "one", "1:2.0-3", ""))

    @unittest.skipUnless(shutil.which("dpkg-query"), "this system has no dpkg")
    def test_a_file_of_no_package_is_refused(self):
        self.dpkg("libone1", "one", [])
        library = self.binary(self.libraries / "libstray.so.1")
        with self.assertRaisesRegex(Refused, "libstray.so.1 is in the program, but in no package"):
            debian.owners(self.facts, [str(library)])

    def test_a_project_without_a_known_licence_is_refused(self):
        with self.assertRaisesRegex(Refused, "one is in the program, but packaging/licences.json"):
            pieces.piece_of(self.facts, debian.DebianPackage("libone1", "one", "2.0-3", ""), "shared")

    def test_a_licence_without_text_is_refused(self):
        with self.assertRaisesRegex(Refused, "usr/share/doc/zlib1g/copyright is missing"):
            pieces.piece_of(self.facts, debian.DebianPackage("zlib1g:amd64", "zlib", "1:1.2.13", ""), "shared")

    def test_versions_in_names_of_source_packages_are_no_part_of_the_project(self):
        for source, project in (("boost1.74", "boost"), ("libpng1.6", "libpng"), ("nlohmann-json3", "nlohmann-json"), ("re2", "re2")):
            self.assertEqual(debian.project_name(source), project)

    def piece(self):
        file = self.binary(self.folder / "lib/libone.so.1")
        return pieces.Piece("one", "2.0-3", "MIT", "shared", "", "pkg:deb/debian/one@2.0-3", "see /usr/share/common-licenses/GPL-2.",
                            {"libone.so.1": file})

    def test_the_bill_of_materials_names_each_thing_once_and_relates_what_it_names(self):
        program = self.binary(self.folder / "bin/clusterbench")
        document = sbom.document(self.facts, self.folder, [self.piece()], program)
        names = [entry["SPDXID"] for kind in ("packages", "files") for entry in document[kind]] + [document["SPDXID"]]
        self.assertEqual(len(names), len(set(names)))
        related = {name for relation in document["relationships"] for name in (relation["spdxElementId"], relation["relatedSpdxElement"])}
        self.assertEqual(related, set(names))
        sums = subprocess.run(["sha256sum", self.folder / "lib/libone.so.1"], check=True, capture_output=True, text=True).stdout
        file = next(entry for entry in document["files"] if entry["fileName"] == "./lib/libone.so.1")
        self.assertIn({"algorithm": "SHA256", "checksumValue": sums.split()[0]}, file["checksums"])
        self.assertEqual([entry["versionInfo"] for entry in document["packages"]], ["1.2.3", "2.0-3"])

    def test_notices_hold_the_texts_and_what_these_refer_to(self):
        notices.write([self.piece()], self.folder / "third-party")
        written = {path.name for path in (self.folder / "third-party").iterdir()}
        common = {"GPL-2"} if (notices.COMMON / "GPL-2").exists() else set()
        self.assertEqual(written, {"README.md", "one.txt"} | common)
        self.assertIn("| one | 2.0-3 | MIT | shared library |", (self.folder / "third-party/README.md").read_text(encoding="utf-8"))

    def test_times_and_modes_are_those_of_the_commit_alone(self):
        program = self.binary(self.folder / "packed/bin/clusterbench")
        text = self.binary(self.folder / "packed/README.txt")
        text.chmod(0o600)
        stage.settle(self.folder / "packed", 1000)
        for path, mode in ((program, 0o755), (text, 0o644), (program.parent, 0o755)):
            self.assertEqual((stat.S_IMODE(path.stat().st_mode), path.stat().st_mtime), (mode, 1000), path)


    def test_an_archive_does_not_depend_on_who_made_the_files_in_which_order(self):
        for write, ending in ((archive.write_tar, "tar.xz"), (archive.write_zip, "zip")):
            made = []
            for names in (("a", "b/c"), ("b/c", "a")):
                folder = self.folder / str(len(made)) / ending / "packed"
                for name in names:
                    self.binary(folder / name, name)
                os.utime(folder / "a", (len(made), len(made)))
                file = self.folder / f"{len(made)}.{ending}"
                write(folder, file, 1000000000)
                made.append(file.read_bytes())
            self.assertEqual(made[0], made[1], ending)
        with tarfile.open(self.folder / "0.tar.xz") as packed:
            self.assertEqual(packed.getnames(), ["packed", "packed/a", "packed/b", "packed/b/c"])


class OfThisBuild(unittest.TestCase):
    build = None

    @unittest.skipUnless(shutil.which("dpkg-query"), "versions and licences are those of Debian's packages")
    def test_the_version_and_licence_of_all_that_is_in_the_program_are_known(self):
        if self.build is None:
            self.skipTest("no build was named")
        facts = Facts(**json.loads((self.build / "package_facts.json").read_text(encoding="utf-8")))
        facts.source, facts.build, facts.sysroot = map(pathlib.Path, (facts.source, facts.build, facts.sysroot))
        shared = binaries.libraries(facts, self.build / "clusterbench")
        found = {piece.name: piece for piece in pieces.all_pieces(facts, shared)}
        self.assertEqual(set(shared), {name for piece in found.values() for name in piece.files})
        for name, how in (("nlohmann-json", "headers"), ("glm", "headers"), ("highway", "shared")):
            self.assertEqual(found[name].how, how)
        self.assertTrue(all(piece.text and piece.version for piece in found.values()))
        documented = (ROOT / "docs/third-party.md").read_text(encoding="utf-8").lower().replace(" ", "-")
        names = {name: pieces.known_licences()[name].get("documented", name) for name, piece in found.items() if piece.how != "page"}
        self.assertEqual([name for name, written in names.items() if f"[{written}]" not in documented], [])


if __name__ == "__main__":
    if len(sys.argv) > 1:
        OfThisBuild.build = pathlib.Path(sys.argv.pop(1))
    unittest.main()
