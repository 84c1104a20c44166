"""Save and load result files: validated, stamped, atomic and bit-identical on rewriting.

A file is written under a temporary name, synchronised and renamed: at no moment does half a file
bear the final name. It holds no dates, so that the same values give the same bytes.
`tramdva.variables` says which variables belong to each file.
"""

from __future__ import annotations

import importlib
import inspect
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from importlib.metadata import version
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

import netCDF4
import numpy as np
from numpy.typing import ArrayLike

from tramdva.running import job, stamps, supervision
from tramdva.running.derived_values import completed, lacking
from tramdva.variables.kinds import Stage, Variable

if TYPE_CHECKING:
    import xarray

COMPRESSION = {"zlib": True, "complevel": 4, "shuffle": True}
QUICK_COMPRESSION = COMPRESSION | {"complevel": 1}
CONTENT = "content_hash"  # the stamp of all others and of the values


def make(snakemake: Any, stage: ModuleType) -> None:
    """Make the result files of a job: the one place where a stage meets Snakemake.

    Parameters
    ----------
    snakemake : Snakemake's object of the job
        Its inputs are files of other stages, by the names of these; one or several each. A job of
        several orders says them in ``params.orders``; its outputs are theirs, and so is each input
        of several files.
    stage : module
        `compute` takes the values of the configuration (``cfg``), the variables of the inputs by
        name and, where it names them, wildcards of the job and ``file_of``, which finds a file that
        the configuration names; it returns the variables that `VARIABLES` describes.
    """
    with job.logging_to(snakemake.log[0]):
        orders = snakemake.params.get("orders", [None])
        shared, own = _inputs(snakemake, batch=snakemake.params.get("orders") is not None)
        cfg, reason = snakemake.params.cfg, ""
        if "basic_model" not in inspect.signature(stage.compute).parameters:
            basic = shared.pop("basic_model", None)
            cfg, reason = completed(cfg, basic), lacking(cfg, basic)
        for place, (order, output) in enumerate(zip(orders, snakemake.output, strict=True)):
            of_order = {name: read(paths[place]) for name, paths in own.items()}
            asked = _asked_for(stage, snakemake, order)
            values = nothing(stage.VARIABLES)
            if not reason:
                values = stage.compute(cfg, **shared, **of_order, **asked)
            save(
                output, stage.VARIABLES, values,
                parameters=snakemake.params.cfg, code=snakemake.params.code, reason=reason,
            )  # fmt: skip


def nothing(stage: Stage) -> dict[str, np.ndarray]:
    """Variables of a stage without a result: arrays without an entry, numbers that are none."""

    def alone(variable: Variable) -> np.ndarray:
        # The last of the states of a variable is the one that is furthest from a result.
        of_kind = {"real": np.nan, "text": "", "truth": False}
        return np.array(of_kind.get(variable.kind, ("", *variable.meanings)[-1]))

    def empty(variable: Variable) -> np.ndarray:
        kinds = {"real": float, "text": "U1", "flag": np.int8, "truth": bool}
        return np.zeros((0,) * len(variable.dimensions), kinds[variable.kind])

    return {
        name: empty(variable) if variable.dimensions else alone(variable)
        for name, variable in stage.variables.items()
    }


def _inputs(snakemake: Any, batch: bool) -> tuple[dict[str, Any], dict[str, Sequence[str]]]:
    """Variables that all files of the job are made from, and the files that each has for itself."""
    given = {name: paths for name, paths in snakemake.input.items() if paths}
    own = {name: paths for name, paths in given.items() if batch and not isinstance(paths, str)}
    shared = {name: _read_all(paths) for name, paths in given.items() if name not in own}
    return shared, own


def _read_all(paths: str | Sequence[str]) -> Any:
    return read(paths) if isinstance(paths, str) else [read(path) for path in paths]


def _asked_for(stage: ModuleType, snakemake: Any, order: int | None) -> dict[str, Any]:
    """What else the stage asks for by name: wildcards, numbers as such, and ``file_of``."""
    offered: dict[str, Any] = {
        name: int(value) if value.isdecimal() else value
        for name, value in snakemake.wildcards.items()
    }
    if order is not None:
        offered["order"] = order
    offered["file_of"] = partial(job.configuration_file, scriptdir=snakemake.scriptdir)
    wanted = inspect.signature(stage.compute).parameters
    return {name: offered[name] for name in wanted if name in offered}


