"""Speed and numerical damping of the bogie's time integration, on one core.

python benchmarks/bogie.py [line]
"""

import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numba import njit

from tramdva.bogie import integration, modes, ride, tram, wheel_forces
from tramdva.bogie.modal import modal_basis
from tramdva.bogie.tram import BogieLine, Running
from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.stages import contact_geometry
from tramdva.stages.bogie_sections import bogie_line

CONFIG = Path(__file__).resolve().parents[1] / "config"


def seconds(work: Callable[[], object], repeat: int = 3) -> float:
    """Least wall time of a call in s; the first, which may compile, does not count."""
    work()
    times = []
    for _ in range(repeat):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


@njit(nogil=True, error_model="numpy")
def _repeat(count, contacts, curvatures, local, deviation, rate, scratch, results, force):
    for _ in range(count):
        wheel_forces.all_wheel_forces(
            contacts, curvatures, local, deviation, rate, scratch, results, force
        )


def contact_cost(known: Running) -> float:
    """Wall seconds of one evaluation of all contacts in the curve."""
    system = known.curve
    local = system.local(known.equilibrium.state)
    force, zero = np.empty(24), np.zeros((4, len(system.contacts.tables)))
    scratch, results = wheel_forces.workspace(system.contacts)

    arguments = (system.contacts, system.curvatures, local, zero, zero, scratch, results, force)
    return seconds(lambda: _repeat(20000, *arguments)) / 20000


def ride_cost(
    line: BogieLine, known: Running, numerics: dict, entry: float, duration: float
) -> ride.Ride:
    """Ride into the curve as figure 9 does it."""
    route = ride.Route(
        tram.track_line(line, entry * line.track.speed),
        line.track.speed,
        line.bogie.half_wheelbase,
        line.track.gravity,
        (known.straight, known.curve),
        (known.straight_equilibrium, known.equilibrium),
    )
    return ride.ride(
        route, duration, numerics["interval"], numerics["every"], numerics["tolerance"]
    )


def damping_of_scheme(known: Running, limits: tuple[float, float], interval: float) -> float:
    """Growth rate of a small oscillation in the simulation less that of the eigenvalue, 1/s."""
    critical = modes.critical_oscillation(known.curve, known.equilibrium.state, limits)
    basis = modal_basis(known.curve, known.equilibrium)
    z = np.zeros(2 * basis.eigenvalue.size)
    z[np.argmin(np.abs(basis.eigenvalue.imag / (2 * np.pi) - critical.frequency))] = 1e-4
    count = round(5.0 / interval)
    local = np.empty((count, 44))
    results = np.empty((count, 4, len(known.curve.contacts.tables), 1))
    integration.run(
        basis.contact, known.curve.contacts,
        integration.steady(basis.eigenvalue.size, known.curve.curvatures),
        ride.no_excitation(basis, known.curve.contacts),
        integration.step_table(basis.eigenvalue, interval),
        interval, 1e9, 0, 0.0, z, integration.workspace(known.curve.contacts), local, results,
        np.array([1]), 1,
    )  # fmt: skip
    velocity = local[:, 16] + 0.3 * local[:, 18]
    window = round(40 / critical.frequency / interval)
    growth = np.log(np.std(velocity[-window:]) / np.std(velocity[:window]))
    return growth / ((count - window) * interval) - critical.growth_rate


def main(name: str) -> None:
    """Print the speed in the curve and of figure 9, and the damping of the scheme."""
    configuration = load(CONFIG, overrides={"lines": [name]})
    tables = contact_geometry.compute(used_values(configuration, name, "contact_geometry"))
    cfg = used_values(configuration, name, "curve_entry")
    line = bogie_line(cfg, tables)
    known = tram.run_through(line)
    limits = (30.0, 200.0)
    per_call = contact_cost(known)
    numerics, study = cfg["numerics"], cfg["study"]
    print(f"contacts: {1e6 * per_call:.1f} us per evaluation of the four wheels")
    entry, whole = study["entry"], study["duration"]
    walls, counts = [], []
    for duration in (entry + 2.0, whole):
        walls.append(seconds(lambda d=duration: ride_cost(line, known, numerics, entry, d), 1))
        counts.append(ride_cost(line, known, numerics, entry, duration).evaluations)
    later = whole - entry - 2.0
    wall, count = walls[1] - walls[0], counts[1] - counts[0]
    print(
        f"in the curve: {wall / later:.3f} wall s per simulated s, {count / later:.0f} "
        f"evaluations per s, share of contact {100 * count * per_call / wall:.0f} %"
    )
    print(
        f"figure 9: {walls[1]:.1f} s for {whole:g} s, of which {walls[0]:.1f} s up to 2 s after "
        f"the entry; share of contact {100 * counts[1] * per_call / walls[1]:.0f} %"
    )
    for interval in (1e-3, 5e-4, 2.5e-4):
        error = damping_of_scheme(known, limits, interval)
        print(f"step {1e3 * interval:g} ms: growth of the scheme itself {error:+.1e} 1/s")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "paper")
