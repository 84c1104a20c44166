#!/usr/bin/env python3
"""Set tramdva up once and run it; needs Python 3.11, 3.12 or 3.13 and nothing else.

    python3 run.py [...]         all figures and numbers; arguments go to snakemake
    python3 run.py check [...]   the lines at a glance, in seconds; arguments go to snakemake
    python3 run.py test [...]    the tests, on two cores; arguments go to pytest
    python3 run.py quick [...]   the same coarsely, in the folder quick/ of its own; `quick report`,
                                 `quick status` and so on concern that folder
    python3 run.py status [...]  what is missing, stale or coarse
    python3 run.py route ...     a table of a route from an alignment and logs of speed (--help)
    python3 run.py report        report.html with the figures that exist; none beside other values
    python3 run.py crate [...]   ro-crate-metadata.json: where each figure and number comes from
    python3 run.py archive [...] a .tar.gz of sources, results and crate that runs elsewhere
    python3 run.py docs          the documentation as pages in docs/_build/html
    python3 run.py setup         only set up

The environment is .venv beside this file. `. .venv/bin/activate` and then `snakemake -j2` is
the same as the first line.
"""

from __future__ import annotations

import ast
import hashlib
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent
VENV = ROOT / ".venv"
BIN = VENV / "bin"
STAMP = VENV / "tramdva-stamp"
LOCK = ROOT / "requirements.lock"
QUICK = "quick"  # folder of coarse results
STATUS = ("python", "-m", "tramdva.record.status")
PYTHONS = ((3, 11), (3, 12), (3, 13))  # as in pyproject.toml


class SetupError(Exception):
    """What prevents the set-up, in a line for the user."""


def main(arguments: list[str]) -> None:
    """Set up where necessary, then become the program that the arguments ask for."""
    if arguments[:1] in (["-h"], ["--help"], ["help"]):
        print(__doc__)
        return
    if sys.version_info[:2] not in PYTHONS:
        become_supported_python(arguments)
    os.chdir(ROOT)
    if not is_set_up():
        set_up()
    check_data(config_files(arguments))
    if arguments != ["setup"]:
        become(command(arguments))


def cannot(error: OSError) -> str:
    """Say in a line what the system refused, and what helps where nothing can be written."""
    place = error.filename or ROOT
    why = (error.strerror or str(error)).lower()
    if os.access(ROOT, os.W_OK):
        return f"tramdva: {place}: {why}"
    return (
        f"tramdva: {place}: {why}; {ROOT} cannot be written, so that its environment cannot be "
        "set up: copy it to a folder of your own and run it there"
    )


def command(arguments: list[str]) -> list[str]:
    """Return the program, with its arguments, that the arguments of this one ask for."""
    if arguments[:1] == ["quick"]:
        return quick(arguments[1:])
    if arguments[:1] == ["test"]:
        chosen = any(re.match(r"-n|--numprocesses|-p", argument) for argument in arguments)
        parallel = [] if chosen else ["--numprocesses=2", "--dist=loadfile"]
        return ["pytest", *parallel, *arguments[1:]]
    if arguments[:1] == ["check"]:
        return ["snakemake", "check", "-j2", "--quiet", "all", *arguments[1:]]
    if arguments[:1] == ["report"]:
        return [*STATUS, "--report", str(ROOT / "report.html"), *arguments[1:]]
    if arguments[:1] == ["status"]:
        return [*STATUS, *arguments[1:]]
    if arguments[:1] in (["crate"], ["archive"]):
        return ["python", "-m", f"tramdva.record.{arguments[0]}", *arguments[1:]]
    if arguments[:1] == ["route"]:
        return ["python", "-m", "tramdva.importing.route", *arguments[1:]]
    if arguments[:1] == ["docs"]:
        return ["sphinx-build", "-W", "--keep-going", *arguments[1:], "docs", "docs/_build/html"]
    cores = re.compile(r"(-j|--jobs|-c|--cores)(=?\d+|=?all)?")
    if any(cores.fullmatch(argument) for argument in arguments):
        return ["snakemake", *arguments]
    return ["snakemake", "-j2", *arguments]


