"""What of others is in the program: found in what the build has linked and read, not in a list."""

import dataclasses
import json
import os
import pathlib
import re

import binaries
import debian
from facts import Refused, output

# Source packages of the compiler and the C library. The exception in their licences leaves programs free of it.
TOOLCHAIN = re.compile(r"^(glibc|linux|gcc-\d+.*|gcc-defaults.*|cross-toolchain-base.*|libxcrypt|mingw-w64|gcc-mingw-w64)$")
COMPILERS_OWN = re.compile(r"^/usr/(lib/(gcc|llvm)|[a-z0-9_]+-(linux-gnu|w64-mingw32))|/c\+\+/")


@dataclasses.dataclass
class Piece:
    name: str
    version: str
    licence: str  # an SPDX expression
    how: str  # shared: packed; system: a shared library that is not; static, headers, page
    homepage: str
    purl: str  # package URL
    text: str  # its licences in full
    files: dict = dataclasses.field(default_factory=dict)  # of shared libraries that are packed: {name in the package: file}
    source: str = ""  # where Debian keeps the source of this version


def known_licences():
    return json.loads((pathlib.Path(__file__).parent / "licences.json").read_text(encoding="utf-8"))


def inputs(facts):
    """Files that the program is made of, those that are made on the way to it included."""
    return set(output(["ninja", "-C", str(facts.build), "-t", "inputs", "clusterbench"]).splitlines())


def library_objects(facts):
    """Files in the library for engines; `-t inputs` would name what has to be built before it, too."""
    text = output(["ninja", "-C", str(facts.build), "-t", "query", "libclusterbench_assign.a"])
    return set(re.findall(r"^    ([^|\s].*\.o)$", text, re.MULTILINE))


def linked_archives(facts):
    """Static libraries of others in the program."""
    return sorted(path for path in inputs(facts) if path.startswith("/") and path.endswith(".a") and not is_own(facts, path))


def read_headers(facts, made_of):
    """Headers of others that were read for these files."""
    paths, counts = set(), False
    for line in output(["ninja", "-C", str(facts.build), "-t", "deps"]).splitlines():
        if not line.startswith(" "):  # OUTPUT: #deps 436, ..., and its files below
            counts = line.split(": #deps")[0] in made_of
        elif counts:
            paths.add(os.path.normpath(facts.build / line.strip()))
    return sorted(path for path in paths if not is_own(facts, path) and not COMPILERS_OWN.search(path))


def is_own(facts, path):
    """Of the sources or made by this build. Libraries for another processor or system lie in other folders of build/."""
    path = pathlib.Path(path)
    return path.is_relative_to(facts.build) or (path.is_relative_to(facts.source) and not path.is_relative_to(facts.source / "build"))


def first_comment(path):
    return re.search(r"/\*.*?\*/", path.read_text(encoding="utf-8"), re.DOTALL).group(0)


def licence_text(facts, package, only):
    if only:
        return first_comment(facts.sysroot / only)
    path = facts.sysroot / package.copyright_file
    if not path.exists():
        raise Refused(f"{path} is missing, the licence of what is in the program (dpkg leaves it out where path-exclude says so)")
    return path.read_text(encoding="utf-8")


def piece_of(facts, package, how):
    name = debian.project_name(package.source)
    known = known_licences().get(name)
    if known is None:
        raise Refused(f"{name} is in the program, but packaging/licences.json does not name its licence")
    version = package.version.replace("+", "%2B").replace(":", "%3A")
    purl = f"pkg:deb/debian/{package.source}@{version}?arch=source"
    return Piece(name, package.version, known["licence"], how, package.homepage, purl, licence_text(facts, package, known.get("only")),
                 source=f"https://snapshot.debian.org/package/{package.source}/{version}/")


def runtimes(facts):
    """Windows has no C library for programs of mingw-w64: it is in the program, with g++'s."""
    return [piece_of(facts, debian.package(facts, name), "static") for name in ("mingw-w64-x86-64-dev", "gcc-mingw-w64-base")] \
        if facts.is_windows else []


def debian_pieces(facts, ways):
    """`ways`: (how, files) in turn. What is in several ways in the program is named by the first."""
    pieces = {}
    for how, files in ways:
        owner = debian.owners(facts, [str(path) for path in (files.values() if how == "shared" else files)])
        for name in sorted(set(owner.values())):
            package = debian.package(facts, name)
            if not TOOLCHAIN.match(package.source) and debian.project_name(package.source) not in pieces:
                pieces[debian.project_name(package.source)] = piece_of(facts, package, how)
        if how == "shared":  # {name in the package: file}
            for name, path in files.items():
                pieces[debian.project_name(debian.package(facts, owner[str(path)]).source)].files[name] = path
    return sorted(pieces.values(), key=lambda piece: piece.name)


def compiled(facts):
    return [("static", linked_archives(facts)), ("headers", read_headers(facts, inputs(facts)))]


def page_pieces(facts):
    """The packages of npm in the pages of `report`, as page/build.mjs has found them; none where the pages are left out."""
    path = facts.build / "page/packages.json"
    if not path.exists():
        return []
    return [Piece(one["name"], one["version"], one["licence"], "page", one["homepage"],
                  f"pkg:npm/{one['name'].replace('@', '%40')}@{one['version']}", one["text"])
            for one in json.loads(path.read_text(encoding="utf-8"))]


def all_pieces(facts, shared):
    """Of the program. `shared`: {name: file} of the libraries that are packed."""
    found = debian_pieces(facts, [("shared", shared), *compiled(facts)]) + runtimes(facts)
    return sorted(found, key=lambda piece: piece.name) + sorted(page_pieces(facts), key=lambda piece: piece.name)


def pieces_beside_the_system(facts, program):
    """Of a program whose shared libraries are dependencies, and not in its package."""
    system = [binaries.find_library(facts, name) for name in binaries.needed(facts, program) if not binaries.OF_THE_MACHINE.match(name)]
    found = debian_pieces(facts, [("system", system), *compiled(facts)])
    return found + sorted(page_pieces(facts), key=lambda piece: piece.name)


def library_pieces(facts):
    """Of the static library for engines, which is linked with Highway's shared one."""
    found = debian_pieces(facts, [("headers", read_headers(facts, library_objects(facts)))])
    for piece in found:
        piece.how = "system" if piece.name == "highway" else piece.how
    return found
