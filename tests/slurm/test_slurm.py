#!/usr/bin/env python3
"""scripts/slurm/ on a real Slurm: a controller and two nodes on the loopback interface, of the user that runs this, in a folder that goes
with them. A task is killed, a task is put back into the queue, and the controller is killed, while shards are measured; each time the
merged result has to be that of the undivided run, byte for byte. Exit code 77 with a sentence where Slurm is missing.

usage: test_slurm.py PROGRAM [--keep]"""

import getpass
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SHARDS = 4
DAEMONS = ("slurmctld", "slurmd", "sbatch", "scontrol", "squeue")
# Each shard has four grids, and takes some seconds.
CONFIGURATION = {
    "scenes": [{"path": str(ROOT / "scenes/hall-4096.glb"), "frames": 96}],
    "viewport": [1920, 1080],
    "grids": [{"kind": "frustum", "tiles": {"pixels": [[32, 32], [24, 24]]},
               "slices": {"count": [16, 20, 24, 28, 32, 36, 40, 44], "far": 300}}],
    "assigners": ["aabb-fast", "exact-fast"],
}
SETTINGS = """ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/none
CredType=cred/none
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_res
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=0
ReturnToService=2
KillWait=1
MessageTimeout=5
NodeName=node1 NodeHostname=localhost NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1 RealMemory=1000
NodeName=node2 NodeHostname=localhost NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1 RealMemory=1000
PartitionName=all Nodes=node1,node2 Default=YES MaxTime=INFINITE State=UP
"""


def until(is_done, what, seconds=90):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if is_done():
            return
        time.sleep(0.1)
    sys.exit(f"after {seconds} s still not: {what}")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """Two nodes with a processor each."""

    def __init__(self, folder):
        self.folder = folder
        self.processes = {}
        for name in ("state", "node1", "node2"):
            (folder / name).mkdir()
        configuration = folder / "slurm.conf"
        configuration.write_text(SETTINGS.format(folder=folder, user=getpass.getuser(), ports=free_ports(3)), encoding="utf-8")
        self.environment = dict(os.environ, SLURM_CONF=str(configuration))
        for name in [name for name in self.environment if name.startswith(("SLURM_", "SBATCH_")) and name != "SLURM_CONF"]:
            del self.environment[name]

    def start(self, name, *command):
        with open(self.folder / f"{name}.out", "ab") as out:
            self.processes[name] = subprocess.Popen(command, env=self.environment, stdout=out, stderr=out, start_new_session=True)

    def start_controller(self):
        self.start("slurmctld", "slurmctld", "-D")

    def __enter__(self):
        self.start_controller()
        for node in ("node1", "node2"):
            self.start(node, "slurmd", "-D", "-N", node)
        until(lambda: self.ask("sinfo", "-h", "-t", "idle", "-o", "%D").strip() == "2", f"two idle nodes; logs are in {self.folder}")
        return self

    def __exit__(self, *_):
        for process in self.processes.values():
            process.kill()
            process.wait()

    def kill_controller(self):
        """Once it has written its jobs to the disk, which it does some seconds after they came."""
        began, jobs = time.time(), self.folder / "state" / "job_state"
        until(lambda: jobs.exists() and jobs.stat().st_mtime > began, "the controller's jobs are on the disk", 30)
        self.processes["slurmctld"].kill()
        self.processes["slurmctld"].wait()

    def ask(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False, timeout=60).stdout

    def submit(self, program, *arguments):
        done = subprocess.run([ROOT / "scripts/slurm/submit", *arguments], env=dict(self.environment, CLUSTERBENCH=str(program)),
                              cwd=self.folder, capture_output=True, text=True, check=False, timeout=60)
        if done.returncode != 0:
            sys.exit(f"submit {arguments}: {done.returncode}\n{done.stderr}")
        return done.stdout.strip().splitlines()[-1]

    def wait_for(self, job):
        """A controller that was away when a task ended may hear of it only as it next asks the nodes: every 100 s."""
        until(lambda: self.ask("scontrol", "show", "job", job).find("JobState=COMPLETED") >= 0
              or self.ask("scontrol", "show", "job", job).find("JobState=FAILED") >= 0, f"the end of job {job}", 240)


