"""The bogie of a line on its track: absorber designs, systems, equilibria."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from tramdva.bogie import track, wheel_forces
from tramdva.bogie.curve_following import enter_curve
from tramdva.bogie.curving import (
    HUBS,
    Equilibrium,
    System,
    equilibrium,
    near,
    resting_start,
    system_on,
)
from tramdva.bogie.parameters import BareBogie, BogieAbsorber, Track
from tramdva.bogie.vehicle import Vehicle, build_vehicle
from tramdva.contact import patch
from tramdva.contact.parameters import ContactGeometry


class BogieLine(NamedTuple):
    """Parameters of the bogie on its line, as validated sections.

    friction : mu_0, A, B in s/m
    tables : contact tables of the zones
    grid : cells along and strips of the contact patch
    cutoff_frequency : Hz; elements_per_section : of the axle bridge
    """

    bogie: BareBogie
    track: Track
    contact_geometry: ContactGeometry
    friction: tuple[float, float, float]
    tables: tuple
    grid: tuple[int, int]
    cutoff_frequency: float
    elements_per_section: int


def absorber(line: BogieLine, c_T: float, d_T: float) -> BogieAbsorber | None:
    """Absorber of the line with other values; None where these are NaN.

    Parameters
    ----------
    line : BogieLine
    c_T : N m/rad, or N/m of a translating absorber; d_T : N m s/rad, or N s/m
    """
    if np.isnan(c_T):
        return None
    return line.bogie.absorber.model_copy(update={"c_T": float(c_T), "d_T": float(d_T)})


def track_line(line: BogieLine, start: float = 0.0) -> track.TrackLine:
    """Track that begins to curve at `start` (m)."""
    t = line.track
    return track.TrackLine(start, t.transition_length, 1.0 / t.radius, t.cant)


def contacts_of(line: BogieLine) -> wheel_forces.Contacts:
    """Contacts of the vehicle's wheels."""
    material = line.contact_geometry.material
    law = patch.contact_law(
        *line.friction, material.youngs_modulus, material.poisson_ratio, *line.grid,
        method=line.contact_geometry.creep_law,
    )  # fmt: skip
    places = wheel_forces.wheel_places(
        line.bogie.wheel.half_distance,
        line.contact_geometry.wheel.tape_circle_offset,
        line.contact_geometry.rail.lateral_position,
        line.track.speed,
        line.bogie.wheel.radius,
    )
    return wheel_forces.Contacts(line.tables, law, places)


def systems(line: BogieLine, design: BogieAbsorber | None, shares: Iterable[float]) -> list[System]:
    """The vehicle on tracks with shares (of 1) of the full curvature and cant."""
    vehicle = build_vehicle(
        line.bogie, line.track.speed, line.cutoff_frequency, line.elements_per_section, design
    )
    contacts = contacts_of(line)
    return [on_track(line, vehicle, contacts, share) for share in shares]


def on_track(
    line: BogieLine, vehicle: Vehicle, contacts: wheel_forces.Contacts, share: float
) -> System:
    """Put a vehicle on a track with a share (of 1) of the full curvature and cant."""
    full = track_line(line)
    return system_on(
        vehicle,
        contacts,
        full._replace(curvature=share * full.curvature, cant=share * full.cant),
        full.transition + 10.0 * line.bogie.half_wheelbase,
        line.bogie.half_wheelbase,
        line.track.gravity,
    )


class Running(NamedTuple):
    """The vehicle on the straight and in the curve, with its equilibria."""

    straight: System
    straight_equilibrium: Equilibrium
    curve: System
    equilibrium: Equilibrium


def run_through(line: BogieLine) -> Running:
    """Bogie without absorbers, followed from rest on the straight track into the curve.

    Parameters
    ----------
    line : BogieLine

    Examples
    --------
    The bogie of the paper in its curve, with coarse contacts and axles. Its wheels carry all of
    its weight; the front axle heads outwards, the rear one inwards.

    >>> import numpy as np
    >>> from tramdva.bogie.curving import angle_of_attack, wheel_loads
    >>> from tramdva.bogie.published import paper_bogie
    >>> from tramdva.bogie.tram import run_through
    >>> line = paper_bogie(shift_step=1e-4, yaw_nodes=10, grid=(6, 6), cutoff_frequency=300.0)
    >>> run = run_through(line)
    >>> run.equilibrium.status
    'converged'
    >>> print(f"{sum(wheel_loads(run.equilibrium).values()) / 9.81 / 1e3:.1f} t")
    15.0 t
    >>> front, rear = np.degrees(angle_of_attack(run.curve, run.equilibrium))
    >>> print(f"{front:.0f} and {rear:.0f} degrees")
    2 and -2 degrees

    Without absorbers it vibrates by itself: the second bending of its front axle grows.

    >>> from tramdva.bogie.modes import modes
    >>> found = modes(run.curve, run.equilibrium.state, limits=(50.0, 60.0))
    >>> for name, frequency, damping in zip(found.name, found.frequency, found.damping_ratio):
    ...     if "bending" in name:
    ...         print(f"{name}: {frequency:.0f} Hz, grows: {damping < 0.0}")
    second_bending_rear: 56 Hz, grows: False
    second_bending_front: 58 Hz, grows: True
    """
    straight, curve = systems(line, None, (0.0, 1.0))
    resting = equilibrium(straight, resting_start(straight))
    return Running(straight, resting, curve, enter_curve(straight, curve, resting.state))


def changed(line: BogieLine, design: BogieAbsorber | None, known: Running) -> Running:
    """Equilibria of the line with another absorber or friction, from known ones."""
    straight, curve = systems(line, design, (0.0, 1.0))
    return Running(
        straight,
        near(straight, transferred(known.straight, known.straight_equilibrium, straight)),
        curve,
        near(curve, transferred(known.curve, known.equilibrium, curve)),
    )


def transferred(source: System, state: Equilibrium, target: System) -> np.ndarray:
    """State (2 n - 4,) of one vehicle as start for another; m, rad and per s.

    Coordinates of the same name are kept, the others are zero.
    """
    k, n = source.size, target.size
    out = np.zeros(2 * n + HUBS)
    position = dict(zip(source.vehicle.names[:k], state.state[:k], strict=True))
    velocity = dict(zip(source.vehicle.names, state.state[k:], strict=True))
    out[:n] = [position.get(name, 0.0) for name in target.vehicle.names[:n]]
    out[n:] = [velocity.get(name, 0.0) for name in target.vehicle.names]
    return out
