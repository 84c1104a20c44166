"""What a crate says of a run is true, and a run that is not whole gets none."""

import gzip
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from conftest import copy_code

from tramdva import results
from tramdva.record import archive, crate, run_record

QUICK = ("--configfile", "config/quick.yaml")
BESIDE_CODE = ("CITATION.cff", "LICENSE", "README.md", "pyproject.toml", "requirements.lock")
FIGURE = "paper_figures/paper/fig03_bifurcation_diagram.png"
ABROAD = {"https://w3id.org/ro/crate/1.1", "https://snakemake.github.io"}
ABROAD |= {"http://schema.org/CompletedActionStatus"}


@pytest.fixture(scope="module")
def checkout(quick_run: Path, root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Sources with the complete quick run in their folder; no git."""
    folder = copy_code(root, tmp_path_factory.mktemp("crate") / "checkout")
    for name in BESIDE_CODE:
        shutil.copy2(root / name, folder)
    for name in ("results", "paper_figures", "logs", ".snakemake"):
        shutil.copytree(quick_run / name, folder / name, dirs_exist_ok=True)
    return folder


@pytest.fixture
def here(checkout: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The checkout, which is the working directory as well."""
    monkeypatch.chdir(checkout)
    monkeypatch.setenv("PYTHONPATH", str(checkout / "src"))
    return checkout


@pytest.fixture(scope="module")
def described(checkout: Path) -> list[dict]:
    """Entities of the crate of the run, made by the command."""
    ended = command(checkout, "tramdva.record.crate")
    assert ended.returncode == 0, ended.stderr
    assert re.search(r"describes \d+ files of the run", ended.stdout)
    return json.loads((checkout / crate.NAME).read_text())["@graph"]


def command(folder: Path, module: str) -> subprocess.CompletedProcess:
    return subprocess.run(
        [sys.executable, "-m", module, *QUICK],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(folder / "src")},
        capture_output=True,
        text=True,
    )


@contextmanager
def replaced(path: Path, content: bytes | None, keep_date: bool = False) -> Iterator[None]:
    """Give a file other bytes, or none, for a while."""
    stat, before = path.stat(), path.read_bytes()
    path.unlink()
    try:
        if content is not None:
            path.write_bytes(content)
        if keep_date:
            os.utime(path, ns=(stat.st_atime_ns, stat.st_mtime_ns))
        yield
    finally:
        path.write_bytes(before)
        os.utime(path, ns=(stat.st_atime_ns, stat.st_mtime_ns))


def of_type(entities: list[dict], kind: str) -> list[dict]:
    return [
        e for e in entities if kind in ([e["@type"]] if isinstance(e["@type"], str) else e["@type"])
    ]


def ids(value: dict | list[dict]) -> list[str]:
    return [entry["@id"] for entry in (value if isinstance(value, list) else [value])]


def references(tree: object) -> Iterator[str]:
    if isinstance(tree, dict) and set(tree) == {"@id"}:
        yield tree["@id"]
    elif isinstance(tree, dict | list):
        for branch in tree.values() if isinstance(tree, dict) else tree:
            yield from references(branch)


def test_every_reference_leads_to_one_entity(described: list[dict]) -> None:
    names = [entity["@id"] for entity in described]

    assert len(names) == len(set(names))
    assert set(references(described)) - set(names) == ABROAD


def test_every_file_is_there_with_its_size_and_checksum(
    described: list[dict], checkout: Path
) -> None:
    files = of_type(described, "File")
    for entity in files:
        content = (checkout / entity["@id"]).read_bytes()
        assert entity["sha256"] == hashlib.sha256(content).hexdigest(), entity["@id"]
        assert entity["contentSize"] == str(len(content))
    root_part = next(entity for entity in described if entity["@id"] == "./")
    assert set(ids(root_part["hasPart"])) == {entity["@id"] for entity in files}


def test_every_result_and_figure_is_there(described: list[dict], quick_run: Path) -> None:
    names = {entity["@id"] for entity in of_type(described, "File")}
    for folder in ("results", "paper_figures"):
        for path in (quick_run / folder).rglob("*.*"):
            assert path.relative_to(quick_run).as_posix() in names