def finished_cases(folder, index):
    journal = folder / f"shard-{index}.json.partial"
    try:
        return sum(line.startswith('{"case"') for line in journal.read_text(encoding="utf-8").splitlines())
    except OSError:
        return 0


def process_of(folder, index):
    """The clusterbench that measures the shard."""
    wanted = str(folder / f"shard-{index}.json").encode()
    for place in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = place.read_bytes().split(b"\0")
        except OSError:
            continue
        if wanted in words and b"--shard" in words:
            return int(place.parent.name)
    return None


def wait_until_begun(folder, index):
    until(lambda: finished_cases(folder, index) > 0 and process_of(folder, index), f"a finished case of shard {index}")


def expect(holds, what):
    if not holds:
        sys.exit(f"FAILED: {what}")


def check_result(folder, whole):
    expect((folder / "result.json").read_bytes() == whole, f"{folder}/result.json is the undivided run's")
    ids = [one["id"] for index in range(1, SHARDS + 1) for one in json.loads((folder / f"shard-{index}.json").read_bytes())["cases"]]
    expect(len(ids) == len(set(ids)), "no case was measured by two shards")
    expect(not list(folder.glob("*.partial")), "no journal is left")


def killed_task(cluster, program, folder, arguments, whole):
    """Its task fails, the merge says that its shard is missing, and submit --again goes on with what it had finished."""
    job = cluster.submit(program, str(SHARDS), folder, *arguments)
    wait_until_begun(folder, 2)
    os.kill(process_of(folder, 2), signal.SIGKILL)
    cluster.wait_for(job)
    said = (folder / "merge.log").read_text(encoding="utf-8")
    expect(f"shard 2 of {SHARDS} is missing" in said, f"the merge names the missing shard, and not: {said}")
    expect(not (folder / "result.json").exists(), "no result without all shards")
    kept = finished_cases(folder, 2)
    expect(kept > 0, "the killed task left its finished cases")
    cluster.wait_for(cluster.submit(program, "--again", folder))
    check_result(folder, whole)
    return f"a killed task: {kept} finished cases were kept"


def requeued_task(cluster, program, folder, arguments, whole):
    """Slurm ends the task, and starts it again."""
    job = cluster.submit(program, str(SHARDS), folder, *arguments)
    wait_until_begun(folder, 1)
    array = cluster.ask("squeue", "-h", "-r", "-t", "running", "-o", "%i %K %A").splitlines()
    number = next(line.split()[2] for line in array if line.split()[1] == "1")
    cluster.ask("scontrol", "requeue", number)
    until(lambda: "JobState=PENDING" in cluster.ask("scontrol", "show", "job", number), "the task is back in the queue")
    cluster.ask("scontrol", "update", f"JobId={number}", "StartTime=now")  # Slurm would wait two minutes
    cluster.wait_for(job)
    restarts = cluster.ask("scontrol", "show", "job", number)
    expect("Restarts=1" in restarts, f"the task was started again: {restarts}")
    check_result(folder, whole)
    return "a requeued task: started again, and went on"


def killed_controller(cluster, program, folder, arguments, whole):
    """Tasks go on without it, and what waits is started once it is back."""
    job = cluster.submit(program, str(SHARDS), folder, *arguments)
    wait_until_begun(folder, 1)
    cluster.kill_controller()
    time.sleep(1)
    cluster.start_controller()
    until(lambda: job in cluster.ask("squeue", "-h", "-o", "%i"), "the controller is back, and knows the merge")
    cluster.wait_for(job)
    check_result(folder, whole)
    return "a killed controller: all tasks ended, and the merge ran"


