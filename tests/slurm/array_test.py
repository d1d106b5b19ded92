#!/usr/bin/env python3
"""Tests Slurm job arrays on a real cluster of two nodes on the loopback interface.

An array of tasks renders the frames of a video, and one task is killed half-way and queued again. The frames must be
complete and bit-identical to a single run. So must a frame that is split by samples or by rows, as in
scripts/slurm/README.md, and merged.

    array_test.py PROGRAM BATCH_FILE

Exit code 77: skipped; the reason is printed.
"""

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

FRAMES = 24
TASKS = 4
SKIPPED = 77


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def reserved_ports(count):
    """Returns `count` sockets that each reserve a free port. Programs that set SO_REUSEADDR, such as Slurm's daemons,
    can still listen on the port; the system gives the port to no other program.
    """
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        each.bind(("127.0.0.1", 0))
    return sockets


def wait_until(what, condition, seconds=240):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError(f"after {seconds} s: {what}")


class Cluster:
    """A Slurm cluster in a temporary folder: munged, slurmctld and two slurmd."""

    def __init__(self, folder):
        self.folder = folder
        self.processes = []
        self.ports = []
        self.environment = os.environ | {"SLURM_CONF": str(folder / "slurm.conf")}

    def start(self):
        self.start_munge()
        self.ports = reserved_ports(3)  # the ports are reserved for the lifetime of the cluster
        controller, *nodes = [each.getsockname()[1] for each in self.ports]
        host = socket.gethostname().split(".")[0]
        cores = os.cpu_count() or 1
        text = f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={self.folder}/munge.socket,cred_expire=120