def test_every_figure_tells_script_inputs_and_values(described: list[dict]) -> None:
    made_by = {
        name: job
        for job in of_type(described, "CreateAction")
        for name in ids(job["result"])
        if job["@id"] != "#run"
    }
    entity = {e["@id"]: e for e in described}
    figures = [name for name in made_by if name.startswith("paper_figures/")]
    for name in figures:
        job = made_by[name]
        assert ids(job["instrument"]) == [f"paper_figures/{Path(name).stem}.py"]
        read = [i for i in ids(job["object"]) if i.startswith("results/")]
        assert read or "fig08" in name  # the sketch of the bogie shows the configuration
        assert all(i in made_by for i in read)
        values = [entity[i] for i in ids(job["object"]) if i.startswith("#value-")]
        assert "hash of the code" in {value["name"] for value in values}
        assert job["startTime"] < job["endTime"]
    assert len(figures) >= 34


def test_values_are_those_of_the_result_files(described: list[dict], checkout: Path) -> None:
    entity = {e["@id"]: e for e in described}
    checked = []
    for job in of_type(described, "CreateAction"):
        if job["@id"].startswith("#job/results/"):
            stamps = results.read_stamps(checkout / ids(job["result"])[0])
            values = {
                entity[i]["name"]: entity[i]["value"]
                for i in ids(job["object"])
                if i.startswith("#value-")
            }
            assert values["hash of the code"] == stamps["code_hash"]
            assert json.loads(values["values of the configuration"]) == json.loads(
                stamps["parameters"]
            )
            checked += ids(job["result"])
    assert len(checked) == len(list((checkout / "results").rglob("*.nc")))


def test_versions_commit_and_authors_are_told(described: list[dict]) -> None:
    entity = {e["@id"]: e for e in described}

    assert entity["#python"]["version"] == ".".join(map(str, sys.version_info[:3]))
    assert entity["#package-numpy"]["version"] == np.__version__
    assert entity["#commit"]["value"] == "unknown"
    assert entity["./"]["license"] == {"@id": "https://spdx.org/licenses/MIT"}
    assert [entity[i]["name"] for i in ids(entity["./"]["author"])] == ["The tramdva founders"]
    assert "config/lines/paper.yaml" in ids(entity["#run"]["object"])
    assert "config/quick.yaml" in ids(entity["#run"]["object"])
    assert entity["#arguments"]["value"] == " ".join(QUICK)