def quick(arguments: list[str]) -> list[str]:
    """Return the program for a coarse run, which has a folder of its own.

    Full results stay as they are, and nobody takes one for the other.
    """
    coarse = ["--configfile", "config/quick.yaml", "--directory", QUICK]
    if arguments[:1] == ["report"]:
        target = str(ROOT / QUICK / "report.html")
        return [*STATUS, "--report", target, *arguments[1:], *coarse]
    return command([*arguments, *coarse])


def config_files(arguments: list[str]) -> list[str]:
    """Return the files that snakemake is to read as configuration."""
    files: list[str] = []
    reading = False
    for argument in arguments:
        name, is_given, value = argument.partition("=")
        # Snakemake takes every unique beginning of an option's name, and several files per option.
        option = name.startswith("--configf") and "--configfiles".startswith(name)
        reading = option if argument.startswith("-") else reading
        files += [value] if option and is_given else []
        files += [argument] if reading and not argument.startswith("-") else []
    return files


def check_data(files: list[str]) -> None:
    """Refuse configuration that is code: Snakemake would run it before anything is checked."""
    if (
        files
        and subprocess.run(
            [BIN / "python", "-m", "tramdva.configuration.yaml_files", *files]
        ).returncode
    ):
        sys.exit(1)


def become(program: list[str]) -> None:
    """Replace this process by a program of the environment, so that signals reach it."""
    environment = os.environ | {
        "VIRTUAL_ENV": str(VENV),
        "PATH": f"{BIN}{os.pathsep}{os.environ.get('PATH', os.defpath)}",
    }
    environment.pop("PYTHONHOME", None)
    sys.stdout.flush()
    os.execve(BIN / program[0], program, environment)


def become_supported_python(arguments: list[str]) -> None:
    """Start again with a supported Python where another version was called."""
    other = supported_python()
    if other is None:
        names = [dotted(version) for version in PYTHONS]
        raise SetupError(
            f"tramdva needs Python {', '.join(names[:-1])} or {names[-1]}; "
            f"this is {sys.version.split()[0]} and there is no other on PATH: "
            f"install one, for example python{names[-1]}, and run this again"
        )
    os.execv(other, [other, str(Path(__file__).resolve()), *arguments])


def supported_python() -> str | None:
    """Find a Python that is supported: that of the environment, else the newest of a folder."""
    for folder in [str(BIN), *os.environ.get("PATH", os.defpath).split(os.pathsep)]:
        for version in reversed(PYTHONS):
            path = shutil.which(f"python{dotted(version)}", path=folder)
            if path is not None and is_python(path, version):
                return path
    return None


def is_python(path: str | Path, version: tuple[int, ...], module: str = "sys") -> bool:
    """Tell whether a program is a Python of a version and has a module; a shim need not be one."""
    check = f"import {module}, sys; sys.exit(sys.version_info[:2] != {tuple(version)})"
    try:
        return subprocess.run([path, "-c", check], capture_output=True).returncode == 0
    except OSError:
        return False


def dotted(version: tuple[int, ...]) -> str:
    """Write a version of Python, such as 3.11."""
    return ".".join(map(str, version))


def stamp() -> str:
    """Return what the environment must have been made from."""
    digest = hashlib.sha256(f"{sys.version_info[:2]} {ROOT}".encode())
    for name in ("run.py", "pyproject.toml", "requirements.lock"):
        digest.update((ROOT / name).read_bytes())
    return digest.hexdigest()


def is_set_up() -> bool:
    """Tell whether the environment is complete and current."""
    return STAMP.is_file() and STAMP.read_text() == stamp() and (BIN / "python").exists()


def set_up() -> None:
    """Make the environment; the stamp comes last, so that a half-made one is recognised."""
    version = dotted(sys.version_info[:2])
    print(f"tramdva: setting up .venv for Python {version} (once, about two minutes)", flush=True)
    STAMP.unlink(missing_ok=True)
    if not works():
        make_venv()
    try:
        install_with_uv()
    except subprocess.CalledProcessError:
        print("tramdva: uv failed; installing with pip instead", flush=True)
        install_with_pip()
    compile_kernels()
    STAMP.write_text(stamp())


def compile_kernels() -> None:
    """Compile now what the first run would have to; a failure costs time later, nothing else."""
    program = (
        "from tramdva.running.numba_cache import compile_kernels_once, use_numba_cache;"
        "use_numba_cache(); compile_kernels_once()"
    )
    subprocess.run([BIN / "python", "-c", program], capture_output=True, check=False)


