#!/usr/bin/env python3
"""Runs the recipes of docs/several-machines.md as their services would, and compares what they merge with the undivided run: GitHub's
matrix and GitLab's `parallel` always, GNU parallel and Snakemake where they are installed.

usage: test_several_machines.py PROGRAM"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import yaml
except ImportError:
    print("skipped: Python's yaml is missing (Debian: python3-yaml)")
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parent.parent
TEXT = (ROOT / "docs/several-machines.md").read_text(encoding="utf-8")
CONFIGURATION = {
    "scenes": [{"path": "../level.glb", "frames": 2}],
    "viewport": [320, 180],
    "grids": [{"tiles": {"pixels": [[64, 64], [32, 32]]}, "slices": {"count": [8, 16], "far": 100}}],
    "assigners": ["aabb", "exact"],
}


def shell(script, folder, **variables):
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder, env={**os.environ, **variables},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"exit code {done.returncode} of\n{script}\n{done.stdout}")


def yaml_recipe(job):
    blocks = [yaml.safe_load(block) for block in re.findall(r"^```yaml\n(.*?)^```", TEXT, re.DOTALL | re.MULTILINE)]
    return next(block for block in blocks if job in block)


def commands_of(steps, values):
    """The commands of a job of GitHub, with its expressions replaced."""
    for step in steps:
        if "run" in step:
            yield re.sub(r"\$\{\{ *([\w.-]+) *\}\}", lambda found: str(values[found[1]]), step["run"])


def github(folder):
    jobs = yaml_recipe("jobs")["jobs"]
    shards = jobs["measure"]["strategy"]["matrix"]["shard"]
    for shard in shards:
        for command in commands_of(jobs["measure"]["steps"], {"matrix.shard": shard, "strategy.job-total": len(shards)}):
            shell(command, folder)
    for command in commands_of(jobs["merge"]["steps"], {}):
        shell(command, folder)


def gitlab(folder):
    jobs = yaml_recipe("measure")
    shards = jobs["measure"]["parallel"]
    for index in range(1, shards + 1):
        shell("\n".join(jobs["measure"]["script"]), folder, CI_NODE_INDEX=str(index), CI_NODE_TOTAL=str(shards))
    shell("\n".join(jobs["merge"]["script"]), folder)


def gnu_parallel(folder):
    section = TEXT.split("\n## GNU parallel\n")[1].split("\n## ")[0]
    script = "\n".join(line[4:] for line in section.splitlines() if line.startswith("    "))
    shell(script.replace("--sshlogin node1,node2 --workdir . ", ""), folder)


def snakemake(folder):
    (folder / "Snakefile").write_text(re.search(r"^```snakemake\n(.*?)^```", TEXT, re.DOTALL | re.MULTILINE)[1], encoding="utf-8")
    shell("snakemake --cores 2 --quiet", folder)


def check(name, recipe, undivided):
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        (folder / "ci").mkdir()
        (folder / "ci/lights.json").write_text(json.dumps(CONFIGURATION), encoding="utf-8")
        shutil.copy(ROOT / "scenes/mirror.glb", folder / "level.glb")
        recipe(folder)
        shell(f"clusterbench run {undivided} --no-timing -q -o whole.json", folder)
        if (folder / "result.json").read_bytes() != (folder / "whole.json").read_bytes():
            sys.exit(f"FAILED: {name}: the merged result is not the undivided run's")
    print(f"{name}: as the undivided run", flush=True)


def is_of_array_job(variable):
    return variable.startswith(("CI_NODE", "SLURM_ARRAY", "SGE_TASK", "AWS_BATCH")) or variable == "JOB_COMPLETION_INDEX"


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    os.environ["PATH"] = f"{program.parent}:{os.environ['PATH']}"
    for variable in filter(is_of_array_job, list(os.environ)):
        del os.environ[variable]
    check("GitHub", github, "ci/lights.json --fail-if 'longest > 1000'")
    check("GitLab", gitlab, "ci/lights.json --fail-if 'longest > 1000'")
    for name, recipe, command in (("GNU parallel", gnu_parallel, "parallel"), ("Snakemake", snakemake, "snakemake")):
        if shutil.which(command) is None:
            print(f"{name}: skipped, {command} is not installed")
        else:
            check(name, recipe, "level.glb")


if __name__ == "__main__":
    main()
