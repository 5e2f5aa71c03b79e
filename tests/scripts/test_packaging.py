#!/usr/bin/env python3
"""What a package says of its contents is what is in it: test_packaging.py [BUILD_FOLDER]."""

import hashlib
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
import links  # noqa: E402
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

    def piece(self, how="shared"):
        file = self.binary(self.folder / "root/lib/libone.so.1")
        return pieces.Piece("one", "2.0-3", "MIT", how, "", "pkg:deb/debian/one@2.0-3", "see /usr/share/common-licenses/GPL-2.",
                            {"libone.so.1": file} if how == "shared" else {}, "https://snapshot.debian.org/package/one/2.0-3/")

    def bill(self, piece, name="clusterbench", kind=""):
        return sbom.document(self.facts, self.folder / "root", [piece], self.folder / "root/x.spdx.json", name, kind)

    def test_the_bill_of_materials_names_each_thing_once_and_relates_what_it_names(self):
        self.binary(self.folder / "root/bin/clusterbench")
        document = self.bill(self.piece())
        names = [entry["SPDXID"] for kind in ("packages", "files") for entry in document[kind]] + [document["SPDXID"]]
        self.assertEqual(len(names), len(set(names)))
        related = {name for relation in document["relationships"] for name in (relation["spdxElementId"], relation["relatedSpdxElement"])}
        self.assertEqual(related, set(names))
        sums = subprocess.run(["sha256sum", self.folder / "root/lib/libone.so.1"], check=True, capture_output=True, text=True).stdout
        file = next(entry for entry in document["files"] if entry["fileName"] == "./lib/libone.so.1")
        self.assertIn({"algorithm": "SHA256", "checksumValue": sums.split()[0]}, file["checksums"])
        self.assertEqual([entry["versionInfo"] for entry in document["packages"]], ["1.2.3", "2.0-3"])

    def test_the_bill_of_materials_has_all_files_and_their_sum(self):
        self.binary(self.folder / "root/bin/clusterbench", "x")
        self.binary(self.folder / "root/lib/libclusterbench_assign.a", "y")
        self.binary(self.folder / "root/a/b-c")
        self.binary(self.folder / "root/a-b/c")
        self.binary(self.folder / "root/x.spdx.json")
        document = self.bill(self.piece())
        self.assertEqual([entry["fileName"] for entry in document["files"]],
                         ["./a/b-c", "./a-b/c", "./bin/clusterbench", "./lib/libclusterbench_assign.a", "./lib/libone.so.1"])
        self.assertEqual(len({entry["SPDXID"] for entry in document["files"]}), 5)
        sums = sorted(entry["checksums"][0]["checksumValue"] for entry in document["files"])
        code = document["packages"][0]["packageVerificationCode"]
        self.assertEqual(code, {"packageVerificationCodeValue": hashlib.sha1("".join(sums).encode()).hexdigest(),
                                "packageVerificationCodeExcludedFiles": ["./x.spdx.json"]})

    def test_only_a_package_whose_files_were_analyzed_contains_files(self):
        self.binary(self.folder / "root/bin/clusterbench")
        document = self.bill(self.piece())
        analyzed = {entry["SPDXID"] for entry in document["packages"] if entry["filesAnalyzed"]}
        files = {entry["SPDXID"] for entry in document["files"]}
        holders = {relation["spdxElementId"] for relation in document["relationships"]
                   if relation["relationshipType"] == "CONTAINS" and relation["relatedSpdxElement"] in files}
        self.assertEqual(holders, analyzed)

    def test_a_library_of_the_system_is_linked_dynamically_and_not_in_the_package(self):
        self.binary(self.folder / "root/bin/clusterbench")
        kinds = {relation["relationshipType"] for relation in self.bill(self.piece("system"))["relationships"]
                 if relation["relatedSpdxElement"].endswith("-one")}
        self.assertEqual(kinds, {"DYNAMIC_LINK"})
        self.assertIn("shared library of the system, not in this package", notices.table([self.piece("system")]))

    @unittest.skipUnless(shutil.which("dpkg-query"), "this system has no dpkg")
    def test_libraries_that_a_program_needs_and_does_not_bring_are_of_the_system(self):
        program = self.binary(self.folder / "bin/clusterbench", "libone.so.1", "libc.so.6")
        library = self.binary(self.libraries / "libone.so.1", "libtwo.so.2")
        self.binary(self.folder / "usr/share/doc/zlib1g/copyright", "licence")
        self.dpkg("zlib1g", "zlib", [f"/{library.relative_to(self.folder)}"])
        pieces_compiled, pieces.compiled = pieces.compiled, lambda facts: [("static", []), ("headers", [str(library)])]
        self.addCleanup(setattr, pieces, "compiled", pieces_compiled)
        self.assertEqual([(piece.name, piece.how, piece.files) for piece in pieces.pieces_beside_the_system(self.facts, program)],
                         [("zlib", "system", {})])

    def test_two_bills_of_materials_are_two_documents(self):
        self.binary(self.folder / "root/bin/clusterbench")
        one = self.piece()
        bills = [self.bill(one), self.bill(one, kind="-deb"), self.bill(one, name="clusterbench-dev", kind="-deb")]
        one.version = "2.0-4"
        bills.append(self.bill(one))
        self.assertEqual(len({bill["documentNamespace"] for bill in bills}), 4)
        self.assertEqual(len({bill["name"] for bill in bills}), 3)

    def test_the_copyright_of_a_debian_package_names_others(self):
        text = notices.debian_copyright("MIT License\n", [self.piece("headers")], "clusterbench-dev")
        self.assertIn("/usr/share/doc/clusterbench-dev/third-party/README.md", text)
        self.assertIn("  one 2.0-3: MIT\n", text)
        self.assertEqual("  /usr/share/common-licenses/GPL-2\n" in text, (notices.COMMON / "GPL-2").exists())

    def test_the_note_on_the_lgpl_says_where_the_source_is(self):
        for how, place in (("shared", "in `lib/`"), ("system", "of the system")):
            piece = self.piece(how)
            piece.licence = "LGPL-2.1-or-later AND MIT"
            self.assertRegex(notices.lgpl_note([piece]), f"{place}.*https://snapshot.debian.org/package/one/2.0-3/")
        self.assertEqual(notices.lgpl_note([self.piece()]), "")

    def test_updates_that_are_there_are_found(self):
        policy = ("libone1:\n  Installed: 1.0-1\n  Candidate: 1.0-2\n  Version table:\n     1.0-2 500\n"
                  "libtwo2:\n  Installed: 2.0\n  Candidate: 2.0\n  Version table:\nlibthree3:\n  Installed: (none)\n  Candidate: 3.0\n")
        self.assertEqual(debian.updates(policy), [("libone1", "1.0-1", "1.0-2")])

    def test_links_of_packed_documents_lead_to_what_is_packed(self):
        documents, data = self.folder / "share/doc/clusterbench", self.folder / "share/clusterbench"
        for path in (data / "configs/a.json", documents / "docs/b.md", documents / "copyright"):
            self.binary(path)
        (documents / "README.md").write_text("# title\n\n[b](docs/b.md#x) [b](#x) [c](https://x/) [a](configs/a.json) [MIT](LICENSE)\n"
                                             "![cells of `x`](results/x.svg) [`page/y`](page/y) [z](page/z)\n```cpp\n[](int)\n```\n",
                                             encoding="utf-8")
        links.settle(documents, data, "0123", {"LICENSE": "copyright"})
        text = (documents / "README.md").read_text(encoding="utf-8")
        self.assertTrue(text.startswith("# title\n\n*From a package of commit 0123"), text)
        self.assertTrue(text.endswith(
            "[b](docs/b.md#x) [b](#x) [c](https://x/) [a](../../clusterbench/configs/a.json) [MIT](copyright)\n"
            "(In the sources a picture, `results/x.svg`: cells of `x`) `page/y` z (`page/z` in the sources)\n```cpp\n[](int)\n```\n"), text)

    def test_debian_packages_have_notices_bills_of_materials_and_names_in_usr(self):
        for path in ("Unspecified/usr/bin/clusterbench", "Unspecified/usr/share/man/man1/clusterbench.1",
                     "Unspecified/usr/share/doc/clusterbench/README.md", "library/usr/lib/libclusterbench_assign.a",
                     "library/usr/lib/pkgconfig/clusterbench-assign.pc"):
            self.binary(self.folder / path)
        for name in ("pieces_beside_the_system", "library_pieces"):
            self.addCleanup(setattr, pieces, name, getattr(pieces, name))
        pieces.pieces_beside_the_system = lambda facts, program: [self.piece("system")]
        pieces.library_pieces = lambda facts: [self.piece("headers")]
        stage.stage_deb(self.facts, self.folder)
        for folder, package, file in (("Unspecified", "clusterbench", "./usr/bin/clusterbench"),
                                      ("library", "clusterbench-dev", "./usr/lib/libclusterbench_assign.a")):
            documents = self.folder / folder / "usr/share/doc" / package
            self.assertIn("| one |", (documents / "third-party/README.md").read_text(encoding="utf-8"))
            bill = json.loads((documents / f"{package}-1.2.3-linux-some.spdx.json").read_text(encoding="utf-8"))
            self.assertIn(file, [entry["fileName"] for entry in bill["files"]])
            self.assertIn("third-party/README.md", (documents / "copyright").read_text(encoding="utf-8"))
        self.assertTrue((self.folder / "library/usr/share/pkgconfig/clusterbench-assign.pc").exists())

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
                os.utime(folder / "a", (len(made) * 2**32, len(made) * 2**32))
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
        library = {piece.name for piece in pieces.library_pieces(facts)} if (self.build / "libclusterbench_assign.a").exists() else set()
        self.assertLessEqual(library, {"glm", "highway"})
        documented = (ROOT / "docs/third-party.md").read_text(encoding="utf-8").lower().replace(" ", "-")
        names = {name: pieces.known_licences()[name].get("documented", name) for name, piece in found.items() if piece.how != "page"}
        self.assertEqual([name for name, written in names.items() if f"[{written}]" not in documented], [])


if __name__ == "__main__":
    if len(sys.argv) > 1:
        OfThisBuild.build = pathlib.Path(sys.argv.pop(1))
    unittest.main()