def save(
    path: str | Path,
    stage: Stage,
    values: Mapping[str, ArrayLike],
    *,
    parameters: Mapping[str, Any],
    code: str,
    reason: str = "",
) -> None:
    """Write the result file of a stage.

    Parameters
    ----------
    path : path
        The file; its folder is made where it is missing.
    stage : Stage
        Its name, its title and the description of its variables.
    values : mapping
        All variables of the stage in SI units. Flags may be given as their meanings, truths as
        bool.
    parameters : mapping
        The values that made the results, stamped as JSON.
    code : str
        Hash of the code that made the results.
    reason : str, optional
        Why there is no result, where there is none.

    Raises
    ------
    ValueError
        Where a variable is unknown, missing, of a wrong type, or of a shape that does not fit.
    """
    arrays, lengths = _validated(stage, values)
    own = {
        "title": stage.title,
        "stage": stage.name,
        "tramdva_version": version("tramdva"),
        "packages": stamps.package_versions(),
        "code_hash": code,
        "parameters": json.dumps(parameters, sort_keys=True, ensure_ascii=False, allow_nan=False),
    }
    if reason:
        own["no_result"] = reason
    own[CONTENT] = stamps.content_hash(_as_stored(arrays), _words(own))
    with atomically(path) as part:
        try:
            _write(part, stage, arrays, lengths, own)
        except RuntimeError as error:
            raise OSError(f"{path}: cannot be written, disk full? ({error})") from None