def submitted(folder, *arguments, sbatch="echo 7", squeue="true"):
    """Exit code and words of `submit`, with stand-ins for Slurm's programs."""
    programs = folder / "programs"
    programs.mkdir(exist_ok=True)
    for name, script in (("sbatch", sbatch), ("squeue", squeue)):
        (programs / name).write_text(f"#!/bin/bash\n{script}\n", encoding="utf-8")
        (programs / name).chmod(0o755)
    done = subprocess.run([ROOT / "scripts/slurm/submit", *arguments], cwd=folder, env=dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}"),
                          capture_output=True, text=True, check=False, timeout=60)
    return done.returncode, done.stdout + done.stderr


def refusals(folder):
    """What `submit` refuses before Slurm has anything to do, and what it leaves then."""
    def expect_refused(part, *arguments, **programs):
        code, said = submitted(folder, *arguments, **programs)
        expect(code == 2 and part in said, f"submit {arguments} is refused with '{part}', and not: {code} {said}")

    for flag in ("-o", "-ofile", "--output=x", "--shard", "--shard=1/2"):
        expect_refused(f"'{flag}' is not for ARGUMENTS", "2", "new", "level.glb", flag)
    expect_refused("has a %", "2", "100%", "level.glb")
    expect_refused("sbatch took no task", "2", "new", "level.glb", sbatch="exit 1")
    expect(not (folder / "new").exists(), "a folder that was made for nothing is gone")
    (folder / "old").mkdir()
    expect_refused("sbatch took no task", "2", "old", "level.glb", sbatch="exit 1")
    expect((folder / "old").exists() and not list((folder / "old").iterdir()), "a folder of the user's stays, as it was")
    expect_refused("did not take the merge, and took the tasks (job 7)", "2", "half", "level.glb",
                   sbatch="case $* in *-merge*) exit 1 ;; *) echo 7 ;; esac")
    expect(submitted(folder, "2", "run", "level.glb")[0] == 0, "a run is submitted")
    expect_refused("tasks of job 7 are still waiting or running", "--again", "run", squeue="echo 7_1")
    expect_refused("squeue does not say whether job 7 has ended: no controller", "--again", "run", squeue="echo no controller; exit 1")
    (folder / "run/shard-1.json").write_text("{}", encoding="utf-8")
    (folder / "run/shard-2.json").write_text("", encoding="utf-8")
    code, said = submitted(folder, "--again", "run", sbatch='echo "$*" >&2; echo 8', squeue="echo Invalid job id specified; exit 1")
    expect(code == 0 and "--array=2 " in said, f"an empty file is a missing shard: {code} {said}")


def main():
    with tempfile.TemporaryDirectory() as place:
        refusals(pathlib.Path(place))
    print("submit: refuses what cannot go well", flush=True)
    missing = [name for name in DAEMONS if shutil.which(name) is None and not pathlib.Path("/usr/sbin", name).exists()]
    if missing:
        print(f"skipped: {', '.join(missing)} not found (Debian: slurmctld slurmd slurm-client)")
        sys.exit(77)
    os.environ["PATH"] += ":/usr/sbin"
    program = pathlib.Path(sys.argv[1]).resolve()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="clusterbench-slurm."))
    (folder / "sweep.json").write_text(json.dumps(CONFIGURATION), encoding="utf-8")
    arguments = ["sweep.json", "--no-timing"]
    subprocess.run([program, "run", *arguments, "-q", "-o", "whole.json"], cwd=folder, check=True)
    whole = (folder / "whole.json").read_bytes()
    try:
        with Cluster(folder) as cluster:
            for name, check in (("kill", killed_task), ("requeue", requeued_task), ("controller", killed_controller)):
                begin = time.monotonic()
                print(check(cluster, program, folder / name, arguments, whole) + f" ({time.monotonic() - begin:.1f} s)", flush=True)
    finally:
        if "--keep" not in sys.argv:
            shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