def works() -> bool:
    """Tell whether there is an environment with this version of Python and pip."""
    return is_python(BIN / "python", sys.version_info[:2], "pip")


def make_venv() -> None:
    """Make an empty environment, after installing what Debian leaves out of Python."""
    if importlib.util.find_spec("ensurepip") is None:
        install_debian_package(f"python{dotted(sys.version_info[:2])}-venv")
    run([sys.executable, "-m", "venv", "--clear", str(VENV)])


def install_debian_package(name: str) -> None:
    """Install a package with apt where that is possible, else say how."""
    how = f"apt-get update && apt-get install -y {name}"
    if os.geteuid() != 0 or shutil.which("apt-get") is None:
        raise SetupError(f"Python's module venv is missing; run: sudo sh -c '{how}'")
    run(["sh", "-c", how.replace("apt-get", "apt-get -qq")], DEBIAN_FRONTEND="noninteractive")


def install_with_uv() -> None:
    """Install exactly the lock file with uv, and the package itself."""
    with tempfile.TemporaryDirectory() as folder:
        only_uv = Path(folder) / "uv.txt"
        only_uv.write_text(locked("uv", LOCK.read_text()))
        pip("install", "--require-hashes", "--no-deps", "-r", str(only_uv))
    environment = index_of_pip() | {"VIRTUAL_ENV": str(VENV)}
    uv = [str(BIN / "uv"), "--quiet", "pip"]
    run([*uv, "sync", "--require-hashes", "--compile-bytecode", str(LOCK)], **environment)
    run(
        [*uv, "install", "--offline", "--no-deps", "--no-build-isolation", "-e", "."], **environment
    )


def install_with_pip() -> None:
    """Install exactly the lock file with pip, and the package itself."""
    pip("install", "--require-hashes", "--no-deps", "--compile", "-r", str(LOCK))
    pip("install", "--no-index", "--no-deps", "--no-build-isolation", "-e", ".")


def locked(package: str, lock: str) -> str:
    """Return the entry of one package in a lock file: its version and hashes."""
    entry = re.search(rf"^{re.escape(package)}==.*(\n {{4}}--hash=.*)*$", lock, re.MULTILINE)
    if entry is None:
        raise SetupError(f"requirements.lock does not hold {package}")
    return entry.group() + "\n"


def index_of_pip() -> dict[str, str]:
    """Return pip's configured sources of packages in the words of uv, which does not read them."""
    listed = subprocess.run(
        [BIN / "python", "-m", "pip", "config", "list"], capture_output=True, text=True, check=True
    )
    settings = pip_settings(listed.stdout.splitlines())
    names = {
        "index-url": "UV_DEFAULT_INDEX",
        "extra-index-url": "UV_INDEX",
        "find-links": "UV_FIND_LINKS",
        "cert": "SSL_CERT_FILE",
        "proxy": "ALL_PROXY",
    }
    found = {
        theirs: settings[ours]
        for ours, theirs in names.items()
        if ours in settings and theirs not in os.environ
    }
    # The first source that knows a package need not have the locked version; hashes decide.
    return {"UV_INDEX_STRATEGY": "unsafe-best-match"} | found


def pip_settings(lines: list[str]) -> dict[str, str]:
    """Read the output of `pip config list`; the environment comes first, then the command."""
    ranks = {"global": 0, "install": 1, ":env:": 2}
    settings: dict[str, str] = {}
    for line in sorted(lines, key=lambda line: ranks.get(line.partition(".")[0], -1)):
        name, _, value = line.partition("=")
        section, _, key = name.partition(".")
        if section in ranks:
            settings[key] = " ".join(str(ast.literal_eval(value)).split())
    return settings


def pip(*arguments: str) -> None:
    """Run pip of the environment."""
    run([str(BIN / "python"), "-m", "pip", "--quiet", "--disable-pip-version-check", *arguments])


def run(program: list[str], **environment: str) -> None:
    """Run a program of the set-up to its end."""
    subprocess.run(program, check=True, env=os.environ | environment)


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except SetupError as error:
        sys.exit(str(error))
    except subprocess.CalledProcessError as error:
        sys.exit(f"tramdva: set-up failed: {' '.join(map(str, error.cmd))}")
    except OSError as error:
        sys.exit(cannot(error))
    except KeyboardInterrupt:
        sys.exit("tramdva: interrupted; the next start completes the set-up")
