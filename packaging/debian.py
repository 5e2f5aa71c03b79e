"""Which Debian packages files come from, and what these packages say of themselves."""

import dataclasses
import pathlib
import re
import shutil

from facts import Refused, output


@dataclasses.dataclass(frozen=True)
class DebianPackage:
    name: str  # of the binary package, with its architecture where it can be installed for several: libtbb12:amd64
    source: str  # onetbb
    version: str  # of the source package: 2021.8.0-2
    homepage: str

    @property
    def copyright_file(self):
        return f"usr/share/doc/{self.name.split(':')[0]}/copyright"


def query(facts, *arguments):
    admin = [f"--admindir={facts.dpkg}"] if facts.dpkg else []
    return output(["dpkg-query", *admin, *arguments])


def inside(facts, path):
    """A file's name as its package has it: without the sysroot before it, nor links."""
    path = pathlib.Path(path).resolve()
    return "/" + str(path.relative_to(facts.sysroot.resolve()))


def spellings(path):
    """Packages older than the merge of /lib and /usr/lib name their files without /usr."""
    return [path, path.removeprefix("/usr")] if path.startswith("/usr/lib") else [path]


def owners(facts, paths):
    """The package of each file: {path: name}. A file that no package has refuses the whole."""
    answer = {path: package for path in paths for start, package in facts.built.items() if path.startswith(start)}
    names = {path: spellings(inside(facts, path)) for path in paths if path not in answer}
    found = {}
    admin = [f"--admindir={facts.dpkg}"] if facts.dpkg else []
    asked = sorted({name for spelled in names.values() for name in spelled})
    # It fails where one of many files has no package, and still names those of the others.
    text = output(["sh", "-c", '"$@" 2>/dev/null || true', "sh", "dpkg-query", *admin, "-S", *asked]) if asked else ""
    for line in text.splitlines():
        packages, _, file = line.rpartition(": ")
        if not packages.startswith("diversion by"):
            found[file] = packages.split(", ")[0]
    for path, spelled in names.items():
        owner = next((found[name] for name in spelled if name in found), None)
        if owner is None:
            raise Refused(f"{path} is in the program, but in no package of Debian, so its version and licence are not known")
        answer[path] = owner
    return answer


def package(facts, name):
    form = "${source:Package}\t${source:Version}\t${Homepage}"
    source, version, homepage = query(facts, "-W", "-f", form, name).split("\t")
    return DebianPackage(name, source, version, homepage.strip())


def project_name(source):
    """The name of the project behind a source package. Some of these have the version in it: boost1.74."""
    return re.sub(r"^(boost|libpng|nlohmann-json|embree)[\d.]+$", r"\1", source)


def updates(policy):
    """Of what `apt-cache policy` prints: packages that have a newer version than the installed one: [(name, installed, candidate)]."""
    found = re.findall(r"^(\S+):\n  Installed: (\S+)\n  Candidate: (\S+)$", policy, re.MULTILINE)
    return [entry for entry in found if entry[1] not in ("(none)", entry[2]) and entry[2] != "(none)"]


def pending_updates(facts, paths):
    """Updates of the packages that these files are of, as far as this machine's lists of packages know of them."""
    if facts.dpkg or not paths or not shutil.which("apt-cache"):
        return []
    names = sorted(set(owners(facts, [str(path) for path in paths]).values()))
    return updates(output(["env", "LC_ALL=C", "apt-cache", "policy", *names]))
