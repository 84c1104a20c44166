"""Power of a steadily curving vehicle by the places where it enters and leaves, in W."""

from typing import NamedTuple

import numpy as np

from tramdva.bogie.names import AXLE_OF_WHEEL, WHEELS
from tramdva.bogie.wheel_forces import contact_forces
from tramdva.contact import patch


class Power(NamedTuple):
    """Watts; what enters the vehicle counts positive.

    traction : of the body that pulls the car along the track at constant speed
    support : of what stands for the omitted cars, which turns with the track
    rails : of all forces of the rails on the material of the wheels
    friction : of the creep forces and spin moments in the contacts
    normal : (4,) of the normal forces, per wheel
    joints : lost in dampers and bearings
    """

    traction: float
    support: float
    rails: float
    friction: float
    normal: np.ndarray
    joints: float

    @property
    def balance(self) -> float:
        """What enters and is not lost."""
        return self.traction + self.support + self.friction + self.joints


def contact_power(system, local: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Power (4,) of all forces of the rails on the wheels, and that of the creep forces alone.

    The whole counts from the generalised forces and the motion of the wheels in their axle's axes
    over ground; the creep forces' from the creepages.
    """
    force, results = contact_forces(system.contacts, system.curvatures, local)
    places = system.contacts.places
    force, wheel = force.reshape(4, -1), local.reshape(4, -1)
    curvature = system.curvatures[places.axle]
    yaw, x = wheel[:, 3], wheel[:, 10]
    turning = places.speed * curvature
    # The frame's motion where the wheel is, then turned into the axes of the axle.
    across = places.lateral_position * np.sqrt(1.0 - (x / places.lateral_position) ** 2)
    along, sideways = places.speed - turning * (across + wheel[:, 0]), turning * x
    spin = places.spin_rate + wheel[:, 8]
    motion = np.column_stack(
        [
            along * np.cos(yaw) + sideways * np.sin(yaw) + wheel[:, 4],
            sideways * np.cos(yaw) - along * np.sin(yaw) + wheel[:, 5],
            wheel[:, 6],
            wheel[:, 7],
            spin,
            wheel[:, 9] + turning,
        ]
    )
    rolling = (places.speed - turning * places.lateral_position)[:, None]
    friction = rolling * sum(
        results[..., f] * results[..., v]
        for f, v in (
            (patch.LONGITUDINAL_FORCE, patch.LONGITUDINAL_CREEPAGE),
            (patch.LATERAL_FORCE, patch.LATERAL_CREEPAGE),
            (patch.SPIN_MOMENT, patch.SPIN_CREEPAGE),
        )
    )
    return (force * motion).sum(axis=1), friction.sum(axis=1)


def steady_power(system, state: np.ndarray, half_wheelbase: float, support: float) -> Power:
    """Power in a curving equilibrium; `support` : yaw stiffness in N m/rad of the car's support."""
    k, vehicle, places = system.size, system.vehicle, system.contacts.places
    local = system.local(state)
    rails, friction = contact_power(system, local)
    force, _ = contact_forces(system.contacts, system.curvatures, local)
    force, yaw = force.reshape(4, -1), local.reshape(4, -1)[:, 3]
    # From the axes of the axles to those of the track beside them, then of the bogie's centre.
    frame = np.array([half_wheelbase, -half_wheelbase])[list(AXLE_OF_WHEEL)]
    frame = frame * system.curvatures[places.axle]
    forward = force[:, 0] * np.cos(yaw + frame) - force[:, 1] * np.sin(yaw + frame)
    turning = places.speed * system.curvatures[0]
    car_yaw = vehicle.motion_of["car_body"][5, :k] @ state[:k]
    v = state[k:]
    hubs = [vehicle.names.index(f"{name}_hub spin") for name in WHEELS]
    whole = np.zeros(v.size)
    whole[hubs] = vehicle.spin_rate
    drag = vehicle.constant_load[hubs] @ (v[hubs] + vehicle.spin_rate)
    return Power(
        float(-forward.sum() * places.speed),
        float(-support * car_yaw * turning),
        float(rails.sum()),
        float(friction.sum()),
        rails - friction,
        float(drag - (v + whole) @ vehicle.damping @ v),
    )
