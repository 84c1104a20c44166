"""Faults around the pipeline: disks, memory, clocks, locks, files and names of others."""

import json
import os
import re
import resource
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tramdva import results

QUICK = ("--configfile", "config/quick.yaml")
MAP = "results/paper/stability_map.nc"
HOPF = "results/paper/hopf_points.nc"
FIGURE = "paper_figures/paper/fig08_bogie.png"


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of 1 MB."""
    if os.geteuid() != 0:
        pytest.skip("only root can mount a small disk")
    folder = tmp_path / "disk"
    folder.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", folder])
    if mounted.returncode:
        pytest.skip("a small disk cannot be mounted here")
    yield folder
    subprocess.run(["umount", folder], check=True)


def fill(disk: Path, left: int) -> Path:
    """Fill a disk up to some bytes."""
    filler = disk / "filler"
    filler.write_bytes(bytes(shutil.disk_usage(disk).free - left))
    return filler


@pytest.mark.slow
def test_full_disk_is_told_and_survived(disk: Path, snakemake) -> None:
    filler = fill(disk, 60_000)
    assert snakemake(disk, "-n", MAP, *QUICK).stderr.endswith(f"{disk}: the disk is full\n")
    filler.unlink()
    filler = fill(disk, 270_000)
    ended = snakemake(disk, MAP, *QUICK)
    assert ended.returncode == 1
    assert f"OSError: {MAP}: cannot be written, disk full?" in ended.stderr
    assert not (disk / MAP).exists()
    filler.unlink()

    ended = snakemake(disk, MAP, *QUICK)

    assert ended.returncode == 0, ended.stderr
    assert [path.name for path in (disk / "results/paper").iterdir()] == ["stability_map.nc"]


@pytest.mark.slow
def test_read_only_folders_are_told(disk: Path, snakemake) -> None:
    assert snakemake(disk, MAP, *QUICK).returncode == 0
    before = (disk / MAP).read_bytes()
    subprocess.run(["mount", "--bind", disk / "results", disk / "results"], check=True)
    subprocess.run(["mount", "-o", "remount,bind,ro", disk / "results"], check=True)
    part = snakemake(disk, HOPF, *QUICK)
    subprocess.run(["umount", disk / "results"], check=True)
    subprocess.run(["mount", "-o", "remount,ro", disk], check=True)
    whole = snakemake(disk, MAP, *QUICK, "--forceall")

    for ended, folder in ((part, disk / "results"), (whole, disk)):
        assert ended.returncode == 1
        assert "Traceback" not in ended.stdout + ended.stderr
        assert f"{folder}: cannot be written" in ended.stderr
    assert (disk / MAP).read_bytes() == before


@pytest.mark.slow
def test_job_beyond_its_memory(tmp_path: Path, snakemake) -> None:
    large = tmp_path / "large.yaml"
    large.write_text("numerics: {stability_map: {points: 3001}}\n")
    unlimited = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (1_500_000_000, unlimited[1]))
    try:
        ended = snakemake(tmp_path, MAP, *QUICK, str(large))
    finally:
        resource.setrlimit(resource.RLIMIT_AS, unlimited)

    assert ended.returncode == 1
    assert "MemoryError: Unable to allocate" in ended.stderr
    assert f"(see logs/paper/{Path(MAP).stem}.log)" in ended.stderr
    assert snakemake(tmp_path, MAP, *QUICK).returncode == 0


@pytest.mark.slow
def test_clock_that_was_put_back(tmp_path: Path, snakemake) -> None:
    """What follows from a new file is made again though it was later than the file."""
    assert snakemake(tmp_path, HOPF, *QUICK).returncode == 0
    for path in [*tmp_path.glob("results/*/*.nc"), *tmp_path.glob("logs/*/*")]:
        put_forward(tmp_path, path, 86400.0)
    other = tmp_path / "other.yaml"
    other.write_text("numerics: {stability_map: {points: 31}}\n")

    interrupted = snakemake(tmp_path, MAP, *QUICK, str(other))
    plan = snakemake(tmp_path, "-n", HOPF, *QUICK, str(other))

    assert interrupted.returncode == 0
    assert "the clock was put back: files are taken back" in interrupted.stderr
    assert dict(re.findall(r"^(\w+) +(\d+)$", plan.stdout, re.MULTILINE)) == {
        "hopf_points": "1",
        "total": "1",
    }


def put_forward(folder: Path, path: Path, seconds: float) -> None:
    """Let a file and, of a result, Snakemake's record of it be of a later date."""
    date = path.stat().st_mtime + seconds
    os.utime(path, (date, date))
    if path.suffix != ".nc":
        return
    for record in (folder / ".snakemake/metadata").iterdir():
        content = json.loads(record.read_text())
        if content["rule"] == path.stem:
            record.write_text(json.dumps(content | {"endtime": path.stat().st_mtime}))


