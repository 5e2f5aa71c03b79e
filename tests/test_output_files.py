#!/usr/bin/env python3
"""Draws targets for every command that writes a file: one that is missing, a file, links, a folder, a pipe, a device, files of this
command, a full disk, a signal. Holds the exit code, that the target has its old content or all of the new one, that inputs and all
other files stay as they are, and that nothing is left behind.

usage: test_output_files.py PROGRAM [--tries N] [--seed N]"""

import argparse
import fcntl
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import stat
import struct
import subprocess
import sys
import tempfile
import threading
import time

USAGE, NOT_WHOLE = 2, 70
NOBODY = 65534
OLD = "what was there before\n"


def level():
    """Lights, a camera that moves and a floor, with all numbers in a file beside it."""
    times, places = struct.pack("<2f", 0, 1), struct.pack("<6f", 0, 1, 0, 0, 1, -3)
    corners, indices = struct.pack("<12f", -4, 0, -8, 4, 0, -8, 4, 0, 0, -4, 0, 0), struct.pack("<6H", 0, 2, 1, 0, 3, 2)
    parts, views, at = [times, places, corners, indices], [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": at, "byteLength": len(part)})
        at += len(part)
    punctual = {"extensions": {"KHR_lights_punctual": {"light": 0}}}
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}], "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": 3, "intensity": 50}]}},
        "nodes": [{"name": "player", "camera": 0}, {"translation": [0, 1, -5], **punctual}, {"translation": [1, 1, -6], **punctual},
                  {"mesh": 0}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 50}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 2}, "indices": 3}]}],
        "animations": [{"samplers": [{"input": 0, "output": 1}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
        "buffers": [{"uri": "keys%2ebin", "byteLength": at}], "bufferViews": views,
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
            {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-4, 0, -8], "max": [4, 0, 0]},
            {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}]}
    return document, b"".join(parts)


CONFIGURATION = {
    "scenes": [{"path": "level.gltf", "frames": 2}], "viewport": [64, 64], "limits": {"baseline": "r.json"},
    "grids": [{"kind": "frustum", "tiles": {"pixels": [32, 32]}, "slices": {"scheme": "exponential", "count": 4, "far": 50}}],
    "assigners": ["aabb-fast", "bounds"], "timing": {"sweep_mib": 4, "rounds": 6, "frames": 1, "launches": 1, "min_time_ms": 0.01},
}
SCENE = ["level.gltf", "keys.bin"]

# What follows the name of the program, what is read, and how the target ends.
COMMANDS = {
    "run": ("run config.json -q --no-timing -o {}", ["config.json", "r.json", *SCENE], ".json"),
    "run --export": ("run config.json -q --no-timing -o /dev/null --export csv={}", ["config.json", "r.json", *SCENE], ".csv"),
    "report": ("report r.json -o {}", ["r.json"], ".html"),
    "merge": ("merge r.json -o {}", ["r.json"], ".json"),
    "compare --json": ("compare r.json r.json --json {}", ["r.json"], ".json"),
    "compare --markdown": ("compare r.json r.json --markdown {}", ["r.json"], ".md"),
    "export": ("export r.json --format csv -o {}", ["r.json"], ".csv"),
    "ratio --csv": ("ratio r.json --csv {}", ["r.json"], ".csv"),
    "history add": ("history add r.json {}", ["r.json"], ".jsonl"),
    "history show": ("history show h.jsonl -o {}", ["h.jsonl"], ".html"),
    "scene generate": ("scene generate jam --lights 5 -o {}", [], ".glb"),
    "scene views": ("scene views level.gltf --faces 0,1,0 -o {}", SCENE, ".gltf"),
    "worst-case": ("worst-case config.json --filter aabb -q --evaluations 5 --random 0 -o {}", ["config.json", *SCENE], ".json"),
    "light-map": ("light-map level.gltf -q --unwrap --texels-per-metre 1 -o {}", SCENE, ".json"),
    "recommend": ("recommend config.json --by gpu_cost_us --no-timing -q -o {}", ["config.json", *SCENE], ".json"),
    "stress": ("stress -q --cases H1 --methods aabb-fast --tries 0 -o {}", [], ".json"),
}


