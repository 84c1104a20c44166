"""The argument logic and the set-up of run.py, without installing anything."""

import ast
import importlib.util
import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

OWN = "python" + ".".join(map(str, sys.version_info[:2]))  # name of this interpreter


COARSE = ["--configfile", "config/quick.yaml", "--directory", "quick"]


@pytest.fixture
def run(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """run.py as it would be in another folder."""
    spec = importlib.util.spec_from_file_location("run", root / "run.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for name in ("run.py", "pyproject.toml", "requirements.lock"):
        (tmp_path / name).write_bytes((root / name).read_bytes())
    venv = tmp_path / ".venv"
    for name, path in {
        "ROOT": tmp_path,
        "VENV": venv,
        "BIN": venv / "bin",
        "STAMP": venv / "tramdva-stamp",
        "LOCK": tmp_path / "requirements.lock",
    }.items():
        monkeypatch.setattr(module, name, path)
    return module


@pytest.mark.parametrize(
    ("arguments", "program"),
    [
        ([], ["snakemake", "-j2"]),
        (["-n"], ["snakemake", "-j2", "-n"]),
        (["-j4"], ["snakemake", "-j4"]),
        (["-j", "4"], ["snakemake", "-j", "4"]),
        (["-c1", "-n"], ["snakemake", "-c1", "-n"]),
        (["--cores", "all"], ["snakemake", "--cores", "all"]),
        (["--jobs=3"], ["snakemake", "--jobs=3"]),
        (["--configfile", "a.yaml"], ["snakemake", "-j2", "--configfile", "a.yaml"]),
        (["--config", "lines=[x]"], ["snakemake", "-j2", "--config", "lines=[x]"]),
        (["status", "-q"], ["python", "-m", "tramdva.record.status", "-q"]),
        (["quick"], ["snakemake", "-j2", *COARSE]),
        (["quick", "-j1"], ["snakemake", "-j1", *COARSE]),
        (["quick", "status"], ["python", "-m", "tramdva.record.status", *COARSE]),
        (["test"], ["pytest", "--numprocesses=2", "--dist=loadfile"]),
        (
            ["test", "-k", "hopf"],
            ["pytest", "--numprocesses=2", "--dist=loadfile", "-k", "hopf"],
        ),
        (["test", "-n0"], ["pytest", "-n0"]),
        (["test", "--numprocesses", "4"], ["pytest", "--numprocesses", "4"]),
        (["crate", "-j1"], ["python", "-m", "tramdva.record.crate", "-j1"]),
        (["archive"], ["python", "-m", "tramdva.record.archive"]),
        (["route", "a.xml"], ["python", "-m", "tramdva.importing.route", "a.xml"]),
        (["docs", "-q"], ["sphinx-build", "-W", "--keep-going", "-q", "docs", "docs/_build/html"]),
        (["results/paper/test"], ["snakemake", "-j2", "results/paper/test"]),
    ],
)
def test_arguments_go_to_the_right_program(
    run: ModuleType, arguments: list[str], program: list[str]
) -> None:
    assert run.command(arguments) == program


def test_reports_lie_beside_their_results(run: ModuleType) -> None:
    status = ["python", "-m", "tramdva.record.status", "--report"]

    assert run.command(["report"]) == [*status, str(run.ROOT / "report.html")]
    assert run.command(["quick", "report"]) == [
        *status,
        str(run.ROOT / "quick/report.html"),
        *COARSE,
    ]


@pytest.mark.parametrize(
    ("arguments", "files"),
    [
        ([], []),
        (["-n", "results/x.nc"], []),
        (["--configfile", "a.yaml"], ["a.yaml"]),
        (["--configfile", "a.yaml", "b.yaml", "-n", "c"], ["a.yaml", "b.yaml"]),
        (["--configfiles", "a.yaml", "--configfile=b.yaml"], ["a.yaml", "b.yaml"]),
        (["--configf", "a.yaml"], ["a.yaml"]),
        (["--config", "lines=[a.yaml]"], []),
    ],
)
def test_configuration_files_are_found(
    run: ModuleType, arguments: list[str], files: list[str]
) -> None:
    assert run.config_files(arguments) == files


def test_configuration_that_is_code_is_refused(
    run: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd
) -> None:
    monkeypatch.setattr(run, "BIN", Path(sys.executable).parent)
    (tmp_path / "data.yaml").write_text("numerics: {}\n")
    (tmp_path / "code.yaml").write_text('"__use_yte\\x5f_": true\n?print(6): 7\n')

    run.check_data([str(tmp_path / "data.yaml")])
    with pytest.raises(SystemExit):
        run.check_data([str(tmp_path / "code.yaml")])

    assert "code.yaml: line 1: the key __use_yte__ is not allowed" in capfd.readouterr().err


def make_python(run: ModuleType) -> None:
    run.BIN.mkdir(parents=True)
    (run.BIN / "python").symlink_to(sys.executable)


def test_complete_environment_is_recognised(run: ModuleType) -> None:
    make_python(run)
    run.STAMP.write_text(run.stamp())

    assert run.is_set_up()


@pytest.mark.parametrize("name", ["requirements.lock", "pyproject.toml", "run.py"])
def test_changed_requirements_set_up_again(run: ModuleType, name: str) -> None:
    make_python(run)
    run.STAMP.write_text(run.stamp())
    with (run.ROOT / name).open("a") as file:
        file.write("\n# more\n")

    assert not run.is_set_up()


def test_half_made_environment_is_recognised(run: ModuleType) -> None:
    assert not run.is_set_up()
    make_python(run)
    assert not run.is_set_up()
    run.STAMP.write_text(run.stamp())
    (run.BIN / "python").unlink()
    assert not run.is_set_up()
    assert not run.works()


def set_up_with(run: ModuleType, monkeypatch: pytest.MonkeyPatch, failing: str) -> list[str]:
    """Set up with programs that do nothing but fail where their line holds a word."""
    lines: list[str] = []

    def pretend(program: list[str], **environment: str) -> None:
        line = " ".join(program).replace(str(run.BIN), "BIN")
        lines.append(line)
        if "venv" in program:
            make_python(run)
        if failing and failing in line:
            raise subprocess.CalledProcessError(1, program)

    monkeypatch.setattr(run, "run", pretend)
    monkeypatch.setattr(run, "index_of_pip", dict)
    run.set_up()
    return lines


def test_set_up_ends_with_the_stamp(run: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    lines = set_up_with(run, monkeypatch, "")

    assert "-m venv --clear" in lines[0]
    assert "--require-hashes" in lines[1]
    assert lines[2].startswith("BIN/uv --quiet pip sync --require-hashes")
    assert lines[3].endswith("-e .")
    assert run.is_set_up()


def test_pip_steps_in_where_uv_fails(run: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    lines = set_up_with(run, monkeypatch, "BIN/uv")

    assert "--require-hashes" in lines[-2]
    assert lines[-2].startswith("BIN/python -m pip")
    assert run.is_set_up()


def test_failed_set_up_leaves_no_stamp(run: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    run.VENV.mkdir()
    run.STAMP.write_text(run.stamp())
    with pytest.raises(subprocess.CalledProcessError):
        set_up_with(run, monkeypatch, "pip")

    assert not run.STAMP.exists()


def test_interrupted_set_up_leaves_no_stamp(
    run: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(program: list[str], **environment: str) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(run, "run", interrupt)
    with pytest.raises(KeyboardInterrupt):
        run.set_up()

    assert not run.is_set_up()


def test_missing_module_venv_is_told_in_a_line(
    run: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    monkeypatch.setattr(run.importlib.util, "find_spec", lambda name: None)

    with pytest.raises(run.SetupError) as error:
        run.make_venv()

    assert str(error.value) == (
        "Python's module venv is missing; run: "
        f"sudo sh -c 'apt-get update && apt-get install -y {OWN}-venv'"
    )


def test_missing_module_venv_is_installed_as_root(
    run: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran = []
    monkeypatch.setattr(run, "run", lambda program, **environment: ran.append(program))
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    monkeypatch.setattr(run.shutil, "which", lambda name: f"/usr/bin/{name}")
    monkeypatch.setattr(run.importlib.util, "find_spec", lambda name: None)

    run.make_venv()

    assert f"install -y {OWN}-venv" in ran[0][-1]
    assert ran[1][1:3] == ["-m", "venv"]


def pretend_old(run: ModuleType, monkeypatch: pytest.MonkeyPatch, *folders: Path) -> None:
    """Let run.py take its interpreter for one that is too old, and see only these folders."""
    old = SimpleNamespace(version_info=(3, 10, 2), version="3.10.2 (main)", executable="old")
    monkeypatch.setattr(run, "sys", old)
    monkeypatch.setenv("PATH", os.pathsep.join(map(str, folders)))


def make_program(path: Path, text: str) -> Path:
    path.parent.mkdir(exist_ok=True)
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)
    return path


def test_unsupported_python_is_told_in_a_line(
    run: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    pretend_old(run, monkeypatch, tmp_path / "nothing")

    with pytest.raises(run.SetupError) as error:
        run.main([])

    assert str(error.value) == (
        "tramdva needs Python 3.11, 3.12 or 3.13; this is 3.10.2 and there is no other on PATH: "
        "install one, for example python3.13, and run this again"
    )


def test_supported_python_on_path_takes_over(
    run: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    make_program(tmp_path / "shims" / OWN, "exit 127")  # of a version manager, switched off
    other = make_program(tmp_path / "bin" / OWN, f'exec {sys.executable} "$@"')
    pretend_old(run, monkeypatch, tmp_path / "shims", tmp_path / "bin")
    became = []
    monkeypatch.setattr(run.os, "execv", lambda *arguments: became.append(arguments))

    run.become_supported_python(["-n"])

    assert became == [(str(other), [str(other), str(Path(run.__file__).resolve()), "-n"])]


def test_python_of_the_environment_comes_first(
    run: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    make_program(tmp_path / "bin" / OWN, f'exec {sys.executable} "$@"')
    pretend_old(run, monkeypatch, tmp_path / "bin")
    make_python(run)
    (run.BIN / OWN).symlink_to(sys.executable)

    assert run.supported_python() == str(run.BIN / OWN)


def test_unsupported_python_says_so_for_real(root: Path, tmp_path: Path) -> None:
    """The whole script, with a list of versions in which no interpreter can be."""
    text = (root / "run.py").read_text()
    versions = text.replace("PYTHONS = ((3, 11), (3, 12), (3, 13))", "PYTHONS = ((3, 98), (3, 99))")
    (tmp_path / "run.py").write_text(versions)
    ended = subprocess.run(
        [sys.executable, tmp_path / "run.py", "-n"], capture_output=True, text=True, check=False
    )

    assert ended.returncode == 1
    assert ended.stderr.startswith("tramdva needs Python 3.98 or 3.99; this is 3.")
    assert ended.stderr.count("\n") == 1
    assert not (tmp_path / ".venv").exists()


def test_environment_of_another_python_is_set_up_again(
    run: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_python(run)
    run.STAMP.write_text(run.stamp())
    assert run.is_set_up()
    assert run.is_python(run.BIN / "python", sys.version_info[:2])

    another = next(version for version in run.PYTHONS if version != sys.version_info[:2])
    monkeypatch.setattr(run, "sys", SimpleNamespace(version_info=(*another, 0)))

    assert not run.is_set_up()
    assert not run.works()


def test_versions_are_the_same_everywhere(root: Path, run: ModuleType) -> None:
    project = tomllib.loads((root / "pyproject.toml").read_text())["project"]
    workflow = (root / ".github/workflows/ci.yml").read_text()
    lock = (root / "requirements.lock").read_text()
    names = [run.dotted(version) for version in run.PYTHONS]
    (major, first), (_, last) = run.PYTHONS[0], run.PYTHONS[-1]

    assert project["requires-python"] == f">={major}.{first},<{major}.{last + 1}"
    listed = [text for text in project["classifiers"] if re.search(r"Python :: \d+\.", text)]
    assert listed == [f"Programming Language :: Python :: {name}" for name in names]
    assert f"python-version: [{', '.join(map(json.dumps, names))}]" in workflow
    assert f"--python-version {names[0]} " in lock
    for page in ("run.py", "README.md", "docs/tutorial.md"):
        said = " ".join((root / page).read_text().split())
        assert f"Python {', '.join(names[:-1])} or {names[-1]}" in said, page


def test_only_one_entry_of_the_lock_is_taken(run: ModuleType) -> None:
    lock = "a==1 \\\n    --hash=sha256:0\nuv==2 \\\n    --hash=sha256:1 \\\n    --hash=sha256:2\n"

    assert run.locked("uv", lock + "    # via x\nuvx==3 \\\n    --hash=sha256:3\n") == (
        "uv==2 \\\n    --hash=sha256:1 \\\n    --hash=sha256:2\n"
    )
    with pytest.raises(run.SetupError, match="does not hold uv"):
        run.locked("uv", "a==1\n")


def test_lock_holds_uv_and_names_no_place(root: Path, run: ModuleType) -> None:
    lock = (root / "requirements.lock").read_text()

    assert "--hash=sha256:" in run.locked("uv", lock)
    for word in ("http", "index-url=", "find-links", "file:", "constraint"):
        assert word not in lock


def test_settings_of_pip_are_read(run: ModuleType) -> None:
    lines = [
        ":env:.index-url='a'",
        "global.index-url='b'",
        "install.index-url='c'",
        "global.extra-index-url='d\\ne'",
        "install.find-links='f'",
        "freeze.find-links='g'",
    ]

    assert run.pip_settings(lines) == {
        "index-url": "a",
        "extra-index-url": "d e",
        "find-links": "f",
    }


def test_help_is_shown_without_set_up(root: Path, tmp_path: Path) -> None:
    (tmp_path / "run.py").write_bytes((root / "run.py").read_bytes())
    shown = subprocess.run(
        [sys.executable, tmp_path / "run.py", "--help"], capture_output=True, text=True, check=True
    )

    assert "python3 run.py test" in shown.stdout
    assert not (tmp_path / ".venv").exists()


def test_standard_library_only(root: Path) -> None:
    tree = ast.parse((root / "run.py").read_text())
    names = {
        alias.name.partition(".")[0]
        for node in ast.walk(tree)
        if isinstance(node, ast.Import)
        for alias in node.names
    } | {
        node.module.partition(".")[0] for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)
    }

    assert names <= set(sys.stdlib_module_names)


def test_folder_that_cannot_be_written_is_told_in_a_line(root: Path, tmp_path: Path) -> None:
    """The whole script in a copy of a checkout, set up elsewhere; root may write everywhere."""
    text = (root / "run.py").read_text()
    refused = "raise PermissionError(13, 'Permission denied', str(STAMP))"
    (tmp_path / "run.py").write_text(text.replace("STAMP.unlink(missing_ok=True)", refused))
    for name in ("pyproject.toml", "requirements.lock"):
        (tmp_path / name).write_bytes((root / name).read_bytes())
    ended = subprocess.run(
        [sys.executable, tmp_path / "run.py", "-n"], capture_output=True, text=True, check=False
    )

    assert ended.returncode == 1
    assert ended.stderr.startswith(f"tramdva: {tmp_path}/.venv/tramdva-stamp: permission denied")
    assert ended.stderr.count("\n") == 1


def test_folder_that_cannot_be_written_says_what_helps(
    run: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    error = PermissionError(30, "Read-only file system", str(run.STAMP))
    monkeypatch.setattr(run.os, "access", lambda path, mode: False)

    assert run.cannot(error) == (
        f"tramdva: {run.STAMP}: read-only file system; {run.ROOT} cannot be written, so that its "
        "environment cannot be set up: copy it to a folder of your own and run it there"
    )
