#!/usr/bin/python3
"""Light lists out of a RenderDoc capture, for `clusterbench check`.

    dump_buffers.py CAPTURE.rdc                        lists dispatches and draws with the buffers that they are bound to
    dump_buffers.py CAPTURE.rdc --event N -o NAME.json writes the buffers of event N as they are after it, as NAME.BUFFER.bin,
                                                       and a dump to fill in

Needs RenderDoc's module for Python (Debian: python3-renderdoc, for the system's python3), of version 1.20 or later.
In RenderDoc's own window (Python Shell, Run Scripts) it writes the selected event of the open capture, beside the capture.
"""

import argparse
import json
import os
import pathlib
import re
import sys

WHOLE_BUFFER = 2**64 - 1


class Refused(Exception):
    """A sentence for the user."""


def renderdoc_module():
    try:
        import renderdoc
    except ImportError as problem:
        raise Refused(
            f"RenderDoc's Python module is not here ({problem}): install python3-renderdoc and run this with /usr/bin/python3"
        ) from None
    return renderdoc


class Bound:
    """A buffer that a shader has: bytes [at, at + size) of a resource."""

    def __init__(self, stage, access, block, resource, at, size, name, layout):
        self.stage, self.access, self.block = stage, access, block
        self.resource, self.at, self.size = resource, at, size
        self.name, self.layout = name, layout

    def text(self):
        kind = {"constants": "constants", "read": "read only", "written": "storage"}[self.access]
        return f"{self.stage} {kind} '{self.block}': buffer '{self.name}', {self.size} bytes" + (
            f" from byte {self.at} on" if self.at else ""
        )


# --- What a shader says of its blocks ---


def number_name(rd, member_type):
    """The type of a dump's field, or None for structures and others that a dump has no name for."""
    names = {"Float": "f32", "UInt": "u32", "SInt": "u32", "Half": "f16", "UShort": "u16", "UByte": "u8", "ULong": "u64"}
    names["Double"] = "f64"
    for kind, name in names.items():
        if getattr(rd.VarType, kind, None) == member_type.baseType:
            return name
    return None


def is_endless(elements):
    return elements in (0, 0xFFFFFFFF)


def flat_members(rd, members, prefix="", at=0):
    """Lines "byte 16 f32 x 4 position" of a structure's members."""
    lines = []
    for member in members:
        kind, name, byte = member.type, prefix + member.name, at + member.byteOffset
        if len(kind.members) > 0:
            lines += flat_members(rd, kind.members, name + ".", byte)
            continue
        count = max(1, kind.rows) * max(1, kind.columns) * (1 if is_endless(kind.elements) else max(1, kind.elements))
        lines.append((byte, number_name(rd, kind) or kind.name, count, name))
    return lines


def row_layout(rd, block_type):
    """(stride, members) of the array of rows that a block is or ends with; (0, members) without one."""
    members = list(block_type.members)
    if members and len(members) == 1 and is_endless(members[0].type.elements):
        row = members[0].type
        inner = flat_members(rd, row.members) if len(row.members) > 0 else [(0, number_name(rd, row) or row.name, max(1, row.columns), members[0].name)]
        return row.arrayByteStride, inner
    return 0, flat_members(rd, members)


# --- What an event has bound: RenderDoc before 1.33, and later ---


def vulkan_ranges(controller, stage_name):
    """{(set, binding): (resource, at, size)} of a stage, which pipelines in general do not tell before RenderDoc 1.33."""
    state = controller.GetVulkanPipelineState()
    part = state.compute if stage_name == "compute" else state.graphics
    ranges = {}
    for set_number, descriptor_set in enumerate(getattr(part, "descriptorSets", [])):
        for binding_number, binding in enumerate(descriptor_set.bindings):
            for bind in binding.binds:
                ranges[set_number, binding_number] = (bind.resourceResourceId, bind.byteOffset, bind.byteSize)
    return ranges


