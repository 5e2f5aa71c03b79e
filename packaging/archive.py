#!/usr/bin/env python3
"""Packs a folder so that the same files give the same bytes: archive.py FOLDER FILE SECONDS. FILE ends in .tar.xz or .zip. cpack's own
archives have their files in the order of the file system. cmake/package/Archive.cmake calls it."""

import pathlib
import stat
import sys
import tarfile
import time
import zipfile


def members(folder):
    """The folder itself and all below it, sorted by name."""
    return [folder, *sorted(folder.rglob("*"), key=lambda path: path.relative_to(folder).parts)]


def write_tar(folder, file, seconds):
    def settled(member):
        member.uid = member.gid = 0
        member.uname = member.gname = "root"
        member.mtime = seconds
        return member

    with tarfile.open(file, "w:xz", format=tarfile.GNU_FORMAT, preset=6) as archive:
        for path in members(folder):
            archive.add(path, str(path.relative_to(folder.parent)), recursive=False, filter=settled)


def write_zip(folder, file, seconds):
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path in members(folder):
            name = path.relative_to(folder.parent).as_posix() + ("/" if path.is_dir() else "")
            entry = zipfile.ZipInfo(name, time.gmtime(seconds)[:6])
            entry.create_system, entry.compress_type = 3, zipfile.ZIP_DEFLATED
            entry.external_attr = (path.stat().st_mode << 16) | (0x10 if stat.S_ISDIR(path.stat().st_mode) else 0)
            archive.writestr(entry, b"" if path.is_dir() else path.read_bytes())


def main():
    if len(sys.argv) != 4 or not sys.argv[2].endswith((".tar.xz", ".zip")):
        sys.exit("usage: archive.py FOLDER FILE.tar.xz|FILE.zip SECONDS")
    write = write_zip if sys.argv[2].endswith(".zip") else write_tar
    write(pathlib.Path(sys.argv[1]), sys.argv[2], int(sys.argv[3]))


if __name__ == "__main__":
    main()
