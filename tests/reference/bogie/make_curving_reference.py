"""Steady running in the curve and its stability, on a vehicle built with Exudyn.

    python make_curving_reference.py vehicle_heavy_arms.yaml curving_heavy_arms.csv

(Exudyn 1.13.6, NumPy, SciPy, PyYAML; vehicle: `exudyn_vehicle.py`, contact: `exact_contact.py`,
`creep_laws.py` and `exact_wheels.py`, steady running: `exact_curving.py`.) Rails are exact circles,
wheels turn by finite angles, no approximation for small yaw is made. Tread and root of a wheel may
act side by side; a touch on the flank ends the script. There is no damping and no rounding of
edges in the contact.
"""

import csv
import itertools
import sys
from pathlib import Path

import exact_contact
import exact_wheels
import exudyn as exu
import numpy as np
from exact_curving import Curve, guess, nonlinear, settle, spectrum
from exudyn_vehicle import parameters

CUTOFF = 800.0  # Hz, of an axle bridge's free modes, in the linear structure
LIMITS = (45.0, 65.0)  # Hz, of the second bending mode
WHEELS = ("front_outer", "front_inner", "rear_outer", "rear_inner")
QUIET = 0.4  # s/m, the friction decrease without self-excitation


def attack(curve, rails, q, axle):
    """Angle in rad from the line between an axle's wheels to the curve's radius at its middle."""
    ends = [
        exact_wheels.TO_VEHICLE @ (curve.places[k] + q[curve.rims[k][:3]])
        for k in (2 * axle, 2 * axle + 1)
    ]
    middle, line = 0.5 * (ends[0] + ends[1]), ends[1] - ends[0]
    tangent = np.arctan2(middle[0], rails.radius - middle[1])
    return tangent - np.arctan2(-line[0], line[1])


def running(curve, rails, q, v):
    """Rows (wheel, quantity, value) of steady running."""
    _, results = curve.contacts(rails, q, v)
    for k, contacts in enumerate(results):
        if len(contacts) != 1:
            raise ArithmeticError(f"{WHEELS[k]} touches {len(contacts)} times")
        (r,) = contacts
        local = curve.local(k, q, v)
        hub, axis, *_ = rails.motion(curve.places[k], local)
        side = curve.model.wheels[k].side
        gap = exact_contact.flank_gap(rails.arcs, rails.radius, side, hub, axis)
        if gap < 0.0:
            raise ArithmeticError(f"{WHEELS[k]} touches on the flank, which is not modelled")
        low, high = r.curvatures
        for quantity, value in (
            ("vertical_force_N", r.vertical_force),
            ("normal_force_N", r.normal_force),
            ("contact_angle_rad", r.angle),
            ("forward_shift_m", r.forward_shift),
            ("slip_velocity_m_s", np.hypot(*r.slip[:2])),
            ("normal_velocity_m_s", r.slip[2]),
            ("least_curvature_1_m", low),
            ("largest_curvature_1_m", high),
            ("turned_rad", r.turned),
            ("flank_gap_m", gap),
        ):
            yield WHEELS[k], quantity, value
    for axle, name in enumerate(("front", "rear")):
        yield name, "angle_of_attack_rad", attack(curve, rails, q, axle)
    flat = list(itertools.chain(*results))
    yield "", "friction_power_W", sum(r.friction_power for r in flat)
    yield "", "normal_power_W", sum(r.normal_power for r in flat)


def second_bending(values):
    """Growth rate (1/s) and frequency (Hz) of the least stable motion within LIMITS."""
    frequency = values.imag / (2.0 * np.pi)
    inside = values[(frequency > LIMITS[0]) & (frequency < LIMITS[1])]
    top = inside[np.argmax(inside.real)]
    return ("", "growth_rate_1_s", top.real), ("", "frequency_Hz", top.imag / (2.0 * np.pi))


def rows(values):
    """Rows (structure, law, curvature, B, wheel, quantity, value)."""
    curve, curvature = Curve(values), 1.0 / values["track"]["radius"]
    linear = curve.mass, curve.stiffness, curve.damping
    rails = exact_wheels.Rails(values, exact_wheels.Choice("she"), curvature)
    start = settle(curve, rails, guess(curve, rails), np.zeros(curve.size), 1e-3)
    full = values["creep_force"]["B"]
    for law, skewed, B in itertools.product(("fastsim", "she"), (True, False), (full, QUIET)):
        choice = exact_wheels.Choice(law, skewed=skewed)
        rails = exact_wheels.Rails(values, choice, curvature, B)
        q, v = settle(curve, rails, *start)
        name = "linear", law, "principal" if skewed else "silhouette", B
        for row in running(curve, rails, q, v):
            yield *name, *row
        for row in second_bending(spectrum(curve, rails, q, v, linear, CUTOFF)):
            yield *name, *row
        if (law, skewed, B) == ("fastsim", True, full):
            q, v, structure = nonlinear(curve, rails, q, v)
            for row in running(curve, rails, q, v):
                yield "nonlinear", *name[1:], *row
            for row in second_bending(spectrum(curve, rails, q, v, structure, np.inf)):
                yield "nonlinear", *name[1:], *row


def main(source, target):
    """Write steady running and stability for the theories of contact."""
    values = parameters(source)
    found = list(rows(values))
    with Path(target).open("w", newline="", encoding="utf-8") as file:
        file.write(
            f"# {Path(__file__).name} with Exudyn {exu.config.Version()}, parameters"
            f" {Path(source).name}: steady running in the curve on exact circles\n"
            "# structure: linear (axle bridges' free modes to"
            f" {CUTOFF} Hz) or nonlinear (Exudyn's static solver, all flexibility)\n"
            "# law: FASTSIM (60 x 40 cells, bound (1-y^2)^0.5 (1-x^2)^0.75) or Shen-Hedrick-Elkins"
            "; curvature: true principal ones or those of the silhouette; B in s/m\n"
            f"# growth rate and frequency: least stable motion in {LIMITS} Hz\n"
        )
        table = csv.writer(file)
        table.writerow(["structure", "law", "curvature", "B", "wheel", "quantity", "value"])
        for *name, value in found:
            table.writerow([*name, f"{value:.7g}"])


if __name__ == "__main__":
    main(*sys.argv[1:])
