"""How far the wear of an order follows the linearised bogie: simulated waves of several amplitudes.

    python benchmarks/linearity.py results/paper [line]

after a run of the pipeline. Of the front outer wheel: amplitude of the simulated response over the
linearised one less one, and the effective value of its harmonics over the order's own, in %. Some
minutes on one core.
"""

import os
import sys
from pathlib import Path

import numpy as np

os.environ["OMP_NUM_THREADS"] = "1"

from tramdva import results
from tramdva.configuration.reading import load
from tramdva.configuration.uses import USES, used_values
from tramdva.running.numba_cache import use_numba_cache
from tramdva.stages import bogie_simulation, wear

use_numba_cache()

CONFIG = Path(__file__).resolve().parents[1] / "config"
CASES = (("none", 10), ("none", 26), ("paper", 26), ("none", 34), ("none", 55), ("paper", 55))
AMPLITUDES = (2e-7, 1e-6, 5e-6, 2e-5)  # m


def told(values: dict, linear: dict, tables: dict, order: int, exact: float) -> str:
    """Deviation and harmonics of the outer wheel in words."""
    simulated = bogie_simulation.compute(values["bogie_simulation"], order, tables, linear)
    if str(simulated["status"]) != "periodic":
        return str(simulated["status"])
    worn = wear.compute(values["wear"], simulated)
    deviation = worn["wear_amplitude"][0] / worn["amplitude"] / exact - 1.0
    return f"{100 * deviation:.2g} %; {100 * worn['harmonic_distortion'][0]:.2g} %"


def main(folder: Path, name: str) -> None:
    """Print a row per order and absorber, a column per amplitude."""
    loaded = load(CONFIG, overrides={"lines": [name]})
    values = {stage: used_values(loaded, name, stage) for stage in USES}
    tables = results.read(folder / "contact_geometry.nc")
    known = results.read(folder / "evolution_tendency.nc")
    response = np.hypot(known["order_linearised_real"], known["order_linearised_imag"])
    print("| order, absorbers |", " | ".join(f"{1e6 * a:g} um" for a in AMPLITUDES), "|")
    for absorber, order in CASES:
        linear = results.read(folder / "bogie_linearisation" / f"{absorber}.nc")
        row = list(known["absorber"]).index(absorber)
        exact = response[row, 0, list(known["order"]).index(order)]
        cells = []
        for amplitude in AMPLITUDES:
            values["bogie_simulation"]["out_of_roundness"]["amplitude"] = amplitude
            cells.append(told(values, linear, tables, order, exact))
        print(f"| {order}, {absorber} |", " | ".join(cells), "|", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "paper")
