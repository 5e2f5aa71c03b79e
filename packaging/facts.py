"""What CMake knows of the build that is packed: the file package_facts.json of the build folder."""

import dataclasses
import json
import pathlib
import subprocess


class Refused(Exception):
    """Why there can be no package, in one sentence."""


@dataclasses.dataclass
class Facts:
    version: str  # of the project
    platform: str  # linux-x86_64
    triplet: str  # where Debian has the libraries of this processor: x86_64-linux-gnu
    source: pathlib.Path
    build: pathlib.Path
    sysroot: pathlib.Path  # / or the folder with the libraries of another processor
    dpkg: str  # the folder of dpkg's records on the sysroot, "" for the machine's own
    readelf: str
    maintainer: str  # of Debian's packages
    program: str = "clusterbench"  # its file's name
    built: dict = dataclasses.field(default_factory=dict)  # {beginning of a path: Debian package that it was built from}

    @property
    def is_windows(self):
        return self.platform.startswith("windows")

    @property
    def commit(self):
        return git(self, "rev-parse", "HEAD")

    @property
    def seconds(self):
        """When the commit was made, in seconds since 1970: the time of everything in a package."""
        return int(git(self, "log", "-1", "--format=%ct"))


def git(facts, *arguments):
    return output(["git", "-C", facts.source, *arguments]).strip()


def output(command):
    """What a command prints; its failure refuses the package."""
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout
    except FileNotFoundError:
        raise Refused(f"{command[0]} is not installed (scripts/package says which packages it needs)") from None
    except subprocess.CalledProcessError as error:
        raise Refused(f"`{' '.join(map(str, command[:4]))} ...` failed: {error.stderr.strip()}") from None


def read_facts(path):
    facts = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    for name in ("source", "build", "sysroot"):
        facts[name] = pathlib.Path(facts[name])
    return Facts(**facts)
