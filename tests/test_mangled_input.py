"""Files that somebody or some disk has mangled: test_mangled_input.py CLUSTERBENCH SCENE [--tries N] [--seed S].

Scenes, configurations, results, histories and what interrupted runs left, all of the program's own, are changed at
random (the same for the same seed), and every command that reads them must end in time with an exit code that
docs/commands.md names: never by a signal, an internal error or a sanitizer's report. What failed is kept and named."""

import argparse
import copy
import json
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

ANSWERS = {0, 1, 2, 3, 4}  # the exit codes of docs/commands.md without internal errors and interrupts
TIMEOUT_S = 120
STRANGE = [None, True, False, 0, -1, 0.5, 255, 65536, 2**31, 2**32, 2**53, -(2**63), 1e300, -1e300, 1e-320, "", "x" * 300,
           "\0", "é", [], {}, [1, 2, 3], [[[]]], {"a": {}}]


# --- Mangling ---

def places(value, place=()):
    """All places within a JSON value, as tuples of keys; of long lists the first ones."""
    yield place
    members = value.items() if isinstance(value, dict) else enumerate(value[:40]) if isinstance(value, list) else ()
    for key, member in members:
        yield from places(member, place + (key,))


def at(value, place):
    for key in place:
        value = value[key]
    return value


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def change(whole, place, draw):
    """Changes one place in a JSON value."""
    parent, key = at(whole, place[:-1]), place[-1]
    old = parent[key]
    how = draw.random()
    if how < 0.2 and is_number(old):
        parent[key] = draw.choice([old + 1, old - 1, -old, 2 * old, 1000 * old, old / 3, 0])
    elif how < 0.5:
        parent[key] = copy.deepcopy(draw.choice(STRANGE))
    elif how < 0.7:
        del parent[key]
    elif how < 0.85 and isinstance(parent, list):
        parent.insert(draw.randrange(len(parent) + 1), copy.deepcopy(draw.choice(parent)))
    elif isinstance(parent, dict):
        parent[draw.choice(list(parent))] = copy.deepcopy(old)
    else:
        parent[key] = copy.deepcopy(at(whole, draw.choice(list(places(whole)))))


def mangled_json(value, draw):
    value = copy.deepcopy(value)
    for _ in range(draw.choice([1, 1, 1, 2, 4])):
        inner = [place for place in places(value) if place]
        if inner:
            change(value, draw.choice(inner), draw)
    return value


def mangled_bytes(data, draw):
    data = bytearray(data)
    for _ in range(draw.choice([1, 1, 2, 8])):
        how, place = draw.random(), draw.randrange(len(data) + 1)
        if how < 0.5:
            data[place:place + 1] = bytes([draw.randrange(256)])
        elif how < 0.7:
            del data[place:]
        elif how < 0.85:
            data[place:place] = data[place:place + draw.randrange(64)]
        else:
            data[place:place + 4] = struct.pack("<I", draw.choice([0, 1, 2**31 - 1, 2**31, 2**32 - 1, len(data)]))
    return bytes(data)


def mangled_document(text, draw):
    if draw.random() < 0.2:
        return mangled_bytes(text, draw)
    return json.dumps(mangled_json(json.loads(text), draw)).encode()


def mangled_lines(text, draw):
    """Of a file with a JSON value per line one line, or a blank one more."""
    lines = text.split(b"\n")
    place = draw.randrange(len(lines))
    if draw.random() < 0.15:
        lines.insert(place, draw.choice([b"", b" ", b"\r", b"\t\r"]))
        return b"\n".join(lines)
    lines[place] = mangled_document(lines[place], draw) if lines[place] else b"{}"
    return b"\n".join(lines)


def mangled_scene(data, draw):
    """A .glb: its JSON, its buffer, or anything."""
    how = draw.random()
    if how < 0.25:
        return mangled_bytes(data, draw)
    length = struct.unpack_from("<I", data, 12)[0]
    head, rest = json.loads(data[20:20 + length]), data[20 + length:]
    if how < 0.4:
        rest = mangled_bytes(rest, draw)
    else:
        head = mangled_json(head, draw)
    text = json.dumps(head).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text) + len(rest), len(text), b"JSON") + text + rest


# --- What reads them ---

def config_of(scene, assigners):
    return {"scenes": [{"path": str(scene), "frames": 2}], "viewport": [320, 180], "assigners": assigners,
            "grids": [{"kind": "frustum", "tiles": {"count": [6, 4]}, "slices": {"scheme": "linear", "count": 4}}],
            "storages": ["packed", "bitfield"], "timing": {"sweep_mib": 4, "rounds": 3}, "details": {"frames": [0]},
            "stability": {"steps": 3}}


