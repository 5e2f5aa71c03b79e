#!/usr/bin/env python3
"""Does a build without optional libraries count the same? tests/test_minimal_counts.py PROGRAM MINIMAL_PROGRAM [--other-library]

Both run the same configurations without timing. Each case that both can measure must be the same JSON, and what the minimal
one cannot must stand under `skipped` with the library's name. --other-library: but for buffers.scratch_bytes, since vectors of
another standard library grow by other steps."""

import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "scenes"
RUNS = {
    "a level": [SCENES / "street.glb"],
    "patterns": [SCENES / "street.glb", "--filter", "(aabb|exact)(-fast)?/(packed|bitfield)$"],
    "presets": [SCENES / "street.glb", "--presets", "--set", "scenes.*.frames=2", "--set", "viewport=[480,270]"],
    "depth": [ROOT / "configs/depth.json", "--set", "scenes.*.frames=1", "--set", "viewport=[480,270]"],
    "two threads": [SCENES / "street.glb", "--threads", "2"],
}
FOREIGN = "this clusterbench was built without"


def result_of(program, arguments, folder):
    file = pathlib.Path(folder) / "result.json"
    subprocess.run([program, "run", "--no-timing", "-q", *arguments, "-o", file], check=True, stderr=subprocess.DEVNULL)
    return json.loads(file.read_text())


def without_sets(case, missing):
    """Samples of visible surfaces rank, so what is made of them goes, too, where one build has none."""
    return {key: value for key, value in case.items() if key not in missing}


def of_any_library(result):
    for case in result["cases"]:
        case["buffers"].pop("scratch_bytes", None)
    return result


def faults(name, full, minimal):
    cases = {case["id"]: case for case in full["cases"]}
    skipped = [entry for entry in minimal["skipped"] if FOREIGN in entry["reason"]]
    lacks_samples = any("samples" in entry["name"] for entry in skipped)
    missing = ("shading", "samples", "failures", "warnings", "eligible", "loses_lights", "cost", "depth_ranges") if lacks_samples else ()
    for case in minimal["cases"]:
        if without_sets(case, missing) != without_sets(cases.pop(case["id"], {}), missing):
            yield f"{name}: {case['name']} differs"
    if cases and not skipped:
        yield f"{name}: {len(cases)} cases are missing, and nothing says why"
    if [scene["sha256"] for scene in full["scenes"]] != [scene["sha256"] for scene in minimal["scenes"]]:
        yield f"{name}: the scenes have other hashes"


def main():
    program, minimal = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for name, arguments in RUNS.items():
            full, small = result_of(program, arguments, folder), result_of(minimal, arguments, folder)
            if "--other-library" in sys.argv[3:]:
                full, small = of_any_library(full), of_any_library(small)
            found += faults(name, full, small)
            print(f"{name}: {len(small['cases'])} of {len(full['cases'])} cases are measured by both")
    print("\n".join(found) if found else "all that both measure is the same")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