@contextmanager
def atomically(path: str | Path) -> Iterator[Path]:
    """Give a temporary name to write to, which becomes the file when the block succeeds.

    The name of the file thus never stands for half of it.
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    for leftover in path.parent.glob(f".{path.name}.*.part"):
        leftover.unlink(missing_ok=True)
    part = path.parent / f".{path.name}.{os.getpid()}.part"
    try:
        yield part
        with part.open("rb+") as file:
            os.fsync(file.fileno())
        supervision.put_in_place(part, path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def read(path: str | Path) -> dict[str, np.ndarray]:
    """Read a result file into plain arrays, without xarray.

    Returns
    -------
    dict
        Arrays by name as they were saved: truths as bool, flags as their meanings, texts as str.

    Raises
    ------
    ValueError
        Where the file is no complete result of this version of tramdva, or was changed since.
    """
    with _opened(path) as dataset:
        stored = _checked(path, dataset)
        variables = _descriptions()[dataset.stage].variables
        # Texts are checked as letters and read anew as words.
        words = {n: np.asarray(dataset[n][...]) for n, v in variables.items() if v.kind == "text"}
        arrays = stored | words
        return {name: _plain(arrays[name], v) for name, v in variables.items()}


def read_parameters(path: str | Path) -> dict[str, Any]:
    """Return the parameters that made a result file."""
    return json.loads(read_stamps(path)["parameters"])


def read_stamps(path: str | Path) -> dict[str, str]:
    """Return what a result file says about its making: stage, code_hash, parameters and so on."""
    with _opened(path) as dataset:
        return {name: dataset.getncattr(name) for name in dataset.ncattrs()}


def verify(path: str | Path) -> None:
    """Refuse a file whose values are not those that were saved.

    Raises
    ------
    ValueError
        Where the file is no complete result of this version of tramdva, or was changed since.
    """
    with _opened(path) as dataset:
        _checked(path, dataset)


def load(path: str | Path) -> xarray.Dataset:
    """Load a result file as an xarray dataset, flags as the numbers in the file.

    Raises
    ------
    ValueError
        Where the file is no complete result of this version of tramdva.
    """
    import xarray

    _opened(path).close()
    return xarray.load_dataset(path, engine="netcdf4")


def _validated(
    stage: Stage, values: Mapping[str, ArrayLike]
) -> tuple[dict[str, np.ndarray], dict[str, int]]:
    variables = stage.variables
    if unknown := sorted(set(values) - set(variables)):
        raise ValueError(f"{stage.name}: unknown variable {', '.join(unknown)}")
    if missing := sorted(set(variables) - set(values)):
        raise ValueError(f"{stage.name}: missing variable {', '.join(missing)}")
    arrays: dict[str, np.ndarray] = {}
    lengths: dict[str, int] = {}
    for name, variable in variables.items():
        try:
            arrays[name] = _encoded(values[name], variable)
            _fit(arrays[name].shape, variable.dimensions, lengths)
        except ValueError as error:
            raise ValueError(f"{stage.name}: {name}: {error}") from None
    return arrays, lengths


def _fit(shape: tuple[int, ...], dimensions: tuple[str, ...], lengths: dict[str, int]) -> None:
    if len(shape) != len(dimensions):
        raise ValueError(f"has shape {shape}, must have dimensions ({', '.join(dimensions)})")
    for dimension, length in zip(dimensions, shape, strict=True):
        if lengths.setdefault(dimension, length) != length:
            raise ValueError(
                f"has length {length} along {dimension}, others have {lengths[dimension]}"
            )


def _encoded(value: ArrayLike, variable: Variable) -> np.ndarray:
    """Return a value as its array in the file; texts as bytes of fixed length."""
    if np.ma.isMaskedArray(value):
        raise ValueError("is a masked array: use NaN and a status")
    array = np.asarray(value)
    if variable.kind == "text":
        return _encoded_text(array)
    if variable.kind == "real":
        if array.dtype.kind not in "fiu":
            raise ValueError(f"must be real numbers, not {array.dtype}")
        return array.astype(np.float64)
    return _encoded_flag(array, variable.meanings)


def _encoded_text(array: np.ndarray) -> np.ndarray:
    if array.size and array.dtype.kind not in "UOT":
        raise ValueError(f"must be texts, not {array.dtype}")
    encoded = [str(item).encode() for item in array.ravel()]
    length = max([1, *map(len, encoded)])
    return np.array(encoded, dtype=f"S{length}").reshape(array.shape)


def _encoded_flag(array: np.ndarray, meanings: tuple[str, ...]) -> np.ndarray:
    if array.dtype.kind in "UOT":
        if wrong := sorted(set(map(str, array.ravel())) - set(meanings)):
            raise ValueError(f"{', '.join(wrong)} is none of {', '.join(meanings)}")
        codes = [meanings.index(str(item)) for item in array.ravel()]
        return np.array(codes, dtype=np.int8).reshape(array.shape)
    if array.size and array.dtype.kind not in "biu":
        raise ValueError(f"must be flags, not {array.dtype}")
    if array.size and (array.min() < 0 or array.max() >= len(meanings)):
        raise ValueError(f"must be between 0 and {len(meanings) - 1}")
    return array.astype(np.int8)


def _as_stored(arrays: Mapping[str, np.ndarray]) -> Iterator[tuple[str, np.ndarray]]:
    """Yield arrays as they are read without their meanings: texts as single letters."""
    for name, array in arrays.items():
        yield name, np.frombuffer(array.tobytes(), "S1") if array.dtype.kind == "S" else array


def _words(own: Mapping[str, str]) -> str:
    return json.dumps({name: own[name] for name in sorted(own) if name != CONTENT})


def _checked(path: str | Path, dataset: netCDF4.Dataset) -> dict[str, np.ndarray]:
    """Arrays as they are stored, read once, if they are those that were saved."""
    names = _descriptions()[dataset.stage].variables
    dataset.set_auto_chartostring(False)
    stored = {name: np.asarray(dataset[name][...]) for name in names}
    own = {name: dataset.getncattr(name) for name in dataset.ncattrs()}
    if own.get(CONTENT) != stamps.content_hash(stored.items(), _words(own)):
        raise ValueError(
            f"{path}: its values are not those that were saved: it was changed afterwards; remove "
            "it and run the pipeline again"
        )
    dataset.set_auto_chartostring(True)
    return stored


def _write(
    path: Path,
    stage: Stage,
    arrays: Mapping[str, np.ndarray],
    lengths: Mapping[str, int],
    own: Mapping[str, str],
) -> None:
    with netCDF4.Dataset(path, "w", format="NETCDF4") as dataset:
        dataset.setncatts(own)
        for dimension, length in lengths.items():
            dataset.createDimension(dimension, length)
        for name, variable in stage.variables.items():
            _add(dataset, name, variable, arrays[name], name in stage.by_plane)


def _add(
    dataset: netCDF4.Dataset, name: str, variable: Variable, array: np.ndarray, by_plane: bool
) -> None:
    dimensions = variable.dimensions
    if variable.kind == "text":
        length = array.dtype.itemsize
        characters = f"string{length}"
        if characters not in dataset.dimensions:
            dataset.createDimension(characters, length)
        dimensions = (*dimensions, characters)
        array = np.frombuffer(array.tobytes(), "S1").reshape(*array.shape, length)
    how = COMPRESSION
    if by_plane:
        *first, rows, columns, _ = array.shape
        how = QUICK_COMPRESSION | {"chunksizes": (*[1] * len(first), rows, columns, 1)}
    target = dataset.createVariable(name, array.dtype, dimensions, **how)
    if array.size:
        target[...] = array
    target.setncatts({"long_name": variable.long_name, "units": variable.unit})
    if variable.kind == "text":
        target.setncattr("_Encoding", "utf-8")
    if variable.meanings:
        target.flag_values = np.arange(len(variable.meanings), dtype=np.int8)
        target.flag_meanings = " ".join(variable.meanings)


def _opened(path: str | Path) -> netCDF4.Dataset:
    if not Path(path).is_file():
        raise ValueError(f"{path}: there is no such file")
    try:
        dataset = netCDF4.Dataset(path)
    except OSError as error:
        raise ValueError(f"{path}: is no complete netCDF file ({error.strerror})") from None
    dataset.set_auto_mask(False)
    stage = _descriptions().get(getattr(dataset, "stage", ""))
    if stage is None or not hasattr(dataset, "parameters"):
        dataset.close()
        raise ValueError(f"{path}: is no result of tramdva")
    if missing := sorted(set(stage.variables) - set(dataset.variables)):
        dataset.close()
        raise ValueError(f"{path}: lacks {', '.join(missing)}: made by another version")
    return dataset


def _descriptions() -> dict[str, Stage]:
    """Descriptions of all result files, by the names of their stages.

    Imported by name, so that the hash of a stage's code does not reach the variables of all others:
    where those of a file that it reads change, that file is made again, and the stage after it.
    """
    return importlib.import_module("tramdva.variables.registry").STAGES


def _plain(array: np.ndarray, variable: Variable) -> np.ndarray:
    if variable.kind == "truth":
        return array.astype(bool)
    if variable.kind == "flag":
        return np.array(variable.meanings)[array]
    return array
