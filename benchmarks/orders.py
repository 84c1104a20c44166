"""CPU time of the jobs of one order: start, simulation, wear; and of the linearised curve.

`python benchmarks/orders.py results/paper` after a run of the pipeline; one core.
"""

import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

os.environ["OMP_NUM_THREADS"] = "1"

from tramdva import results
from tramdva.bogie.stored import stored_bogie
from tramdva.configuration.reading import load
from tramdva.configuration.uses import USES, used_values
from tramdva.evolution.tendency import linear_wear_response, wear_sensitivity
from tramdva.running.numba_cache import use_numba_cache
from tramdva.stages import bogie_simulation, wear
from tramdva.stages.wheels_out_of_round import wearing

use_numba_cache()

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
ORDER = 26
START = """
import time
begin = time.process_time()
from tramdva.running.numba_cache import use_numba_cache
use_numba_cache()
from tramdva import results
from tramdva.stages import {stage}
print(time.process_time() - begin)
"""


def seconds(call, repeats: int = 5) -> float:
    """Median CPU time of a call after a first one."""
    call()
    times = []
    for _ in range(repeats):
        begin = time.process_time()
        call()
        times.append(time.process_time() - begin)
    return statistics.median(times)


def first_call(call) -> float:
    """CPU time of the first call in this process: it loads the kernels."""
    begin = time.process_time()
    call()
    return time.process_time() - begin


def start_of_job(stage: str) -> float:
    """CPU seconds that the imports of a job take in a fresh process."""
    program = [sys.executable, "-c", START.format(stage=stage)]
    ended = subprocess.run(program, capture_output=True, text=True, check=True)
    return float(ended.stdout)


def main(folder: Path) -> None:
    """Print the times."""
    loaded = load(ROOT / "config")
    values = {name: used_values(loaded, "paper", name) for name in USES}
    tables = results.read(folder / "contact_geometry.nc")
    linear = results.read(folder / "bogie_linearisation/none.nc")

    def simulate() -> dict:
        return bogie_simulation.compute(values["bogie_simulation"], ORDER, tables, linear)

    def wear_out() -> dict:
        return wear.compute(values["wear"], history)

    print(f"imports: simulation {start_of_job('bogie_simulation'):.2f} s CPU, "
          f"wear {start_of_job('wear'):.2f} s CPU")  # fmt: skip
    kernels = first_call(simulate)
    history = simulate()
    kernels_of_wear = first_call(wear_out)
    simulation, worn = seconds(simulate), seconds(wear_out)
    print(f"kernels: simulation {kernels - simulation:.2f} s, wear {kernels_of_wear - worn:.2f} s")
    print(f"order {ORDER}: simulation {simulation:.3f} s, wear {worn:.3f} s")
    reading = seconds(lambda: results.read(folder / "contact_geometry.nc"))
    print(f"reading the contact tables: {reading:.3f} s")
    cfg, stored = values["evolution_tendency"], stored_bogie(linear)
    frequency = np.linspace(2.0, 150.0, cfg["numerics"]["frequency_points"])
    wheels = cfg["out_of_roundness"]["wheels"]

    def curve() -> np.ndarray:
        found = wear_sensitivity(stored.bogie, stored.law, wearing(cfg))
        return linear_wear_response(
            stored.bogie, found, frequency, stored.places.speed, stored.wheel_radius, wheels
        )

    print(f"linearised curve, {frequency.size} frequencies: {seconds(curve):.2f} s")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