def test_commit_and_changed_sources_are_known(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run_record.commit() is None
    (tmp_path / "Snakefile").write_text("rule all:\n")
    (tmp_path / "old name.txt").write_text("a\n")
    git = ["git", "-c", "user.name=a", "-c", "user.email=a@example.org"]
    for arguments in (["init", "-q"], ["add", "."], ["commit", "-q", "-m", "a"]):
        subprocess.run([*git, *arguments], check=True)
    head = subprocess.run(["git", "rev-parse", "HEAD"], capture_output=True, text=True)

    assert run_record.commit() == head.stdout.strip()
    assert run_record.changes() == []
    (tmp_path / "Snakefile").write_text("rule none:\n")
    (tmp_path / "new line.yaml").write_text("label: a\n")
    assert run_record.changes() == ["Snakefile", "new line.yaml"]
    assert run_record.sources() == ["Snakefile", "old name.txt"]
    assert run_record.sources(["new line.yaml"]) == ["Snakefile", "new line.yaml", "old name.txt"]
    (tmp_path / "inside").mkdir()
    monkeypatch.chdir(tmp_path / "inside")
    assert run_record.commit() is None  # a folder in somebody else's repository


@pytest.fixture
def summary(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What Snakemake says of the complete run, asked once."""
    if not hasattr(summary, "rows"):
        summary.rows = list(run_record._summary(QUICK))
    monkeypatch.setattr(run_record, "_summary", lambda arguments: summary.rows)


def refusal() -> str:
    with pytest.raises(run_record.IncompleteRunError) as error:
        run_record.files_of_run(QUICK)
    return str(error.value)


@pytest.mark.usefixtures("summary")
def test_figure_from_elsewhere_is_reported(here: Path) -> None:
    assert run_record.files_of_run(QUICK)
    with replaced(here / FIGURE, b"drawn by hand"):
        assert refusal().startswith(f"{FIGURE}: was changed after the pipeline had made it")


@pytest.mark.usefixtures("summary")
def test_figure_without_record_is_reported(here: Path) -> None:
    record = here / run_record.record_of(FIGURE)
    with replaced(record, None):
        assert refusal().startswith(f"{FIGURE}: there is no record of its making")


@pytest.mark.usefixtures("summary")
def test_figure_of_other_results_is_reported(here: Path) -> None:
    name = "results/paper/limit_cycles.nc"
    with replaced(here / name, (here / name).read_bytes() + b"\0", keep_date=True):
        assert f"{FIGURE}: was made from another {name}; remove it" in refusal()


def test_stale_figure_is_reported(here: Path) -> None:
    line = here / "config/lines/paper.yaml"
    changed = line.read_bytes().replace(b"label: ", b"label: New ", 1)
    with replaced(line, changed):
        told = refusal().splitlines()

    assert any(row.startswith(f"{FIGURE}: is out of date (params changed") for row in told)
    assert not any(row.startswith("results/") for row in told)


def test_missing_results_are_told_in_a_line(here: Path) -> None:
    with replaced(here / FIGURE, None):
        ended = command(here, "tramdva.record.crate")

    assert ended.returncode == 1
    assert re.fullmatch(
        rf"tramdva: no crate: 1 of \d+ files of this run are missing, such as {FIGURE}; "
        r"make them first: python3 run\.py\n",
        ended.stderr,
    )


def test_wrong_configuration_is_told_in_its_line(here: Path) -> None:
    with replaced(here / "config/lines/paper.yaml", b"curves: {}\n"):
        assert "config/lines/paper.yaml: curves: unknown key; did you mean curve?" in refusal()


def test_results_beside_other_sources_are_refused() -> None:
    with pytest.raises(run_record.IncompleteRunError, match="no --directory"):
        crate.write(["--directory", "elsewhere"])


def test_archive_runs_elsewhere_with_nothing_to_be_done(
    here: Path, tmp_path: Path, snakemake
) -> None:
    ended = command(here, "tramdva.record.archive")
    assert ended.returncode == 0, ended.stderr
    path = here / ended.stdout.split()[1]
    subprocess.run(["tar", "-xzf", path, "-C", tmp_path], check=True)
    path.unlink()
    folder = tmp_path / path.name.removesuffix(".tar.gz")

    ended = snakemake(folder, *QUICK, code=folder)
    assert "Nothing to be done" in ended.stdout + ended.stderr
    for name in ("src/tramdva/record/crate.py", "requirements.lock", crate.NAME, FIGURE):
        assert (folder / name).read_bytes() == (here / name).read_bytes()
    assert command(folder, "tramdva.record.crate").returncode == 0


def test_archive_holds_what_git_knows_and_the_run_and_nothing_else(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("config", "paper_figures"):
        shutil.copytree(root / name, name, ignore=shutil.ignore_patterns("paper"))
    git = ["git", "-c", "user.name=n", "-c", "user.email=e"]
    for arguments in (["init", "-q"], ["add", "config"], ["commit", "-qm", "m"]):
        subprocess.run([*git, *arguments], check=True)
    Path("private-notes.txt").write_text("secret")
    Path("config/lines/mine.yaml").write_text("label: Mine\n")
    Path("config/lines/other.yaml").write_text("label: Not of this run\n")
    made = run_record.Made("results/mine/wear.nc", "wear", (), "ok", {"input": []})
    read = crate.configuration_files([made], ["--config", "lines=[mine]"])
    packed = archive.contents([made], read)

    assert "config/lines/mine.yaml" in packed
    assert "config/profiles/worn_wheel.csv" in packed
    assert not {"private-notes.txt", "config/lines/other.yaml"} & set(packed)


def test_links_are_resolved_or_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "outside").write_text("secret")
    (tmp_path / "here/config").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "here")
    Path("config/a.yaml").write_text("a: 1\n")
    Path("Snakefile").symlink_to("config/a.yaml")
    archive.pack(tmp_path / "one.tar.gz", "x", archive.contents([]))
    with tarfile.open(tmp_path / "one.tar.gz") as files:
        assert files.getmember("x/Snakefile").isfile()
        assert files.extractfile("x/Snakefile").read() == b"a: 1\n"

    Path("config/b.yaml").symlink_to(tmp_path / "outside")
    with pytest.raises(run_record.IncompleteRunError, match=r"b\.yaml: is a link to .*outside"):
        archive.contents([])


def test_same_files_give_the_same_archive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("b.nc", "a.txt"):
        Path(name).write_text(name)
    archive.pack(tmp_path / "one.tar.gz", "x", ["a.txt", "b.nc"])
    archive.pack(tmp_path / "two.tar.gz", "x", ["a.txt", "b.nc"])

    assert Path("one.tar.gz").read_bytes() == Path("two.tar.gz").read_bytes()
    with gzip.open("one.tar.gz") as packed, tarfile.open(fileobj=packed) as files:
        assert files.getnames() == ["x/a.txt", "x/b.nc"]
        assert {(entry.uid, entry.uname) for entry in files} == {(0, "")}
        assert files.getmember("x/a.txt").mtime == Path("a.txt").stat().st_mtime
