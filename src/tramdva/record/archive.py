"""Pack a run with all that it came from: `python3 run.py archive`.

The archive holds the sources, numbers, figures, logs, Snakemake's records and the crate that
describes them. Unpacked anywhere, `python3 run.py` sets it up and finds nothing to be done. Dates
of files are kept, since Snakemake compares them; owners are not. The same folder gives the same
bytes but for the date in the crate.
"""

from __future__ import annotations

import gzip
import sys
import tarfile
from collections.abc import Iterable, Sequence
from importlib.metadata import version
from pathlib import Path

from tramdva import results
from tramdva.record import crate, run_record
from tramdva.record.run_record import IncompleteRunError, Made


def write(arguments: Sequence[str]) -> Path:
    """Pack the run in the current folder into `tramdva-<version>-<commit>.tar.gz`.

    Parameters
    ----------
    arguments : sequence of str
        Arguments that the run was given, for snakemake.

    Raises
    ------
    IncompleteRunError
        Where files are missing, stale or not made by the pipeline.
    """
    made = crate.write(arguments)
    commit = run_record.commit()
    name = f"tramdva-{version('tramdva')}-{commit[:10] if commit else 'unknown'}"
    path = Path(f"{name}.tar.gz")
    with results.atomically(path) as part:
        pack(part, name, contents(made, crate.configuration_files(made, arguments)))
    return path


def contents(made: Sequence[Made], configuration: Sequence[str] = ()) -> list[str]:
    """List what belongs into the archive of a run, each file once, in alphabetical order.

    Parameters
    ----------
    made : sequence of Made
        Files of the run.
    configuration : sequence of str
        Files that the run read as configuration.

    Raises
    ------
    IncompleteRunError
        Where a file is a link that leads out of the folder.
    """
    files = {crate.NAME, *run_record.sources(configuration)}
    for file in made:
        benchmarks = (str(Path(log).with_suffix(".tsv")) for log in file.log)
        record = run_record.record_of(file.path).as_posix()
        files |= {file.path, record, *file.inputs, *file.log, *benchmarks}
    archives = {path.name for path in Path().glob("tramdva-*.tar.gz")}
    packed = sorted(name for name in files - archives if Path(name).is_file())
    here = Path().resolve()
    if out := [name for name in packed if not Path(name).resolve().is_relative_to(here)]:
        raise IncompleteRunError(
            "\n".join(f"{name}: is a link to {Path(name).resolve()}, outside" for name in out)
        )
    return packed


def pack(target: Path, folder: str, files: Iterable[str]) -> None:
    """Write a compressed archive of files below a folder, without owners and its own date.

    Of a link it holds the file that it leads to.
    """
    with (
        target.open("wb") as raw,
        gzip.GzipFile("", "wb", compresslevel=5, fileobj=raw, mtime=0) as packed,
        tarfile.open(
            fileobj=packed, mode="w", format=tarfile.PAX_FORMAT, dereference=True
        ) as archive,
    ):
        for name in files:
            archive.add(name, f"{folder}/{name}", recursive=False, filter=_without_owner)


def _without_owner(entry: tarfile.TarInfo) -> tarfile.TarInfo:
    entry.uid = entry.gid = 0
    entry.uname = entry.gname = ""
    return entry


if __name__ == "__main__":
    try:
        print(f"tramdva: {write(sys.argv[1:])} holds the sources, the run and its crate")
    except IncompleteRunError as error:
        sys.exit("\n".join(f"tramdva: no archive: {line}" for line in str(error).splitlines()))