def state(folder):
    """What each name below the folder is."""
    found = {}
    for path in sorted(folder.rglob("*")):
        mode = path.lstat().st_mode
        if stat.S_ISLNK(mode):
            found[path] = ("link", os.readlink(path))
        elif stat.S_ISREG(mode):
            found[path] = ("file", path.read_bytes(), stat.S_IMODE(mode))
        else:
            found[path] = (stat.S_IFMT(mode),)
    return found


def is_whole(text, ending):
    if ending in (".json", ".gltf"):
        try:
            return isinstance(json.loads(text), dict)
        except ValueError:
            return False
    if ending == ".glb":
        return text[:4] == b"glTF" and struct.unpack("<I", text[8:12])[0] == len(text)
    return len(text) > 40 and text.endswith(b"\n")


class Trial:
    """One command and one target in a fresh folder."""

    def __init__(self, program, base, folder, name, draw):
        self.program, self.folder, self.name, self.draw = program, folder, name, draw
        shutil.copytree(base, folder)
        self.arguments, self.inputs, self.ending = COMMANDS[name]
        self.target = folder / ("out" + self.ending)
        self.written = self.target  # where the new content is to be; None: the command refuses
        self.code, self.moved, self.options, self.reader = 0, {}, {}, None
        self.is_history = name == "history add"
        self.old = (base / "h.jsonl").read_bytes() if self.is_history else OLD.encode()

    def refuse(self, code=USAGE):
        self.code, self.written = code, None

    def missing(self):
        pass

    def file(self):
        self.target.write_bytes(self.old)
        self.target.chmod(self.draw.choice([0o600, 0o644, 0o664]))

    def other_text(self):
        self.target.write_text(OLD)
        if self.is_history:
            self.refuse()

    def link(self):
        (self.folder / "kept").mkdir()
        self.written = self.folder / "kept" / ("target" + self.ending)
        self.written.write_bytes(self.old)
        if self.name == "scene views":
            self.written.unlink()
            self.written = self.folder / ("target" + self.ending)
        (self.folder / "second").symlink_to(self.written)
        self.target.symlink_to("second")

    def dangling_link(self):
        self.written = self.folder / ("target" + self.ending)
        self.target.symlink_to(self.written.name)

    def circle_of_links(self):
        self.target.symlink_to("other")
        (self.folder / "other").symlink_to(self.target.name)
        self.refuse()

    def target_is_input(self):
        if not self.inputs:
            return
        read = self.folder / self.draw.choice(self.inputs)
        way = self.draw.choice(["name", "link", "hard link", "spelling"])
        if way == "link":
            self.target.symlink_to(read.name)
        elif way == "hard link":
            os.link(read, self.target)
        elif read.suffix == self.ending or self.ending not in (".glb", ".gltf"):
            self.target = read if way == "name" else self.folder / "kept" / ".." / read.name
            (self.folder / "kept").mkdir()
        else:
            return
        self.refuse()

    def folder_there(self):
        self.target.mkdir()
        self.refuse()

    def missing_folder(self):
        self.target = self.folder / "none" / self.target.name
        self.refuse()

    def read_only_folder(self):
        if os.geteuid() == 0:
            if subprocess.run([self.program, "--version"], user=NOBODY, capture_output=True, check=False).returncode != 0:
                return
            self.options["user"] = NOBODY
        locked = self.folder / "locked"
        locked.mkdir()
        self.target = locked / self.target.name
        if self.draw.random() < 0.5:
            self.target.write_bytes(self.old)
            self.target.chmod(0o666)
        locked.chmod(0o555)
        self.refuse()

    def names_beside(self):
        self.file()
        for ending in (".new", ".new.1", ".tmp", "~"):
            (self.folder / (self.target.name + ending)).write_text("precious")
        partial = self.folder / (self.target.name + ".partial")
        partial.write_text(self.draw.choice(["notes", "notes\nmore\n", '{"header": 1', '{"header": 1}\n']))
        if self.name == "run":
            self.moved[partial] = self.folder / (self.target.name + ".partial.1")

    def partial_that_is_a_link(self):
        victim = self.folder / "victim"
        if self.draw.random() < 0.5:
            victim.write_text("")
        (self.folder / (self.target.name + ".partial")).symlink_to(victim.name)
        if self.name == "run":
            self.refuse()

    def pipe(self):
        os.mkfifo(self.target)
        taken = []
        self.written = None
        if self.is_history:
            self.refuse()
            return
        reader = threading.Thread(target=lambda: taken.append(self.target.read_bytes()), daemon=True)
        reader.start()

        def end():
            reader.join(5)
            assert taken and is_whole(taken[0], self.ending), f"through the pipe came {taken}"

        self.reader = end

    def full_pipe(self):
        """One that does not block, as another program may have set it, with a reader that is slow to begin."""
        if self.name in ("scene generate", "scene views") or self.is_history:  # by the name's ending; no history
            return
        read, write = os.pipe()
        os.set_blocking(write, False)
        fcntl.fcntl(write, fcntl.F_SETPIPE_SZ, 4096)
        self.target, self.written = pathlib.Path(f"/dev/fd/{write}"), None
        self.options["pass_fds"] = (write,)
        taken = []

        def take():
            time.sleep(0.3)
            with os.fdopen(read, "rb") as pipe:
                taken.append(pipe.read())

        reader = threading.Thread(target=take, daemon=True)
        reader.start()

        def end():
            os.close(write)
            reader.join(5)
            assert taken and is_whole(taken[0], self.ending), f"through the pipe came {taken}"

        self.reader = end

    def held(self):
        """For a moment, by another process that adds to it."""
        if not self.is_history:
            return
        self.file()
        holder = self.target.open("ab")
        fcntl.flock(holder, fcntl.LOCK_EX)
        threading.Timer(0.3, holder.close).start()

    def device(self):
        try:
            os.mknod(self.target, stat.S_IFCHR | 0o666, os.makedev(1, 3))
            self.target.write_text("x")
        except OSError:
            self.target.unlink(missing_ok=True)
            return
        self.written = None
        if self.is_history:
            self.refuse()

    def full_disk(self):
        if self.draw.random() < 0.5:
            self.file()
        most = self.draw.choice([1, 10, 40])  # fewer bytes than the smallest output has
        self.options["preexec_fn"] = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
        self.refuse(NOT_WHOLE)

    def signal(self):
        if self.draw.random() < 0.5:
            self.file()
        self.code = None

    def run(self, kind):
        getattr(self, kind)()
        before = state(self.folder)
        is_near = self.target.is_relative_to(self.folder) and self.draw.random() < 0.5
        out = os.path.relpath(self.target, self.folder) if is_near else str(self.target)
        words = [self.program] + self.arguments.format(out).split()
        with subprocess.Popen(words, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              **self.options) as process:
            if kind == "signal":
                time.sleep(self.draw.uniform(0, 0.08))
                process.send_signal(self.draw.choice([signal.SIGTERM, signal.SIGHUP]))
            try:
                told = process.communicate(timeout=30)[1].decode()
            except subprocess.TimeoutExpired:
                process.kill()
                raise
        if self.reader:
            self.reader()
        self.check(kind, before, process.returncode, told, " ".join(words[1:]))

    def check(self, kind, before, code, told, words):
        after = state(self.folder)
        context = f"{kind}: {words}: exit code {code}: {told}"
        assert "internal error" not in told, context
        if self.code is not None:
            assert code == self.code, f"{context}; {self.code} was expected"
        if code in (USAGE, NOT_WHOLE):
            assert told.startswith("clusterbench: ") or "\nclusterbench: " in told, context
        expected = dict(before)
        for old_name, new_name in self.moved.items():
            expected[new_name] = expected.pop(old_name)
        if self.written and (self.code == 0 or after.get(self.written) != before.get(self.written)):
            assert self.written in after and after[self.written][0] == "file", f"{context}; nothing was written"
            text = after[self.written][1]
            assert is_whole(text, self.ending) and text != self.old, f"{context}; there is {text[:200]}"
            if self.written in before:
                assert before[self.written][2] == after[self.written][2], f"{context}; the mode has changed"
            expected[self.written] = after[self.written]
        if kind == "signal":  # finished cases
            partial = self.folder / (self.target.name + ".partial")
            if partial in after and self.name == "run":
                assert after[partial][1].count(b"\n") > 1, f"{context}; nothing is kept in it"
                expected[partial] = after[partial]
        differences = [str(path) for path in sorted(expected.keys() | after.keys()) if expected.get(path) != after.get(path)]
        assert not differences, f"{context}; {differences} are not as they were"