class OlderPipeline:
    def __init__(self, rd, controller, stage, stage_name):
        self.pipe = controller.GetPipelineState()
        self.stage = stage
        self.mapping = self.pipe.GetBindpointMapping(stage)
        is_vulkan = self.pipe.IsCaptureVK()
        self.ranges = vulkan_ranges(controller, stage_name) if is_vulkan else {}

    def constants(self, index):
        bound = self.pipe.GetConstantBuffer(self.stage, index, 0)
        return bound.resourceId, bound.byteOffset, bound.byteSize

    def resource(self, access, index):
        read = access == "read"
        points = self.mapping.readOnlyResources if read else self.mapping.readWriteResources
        arrays = (self.pipe.GetReadOnlyResources if read else self.pipe.GetReadWriteResources)(self.stage)
        point = points[index]
        for array in arrays:
            if (array.bindPoint.bindset, array.bindPoint.bind) == (point.bindset, point.bind) and len(array.resources) > 0:
                whole = (array.resources[0].resourceId, 0, WHOLE_BUFFER)
                return self.ranges.get((point.bindset, point.bind), whole)
        return None


class NewerPipeline:
    def __init__(self, rd, controller, stage, stage_name):
        self.pipe = controller.GetPipelineState()
        self.stage = stage

    def constants(self, index):
        descriptor = self.pipe.GetConstantBlock(self.stage, index, 0).descriptor
        return descriptor.resource, descriptor.byteOffset, descriptor.byteSize

    def resource(self, access, index):
        used = self.pipe.GetReadOnlyResources(self.stage) if access == "read" else self.pipe.GetReadWriteResources(self.stage)
        for row in used:
            if row.access.index == index:
                return row.descriptor.resource, row.descriptor.byteOffset, row.descriptor.byteSize
        return None


class Capture:
    """A capture that is replayed by `controller`."""

    def __init__(self, rd, controller):
        self.rd, self.controller = rd, controller
        self.names = {self.key(row.resourceId): row.name for row in controller.GetResources()}
        self.lengths = {self.key(row.resourceId): row.length for row in controller.GetBuffers()}

    @staticmethod
    def key(resource):
        return int(resource)

    def events(self):
        """[(event, name, stages)] of dispatches and draws, in their order."""
        flags, found = self.rd.ActionFlags, []
        structured = self.controller.GetStructuredFile()

        def walk(actions):
            for action in actions:
                if action.flags & flags.Dispatch:
                    found.append((action.eventId, action.GetName(structured), ["compute"]))
                elif action.flags & flags.Drawcall:
                    found.append((action.eventId, action.GetName(structured), ["vertex", "pixel"]))
                walk(action.children)

        walk(self.controller.GetRootActions())
        return found

    def bound(self, event, stages):
        """The buffers of an event's shaders, each resource and range once for each stage."""
        self.controller.SetFrameEvent(event, True)
        found = []
        for stage in stages:
            found += self.bound_of_stage(stage)
        return found

    def bound_of_stage(self, stage_name):
        rd = self.rd
        stage = {"compute": rd.ShaderStage.Compute, "vertex": rd.ShaderStage.Vertex, "pixel": rd.ShaderStage.Pixel}[stage_name]
        pipe = self.controller.GetPipelineState()
        shader = pipe.GetShaderReflection(stage)
        if shader is None:
            return []
        older = hasattr(pipe, "GetBindpointMapping")
        pipeline = (OlderPipeline if older else NewerPipeline)(rd, self.controller, stage, stage_name)
        found = []
        for index, block in enumerate(shader.constantBlocks):
            if block.bufferBacked:
                self.add(found, stage_name, "constants", block.name, pipeline.constants(index), (0, flat_members(rd, block.variables)))
        for access, blocks in (("read", shader.readOnlyResources), ("written", shader.readWriteResources)):
            for index, block in enumerate(blocks):
                if not block.isTexture:
                    self.add(found, stage_name, access, block.name, pipeline.resource(access, index), row_layout(rd, block.variableType))
        return found

    def add(self, found, stage, access, block, place, layout):
        if place is None or self.key(place[0]) not in self.lengths:
            return
        resource, at, size = place
        size = min(size, max(0, self.lengths[self.key(resource)] - at))
        name = self.names.get(self.key(resource), "")
        found.append(Bound(stage, access, block, resource, at, size, name, layout))

    def bytes_of(self, bound):
        return bytes(self.controller.GetBufferData(bound.resource, bound.at, bound.size)) if bound.size > 0 else b""

    def viewport(self):
        pipe = self.controller.GetPipelineState()
        port = pipe.GetViewport(0)
        return [round(port.width), round(abs(port.height))] if port.width >= 1 and abs(port.height) >= 1 else None


