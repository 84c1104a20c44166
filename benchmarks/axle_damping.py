"""Find the damping ratio of the axle bridge that gives figure 9 its growth rate.

    python benchmarks/axle_damping.py [line] [growth rate in 1/s]

The growth rate is a small difference of large terms, so this one damping is set last, with the
contact tables and grids of the full run. The value goes to `bogie.axle.damping_ratio`.
"""

import sys
from pathlib import Path

from scipy.optimize import brentq

from tramdva.bogie import modes, tram
from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.stages import contact_geometry
from tramdva.stages.bogie_sections import bogie_line

CONFIG = Path(__file__).resolve().parents[1] / "config"


def main(name: str, target: float) -> None:
    """Print the damping ratio and what it gives."""
    configuration = load(CONFIG, overrides={"lines": [name]})
    tables = contact_geometry.compute(used_values(configuration, name, "contact_geometry"))
    cfg = used_values(configuration, name, "bogie_modes")
    line = bogie_line(cfg, tables)
    known = tram.run_through(line)
    limits = (cfg["study"]["frequency"]["min"], cfg["study"]["frequency"]["max"])

    def critical(ratio: float) -> modes.Critical:
        axle = line.bogie.axle.model_copy(update={"damping_ratio": ratio})
        bogie = line.bogie.model_copy(update={"axle": axle})
        run = tram.changed(line._replace(bogie=bogie), None, known)
        return modes.critical_oscillation(run.curve, run.equilibrium.state, limits)

    ratio = brentq(lambda r: critical(r).growth_rate - target, 0.02, 0.06, xtol=1e-7)
    found = critical(ratio)
    print(f"damping ratio {ratio:.6f}: {found.growth_rate:+.4f} 1/s at {found.frequency:.3f} Hz")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "paper", float((sys.argv[2:] or ["0.3"])[0]))
