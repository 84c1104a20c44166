"""The tutorial does what it prints, command by command."""

import base64
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from conftest import copy_code

FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
MARK = "=== end of command {} with code "
REFUSED = "snakemake -n --config lines=[harbour]"  # the two slips


@dataclass
class Command:
    """A printed command and the lines that it is said to print."""

    text: str
    shown: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Written:
    """A file that the reader is told to write; its first line names it."""

    path: str
    content: str


def steps(tutorial: str) -> Iterator[Command | Written]:
    """What the reader does, in order."""
    for language, body in FENCE.findall(tutorial):
        if language == "console":
            commands: list[Command] = []
            for line in body.splitlines():
                if line.startswith("$ "):
                    commands.append(Command(line[2:]))
                else:
                    commands[-1].shown.append(line)
            yield from commands
        else:
            yield Written(body.splitlines()[0].removeprefix("# "), body)


def script(actions: list[Command | Written]) -> str:
    """The session as a program of the shell; marks separate the outputs."""
    lines = []
    for number, action in enumerate(actions):
        if isinstance(action, Written):
            coded = base64.b64encode(action.content.encode()).decode()
            lines.append(f"echo {coded} | base64 -d >{action.path}")
        else:
            lines += [action.text, f'echo "{MARK.format(number)}$?"']
    return "\n".join(lines) + "\n"


def shows(printed: str, shown: list[str]) -> bool:
    """Whether lines appear as shown; `...` is any text, or any lines where it stands alone."""
    pattern = ""
    for line in shown:
        words = re.escape(line.rstrip()).replace(re.escape("..."), ".*")
        pattern += r"(?:.*\n)*?" if line.strip() == "..." else words + r" *\n"
    return re.fullmatch(pattern, printed) is not None


@pytest.fixture(scope="module")
def checkout(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Copy of the checkout that counts as set up, with the packages of this environment."""
    folder = copy_code(root, tmp_path_factory.mktemp("tutorial") / "tramdva")
    for name in ("run.py", "pyproject.toml", "requirements.lock"):
        shutil.copy(root / name, folder)
    spec = importlib.util.spec_from_file_location("run_of_tutorial", folder / "run.py")
    run = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(run)
    run.VENV.mkdir()
    run.BIN.symlink_to(Path(sys.executable).parent)
    run.STAMP.write_text(run.stamp())
    return folder


def test_shown_output_is_compared() -> None:
    assert shows("a\nb\nc\n", ["a", "...", "c"])
    assert shows("a = 1.5 m\n", ["a = ... m"])
    assert shows("", [])
    assert not shows("a\n", [])
    assert not shows("a\nb\n", ["a"])
    assert not shows("a\nb\n", ["b", "..."])


def test_every_command_prints_what_the_tutorial_says(root: Path, checkout: Path) -> None:
    actions = list(steps((root / "docs/tutorial.md").read_text(encoding="utf-8")))
    ended = subprocess.run(
        ["bash"],
        input=script(actions),
        cwd=checkout,
        env=os.environ | {"PYTHONPATH": str(checkout / "src")},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=1200,
    )
    rest = ended.stdout
    checked = 0
    for number, action in enumerate(actions):
        if isinstance(action, Written):
            continue
        printed, mark, rest = rest.partition(MARK.format(number))
        assert mark, rest
        code, _, rest = rest.partition("\n")
        assert int(code) == (1 if action.text == REFUSED else 0), f"{action.text}\n{printed}"
        assert shows(printed, action.shown), f"$ {action.text}\n{printed}"
        checked += 1
    assert checked == 13
    assert (checkout / "harbour.html").stat().st_size > 100_000