class OpenCapture:
    """Opens a file, and replays it on this machine: `with OpenCapture(rd, path) as capture`."""

    def __init__(self, rd, path):
        self.rd, self.path = rd, path

    def __enter__(self):
        if not self.path.is_file():
            raise Refused(f"{self.path}: does not exist")
        self.rd.InitialiseReplay(self.rd.GlobalEnvironment(), [])
        self.file = self.rd.OpenCaptureFile()
        self.controller = None
        try:
            self.open()
            return Capture(self.rd, self.controller)
        except BaseException:
            self.__exit__()  # a process whose replay is not shut down may never end
            raise

    def open(self):
        rd, path = self.rd, self.path
        opened = self.file.OpenFile(str(path), "", None)
        if opened != rd.ResultCode.Succeeded:
            raise Refused(f"{path}: is no capture that this RenderDoc opens: {opened}")
        if self.file.LocalReplaySupport() != rd.ReplaySupport.Supported:
            raise Refused(f"{path}: cannot be replayed here: it is of {self.file.DriverName()} on another machine or driver")
        result, self.controller = self.file.OpenCapture(rd.ReplayOptions(), None)
        if result != rd.ResultCode.Succeeded:
            self.controller = None
            raise Refused(f"{path}: cannot be replayed here: {result}")

    def __exit__(self, *_):
        if self.controller is not None:
            self.controller.Shutdown()
        self.file.Shutdown()
        self.rd.ShutdownReplay()


# --- The dump ---


def file_part(text):
    return re.sub(r"[^A-Za-z0-9_-]+", "-", text).strip("-") or "buffer"


def unique_names(bounds):
    """A name for each buffer, from its block in the shader."""
    names, taken = [], set()
    for bound in bounds:
        base = file_part(bound.block)
        name, count = base, 2
        while name in taken:
            name, count = f"{base}-{count}", count + 1
        taken.add(name)
        names.append(name)
    return names


def field_text(member):
    byte, kind, count, name = member
    return f"byte {byte}: {name}, {kind}" + (f" x {count}" if count > 1 else "")


def buffer_lines(names, files, bounds):
    lines = []
    for i, (name, file, bound) in enumerate(zip(names, files, bounds)):
        comma = "," if i + 1 < len(names) else ""
        stride, members = bound.layout
        rows = f"; {bound.size // stride} rows of {stride} bytes" if stride else ""
        lines.append(f"    {json.dumps(name)}: {{\"file\": {json.dumps(file)}}}{comma}  // {bound.text()}{rows}")
        lines += [f"    //   {field_text(member)}" for member in members[:24]]
    return lines


def first_number(members, kinds, least=1):
    for member in members:
        if member[1] in kinds and member[2] >= least:
            return member
    return None


def rows_of_lights(names, bounds):
    """The likeliest buffer of lights: the first that is not written and has rows with three numbers or more."""
    for access in ("read", "written", "constants"):
        for name, bound in zip(names, bounds):
            stride, members = bound.layout
            position = first_number(members, ("f32", "f16", "f64"), 3)
            if bound.access == access and stride and position:
                return name, bound, position
    return None


