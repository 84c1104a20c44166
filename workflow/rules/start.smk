"""What happens before and after the rules: configuration, caches, one run at a time, messages."""

import sys
from pathlib import Path

from tramdva.configuration import measured_files
from tramdva.configuration.reading import load_or_exit
from tramdva.record import inventory
from tramdva.running import job, supervision
from tramdva.running.numba_cache import compile_kernels_once, use_numba_cache

ROOT = Path(workflow.current_basedir).parents[1]
settings = workflow.config_settings
configuration = load_or_exit(
    Path("config") if Path("config/config.yaml").is_file() else ROOT / "config",
    settings.configfiles,
    settings.config,
)
LINES = configuration.run.lines
use_numba_cache()
if workflow.is_main_process:
    measured_files.check_or_exit(configuration.measured, configuration.lines)
if supervision.enter_folder(as_job=not workflow.is_main_process):
    inventory.take_back_dates("results", "paper_figures", "logs")
    inventory.set_aside_unusable(configuration, ROOT / "workflow/scripts")


report: "../report/workflow.rst"


onstart:
    coarse = any(
        origins.resolution(line, figure) == "coarse" for line in LINES for figure in FIGURES
    )
    supervision.keep_apart("coarse" if coarse else "full")
    supervision.begin_run("results", "paper_figures", "logs")
    job.stop_polling(workflow)
    compile_kernels_once()
    print(f"tramdva: {', '.join(LINES)}; numbers in results/, figures in paper_figures/")


onsuccess:
    print(job.summary(LINES))


onerror:
    print("tramdva: not all results are complete; logs/<line>/<stage>.log says why.")
    print("A job that died of SIGKILL was killed from outside, mostly for want of memory.")
