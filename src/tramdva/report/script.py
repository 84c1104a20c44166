"""The shared head of the scripts in `paper_figures`."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Callable
from typing import Any

from tramdva import results
from tramdva.report import figures, stamp
from tramdva.report.stamp import Stamp
from tramdva.running import job


def run(main: Callable[..., None], snakemake: Any) -> None:
    """Call the main function of a script as its job in Snakemake says.

    Parameters
    ----------
    main : callable
        Takes, by name, the outputs by their kinds, the inputs by the stages that made them,
        ``cfg``, the values of the configuration, ``code``, the hash of the code, and ``line``.
    snakemake : Snakemake's object of the job
    """
    with job.logging_to(snakemake.log[0]):
        offered = {
            **dict(snakemake.output.items()),
            **dict(snakemake.input.items()),
            **dict(snakemake.params.items()),
            **dict(snakemake.wildcards.items()),
        }
        made = Stamp(snakemake.wildcards.line, snakemake.params.resolution, snakemake.params.origin)
        with stamp.shown(made):
            if reason := no_result(dict(snakemake.input.items())):
                say_nothing(dict(snakemake.output.items()), snakemake.params.cfg, reason)
                return
            main(**{name: offered[name] for name in inspect.signature(main).parameters})


def no_result(files: dict[str, Any]) -> str:
    """Say why a figure has nothing to show: one of its files has no result."""
    single = (path for name, path in files.items() if isinstance(path, str))
    reasons = (results.read_stamps(path).get("no_result", "") for path in single)
    return next((reason for reason in reasons if reason), "")


def say_nothing(outputs: dict[str, str], cfg: dict[str, Any], reason: str) -> None:
    """Make the files of a figure, by their kinds, that say why there is nothing to show."""
    if {"pdf", "png"} <= set(outputs):
        figure = figures.canvas(figures.SINGLE_COLUMN, 60)
        axes = figure.subplots()
        figures.nothing(axes, "\n".join(textwrap.wrap(f"no result: {reason}", 32)))
        figures.save(figure, outputs["pdf"], outputs["png"], f"No result: {cfg.get('label', '')}")
        return
    for kind, path in outputs.items():
        words = f"no result: {reason}\n"
        if kind == "page":
            words = f"<!doctype html><meta charset=utf-8><title>no result</title><p>{words}"
        with results.atomically(path) as part:
            part.write_text(words, encoding="utf-8")
