"""Describe the results of a run as an RO-Crate: `python3 run.py crate`.

`ro-crate-metadata.json` names every file of the run and of the sources with size and checksum, and
for every job the script, the files it read, the values of the configuration it used, the hash of
its code, what it made and when. With it go the commit, the packages and the version of Python. It
follows RO-Crate 1.1 and the profile Workflow Run Crate 0.5, whose words are schema.org's.
"""

from __future__ import annotations

import functools
import hashlib
import importlib.metadata
import json
import mimetypes
import platform
import re
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import yaml

from tramdva import results
from tramdva.configuration.reading import load
from tramdva.record import run_record
from tramdva.record.run_record import IncompleteRunError, Made

NAME = "ro-crate-metadata.json"
CONTEXT = [
    "https://w3id.org/ro/crate/1.1/context",
    {"sha256": "https://w3id.org/ro/terms/workflow-run#sha256"},
]
PROFILES = {
    "https://w3id.org/ro/wfrun/process/0.5": "Process Run Crate",
    "https://w3id.org/ro/wfrun/workflow/0.5": "Workflow Run Crate",
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0": "Workflow RO-Crate",
}
FORMATS = {
    ".nc": "application/x-netcdf",
    ".yaml": "application/yaml",
    ".md": "text/markdown",
    ".cff": "application/yaml",
}
WORKFLOW = "Snakefile"
SCRIPTS = {"results": "workflow/scripts", "paper_figures": "paper_figures"}  # of files below
CODE = re.compile("[0-9a-f]{20}")  # a hash of code among the parameters of a job
LOCKED = re.compile(r"^([A-Za-z0-9._-]+)==([^ ;\\]+)", re.MULTILINE)

Entity = dict[str, Any]


def write(arguments: Sequence[str]) -> list[Made]:
    """Describe the run in the current folder.

    Parameters
    ----------
    arguments : sequence of str
        Arguments that the run was given, for snakemake.

    Returns
    -------
    list of Made
        The files of the run.

    Raises
    ------
    IncompleteRunError
        Where files are missing, stale or not made by the pipeline.
    """
    if any(argument.startswith(("--directory", "-d")) for argument in arguments):
        raise IncompleteRunError("a crate describes results beside their sources: no --directory")
    made = run_record.files_of_run(arguments)
    crate = {"@context": CONTEXT, "@graph": graph(made, arguments)}
    text = json.dumps(crate, indent=1, ensure_ascii=False) + "\n"
    with results.atomically(NAME) as part:
        part.write_text(text, encoding="utf-8")
    return made


def graph(made: Sequence[Made], arguments: Sequence[str]) -> list[Entity]:
    """Return all entities of the crate, each once."""
    configuration = configuration_files(made, arguments)
    sources = [name for name in run_record.sources(configuration) if name != NAME]
    inputs = {path for file in made for path in file.inputs}
    known = {*sources, *(file.path for file in made)}
    further = sorted(path for path in inputs - known if Path(path).is_file())
    jobs = list(_jobs(made))
    entities = [
        *_root(sources + further + [file.path for file in made], jobs),
        *_people(),
        _commit(),
        *_workflow(),
        *_packages(),
        *_earlier_packages(made),
        *(_file(name) for name in sources + further if name != WORKFLOW),
        *(_result(file) for file in made),
        *jobs,
        *(value for file in made for value in _values(file)),
        *_run(made, jobs, arguments),
    ]
    return list({entity["@id"]: entity for entity in entities}.values())


def _root(files: Iterable[str], jobs: Sequence[Entity]) -> Iterator[Entity]:
    citation = _citation()
    profiles = _refer(PROFILES)
    yield {
        "@id": NAME,
        "@type": "CreativeWork",
        "about": {"@id": "./"},
        "conformsTo": [{"@id": "https://w3id.org/ro/crate/1.1"}, profiles[-1]],
    }
    yield {
        "@id": "./",
        "@type": "Dataset",
        "name": citation["title"],
        "description": "Sources, numbers and figures of a run of tramdva.",
        "version": citation["version"],
        "datePublished": datetime.now(UTC).isoformat(timespec="seconds"),
        "license": {"@id": _licence(citation)},
        "author": _refer(_author_id(author) for author in citation["authors"]),
        "conformsTo": profiles,
        "identifier": {"@id": "#commit"},
        "mainEntity": {"@id": WORKFLOW},
        "hasPart": _refer(files),
        "mentions": [{"@id": "#run"}, *_refer(job["@id"] for job in jobs)],
    }
    for profile, name in PROFILES.items():
        yield {"@id": profile, "@type": "CreativeWork", "name": name}
    yield {"@id": _licence(citation), "@type": "CreativeWork", "name": citation["license"]}