KINDS = ["missing", "file", "other_text", "link", "dangling_link", "circle_of_links", "target_is_input", "folder_there",
         "missing_folder", "read_only_folder", "names_beside", "partial_that_is_a_link", "pipe",
         "full_pipe", "held", "device", "full_disk", "signal"]


def prepared(program, base):
    document, numbers = level()
    base.mkdir()
    (base / "level.gltf").write_text(json.dumps(document))
    (base / "keys.bin").write_bytes(numbers)
    (base / "config.json").write_text(json.dumps(dict(CONFIGURATION, limits={})))
    for words in ("run config.json -q -o r.json", "history add r.json h.jsonl --commit before"):
        done = subprocess.run([program, *words.split()], cwd=base, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{words}: {done.stderr}")
    (base / "config.json").write_text(json.dumps(CONFIGURATION))
    if "without" in subprocess.run([program, "report", "r.json"], cwd=base, capture_output=True, text=True, check=False).stderr:
        for name in ("report", "history show"):  # a build without pages
            COMMANDS.pop(name)


def pipe_without_reader(program, base):
    """Waits for one, and a first signal ends that."""
    os.mkfifo(base / "pipe")
    for name in ("run", "report", "stress"):
        if name not in COMMANDS:
            continue
        with subprocess.Popen([program, *COMMANDS[name][0].format("pipe").split()], cwd=base, stderr=subprocess.PIPE) as process:
            time.sleep(1)
            assert process.poll() is None, f"{name}: did not wait for a reader: {process.stderr.read()}"
            process.terminate()
            process.wait(5)
    (base / "pipe").unlink()


def additions_at_once(program, base):
    """Each waits for those before it."""
    count = 12
    processes = [subprocess.Popen([program, "history", "add", "r.json", "at_once.jsonl", "--commit", f"c{number}"], cwd=base,
                                  stderr=subprocess.DEVNULL) for number in range(count)]
    codes = [process.wait() for process in processes]
    lines = (base / "at_once.jsonl").read_text().splitlines()
    assert codes == [0] * count and {json.loads(line)["commit"] for line in lines} == {f"c{number}" for number in range(count)}, codes
    (base / "at_once.jsonl").unlink()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--tries", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    program = os.path.abspath(given.program)
    with tempfile.TemporaryDirectory(prefix="clusterbench.") as name:
        folder = pathlib.Path(name)
        folder.chmod(0o755)
        prepared(program, folder / "base")
        pipe_without_reader(program, folder / "base")
        additions_at_once(program, folder / "base")
        faults = 0
        pairs = [(command, kind) for command in COMMANDS for kind in KINDS]
        for number in range(given.tries):
            draw = random.Random(f"{given.seed} {number}")
            if number % len(pairs) == 0:
                random.Random(f"{given.seed} order {number}").shuffle(pairs)
            command, kind = pairs[number % len(pairs)]
            place = folder / "try"
            try:
                Trial(program, folder / "base", place, command, draw).run(kind)
            except (AssertionError, subprocess.TimeoutExpired) as fault:
                faults += 1
                print(f"seed {given.seed}, try {number}: {command}: {fault}")
            if (place / "locked").exists():
                (place / "locked").chmod(0o755)
            shutil.rmtree(place)
        if faults:
            sys.exit(f"{faults} of {given.tries} tries show a fault")
        print(f"{given.tries} tries")


if __name__ == "__main__":
    main()
