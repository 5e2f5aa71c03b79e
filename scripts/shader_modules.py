"""What SPIR-V of src/gpu/shaders must be like, so that no driver changes a decision: used by tests/gpu/test_shaders.py and
scripts/shader_mutations.py. Wants spirv-dis and spirv-val (Debian: spirv-tools) and glslangValidator (glslang-tools)."""
import array
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHADERS = ROOT / "src" / "gpu" / "shaders"
VARIANTS = {"plain": [], "to_nearest": ["-DROUNDS_TO_NEAREST"]}  # as cmake/ClusterbenchGpu.cmake

# Shaders on whose arithmetic no list depends, by the beginning of their names.
DECIDE_NOTHING = {"read_": "they read lists that are made already; their lookup may be off by what tests/gpu/reading_lookup_test.cpp allows",
                  "probe_functions": "it finds out how far functions are off whose error is the driver's"}

# Results that are rounded: each driver may contract or reorder them unless NoContraction forbids it.
ROUNDED = {"OpFAdd", "OpFSub", "OpFMul", "OpVectorTimesScalar", "OpMatrixTimesScalar", "OpVectorTimesMatrix",
           "OpMatrixTimesVector", "OpMatrixTimesMatrix", "OpOuterProduct"}
# Results with an error, or an order of steps, that is the driver's.
INEXACT = {"OpDot", "OpFDiv", "OpFRem", "OpFMod", "OpDPdx", "OpDPdy", "OpFwidth"}
# Of GLSL.std.450 these alone: none of them rounds.
EXACT_FUNCTIONS = {"FAbs", "FSign", "Floor", "Ceil", "Trunc", "RoundEven", "FMin", "FMax", "FClamp", "NMin", "NMax", "NClamp",
                   "SAbs", "SSign", "SMin", "SMax", "SClamp", "UMin", "UMax", "UClamp", "FindILsb", "FindSMsb", "FindUMsb"}


def tool(*command):
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def compiled(shader, variant, target, options=()):
    """Compiles SHADER.comp of any folder, as the build does. Returns its complaint; "" if it compiled."""
    done = tool("glslangValidator", "-V", "--quiet", "--target-env", "vulkan1.2", *VARIANTS[variant], *options, "-o", target,
                shader)
    return "" if done.returncode == 0 else done.stdout.strip()


def words_of_header(header):
    """The words of a module in the header that the build embeds."""
    body = header.read_text().split("{", 1)[1].rsplit("}", 1)[0]
    return array.array("I", (int(word, 16) for word in re.findall(r"0x[0-9a-fA-F]+", body)))


def disassembled(module):
    done = tool("spirv-dis", "--no-color", "--raw-id", module)
    if done.returncode != 0:
        raise RuntimeError(done.stdout)
    return done.stdout


def written(words, folder, name):
    path = pathlib.Path(folder) / f"{name}.spv"
    path.write_bytes(words.tobytes())
    return path


def validity_faults(module):
    done = tool("spirv-val", "--target-env", "vulkan1.2", module)
    return [] if done.returncode == 0 else [f"spirv-val: {done.stdout.strip()}"]


def arithmetic_faults(text):
    """Of a disassembled module."""
    exact = set(re.findall(r"OpDecorate (%\w+) NoContraction", text))
    faults = []
    for result, operation, rest in re.findall(r"^\s*(%\w+) = (Op\w+) ?(.*)$", text, re.M):
        if operation in INEXACT:
            faults.append(f"{operation}: its error is the driver's; compare squares or products in its place")
        elif operation in ROUNDED and result not in exact:
            faults.append(f"{operation} {result} may be contracted: declare its result `precise`")
        elif operation == "OpExtInst":
            function = rest.split()[2]
            if function not in EXACT_FUNCTIONS:
                faults.append(f"{function}(): its error is the driver's")
    return faults


def memory_faults(text):
    """Bits that several invocations set in one word of shared memory or of a buffer need an atomic operation. Software drivers
    run the invocations of a group one after another, and hide that."""
    shared = set(re.findall(r"(%\w+) = OpVariable %\w+ (?:Workgroup|StorageBuffer)", text))
    for pointer, base in re.findall(r"(%\w+) = OpAccessChain %\w+ (%\w+)", text):
        if base in shared:
            shared.add(pointer)
    ors = set(re.findall(r"(%\w+) = OpBitwiseOr ", text))
    return [f"OpStore {pointer}: bits are set without atomicOr()" for pointer, value in re.findall(r"OpStore (%\w+) (%\w+)", text)
            if pointer in shared and value in ors]


def rounding_faults(text, variant):
    modes = {mode for mode in ("RoundingModeRTE", "SignedZeroInfNanPreserve")
             if re.search(rf"OpExecutionMode %\w+ {mode} 32", text) and f"OpCapability {mode}" in text}
    wanted = {"RoundingModeRTE", "SignedZeroInfNanPreserve"} if variant == "to_nearest" else set()
    return [] if modes == wanted else [f"asks for {sorted(modes)}, not for {sorted(wanted)}"]


def decides_nothing(shader):
    return any(shader.startswith(name) for name in DECIDE_NOTHING)


def faults_of(module, shader, variant):
    text = disassembled(module)
    faults = validity_faults(module) + rounding_faults(text, variant) + memory_faults(text)
    return faults if decides_nothing(shader) else faults + arithmetic_faults(text)