CredType=cred/munge
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
MessageTimeout=100
ReturnToService=2
KillWait=2
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.%n.pid
SlurmdSpoolDir={self.folder}/spool.%n
StateSaveLocation={self.folder}/state
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd.%n.log
SchedulerParameters=batch_sched_delay=0,sched_interval=1
MinJobAge=600
"""
        for name, port in zip(("one", "two"), nodes):
            text += f"NodeName={name} NodeAddr=127.0.0.1 NodeHostname={host} Port={port} CPUs={cores} State=UNKNOWN\n"
            (self.folder / f"spool.{name}").mkdir()
        text += "PartitionName=all Nodes=one,two Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO\n"
        (self.folder / "state").mkdir()
        (self.folder / "slurm.conf").write_text(text)
        self.run_daemon(["slurmctld", "-D", "-i", "-f", str(self.folder / "slurm.conf")])
        for name in ("one", "two"):
            self.run_daemon(["slurmd", "-D", "-N", name, "-f", str(self.folder / "slurm.conf")])
        wait_until("the nodes are not idle", lambda: (self.ask("sinfo", "-h", "-o", "%T") or "").split() == ["idle"])

    def start_munge(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        self.run_daemon(["munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.folder}/munge.socket",
                         f"--pid-file={self.folder}/munge.pid", f"--log-file={self.folder}/munge.log",
                         f"--seed-file={self.folder}/munge.seed", "--num-threads=2"])
        wait_until("munged has no socket", (self.folder / "munge.socket").exists)

    def run_daemon(self, words):
        log = open(self.folder / f"{words[0]}.out", "ab")
        self.processes.append(subprocess.Popen(words, env=self.environment, stdout=log, stderr=log))

    def ask(self, *words):
        """Returns the output of a Slurm command, or None if it fails, as it does while the controller is too busy to
        answer.
        """
        result = subprocess.run(words, env=self.environment, capture_output=True, text=True)
        return result.stdout if result.returncode == 0 else None

    def submit(self, *words):
        job = (self.ask("sbatch", "--parsable", *words) or "").strip()
        assert job, "the job array was refused"
        return job

    def wait_for_all(self):
        wait_until("the job didn't end", lambda: self.ask("squeue", "-h", "-o", "%i") == "")

    def stop(self):
        for process in reversed(self.processes):
            process.terminate()
        for process in reversed(self.processes):
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()


def frame_bytes(folder):
    """Returns the frames under their final names. Unfinished frames have names that begin with a dot and disappear when
    they are finished.
    """
    return {path.name: path.read_bytes() for path in sorted(folder.glob("[!.]*.exr"))}


def task_process(cluster, job, task):
    """Returns the process id of the program in an array task, or None if it does not run."""
    for status in Path("/proc").glob("[0-9]*/environ"):
        try:
            words = status.read_bytes().split(b"\0")
            name = (status.parent / "comm").read_text().strip()
        except OSError:
            continue
        wanted = {f"SLURM_ARRAY_JOB_ID={job}".encode(), f"SLURM_ARRAY_TASK_ID={task}".encode(),
                  f"SLURM_CONF={cluster.folder}/slurm.conf".encode()}
        if name == "defocus" and wanted <= set(words):
            return int(status.parent.name)
    return None


def share_film(cluster, program, batch, folder, samples):
    """Renders the frames of a video by an array of tasks. Kills one task after a frame and queues it again. Returns
    False if this task had already rendered all of its frames.
    """
    shot = {"fish": {"count": 4, "triangles": 4000}, "range": [0, FRAMES - 1], "size": [256, 192], "samples": samples,
            "focus": {"keys": [{"frame": 0, "distance": 1}, {"frame": FRAMES - 1, "distance": 4}]}}
    (folder / "shot.json").write_text(json.dumps(shot))
    full, frames = folder / f"single{samples}", folder / f"frames{samples}"
    subprocess.run([program, "capture", "shot.json", "--quiet", "-o", f"{full}/####.exr"], cwd=folder, check=True)
    job = cluster.submit(f"--array=0-{TASKS - 1}", f"--chdir={folder}", str(batch), "shot.json", "--quiet", "-o",
                         f"{frames}/####.exr")
    wait_until("task 1 has no frame", lambda: (frames / "0001.exr").exists())
    try:
        os.kill(task_process(cluster, job, 1), signal.SIGKILL)
    except (TypeError, ProcessLookupError):  # the process has already ended
        cluster.wait_for_all()
        return False
    done = len(frame_bytes(frames))
    facts = lambda: cluster.ask("scontrol", "show", "job", f"{job}_1") or ""
    wait_until("task 1 didn't end", lambda: "JobState=FAILED" in facts() or "JobState=COMPLETED" in facts())
    if set(range(1, FRAMES, TASKS)) <= {int(name[:4]) for name in frame_bytes(frames)}:
        cluster.wait_for_all()
        return False
    print(f"task 1 killed with {done} of {FRAMES} frames done")
    subprocess.run(["scontrol", "requeue", f"{job}_1"], env=cluster.environment, check=True)

    def ran_again():
        now = facts()
        # Slurm delays a requeued task by two minutes. Setting its start time avoids this, but may fail while the task
        # is ending.
        if "Reason=BeginTime" in now:
            cluster.ask("scontrol", "update", f"JobId={job}_1", "StartTime=now")
        return "Restarts=1" in now and "JobState=COMPLETED" in now

    wait_until("task 1 didn't run again", ran_again)
    cluster.wait_for_all()

    # The array's files are byte-identical to the files of the single run.
    single, array = frame_bytes(full), frame_bytes(frames)
    assert len(single) == FRAMES
    assert array.keys() == single.keys(), f"missing: {sorted(single.keys() - array.keys())}"
    assert array == single, "frames differ from those of a single run"
    left = [path.name for path in frames.iterdir() if path.name.startswith(".")]
    assert not left, f"left behind: {left}"
    print(f"{FRAMES} frames of {TASKS} tasks are those of a single run")
    return True


def share_frame(cluster, program, folder):
    """Renders one frame by arrays of four tasks, split by samples and by rows."""
    frame = ["render", "--quiet", "--fish", "4", "--fish-triangles", "4000", "--size", "256x192", "--samples", "256"]
    subprocess.run([program, *frame, "-o", "single.exr"], cwd=folder, check=True)
    tasks = {
        "part": "first=$((SLURM_ARRAY_TASK_ID * 64)); exec $DEFOCUS {line} --sample-range $first:$((first + 64)) "
                "-o part$SLURM_ARRAY_TASK_ID.exr",
        "tile": "exec $DEFOCUS {line} --tile $SLURM_ARRAY_TASK_ID/4 --resume -o tile$SLURM_ARRAY_TASK_ID.exr",
    }
    for name, task in tasks.items():
        files = [f"{name}{i}.exr" for i in range(4)]
        cluster.submit("--array=0-3", f"--chdir={folder}", f"--output={folder}/{name}-%a.log", "--wrap",
                       task.format(line=" ".join(frame)))
        cluster.wait_for_all()
        missing = [file for file in files if not (folder / file).exists()]
        assert not missing, f"missing: {missing}"
        subprocess.run([program, "merge", "--quiet", *files, "-o", f"{name}s.exr"], cwd=folder, check=True)
        difference = json.loads(subprocess.run([program, "compare", "--json", "single.exr", f"{name}s.exr"], cwd=folder,
                                               check=True, capture_output=True, text=True).stdout)
        assert difference["maxError"] == 0 and difference["psnr"] is None, f"the frame of {name}s differs from that of a single run: {difference}"
        print(f"a frame of four {name}s is that of a single run")


def main():
    program, batch = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    for needed in ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "sinfo", "squeue"):
        if shutil.which(needed) is None:
            skip(f"{needed} is not installed (Debian: slurm-wlm, munge)")
    if os.geteuid() != 0:
        skip("the daemons of a cluster are started by root only")

    folder = Path(tempfile.mkdtemp(prefix="defocus-slurm-", dir="/tmp"))
    cluster = Cluster(folder)
    try:
        os.environ["XDG_CACHE_HOME"] = str(folder / "cache")
        cluster.environment["XDG_CACHE_HOME"] = str(folder / "cache")
        cluster.environment["DEFOCUS"] = str(program)
        cluster.start()
        # A fast machine may finish the task before it is killed; the test then retries with more samples.
        assert any(share_film(cluster, program, batch, folder, samples) for samples in (64, 256, 1024)), "no task was killed in time"
        share_frame(cluster, program, folder)
    except BaseException:
        for log in sorted(folder.glob("*.log")) + sorted(folder.glob("*.out")):
            print(f"--- {log.name}\n{log.read_text(errors='replace')[-2000:]}")
        raise
    finally:
        cluster.stop()
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
