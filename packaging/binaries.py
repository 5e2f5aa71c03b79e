"""The shared libraries that a program needs, and their place beside it."""

import pathlib
import re
import shutil

from facts import Refused, output

# What the machine has, and has to have: its drivers for Vulkan and plug-ins of others are loaded into the same process and may
# need a newer libstdc++ than that of the machine that packs.
OF_THE_MACHINE = re.compile(r"^(ld-linux.*|lib(c|m|dl|pthread|rt|resolv|stdc\+\+|gcc_s))\.so")


def needed(facts, binary):
    text = output([facts.readelf, "-d", str(binary)])
    return re.findall(r"\(NEEDED\).*\[(.+)\]", text)


def find_library(facts, name):
    for folder in (f"usr/lib/{facts.triplet}", f"lib/{facts.triplet}", "usr/lib", "lib"):
        path = facts.sysroot / folder / name
        if path.exists():
            return path
    raise Refused(f"the program needs {name}, which is not in {facts.sysroot}/usr/lib/{facts.triplet}")


def libraries(facts, program):
    """All that the program needs, directly or not, but for OF_THE_MACHINE: {name in the program: file}."""
    found, open_ends = {}, [program]
    while open_ends:
        for name in needed(facts, open_ends.pop()):
            if name not in found and not OF_THE_MACHINE.match(name):
                found[name] = find_library(facts, name)
                open_ends.append(found[name])
    return dict(sorted(found.items()))


def put_beside(found, program, folder):
    """Copies the libraries into `folder` and lets the program find them there, also those that only libraries need: an
    RPATH holds for these, too, a RUNPATH would not."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, path in found.items():
        shutil.copyfile(path, folder / name)
    output(["patchelf", "--force-rpath", "--set-rpath", "$ORIGIN/../lib", str(program)])


def newest_needed(facts, binaries, prefix):
    """The newest version of symbols like GLIBC_2.34 that the binaries ask for: "2.34"."""
    versions = set()
    for binary in binaries:
        versions |= set(re.findall(prefix + r"_([\d.]+)\b", output([facts.readelf, "-V", str(binary)])))
    return max(versions, key=lambda text: [int(part) for part in text.split(".")], default="none")


def architecture(facts, binary):
    return re.search(r"Machine:\s*(.+)", output([facts.readelf, "-h", str(pathlib.Path(binary))])).group(1)