class Kit:
    """A folder with sound files, and the commands for mangled ones."""

    def __init__(self, program, scene, folder):
        self.program, self.folder = program, folder
        self.scene = folder / "scene.glb"
        shutil.copy(scene, self.scene)
        self.config = folder / "config.json"
        self.config.write_text(json.dumps(config_of(self.scene, ["sphere-refinement", "exact-fast"])))
        self.result, self.history = folder / "result.json", folder / "history.jsonl"
        self.must("run", "--quiet", "-o", self.result, self.config)
        for commit in ["one", "two", "three"]:
            self.must("history", "add", self.result, self.history, "--commit", commit)
        self.comparison = folder / "comparison.json"
        self.must("compare", self.result, self.result, "--json", self.comparison)
        self.mangled = folder / "mangled"
        self.mangled.mkdir()
        self.long_config = folder / "long.json"
        long = config_of(self.scene, ["bounds"])
        long["grids"][0]["slices"]["count"] = list(range(4, 16))
        del long["stability"], long["details"]
        self.long_config.write_text(json.dumps(long))
        self.journal = self.interrupted()

    def interrupted(self):
        """What a run leaves that is interrupted after some cases."""
        left = self.folder / "interrupted.json.partial"
        command = [str(self.program), "run", "--quiet", "-o", str(left.with_suffix("")), str(self.long_config)]

        def cases():
            try:
                return left.read_bytes().count(b"\n") - 1
            except FileNotFoundError:  # not begun, or finished
                return 0

        for _ in range(20):  # on a busy machine a run may be over before it is interrupted
            with subprocess.Popen(command, stderr=subprocess.DEVNULL, cwd=self.folder) as run:
                while run.poll() is None and cases() < 2:
                    time.sleep(0.002)
                run.send_signal(signal.SIGINT)
            if cases() > 0:
                return left.read_bytes()
        sys.exit("no run could be interrupted")

    def run(self, *arguments):
        command = [str(word) for word in (self.program, *arguments)]
        return subprocess.run(command, capture_output=True, timeout=TIMEOUT_S, cwd=self.folder)

    def must(self, *arguments):
        done = self.run(*arguments)
        if done.returncode != 0:
            sys.exit(f"{arguments} ends with {done.returncode}: {done.stderr.decode(errors='replace')}")

    def case(self, draw):
        """A mangled file, its bytes, and the command that is to read it."""
        page, out = self.mangled / "page.html", self.mangled / "out.json"
        kind = draw.choice(["scene", "config", "result", "result", "comparison", "history", "journal"])
        if kind == "scene":
            file, data = self.mangled / "scene.glb", mangled_scene(self.scene.read_bytes(), draw)
            config = self.mangled / "of_scene.json"
            config.write_text(json.dumps(config_of(file, ["bounds-fast", "exact"])))
            return file, data, draw.choice([["scene", "info", file], ["run", "--quiet", "--no-timing", "-o", out, config]])
        if kind == "config":
            file = self.mangled / "config.json"
            return (file, mangled_document(self.config.read_bytes(), draw),
                    draw.choice([["validate", file], ["run", "--dry-run", file]]))
        if kind == "comparison":
            file = self.mangled / "comparison.json"
            return file, mangled_document(self.comparison.read_bytes(), draw), ["validate", file]
        if kind == "journal":
            file = self.mangled / "long.json.partial"
            return (file, mangled_lines(self.journal, draw),
                    ["run", "--quiet", "--resume", "-o", file.with_suffix(""), self.long_config])
        if kind == "history":
            file = self.mangled / "history.jsonl"
            return file, mangled_lines(self.history.read_bytes(), draw), ["history", "show", file, "-o", page]
        file = self.mangled / "result.json"
        commands = [["validate", file], ["size", file], ["report", "-o", page, file], ["merge", file, "-o", out],
                    ["compare", file, self.result], ["compare", "--force", self.result, file],
                    ["history", "add", file, self.mangled / "added.jsonl"]]
        commands += [["export", "--all", "--format", form, file] for form in ["csv", "lnt", "google-benchmark", "bencher"]]
        return file, mangled_document(self.result.read_bytes(), draw), draw.choice(commands)


def fault_of(kit, command):
    try:
        done = kit.run(*command)
    except subprocess.TimeoutExpired:
        return f"does not end within {TIMEOUT_S} s"
    said = done.stderr.decode(errors="replace")
    if done.returncode not in ANSWERS or "runtime error" in said or "Sanitizer" in said:
        return f"ends with {done.returncode}: {said[-2000:]}"
    if done.returncode == 2 and not said:
        return "says nothing"
    return ""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path, help="a .glb")
    parser.add_argument("--tries", type=int, default=150)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    draw = random.Random(asked.seed)
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        kit = Kit(asked.program.resolve(), asked.scene, pathlib.Path(folder))
        for number in range(asked.tries):
            file, data, command = kit.case(draw)
            file.write_bytes(data)
            if fault := fault_of(kit, command):
                faults += 1
                kept = pathlib.Path(tempfile.mkdtemp(prefix="mangled_")) / file.name
                shutil.copy(file, kept)
                print(f"try {number}: {' '.join(map(str, command))}\n  {fault}\n  kept as {kept}")
    print(f"{asked.tries} mangled files, seed {asked.seed}: {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