def _citation() -> dict[str, Any]:
    return yaml.safe_load(Path("CITATION.cff").read_text(encoding="utf-8"))


def _licence(citation: Mapping[str, Any]) -> str:
    return f"https://spdx.org/licenses/{citation['license']}"


def _author_name(author: Mapping[str, str]) -> str:
    names = (author.get("given-names"), author.get("family-names"), author.get("name"))
    return " ".join(name for name in names if name)


def _author_id(author: Mapping[str, str]) -> str:
    return author.get("orcid") or "#author-" + re.sub(r"\W+", "-", _author_name(author).lower())


def _people() -> Iterator[Entity]:
    for author in _citation()["authors"]:
        kind = "Person" if "family-names" in author else "Organization"
        yield {"@id": _author_id(author), "@type": kind, "name": _author_name(author)}


def _commit() -> Entity:
    """State the commit and whether the sources are those of it."""
    commit = run_record.commit()
    changes = run_record.changes() if commit else []
    state = f"sources differ from the commit: {', '.join(changes)}" if changes else "sources of it"
    return {
        "@id": "#commit",
        "@type": "PropertyValue",
        "propertyID": "git commit",
        "name": "commit of the sources",
        "value": commit or "unknown",
        "description": state if commit else "the sources are no git checkout",
    }


def _workflow() -> Iterator[Entity]:
    yield {
        **_file(WORKFLOW),
        "@type": ["File", "SoftwareSourceCode", "ComputationalWorkflow"],
        "name": "tramdva",
        "version": _citation()["version"],
        "programmingLanguage": {"@id": "#snakemake"},
        "softwareRequirements": [
            {"@id": "#python"},
            *_refer(f"#package-{name}" for name in _installed()),
        ],
    }
    yield {
        "@id": "#snakemake",
        "@type": "ComputerLanguage",
        "name": "Snakemake",
        "version": importlib.metadata.version("snakemake"),
        "url": {"@id": "https://snakemake.github.io"},
    }


@functools.cache
def _installed() -> dict[str, str]:
    """Return the versions of the packages of the lock file, as they are installed."""
    locked = dict(LOCKED.findall(Path("requirements.lock").read_text(encoding="utf-8")))
    there = {
        re.sub(r"[-_.]+", "-", package.name).lower(): package.version
        for package in importlib.metadata.distributions()
    }
    return {name: there[name] for name in locked if name in there}


def _packages() -> Iterator[Entity]:
    yield {
        "@id": "#python",
        "@type": "SoftwareApplication",
        "name": platform.python_implementation(),
        "version": platform.python_version(),
        "operatingSystem": f"{platform.system()} on {platform.machine()}",
    }
    for name, version in _installed().items():
        yield _package(f"#package-{name}", name, version)


def _package(identifier: str, name: str, version: str) -> Entity:
    return {
        "@id": identifier,
        "@type": "SoftwareApplication",
        "name": name,
        "version": version,
    }


def _file(path: str) -> Entity:
    """Describe a file by its size, checksum and format; a script is a program as well."""
    kind = FORMATS.get(Path(path).suffix) or mimetypes.guess_type(path)[0]
    is_code = path.endswith((".py", ".smk")) or path == WORKFLOW
    return {
        "@id": path,
        "@type": ["File", "SoftwareSourceCode"] if is_code else "File",
        "name": path,
        "contentSize": str(Path(path).stat().st_size),
        "sha256": run_record.sha256(path),
        **({"encodingFormat": kind} if kind else {}),
    }


def _result(file: Made) -> Entity:
    """Describe a file of the run; result files say themselves what they are."""
    if not file.path.endswith(".nc"):
        return _file(file.path)
    stamps = results.read_stamps(file.path)
    return {
        **_file(file.path),
        "description": stamps["title"],
        "version": stamps["tramdva_version"],
        "softwareRequirements": _refer(map(_package_id, _made_with(stamps))),
    }


