"""The licences of all that is in a package, in full."""

import re
import shutil
import pathlib

COMMON = pathlib.Path("/usr/share/common-licenses")
HOW = {"shared": "shared library", "static": "linked into the program", "headers": "headers, compiled into the program",
       "page": "script in the pages that `report` writes"}


def file_name(piece):
    return piece.name.replace("/", "-").removeprefix("@") + ".txt"


def table(pieces):
    rows = [f"| {piece.name} | {piece.version} | {piece.licence} | {HOW[piece.how]} | [{file_name(piece)}]({file_name(piece)}) |"
            for piece in pieces]
    return "\n".join(["| software | version | licence | in this package as | text |", "|---|---|---|---|---|", *rows])


def lgpl_note(pieces):
    names = [piece.name for piece in pieces if "LGPL" in piece.licence and piece.how == "shared"]
    if not names:
        return ""
    return (f"\nThis program uses {', '.join(names)} under the GNU Lesser General Public License: it is a shared library in `lib/`, which you "
            "may replace by a changed one with the same interface. Its source is Debian's source package of the version above.\n")


def common_licences(pieces):
    """Debian's texts name the licences that many share by their file."""
    texts = "".join(piece.text for piece in pieces)
    names = {name.rstrip(".") for name in re.findall(r"/usr/share/common-licenses/([A-Za-z0-9.+-]+)", texts)}
    return sorted(name for name in names if (COMMON / name).exists())


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
