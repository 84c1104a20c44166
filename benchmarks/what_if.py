"""What the bogie of `config/lines/worn-40m.yaml` does if one of its values is another.

    python benchmarks/what_if.py

The numbers under "if wrong" of config/README.md, with the full run's numerics: angle of attack,
slip of the front outer flange, frequency and growth rate of the second bending mode of the front
axle without absorbers, the friction decrease B where self-excitation begins, the resilient wheel
mode, and the least stable oscillation with the line's absorbers.
"""

from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np

from tramdva.bogie import modes, tram
from tramdva.bogie.curving import angle_of_attack
from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.contact import patch
from tramdva.running.numba_cache import use_numba_cache
from tramdva.stages import contact_geometry
from tramdva.stages.bogie_sections import bogie_line

LINE = "worn-40m"
CONFIG = Path(__file__).resolve().parents[1] / "config"
LIMITS = (30.0, 200.0)  # Hz
DECREASE = np.linspace(0.0, 1.5, 7)  # s/m
OUTER, MIDDLE = "bogie.axle.outer", "bogie.axle.middle"
LOW_HIGH = (0.8, 1.2)
# Values by key; a tuple of numbers stands for shares of the line's own value.
CHANGES: tuple[tuple[str, Any], ...] = (
    ("creep_force.mu_0", [0.28]),
    ("creep_force.B", LOW_HIGH),
    ("track.radius", [32.0, 50.0]),
    ("track.speed", [5.0, 7.0]),
    ("track.cant", [0.0]),
    ("bogie.car_body.mass", LOW_HIGH),
    (f"{MIDDLE}.mass_per_length", LOW_HIGH),
    (f"{OUTER}.vertical_bending_stiffness", LOW_HIGH),
    (f"{MIDDLE}.vertical_bending_stiffness", LOW_HIGH),
    ("bogie.axle.damping_ratio", (0.7, 1.3)),
    ("bogie.stub.mass", LOW_HIGH),
    ("bogie.wheel.radius", [0.30]),
    ("bogie.wheel.layer.axial_stiffness", LOW_HIGH),
    ("bogie.wheel.layer.tilting_stiffness", LOW_HIGH),
    ("bogie.primary.stiffness.lateral", LOW_HIGH),
    ("bogie.absorber.lateral_position", [0.2, 0.5]),
    ("bogie.absorber.I_T", [20.0]),
    ("bogie.absorber.c_T", LOW_HIGH),
    ("bogie.absorber.d_T", LOW_HIGH),
    ("contact_geometry.wheel.measured", [""]),
    ("contact_geometry.*.measured_noise", [0.0, 1e-5]),
    ("contact_geometry.rail.lateral_position", [-0.006, -0.002]),
    ("contact_geometry.gap_scale", [4e-6]),
    ("contact_geometry.creep_law", ["fastsim"]),
)


def changed(values: dict[str, Any], key: str, value: Any, share: bool) -> dict[str, Any]:
    """Values of a stage with another one; `*` stands for wheel and rail."""
    out = deepcopy(values)
    for kind in ("wheel", "rail") if "*" in key else ("",):
        *path, last = key.replace("*", kind).split(".")
        section = out
        for word in path:
            section = section.get(word, {})
        if last in section:
            section[last] = section[last] * value if share else value
    return out


def told(cfg: dict[str, Any], tables: dict[str, np.ndarray]) -> str:
    """A line about the bogie of these values."""
    line = bogie_line(cfg, tables)
    run = tram.run_through(line)
    if run.equilibrium.status != "converged":
        return run.equilibrium.status
    state, results = run.equilibrium.state, run.equilibrium.results[0]
    found = modes.modes(run.curve, state, LIMITS)
    words = [f"{1e3 * angle_of_attack(run.curve, run.equilibrium)[0]:.1f} mrad"]
    words.append(
        f"slip {results[results[:, patch.NORMAL_FORCE].argmax(), patch.SLIP_VELOCITY]:.3f}"
    )
    for kind in ("second_bending", "resilient_wheel"):
        place = modes.of_front_axle(found, kind)
        if place is not None:
            value = found.eigenvalue[place].real
            words.append(f"{kind} {found.frequency[place]:.1f} Hz {value:+.1f} 1/s")
    rates = [
        modes.critical_of(modes.at_friction(run.curve, state, B), LIMITS).growth_rate
        for B in DECREASE
    ]
    onset = modes.critical_friction_decrease(run.curve, state, LIMITS, DECREASE, np.array(rates))
    words.append(f"critical B {onset:.2f}")
    absorber = line.bogie.absorber
    damped = tram.changed(line, tram.absorber(line, absorber.c_T, absorber.d_T), run)
    least = modes.critical_oscillation(damped.curve, damped.equilibrium.state, LIMITS)
    words.append(f"with absorbers {least.growth_rate:+.1f} 1/s at {least.frequency:.1f} Hz")
    return ", ".join(words)


def main() -> None:
    """Print a line per change."""
    use_numba_cache()
    configuration = load(CONFIG, overrides={"lines": [LINE]})
    cfg, geometry = (
        used_values(configuration, LINE, stage) for stage in ("bogie_modes", "contact_geometry")
    )

    def file_of(name: str) -> Path:
        return CONFIG / name

    tables = contact_geometry.compute(geometry, file_of)
    print(f"as it is: {told(cfg, tables)}", flush=True)
    for key, values in CHANGES:
        for value in values:
            share = isinstance(values, tuple)
            other = changed(geometry, key, value, share)
            own = tables if other == geometry else contact_geometry.compute(other, file_of)
            word = f"x {value:g}" if share else repr(value)
            print(f"{key} {word}: {told(changed(cfg, key, value, share), own)}", flush=True)


if __name__ == "__main__":
    main()