def _made_with(stamps: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """Names and versions of the packages that made a result, as its stamps say."""
    for package in stamps["packages"].split(", "):
        name, _, version = package.partition(" ")
        yield name.lower(), version


def _package_id(package: tuple[str, str]) -> str:
    name, version = package
    same = _installed().get(name) == version
    return f"#package-{name}" if same else f"#package-{name}-{version}"


def _earlier_packages(made: Sequence[Made]) -> Iterator[Entity]:
    """Describe packages that made a result in another version than the one that is installed."""
    for file in made:
        if file.path.endswith(".nc"):
            for name, version in _made_with(results.read_stamps(file.path)):
                yield _package(_package_id((name, version)), name, version)


def _jobs(made: Sequence[Made]) -> Iterator[Entity]:
    """Describe each job: a rule for some wildcards, which made one or several files."""
    jobs: dict[tuple[str, tuple[str, ...]], list[Made]] = {}
    for file in made:
        jobs.setdefault((file.rule, file.log), []).append(file)
    for (rule, _), files in jobs.items():
        first = files[0]
        yield {
            "@id": f"#job/{first.path}",
            "@type": "CreateAction",
            "name": rule,
            "instrument": {"@id": script_of(first.path)},
            "object": _refer([*first.inputs, *(value["@id"] for value in _values(first))]),
            "result": _refer(file.path for file in files),
            "startTime": _time(first.record["starttime"]),
            "endTime": _time(max(file.record["endtime"] for file in files)),
            "actionStatus": {"@id": "http://schema.org/CompletedActionStatus"},
        }


def script_of(path: str) -> str:
    """Return the script that makes a file, whose name it bears; the Snakefile if there is none.

    The files of a stage of many jobs lie in a folder that bears the name.
    """
    top, _, *name = Path(path).with_suffix("").parts
    folder = SCRIPTS.get(top)
    script = f"{folder}/{name[0]}.py" if folder and name else ""
    return script if Path(script).is_file() else WORKFLOW


def _values(file: Made) -> Iterator[Entity]:
    """Describe the parameters of a job; jobs with the same ones share the entity.

    A name among them is that of the script, which the job tells already.
    """
    for value in file.values:
        if value == Path(script_of(file.path)).stem:
            continue
        text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
        digest = hashlib.sha256(text.encode()).hexdigest()[:16]
        yield {
            "@id": f"#value-{digest}",
            "@type": "PropertyValue",
            "name": _meaning(value),
            "value": text,
        }


def _meaning(value: Any) -> str:
    if isinstance(value, str) and CODE.fullmatch(value):
        return "hash of the code"
    return "orders of the wheels" if isinstance(value, list) else "values of the configuration"


def _run(made: Sequence[Made], jobs: Sequence[Entity], arguments: Sequence[str]) -> list[Entity]:
    """Describe the run as a whole: the configuration it read and everything it made."""
    lines = lines_of(made)
    files = configuration_files(made, arguments)
    return [
        {
            "@id": "#run",
            "@type": "CreateAction",
            "name": f"run of the pipeline for {', '.join(lines)}",
            "instrument": {"@id": WORKFLOW},
            "object": [*_refer(files), {"@id": "#arguments"}],
            "result": _refer(file.path for file in made),
            "startTime": min(job["startTime"] for job in jobs),
            "endTime": max(job["endTime"] for job in jobs),
            "actionStatus": {"@id": "http://schema.org/CompletedActionStatus"},
        },
        {
            "@id": "#arguments",
            "@type": "PropertyValue",
            "name": "arguments of snakemake",
            "value": " ".join(arguments),
        },
        *map(_file, files),
    ]


def lines_of(made: Sequence[Made]) -> list[str]:
    """Names of the lines of a run."""
    return sorted({file.path.split("/")[1] for file in made})


def configuration_files(made: Sequence[Made], arguments: Sequence[str]) -> list[str]:
    """List the files that a run read as configuration: its own, its lines', those of arguments.

    With them go the measured files that the lines name.
    """
    lines = lines_of(made)
    named = ["config/config.yaml", *(f"config/lines/{line}.yaml" for line in ("paper", *lines))]
    given = [argument for argument in arguments if argument.endswith((".yaml", ".yml"))]
    of_lines = load(Path("config"), (), {"lines": lines}).measured.values()
    measured = [file.path for files in of_lines for file in files.values()]
    return [n for n in dict.fromkeys([*named, *given, *measured]) if Path(n).is_file()]


def _time(seconds: float) -> str:
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="milliseconds")


def _refer(names: Iterable[str]) -> list[dict[str, str]]:
    return [{"@id": name} for name in dict.fromkeys(names)]


if __name__ == "__main__":
    try:
        described = write(sys.argv[1:])
    except IncompleteRunError as error:
        sys.exit("\n".join(f"tramdva: no crate: {line}" for line in str(error).splitlines()))
    print(f"tramdva: {NAME} describes {len(described)} files of the run and how they were made")
