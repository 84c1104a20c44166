"""The shared head of the scripts in `paper_figures`."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

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
        main(**{name: offered[name] for name in inspect.signature(main).parameters})
