"""Run the pipeline on a real Slurm that this program installs and starts on this machine.

    python tests/tools/single_node_slurm.py [--keep FOLDER] [target ...]

Needs root on Debian or Ubuntu; elsewhere it says why it does nothing and ends with code 77. Slurm
comes from the Debian packages, the executor from Python's package index into a folder of its
own: where it is installed, each start of snakemake waits for a Slurm. The quick configuration is
used; without targets, everything is made. The exit code is 0 when all results are there and
each job of the pipeline ran through Slurm.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIPPED = 77
PACKAGES = ("slurm-wlm", "munge")
PLUGINS = (
    "snakemake-executor-plugin-slurm==2.8.0",
    "snakemake-executor-plugin-slurm-jobstep==0.6.1",
)
CONFIGURATION = Path("/etc/slurm/slurm.conf")  # elsewhere the executor's commands miss it
MARK = "# written by tests/tools/single_node_slurm.py\n"
TEMPLATE = """\
ClusterName=single
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc={folder}/completed.txt
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SlurmdParameters=config_overrides
MinJobAge=300
ReturnToService=2
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={memory} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


class Impossible(Exception):
    """Why there can be no Slurm here."""


def main(arguments: list[str]) -> int:
    """Run the pipeline through Slurm and judge it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--keep", type=Path, help="working folder, which stays")
    parser.add_argument("targets", nargs="*", help="files to make; else all")
    options = parser.parse_args(arguments)
    try:
        install()
    except Impossible as reason:
        print(f"no Slurm: {reason}")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        plugins = install_plugins(Path(folder) / "plugins")
        work = (options.keep or Path(folder) / "work").resolve()
        with slurm(Path(folder)):
            code, output = run_pipeline(work, plugins, options.targets)
            completed = completed_jobs(Path(folder))
    return judge(code, output, completed)


def install() -> None:
    """Install Slurm's packages where they are missing."""
    if os.geteuid() != 0:
        raise Impossible("only root can start it")
    if CONFIGURATION.exists() and not CONFIGURATION.read_text().startswith(MARK):
        raise Impossible(f"{CONFIGURATION} belongs to another Slurm")
    if all(shutil.which(name) for name in ("slurmctld", "slurmd", "munged")):
        return
    if shutil.which("apt-get") is None:
        raise Impossible("there is no apt-get")
    apt = ["apt-get", "-qq", "-y", "--no-install-recommends"]
    environment = os.environ | {"DEBIAN_FRONTEND": "noninteractive"}
    for command in (["apt-get", "-qq", "update"], [*apt, "install", *PACKAGES]):
        if subprocess.run(command, env=environment, stdout=subprocess.DEVNULL).returncode:
            raise Impossible(f"{' '.join(command)} failed")


def install_plugins(folder: Path) -> Path:
    """Install the executor beside the environment; what it needs is in there already."""
    program = [sys.executable, "-m", "uv", "pip", "install", "--quiet", "--no-deps"]
    subprocess.run([*program, "--target", folder, *PLUGINS], check=True)
    return folder


@contextlib.contextmanager
def slurm(folder: Path) -> Iterator[None]:
    """Start munged, slurmctld and slurmd; end those that were started."""
    host = os.uname().nodename.partition(".")[0]
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2**20 // 2
    for name in ("state", "spool"):
        (folder / name).mkdir()
    CONFIGURATION.parent.mkdir(exist_ok=True)
    CONFIGURATION.write_text(
        MARK + TEMPLATE.format(host=host, folder=folder, cpus=os.cpu_count(), memory=memory)
    )
    started = [*start_munge(), *(start([name, "-D"]) for name in ("slurmctld", "slurmd"))]
    try:
        wait_until_idle(folder)
        yield
    finally:
        for process in reversed(started):
            process.terminate()
            process.wait(30)
        CONFIGURATION.unlink()


def start_munge() -> list[subprocess.Popen]:
    """Start munged, unless it runs."""
    if subprocess.run(["munge", "-n"], capture_output=True).returncode == 0:
        return []
    runtime = Path("/run/munge")
    runtime.mkdir(mode=0o755, exist_ok=True)
    shutil.chown(runtime, "munge", "munge")
    return [start(["runuser", "-u", "munge", "--", "munged", "--foreground"])]


def start(program: list[str]) -> subprocess.Popen:
    """Start a program in the background."""
    return subprocess.Popen(program, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def wait_until_idle(folder: Path, seconds: float = 60.0) -> None:
    """Wait until the node takes jobs."""
    end = time.monotonic() + seconds
    while subprocess.run(["sinfo", "-h", "-o", "%t"], capture_output=True).stdout != b"idle\n":
        if time.monotonic() > end:
            logs = "".join(path.read_text() for path in folder.glob("slurm*.log"))
            raise RuntimeError(f"Slurm did not start:\n{logs}")
        time.sleep(0.2)


def run_pipeline(work: Path, plugins: Path, targets: list[str]) -> tuple[int, str]:
    """Run snakemake with the profile for Slurm; its output is shown and returned."""
    work.mkdir(parents=True, exist_ok=True)
    paths = [str(plugins), str(ROOT / "src"), os.environ.get("PYTHONPATH", "")]
    program = [sys.executable, "-m", "snakemake", "--snakefile", ROOT / "Snakefile"]
    options = ["--profile", ROOT / "profiles/slurm", "--directory", work]
    status = ["--slurm-status-command", "squeue", "--seconds-between-status-checks", "5"]
    with subprocess.Popen(
        [*program, *options, *status, *targets, "--configfile", ROOT / "config/quick.yaml"],
        cwd=ROOT,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, paths))},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as run:
        lines = []
        for line in run.stdout:
            print(line, end="", flush=True)
            lines.append(line)
    return run.returncode, "".join(lines)


def completed_jobs(folder: Path) -> list[str]:
    """Return how each job of Slurm ended."""
    text = (folder / "completed.txt").read_text() if (folder / "completed.txt").exists() else ""
    return re.findall(r"JobState=(\w+)", text)


def judge(code: int, output: str, completed: list[str]) -> int:
    """Say how many jobs ran through Slurm; 0 where these were all, and all ended well."""
    total = re.search(r"^total +(\d+)$", output, re.MULTILINE)
    targets = len(re.findall(r"^all +1$", output, re.MULTILINE))  # no job: it has no script
    planned = int(total[1]) - targets if total else 0
    finished = set(re.findall(r"^Finished jobid: (\d+) \(Rule: (?!all\b)", output, re.MULTILINE))
    states = {state: completed.count(state) for state in sorted(set(completed))}
    done = len(finished)
    print(f"{done} of {planned} jobs of the pipeline in {len(completed)} jobs of Slurm: {states}")
    return 0 if code == 0 and done == planned and set(states) == {"COMPLETED"} else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
