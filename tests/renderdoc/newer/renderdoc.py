"""A stand-in for RenderDoc's module, version 1.33 and later, as its documentation has it (docs/python_api): one dispatch of a
shader with constants, read-only lights and storage of lists. Only what scripts/renderdoc/dump_buffers.py may use."""

import enum
import struct
from types import SimpleNamespace as Row


class ResultCode(enum.Enum):
    Succeeded = 0
    FileCorrupted = 1


class ReplaySupport(enum.Enum):
    Unsupported = 0
    Supported = 1


class ShaderStage(enum.Enum):
    Vertex = 0
    Pixel = 4
    Compute = 5


class VarType(enum.Enum):
    Float = 0
    Double = 1
    Half = 2
    SInt = 3
    UInt = 4


class ActionFlags(enum.IntFlag):
    NoFlags = 0
    Drawcall = 2
    Dispatch = 4


GlobalEnvironment = ReplayOptions = Row
ENDLESS = 0xFFFFFFFF
BUFFERS = {
    1: ("constants of the frame", bytes(64)),
    2: ("lights", b"\0" * 32 + struct.pack("<8f", 0, 0, -5, 2, 1, 0, -9, 3) + b"\0" * 32),
    3: ("lists", struct.pack("<6I", 1, 0, 7, 1, 1, 7)),
}


def kind(name, base, columns=1, elements=1, stride=0, members=()):
    return Row(name=name, baseType=base, rows=1, columns=columns, elements=elements, arrayByteStride=stride, members=list(members))


def member(name, at, of):
    return Row(name=name, byteOffset=at, type=of)


LIGHT = kind("Light", VarType.Float, elements=ENDLESS, stride=16, members=[member("position", 0, kind("float3", VarType.Float, 3)), member("range", 12, kind("float", VarType.Float))])
CELL = kind("Cell", VarType.UInt, elements=ENDLESS, stride=12, members=[member("count", 0, kind("uint", VarType.UInt)), member("lights", 4, kind("uint", VarType.UInt, elements=2, stride=4))])
SHADER = Row(
    constantBlocks=[Row(name="Frame", bufferBacked=True, variables=[member("view", 0, Row(**{**vars(kind("float4x4", VarType.Float, 4)), "rows": 4}))])],
    readOnlyResources=[Row(name="picture", isTexture=True), Row(name="Lights", isTexture=False, variableType=kind("Lights", VarType.Float, members=[member("lights", 0, LIGHT)]))],
    readWriteResources=[Row(name="Cells", isTexture=False, variableType=kind("Cells", VarType.UInt, members=[member("cells", 0, CELL)]))],
)


def used(index, resource, at, size):
    return Row(access=Row(index=index), descriptor=Row(resource=resource, byteOffset=at, byteSize=size))


class Pipeline:
    def GetShaderReflection(self, stage):
        return SHADER if stage == ShaderStage.Compute else None

    def GetConstantBlock(self, stage, index, element):
        return used(index, 1, 0, 64)

    def GetReadOnlyResources(self, stage, only_used=False):
        return [used(0, 99, 0, 0), used(1, 2, 32, 32)]  # the lights begin at byte 32

    def GetReadWriteResources(self, stage, only_used=False):
        return [used(0, 3, 0, 2**64 - 1)]

    def GetViewport(self, index):
        return Row(width=0.0, height=0.0)


class Controller:
    event = None

    def GetResources(self):
        return [Row(resourceId=number, name=name) for number, (name, _) in BUFFERS.items()]

    def GetBuffers(self):
        return [Row(resourceId=number, length=len(data)) for number, (_, data) in BUFFERS.items()]

    def GetStructuredFile(self):
        return None

    def GetRootActions(self):
        dispatch = Row(eventId=4, flags=ActionFlags.Dispatch, children=[], GetName=lambda structured: "vkCmdDispatch(1, 1, 1)")
        return [Row(eventId=2, flags=ActionFlags.NoFlags, children=[dispatch], GetName=lambda structured: "culling")]

    def SetFrameEvent(self, event, force):
        self.event = event

    def GetPipelineState(self):
        return Pipeline()

    def GetBufferData(self, resource, at, size):
        assert self.event == 4, "buffers are those after the event"
        data = BUFFERS[resource][1]
        return data[at : at + size]

    def Shutdown(self):
        pass


class CaptureFile:
    def OpenFile(self, path, kind_of_file, progress):
        with open(path, "rb") as file:
            return ResultCode.Succeeded if file.read(4) == b"RDOC" else ResultCode.FileCorrupted

    def LocalReplaySupport(self):
        return ReplaySupport.Supported

    def DriverName(self):
        return "Vulkan"

    def OpenCapture(self, options, progress):
        return ResultCode.Succeeded, Controller()

    def Shutdown(self):
        pass


def InitialiseReplay(environment, arguments):
    pass


def ShutdownReplay():
    pass


def OpenCaptureFile():
    return CaptureFile()
