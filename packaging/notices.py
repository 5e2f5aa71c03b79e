"""The licences of all that is in a package, in full."""

import re
import shutil
import pathlib

COMMON = pathlib.Path("/usr/share/common-licenses")
HOW = {"shared": "shared library", "system": "shared library of the system, not in this package; code of its headers is compiled in",
       "static": "linked into the program", "headers": "headers, compiled in", "page": "script in the pages that `report` writes"}


def file_name(piece):
    return piece.name.replace("/", "-").removeprefix("@") + ".txt"


def table(pieces):
    rows = [f"| {piece.name} | {piece.version} | {piece.licence} | {HOW[piece.how]} | [{file_name(piece)}]({file_name(piece)}) |"
            for piece in pieces]
    return "\n".join(["| software | version | licence | in this package as | text |", "|---|---|---|---|---|", *rows])


def lgpl_note(pieces):
    notes = []
    for piece in pieces:
        if "LGPL" in piece.licence and piece.how in ("shared", "system"):
            place = "in `lib/`" if piece.how == "shared" else "of the system"
            notes.append(f"\nThis program uses {piece.name} under the GNU Lesser General Public License: it is a shared library {place}, which "
                         "you may replace by a changed one with the same interface. Its source is Debian's source package of the version "
                         f"above: {piece.source}\n")
    return "".join(notes)


def common_licences(pieces):
    """Debian's texts name the licences that many share by their file."""
    texts = "".join(piece.text for piece in pieces)
    names = {name.rstrip(".") for name in re.findall(r"/usr/share/common-licenses/([A-Za-z0-9.+-]+)", texts)}
    return sorted(name for name in names if (COMMON / name).exists())


def debian_copyright(licence, pieces, package):
    """The file `copyright` of a Debian package: ours, and where those of others are."""
    names = "".join(f"  {piece.name} {piece.version}: {piece.licence}\n" for piece in pieces)
    common = "".join(f"  {COMMON / name}\n" for name in common_licences(pieces))
    shared = f"\nOn Debian, licences that these texts name are\n\n{common}" if common else ""
    return (f"{licence.rstrip()}\n\nThe files of this package contain code of others, or are linked with it. Versions, licences and how each is\n"
            f"used are in /usr/share/doc/{package}/third-party/README.md, the licences in full beside it:\n\n{names}{shared}")


def write(pieces, folder):
    folder.mkdir(parents=True, exist_ok=True)
    common = common_licences(pieces)
    for piece in pieces:
        (folder / file_name(piece)).write_text(piece.text.rstrip() + "\n", encoding="utf-8")
    for name in common:
        shutil.copyfile(COMMON / name, folder / name)
    shared = f"\nWhere these texts name files of /usr/share/common-licenses, these lie here, too: {', '.join(common)}.\n" if common else ""
    text = f"# Software of others in this package\n\n{table(pieces)}\n{lgpl_note(pieces)}{shared}"
    (folder / "README.md").write_text(text, encoding="utf-8")
