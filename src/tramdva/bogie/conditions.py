"""The bogie of a line under other conditions: track, friction, load and rubber that differ.

An equilibrium far from a known one is reached by way of conditions between.
"""

from typing import NamedTuple

import numpy as np

from tramdva.bogie.curving import Equilibrium, System, near
from tramdva.bogie.parameters import BareBogie, BogieAbsorber
from tramdva.bogie.tram import BogieLine, Running, systems, transferred


class Conditions(NamedTuple):
    """Shares of the line's own values: 1 is as configured.

    friction : of mu_0; friction_decrease : of B
    radius, speed : of the track's
    car_body_mass : with its inertia
    wheel_stiffness, wheel_damping : of the rubber layer of the wheels
    primary_stiffness, primary_damping : of the rubber of the primary suspension
    """

    friction: float = 1.0
    friction_decrease: float = 1.0
    radius: float = 1.0
    speed: float = 1.0
    car_body_mass: float = 1.0
    wheel_stiffness: float = 1.0
    wheel_damping: float = 1.0
    primary_stiffness: float = 1.0
    primary_damping: float = 1.0


class State(NamedTuple):
    """A line's bogie in its curve under some conditions.

    line : as configured; conditions : under which `system` and `equilibrium` hold
    """

    line: BogieLine
    conditions: Conditions
    system: System
    equilibrium: Equilibrium


def as_configured(line: BogieLine, run: Running) -> State:
    """State of the line in its curve under its own conditions."""
    return State(line, Conditions(), run.curve, run.equilibrium)


def under(line: BogieLine, conditions: Conditions) -> BogieLine:
    """Line under conditions."""
    mu_0, ratio, decrease = line.friction
    track = line.track.model_copy(
        update={
            "radius": conditions.radius * line.track.radius,
            "speed": conditions.speed * line.track.speed,
        }
    )
    return line._replace(
        bogie=_changed_bogie(line.bogie, conditions),
        track=track,
        friction=(
            conditions.friction * mu_0, ratio, conditions.friction_decrease * decrease
        ),
    )  # fmt: skip


def _changed_bogie(bogie: BareBogie, conditions: Conditions) -> BareBogie:
    car = _scaled(
        bogie.car_body,
        conditions.car_body_mass,
        ("mass", "roll_inertia", "pitch_inertia", "yaw_inertia"),
    )
    layer = bogie.wheel.layer
    for word, share in (
        ("stiffness", conditions.wheel_stiffness),
        ("damping", conditions.wheel_damping),
    ):
        names = [name for name in type(layer).model_fields if name.endswith(word)]
        layer = _scaled(layer, share, names)
    return bogie.model_copy(
        update={
            "car_body": car,
            "wheel": bogie.wheel.model_copy(update={"layer": layer}),
            "primary": _changed_primary(bogie.primary, conditions),
        }
    )


def _changed_primary(primary, conditions: Conditions):
    axes = ("longitudinal", "lateral", "vertical")
    k, d = conditions.primary_stiffness, conditions.primary_damping
    turned = _scaled(_scaled(primary, k, ["pitch_stiffness"]), d, ["pitch_damping"])
    return turned.model_copy(
        update={
            "stiffness": _scaled(primary.stiffness, k, axes),
            "damping": _scaled(primary.damping, d, axes),
        }
    )


def _scaled(section, share: float, names):
    return section.model_copy(update={name: share * getattr(section, name) for name in names})


def reached(
    known: State, conditions: Conditions, design: BogieAbsorber | None = None, halvings: int = 4
) -> State:
    """Equilibrium under other conditions, by way of those between if need be.

    Parameters
    ----------
    known : State, where the way begins
    conditions : wanted
    design : absorber of the bogie, or None
    halvings : of the way, at most
    """
    state = _at(known, conditions, design)
    if state.equilibrium.status == "converged" or halvings == 0:
        return state
    middle = Conditions(*map(float, np.sqrt(np.multiply(known.conditions, conditions))))
    between = reached(known, middle, design, halvings - 1)
    if between.equilibrium.status != "converged":
        return state
    return reached(between, conditions, design, halvings - 1)


def _at(known: State, conditions: Conditions, design) -> State:
    """Equilibrium under other conditions, straight from a known one."""
    (system,) = systems(under(known.line, conditions), design, (1.0,))
    start = transferred(known.system, known.equilibrium, system)
    return State(known.line, conditions, system, near(system, start))
