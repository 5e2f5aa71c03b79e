"""A shader of a user's own (--shader) with holes for what a test changes, and runs of the program with it.

Tests that use it are started as TEST.py CLUSTERBENCH CHECKOUT, and end with main() of this module.
"""
import copy
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, CHECKOUT = map(os.path.abspath, sys.argv[1:3])
SHADERS = f"{CHECKOUT}/configs/shaders"
TUTORIAL_GRID = {"kind": "frustum", "tiles": {"count": [12, 12]}, "slices": {"scheme": "exponential", "count": 24, "near": 0.1, "far": 400}}
GRID = {"kind": "frustum", "tiles": {"pixels": 32}, "slices": {"scheme": "exponential", "count": 8}}

# A loop over all lights and cells, with holes for what a test changes.
LOOP = """#version 450
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Lights { vec4 lights[]; };
layout(std430, set = 0, binding = 1) readonly buffer Boundaries { float boundaries[]; };
layout(std430, set = 0, binding = 2) buffer Lists { uint lists[]; };
layout(push_constant) uniform Frame { uvec3 grid; uint lights; } frame;
vec2 span(float a, float b, float near, float far) {
  return vec2(min(min(a * near, a * far), min(b * near, b * far)), max(max(a * near, a * far), max(b * near, b * far)));
}
bool touches(uint light, uint cell) {
  uint x = cell % frame.grid.x, y = cell / frame.grid.x % frame.grid.y, z = cell / frame.grid.x / frame.grid.y;
  uint row = frame.grid.x + 1 + y, slice = frame.grid.x + frame.grid.y + 2 + z;
  float near = boundaries[slice], far = boundaries[slice + 1];
  vec2 h = span(boundaries[x], boundaries[x + 1], near, far), v = span(boundaries[row + 1], boundaries[row], near, far);
  vec3 apart = lights[light].xyz - clamp(lights[light].xyz, vec3(h.x, v.x, -far), vec3(h.y, v.y, -near));
  return dot(apart, apart) <= lights[light].w * lights[light].w * 1.00001;
}
void main() {
  uint cell = gl_GlobalInvocationID.x;
  if (cell >= frame.grid.x * frame.grid.y * frame.grid.z) return;
  BODY
}
"""
COUNTED = """uint count = 0;
  for (uint light = 0; light < frame.lights; ++light)
    if (touches(light, cell)) { if (count < 199) lists[cell * 200 + 1 + count] = light; ++count; }
  lists[cell * 200] = COUNT;"""
METHOD = {
    "shader_version": 1, "name": "mine", "summary": "a test",
    "buffers": {
        "lights": {"bytes": "lights * 16"},
        "boundaries": {"bytes": "4 * (columns + rows + slices + 3)", "values": [
            {"at": 0, "type": "f32", "is": "column_boundaries"},
            {"at": "4 * (columns + 1)", "type": "f32", "is": "row_boundaries"},
            {"at": "4 * (columns + rows + 2)", "type": "f32", "is": "slice_boundaries"}]},
        "lists": {"bytes": "cells * 800"}},
    "lights": {"rows": [{"buffer": "lights", "stride": 16, "fields": [{"at": 0, "type": "f32", "is": "position"},
                                                                       {"at": 12, "type": "f32", "is": "range"}]}]},
    "passes": [{"module": "mine.spv", "invocations": ["cells"],
                "bindings": [{"binding": 0, "buffer": "lights"}, {"binding": 1, "buffer": "boundaries"},
                             {"binding": 2, "buffer": "lists"}],
                "push": [{"at": 0, "type": "u32", "is": "grid_size"}, {"at": 12, "type": "u32", "is": "lights"}]}],
    "lists": [{"layout": "fixed", "per_cell": 199, "rows": {"buffer": "lists", "stride": 800},
               "counts": [{"at": 0, "type": "u32"}], "entries": {"at": 4, "type": "u32"}}]}


def compiled(source, path):
    with open(path + ".comp", "w") as file:
        file.write(source)
    done = subprocess.run(["glslangValidator", "-V", "--quiet", "--target-env", "vulkan1.2", "-o", path, path + ".comp"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stdout)


def configuration(**keys):
    return {"scenes": [{"path": f"{CHECKOUT}/scenes/mix.glb", "frames": 2}], "viewport": [320, 180], "grids": [GRID],
            "assigners": ["brute-force"], "storages": ["packed"],
            "timing": {"rounds": 2, "launches": 1, "min_time_ms": 0.05, "frames": 1, "cold": False}, **keys}


class Folder:
    """A folder with a method and what it names."""

    def __init__(self):
        self.path = tempfile.mkdtemp()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.path)

    def file(self, name, content):
        with open(f"{self.path}/{name}", "wb" if isinstance(content, bytes) else "w") as file:
            file.write(content)
        return f"{self.path}/{name}"

    def method(self, record, body=None, source=LOOP):
        compiled(source.replace("BODY", body or COUNTED.replace("COUNT", "count")), f"{self.path}/mine.spv")
        return self.file("mine.json", json.dumps(record))

    def run(self, document, *flags):
        config, out = self.file("config.json", json.dumps(document)), f"{self.path}/result.json"
        done = subprocess.run([PROGRAM, "run", config, "-o", out, *flags], capture_output=True, text=True)
        if not os.path.exists(out):
            return None, done
        with open(out) as file:
            return json.load(file), done


def changed(record, **paths):
    """The record with values at paths as a__b__0."""
    record = copy.deepcopy(record)
    for path, value in paths.items():
        at, steps = record, [int(step) if step.isdigit() else step for step in path.split("__")]
        for step in steps[:-1]:
            at = at[step]
        if value is None:
            del at[steps[-1]]
        else:
            at[steps[-1]] = value
    return record


def case_of(result, name):
    return next(case for case in result["cases"] if case["assigner"]["name"] == name)


def has_device():
    return subprocess.run([PROGRAM, "list", "devices"], capture_output=True).returncode == 0


def main():
    """Runs the tests of the script; without a device or glslangValidator all are skipped (exit code 77)."""
    if not has_device() or shutil.which("glslangValidator") is None:
        print("skipped: no device, or no glslangValidator")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
