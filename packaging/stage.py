#!/usr/bin/env python3
"""Completes the folder that cpack packs: stage.py archive|deb FOLDER FACTS. cmake/package/Stage.cmake calls it.

archive: the shared libraries beside the program, licences of all that is inside, an SBOM, a README.txt.
deb: the same without the libraries, which are dependencies, in the forms that Debian asks for; for the library for engines, too."""

import datetime
import email.utils
import gzip
import os
import pathlib
import shutil
import sys

import binaries
import debian
import links
import notices
import pieces
import sbom
from facts import Refused, read_facts

README = """clusterbench {version} for {platform}, commit {commit}

bin/{program} measures clustered light assignment on your own level. It starts from any folder and needs no installation:

    bin/{program} run share/clusterbench/scenes/street.glb -o result.json
    bin/{program} report result.json -o report.html
    bin/{program} size share/clusterbench/scenes/street.glb

{needs}

share/doc/clusterbench/README.md       what it is for, and the commands
share/doc/clusterbench/docs/           all documents
share/doc/clusterbench/third-party/    software of others inside, with licences; the SBOM lies beside this folder
include/, lib/cmake, lib/pkgconfig     the library for engines, and the headers of plug-ins
{updates}"""

LINUX_NEEDS = """It needs Linux with glibc {glibc} and libstdc++ with GLIBCXX_{libstdcxx}, or newer ones. Everything else lies in lib/. A GPU is found
through the machine's own Vulkan loader, if there is one."""

UPDATES = """
The libraries of others in lib/ get no security updates by themselves: for these take a newer archive. third-party/README.md has
their versions. (The Debian package uses the system's libraries, which are updated with the system.)
"""

WINDOWS_NEEDS = "It needs 64-bit Windows 10, version 1903, or later, and nothing else. docs/systems.md says what is not in it."


def is_script(path):
    with open(path, "rb") as file:
        return file.read(2) == b"#!"


def settle(folder, seconds):
    """The same commit gives the same bytes: modes do not depend on the umask, nor times on the clock."""
    for path in [folder, *folder.rglob("*")]:
        if not path.is_symlink():
            runs = path.is_dir() or path.parent.name == "bin" or is_script(path)
            path.chmod(0o755 if runs else 0o644)
        os.utime(path, (seconds, seconds), follow_symlinks=False)


def compress(path):
    """As `gzip -9n`: without name and time."""
    with open(path.with_name(path.name + ".gz"), "wb") as file, gzip.GzipFile("", "wb", 9, file, 0) as packed:
        packed.write(path.read_bytes())
    path.unlink()


def readme(facts, files):
    needs = WINDOWS_NEEDS if facts.is_windows else LINUX_NEEDS.format(glibc=binaries.newest_needed(facts, files, "GLIBC"),
                                                                      libstdcxx=binaries.newest_needed(facts, files, "GLIBCXX"))
    return README.format(version=facts.version, platform=facts.platform, commit=facts.commit, program=facts.program, needs=needs,
                         updates="" if facts.is_windows else UPDATES)


def shared_beside(facts, root, program):
    """Windows: all libraries are linked into the program."""
    if facts.is_windows:
        return {}
    shared = binaries.libraries(facts, program)
    binaries.put_beside(shared, program, root / "lib")
    return shared


def warn_of_updates(facts, shared):
    for name, installed, candidate in debian.pending_updates(facts, list(shared.values())):
        print(f"warning: {name} {installed} is packed, and {candidate} is there: apt-get upgrade, and pack again", flush=True)


def stage_archive(facts, root):
    program, documents = root / "bin" / facts.program, root / "share/doc/clusterbench"
    shared = shared_beside(facts, root, program)
    warn_of_updates(facts, shared)
    found = pieces.all_pieces(facts, shared)
    notices.write(found, documents / "third-party")
    links.settle(documents, root / "share/clusterbench", facts.commit)
    (root / "README.txt").write_text(readme(facts, [program, *(root / "lib" / name for name in shared)]), encoding="utf-8")
    sbom.write(facts, root, found, documents)
    settle(root, facts.seconds)


def debian_changelog(facts, package):
    date = email.utils.format_datetime(datetime.datetime.fromtimestamp(facts.seconds, datetime.timezone.utc))
    return (f"{package} ({facts.version}-1) unstable; urgency=medium\n\n"
            f"  * Made of commit\n    {facts.commit}.\n    Its changes are in changelog.gz.\n\n"
            f" -- {facts.maintainer}  {date}\n")


def debian_documents(facts, folder, package, found):
    documents = folder / "usr/share/doc" / package
    documents.mkdir(parents=True, exist_ok=True)
    notices.write(found, documents / "third-party")
    licence = (facts.source / "LICENSE").read_text(encoding="utf-8")
    (documents / "copyright").write_text(notices.debian_copyright(licence, found, package), encoding="utf-8")
    shutil.copyfile(facts.source / "CHANGELOG.md", documents / "changelog")
    (documents / "changelog.Debian").write_text(debian_changelog(facts, package), encoding="utf-8")
    for name in ("changelog", "changelog.Debian"):
        compress(documents / name)
    for name in ("LICENSE", "CHANGELOG.md"):
        (documents / name).unlink(missing_ok=True)
    return documents


def stage_program(facts, root):
    found = pieces.pieces_beside_the_system(facts, root / "usr/bin/clusterbench")
    compress(root / "usr/share/man/man1/clusterbench.1")
    documents = debian_documents(facts, root, "clusterbench", found)
    moved = {"LICENSE": "copyright", "CHANGELOG.md": "changelog.gz"}
    links.settle(documents, root / "usr/share/clusterbench", facts.commit, moved)
    sbom.write(facts, root, found, documents, "clusterbench", "-deb")


def stage_library(facts, root):
    # As deep as lib/pkgconfig, so that its path to the prefix holds.
    if (root / "usr/lib/pkgconfig").exists():
        (root / "usr/lib/pkgconfig").rename(root / "usr/share/pkgconfig")
    found = pieces.library_pieces(facts)
    documents = debian_documents(facts, root, "clusterbench-dev", found)
    sbom.write(facts, root, found, documents, "clusterbench-dev", "-deb")


def stage_deb(facts, root):
    """`root` has a folder for each package."""
    stage_program(facts, root / "Unspecified")
    (root / "library/usr/share").mkdir(parents=True, exist_ok=True)
    stage_library(facts, root / "library")
    settle(root, facts.seconds)


def main():
    if len(sys.argv) != 4 or sys.argv[1] not in ("archive", "deb"):
        sys.exit("usage: stage.py archive|deb FOLDER FACTS")
    kind, folder, facts = sys.argv[1], pathlib.Path(sys.argv[2]), read_facts(sys.argv[3])
    try:
        {"archive": stage_archive, "deb": stage_deb}[kind](facts, folder)
    except Refused as why:
        sys.exit(f"no package: {why}")


if __name__ == "__main__":
    main()
