"""The line at a glance in words: for its page and for the terminal.

``python -m tramdva.report.preflight results/<line>/preflight.nc ...`` prints it.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from tramdva import results
from tramdva.variables.shared import CURVING_WORDS

Section = tuple[str, list[tuple[str, str]]]  # heading; rows of what and value

STATUS_WORDS = CURVING_WORDS | {"converged": "found"}
ABSORBER_WORDS = {"none": "without absorbers", "paper": "with the line's absorber"}
FRICTION_WORDS = {"operation": "in operation", "forced_excitation": "for orders of the wheels"}


def sections(values: Mapping[str, np.ndarray]) -> list[Section]:
    """Say what `preflight.nc` holds: headings with rows of what and value.

    Parameters
    ----------
    values : mapping
        Variables of the file.
    """
    return [
        ("Running in the curve", list(_running(values))),
        ("Contacts without absorbers", list(_contacts(values))),
        ("Vibrations", list(_vibrations(values))),
        ("What a run computes", list(_parts(values))),
    ]


def _running(values: Mapping[str, np.ndarray]) -> Iterator[tuple[str, str]]:
    speed, radius = float(values["speed"]), float(values["radius"])
    yield "curve", f"{radius:.4g} m at {speed:.3g} m/s ({3.6 * speed:.3g} km/h)"
    for row, name in enumerate(values["absorber"]):
        words = STATUS_WORDS[str(values["status"][row])]
        if np.isfinite(values["needed_yaw"][row]):
            words += (
                f": {1e3 * values['needed_yaw'][row]:.1f} mrad of yaw against the rail are needed, "
                f"the tables reach {1e3 * float(values['table_yaw']):.1f} mrad"
            )
        yield f"steady running {ABSORBER_WORDS[str(name)]}", words
    if np.isfinite(values["axle_mass"]).all():
        yield "axle loads on straight track", _joined(values["axle_mass"] / 1e3, ".2f", "t")
    else:
        yield "axle loads on straight track", "no steady running on straight track was found"
    if str(values["status"][0]) == "converged":
        wheels = [str(name).replace("_", " ") for name in values["wheel"]]
        loads = values["wheel_load"][0] / 1e3
        pairs = zip(wheels, loads, strict=True)
        yield "wheel loads in the curve", ", ".join(f"{w} {load:.1f} kN" for w, load in pairs)
        attack = [f"{1e3 * angle:+.1f} mrad" for angle in values["angle_of_attack"][0]]
        yield "angle of attack, front and rear axle, outwards", " and ".join(attack)


def _contacts(values: Mapping[str, np.ndarray]) -> Iterator[tuple[str, str]]:
    if str(values["status"][0]) != "converged":
        yield "contacts", "none: there is no steady running"
        return
    for w, wheel in enumerate(values["wheel"]):
        touching = [
            f"{zone} {values['normal_force'][0, w, z] / 1e3:.1f} kN at "
            f"{1e3 * values['wheel_position'][0, w, z]:+.1f} mm, "
            f"{np.degrees(values['contact_angle'][0, w, z]):.0f} degrees, "
            f"slides at {values['slip_velocity'][0, w, z]:.3f} m/s"
            for z, zone in enumerate(values["zone"])
            if np.isfinite(values["normal_force"][0, w, z])
        ]
        yield str(wheel).replace("_", " "), "; ".join(touching) or "apart"


def _vibrations(values: Mapping[str, np.ndarray]) -> Iterator[tuple[str, str]]:
    if str(values["status"][0]) != "converged":
        yield "modes", "none: there is no steady running to linearise about"
        return
    for i, name in enumerate(values["absorber"]):
        for j, friction in enumerate(values["friction"]):
            rate = float(values["growth_rate"][i, j])
            B = float(values["friction_decrease"][j])
            what = f"{FRICTION_WORDS[str(friction)]} (B = {B:g} s/m), {ABSORBER_WORDS[str(name)]}"
            if np.isnan(rate):
                yield what, "no oscillation in the range of frequencies"
                continue
            verdict = "vibrates by itself" if rate > 0.0 else "dies out"
            mode = str(values["growth_mode"][i, j]).replace("_", " ")
            frequency = float(values["growth_frequency"][i, j])
            yield what, f"{verdict}: {mode}, {frequency:.1f} Hz, {rate:+.2f} 1/s"
    if str(values["critical_mode"]):
        mode = str(values["critical_mode"]).replace("_", " ")
        frequency = float(values["critical_frequency"])
        rate = float(values["critical_growth_rate"])
        yield "critical mode", f"{mode}, {frequency:.1f} Hz, {rate:+.2f} 1/s"
    else:
        yield "critical mode", "no mode in the range of frequencies"


def _parts(values: Mapping[str, np.ndarray]) -> Iterator[tuple[str, str]]:
    rows = zip(
        values["part"], values["part_jobs"], values["part_seconds"], values["part_reason"],
        strict=True,
    )  # fmt: skip
    for part, jobs, seconds, reason in rows:
        files = f"{int(jobs)} file" + ("s" if jobs > 1 else "")
        yield (
            str(part),
            f"no result: {reason}" if str(reason) else f"{files}, about {_time(seconds)}",
        )
    yield "all on one core", f"about {_time(float(np.sum(values['part_seconds'])))}"


def _time(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 90.0 else f"{seconds / 60.0:.0f} min"


def _joined(numbers: Sequence[float], form: str, unit: str) -> str:
    return " and ".join(f"{number:{form}}" for number in numbers) + f" {unit}"


def text(name: str, values: Mapping[str, np.ndarray]) -> str:
    """Return the line at a glance as lines of text."""
    out = [f"{name}"]
    for heading, rows in sections(values):
        out += ["", f"  {heading}"]
        out += [f"    {what}: {value}" for what, value in rows]
    return "\n".join(out)


def main(paths: Sequence[str]) -> None:
    """Print lines at a glance."""
    print("\n\n".join(text(Path(path).parent.name, results.read(path)) for path in paths))


if __name__ == "__main__":
    main(sys.argv[1:])
