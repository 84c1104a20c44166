"""All code and values behind a file, in one hash that needs no run to be known.

A figure bears it in its corner and in its metadata; where code or configuration changed since, that
of today differs: so a picture that is kept tells whether it is of this code.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from tramdva.configuration.reading import Configuration
from tramdva.configuration.uses import USES, stages_read, used_values
from tramdva.running.code_hash import code_hash

SNAKEFILE = "Snakefile"
TABLES = ("STAGES", "JOBS", "FIGURES")
MARK = "tramdva origin"  # name of the metadata of a PNG
WORDS = "Source"  # name of the metadata with the words of the stamp
DIGITS = 12


class Origins:
    """Origins of the stages and figures of a configuration.

    Parameters
    ----------
    configuration : Configuration
    tables : mapping
        ``STAGES``, ``JOBS`` and ``FIGURES`` of the Snakefile, whose entries begin with what each
        reads.
    root : Path
        Folder of the checkout.
    """

    def __init__(
        self, configuration: Configuration, tables: Mapping[str, Mapping], root: Path
    ) -> None:
        self._configuration = configuration
        self._reads = {n: entry[0] for table in TABLES for n, entry in tables[table].items()}
        self._scripts = {
            name: root / ("paper_figures" if table == "FIGURES" else "workflow/scripts")
            for table in TABLES
            for name in tables[table]
        }
        self._known: dict[tuple[str, str], str] = {}
        self._tables, self._root = tables, root
        self._full: Origins | None = None  # of the numerics of `config.yaml`

    def of(self, line: str, name: str) -> str:
        """Return the origin of a stage or figure of a line, in hexadecimal digits."""
        if (line, name) not in self._known:
            digest = hashlib.sha256(code_hash(self._scripts[name] / f"{name}.py").encode())
            for part in self._values(line, name):
                digest.update(part.encode())
            for read in self._read_by(line, name):
                digest.update(self.of(line, read).encode())
            self._known[line, name] = digest.hexdigest()[:DIGITS]
        return self._known[line, name]

    def _read_by(self, line: str, name: str) -> Sequence[str]:
        """Stages that a stage or figure of this line reads."""
        return stages_read(self._configuration, line, name, self._reads[name])

    def resolution(self, line: str, name: str) -> str:
        """Return `full` where all numerics behind a file are those of `config.yaml`, else `coarse`.

        Parameters
        ----------
        line, name : str
            The line, and the stage or figure.
        """
        if self._full is None:
            whole = replace(self._configuration, run=self._configuration.own_run)
            self._full = Origins(whole, self._tables, self._root)
        return "full" if self._full.of(line, name) == self.of(line, name) else "coarse"

    def _values(self, line: str, name: str) -> Iterator[str]:
        """Values that a stage uses; one of many jobs may use others for each absorber."""
        names = [name] if name in USES else [use for use in USES if use.startswith(f"{name}_")]
        for use in names:
            yield json.dumps(used_values(self._configuration, line, use), sort_keys=True)


def tables_of(snakefile: Path) -> dict[str, Mapping[str, Sequence]]:
    """Return the tables of a Snakefile, which are plain Python before its first `include`."""
    head = snakefile.read_text(encoding="utf-8").partition("\ninclude:")[0]
    found: dict[str, Mapping[str, Sequence]] = {}
    exec(compile(head, str(snakefile), "exec"), found)  # code of this checkout, as the rest of it
    return {name: found[name] for name in TABLES}


def of_picture(path: Path, name: str = MARK) -> str:
    """Return the origin that a PNG bears, or other metadata; nothing where it bears none.

    Chunks before the picture itself are read: length, name, content, checksum.
    """
    with path.open("rb") as file:
        file.seek(8)
        while head := file.read(8):
            length, kind = int.from_bytes(head[:4], "big"), head[4:]
            if kind == b"IDAT":
                return ""
            content = file.read(length)
            file.seek(4, 1)
            key, _, value = content.partition(b"\0")
            if kind == b"tEXt" and key == name.encode():
                return value.decode("latin-1")
    return ""


def outdated(configuration: Configuration, folder: Path, root: Path) -> list[str]:
    """Name the pictures of a folder `<line>/` that are not of this code and configuration.

    Parameters
    ----------
    configuration : Configuration
    folder : Path
        Holds a folder of pictures for each line.
    root : Path
        Of the checkout.
    """
    tables = tables_of(root / SNAKEFILE)
    origins = Origins(configuration, tables, root)
    return [
        path.as_posix()
        for line in configuration.lines
        for path in sorted((folder / line).glob("*.png"))
        if path.stem in tables["FIGURES"] and of_picture(path) != origins.of(line, path.stem)
    ]