@pytest.mark.slow
def test_truncated_and_foreign_files_are_made_again(tmp_path: Path, snakemake) -> None:
    assert snakemake(tmp_path, HOPF, *QUICK).returncode == 0
    whole = {name: (tmp_path / name).read_bytes() for name in (MAP, HOPF)}
    os.truncate(tmp_path / MAP, 1000)
    (tmp_path / HOPF).write_text("wheel")

    ended = snakemake(tmp_path, HOPF, *QUICK)

    assert ended.returncode == 0, ended.stderr
    for name in whole:
        assert f"{name}: is no complete netCDF file" in ended.stderr
        assert (tmp_path / name).read_bytes() == whole[name]
        results.read(tmp_path / name)


def test_second_run_is_refused_and_the_first_goes_on(
    tmp_path: Path, snakemake, frozen_code: Path
) -> None:
    slow = tmp_path / "slow.yaml"
    slow.write_text("numerics: {stability_map: {points: 151}}\n")
    first = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "snakemake",
            "-j1",
            "--directory",
            tmp_path,
            MAP,
            "--configfile",
            slow,
        ],
        cwd=frozen_code,
        env=os.environ | {"PYTHONPATH": str(frozen_code / "src")},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    while not (tmp_path / "logs/paper/stability_map.log").exists():
        assert first.poll() is None

    second = snakemake(tmp_path, MAP, *QUICK)

    assert second.returncode == 1
    assert f"tramdva: another run works in {tmp_path} (process {first.pid} on" in second.stderr
    assert "Directory cannot be locked" in second.stderr
    assert first.wait() == 0
    assert results.read_parameters(tmp_path / MAP)["numerics"]["points"] == 151


def test_words_of_the_configuration_are_never_commands(tmp_path: Path, snakemake, root) -> None:
    folder = tmp_path / "a 'quoted' $(touch folder) `touch tick` {line} & ü"
    shutil.copytree(root / "config", folder / "config")
    label = "$(touch a) `touch b` {line} {wildcards.x} %s $x$ \\frac \"'; touch c; #<b>&"
    line = (
        "label: "
        + json.dumps(label)
        + "\nabsorber_variants:\n  - "
        + json.dumps({"name": "touch_d", "label": label, "c_T": 4e7, "d_T": 7500})
    )
    (folder / "config/lines/odd-_-name.yaml").write_text(line)

    names = [name.replace("/paper/", "/odd-_-name/") for name in (MAP, FIGURE)]
    ended = snakemake(folder, *names, *QUICK, "--config", "lines=[odd-_-name]")

    assert ended.returncode == 0, ended.stderr
    assert {path.name for path in folder.iterdir()} <= {
        ".snakemake", "config", "logs", "results", "paper_figures",
    }  # fmt: skip
    assert [path.name for path in tmp_path.iterdir()] == [folder.name]


def test_no_rule_runs_a_shell(root: Path) -> None:
    rules = list(root.glob("workflow/rules/*.smk"))
    texts = [
        p.read_text(encoding="utf-8")
        for p in (*rules, root / "Snakefile", root / "workflow/Snakefile")
    ]

    assert sum("script:" in text for text in texts) == 3  # stages, jobs, figures
    # `check` prints files by names that are quoted and hold no wildcard of a file.
    shells = [words for text in texts for words in re.findall(r"shell:\s+(.*)", text)]
    assert shells == ['"{params.python:q} -m tramdva.report.preflight {input:q} 2> {log:q}"']
    assert not [text for text in texts if "    run:" in text]