def lights_text(names, bounds):
    found = rows_of_lights(names, bounds)
    if found is None:
        return '{"listed": []}'
    name, bound, (at, kind, count, _) = found
    stride, members = bound.layout
    behind = at + 3 * {"f16": 2, "f32": 4, "f64": 8}[kind]
    # Behind the position: its fourth number, or the next number of its own.
    alone = [member[0] for member in members if member[0] >= behind and member[1] == kind and member[2] == 1]
    last = behind if count > 3 else next(iter(alone), at)
    rows = {"buffer": name, "stride": stride, "count": bound.size // stride}
    rows["position"] = {"at": at, "type": kind}
    rows["range"] = {"at": last, "type": kind}
    return json.dumps({"rows": [rows]})


def lists_text(names, bounds):
    """A part for the last storage buffer: what it is like is for the user to say."""
    lights = rows_of_lights(names, bounds)
    stored = [(name, bound) for name, bound in zip(names, bounds) if bound.access == "written" and (lights is None or name != lights[0])]
    if not stored:
        return '[{"layout": "inline", "cells": []}]'
    name, bound = stored[-1]
    stride, members = bound.layout
    count = first_number([member for member in members if member[2] == 1], ("u32", "u16", "u8"))
    entries = first_number(members, ("u32", "u16", "u8"), 2)
    part = {"layout": "fixed", "rows": {"buffer": name, "stride": stride or 4}}
    part["counts"] = [{"at": count[0] if count else 0, "type": count[1] if count else "u32"}]
    part["per_cell"] = entries[2] if entries else 1
    part["entries"] = {"at": entries[0] if entries else 0, "type": entries[1] if entries else "u32"}
    return json.dumps([part])


def skeleton(path, event, viewport, names, files, bounds):
    size = viewport or [1920, 1080]
    lines = [
        "{",
        '  "dump_version": 1,',
        f"  // From {path.name}, event {event}, by scripts/renderdoc/dump_buffers.py. Fill in camera and grid; lights and lists are guesses",
        "  // from the names of the shader: hold them against its code (docs/check.md; `clusterbench schema dump` describes the keys).",
        f'  "viewport": {json.dumps(size)},' + ("" if viewport else "  // a guess: a dispatch has none"),
        '  "buffers": {',
        *buffer_lines(names, files, bounds),
        "  },",
        '  "camera": {',
        '    "world_to_view": [],  // 16 numbers; where lights are in view space leave it out, and say "space": "view" in lights',
        '    "projection": [],     // 16 numbers',
        '    "order": "columns",',
        '    "forward": "-z",',
        '    "depth": "0..1"',
        "  },",
        '  "grid": {"tiles": {"count": [1, 1]}, "slices": {"scheme": "exponential", "count": 1}, "axes": "xyz", "first_row": "top"},',
        f'  "lights": {lights_text(names, bounds)},',
        f'  "lists": {lists_text(names, bounds)}',
        "}",
    ]
    return "\n".join(lines) + "\n"


def write_dump(capture, path, event, out):
    events = {number: stages for number, _, stages in capture.events()}
    if event not in events:
        raise Refused(f"--event: {event} is no dispatch or draw of {path}; allowed: {', '.join(map(str, events)) or 'none is there'}")
    bounds = capture.bound(event, events[event])
    if not bounds:
        raise Refused(f"--event: {event} has no buffers bound")
    names = unique_names(bounds)
    files = [f"{out.stem}.{name}.bin" for name in names]
    for file, bound in zip(files, bounds):
        (out.parent / file).write_bytes(capture.bytes_of(bound))
    out.write_text(skeleton(path, event, capture.viewport(), names, files, bounds))
    print(f"{out}: {len(bounds)} buffers of event {event}; fill in camera and grid, then `clusterbench check {out}`")


def list_events(capture):
    for event, name, stages in capture.events():
        print(f"event {event}: {name}")
        for bound in capture.bound(event, stages):
            print(f"  {bound.text()}")


def parsed(arguments):
    parser = argparse.ArgumentParser(description="Light lists out of a RenderDoc capture, for `clusterbench check`.")
    parser.add_argument("capture", type=pathlib.Path)
    parser.add_argument("--event", type=int, help="the dispatch (or draw) whose buffers are written, as they are after it")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="the dump to write (.json)")
    flags = parser.parse_args(arguments)
    if (flags.event is None) != (flags.output is None):
        parser.error("--event and -o stand together")
    return flags


def dump_from_window(window):
    """The selected event of the capture that RenderDoc's window shows."""
    path, event = pathlib.Path(window.GetCaptureFilename()), window.CurEvent()
    out = path.with_name(f"{path.stem}.event-{event}.json")
    problems = []

    def write(controller):  # on the thread of the replay, where an exception would be lost
        try:
            write_dump(Capture(renderdoc_module(), controller), path, event, out)
        except (Refused, OSError) as problem:
            problems.append(str(problem))

    window.Replay().BlockInvoke(write)
    for problem in problems:
        print(f"dump_buffers.py: {problem}")


def main(arguments):
    flags = parsed(arguments)
    try:
        with OpenCapture(renderdoc_module(), flags.capture) as capture:
            if flags.event is None:
                list_events(capture)
            else:
                write_dump(capture, flags.capture, flags.event, flags.output)
    except Refused as problem:
        print(f"dump_buffers.py: {problem}", file=sys.stderr)
        return 2
    except BrokenPipeError:  # its reader has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as problem:
        print(f"dump_buffers.py: {problem.filename}: {problem.strerror}", file=sys.stderr)
        return 2
    return 0


if "pyrenderdoc" in globals():
    dump_from_window(globals()["pyrenderdoc"])
elif __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
