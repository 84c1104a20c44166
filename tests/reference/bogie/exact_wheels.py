"""Forces of the rails on the wheels of a vehicle in a steady curve, on the coordinates of Exudyn.

The vehicle is described in a frame that turns with it about the curve's centre: at steady running
everything rests there but the spins. A rim has six coordinates (x, y, z and Tait-Bryan angles of
`exudyn_vehicle.py`) and a spin rate; its turn about its own axis counts from the hub and does not
tilt it.
"""

from typing import NamedTuple

import exact_contact as contact
import numpy as np
from creep_laws import CreepLaw

# Vehicle's axes (x forward, y left, z up) from Exudyn's here (X left, Y backward, Z up).
TO_VEHICLE = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
# Steps of central differences: m, rad, m/s, rad/s; small beside the patch's scales.
STEPS = np.array([*3 * [2e-8], *3 * [2e-7], *3 * [2e-6], *3 * [2e-6], 2e-5])


class Choice(NamedTuple):
    """Theory of the contact.

    law : 'fastsim' or 'she'; bound : exponents of FASTSIM's traction bound
    skewed : whether the patch follows the true principal curvatures, else those of the silhouette
    """

    law: str = "fastsim"
    bound: tuple = (0.5, 0.75)
    skewed: bool = True


class Result(NamedTuple):
    """A contact: kind, force on the wheel (N), moment about its centre (N m) and what it shows."""

    kind: str
    force: np.ndarray
    moment: np.ndarray
    normal_force: float
    vertical_force: float
    angle: float
    forward_shift: float
    slip: np.ndarray  # m/s along rolling, across, along the normal
    friction_power: float
    normal_power: float
    curvatures: np.ndarray
    turned: float


class Rails:
    """The rails of a left curve and the law of friction."""

    def __init__(self, values, choice, curvature, decrease=None):
        material, self.creep = values["contact_geometry"]["material"], values["creep_force"]
        young, poisson = material["youngs_modulus"], material["poisson_ratio"]
        self.arcs, self.choice = contact.profiles(values), choice
        self.modulus = young / (2.0 * (1.0 - poisson**2))
        self.law = CreepLaw(young, poisson, choice.law, choice.bound)
        self.speed, self.radius = values["track"]["speed"], 1.0 / curvature
        self.turning = np.array([0.0, 0.0, self.speed * curvature])
        self.centre = np.array([0.0, self.radius, 0.0])
        self.spin_rate = self.speed / self.arcs.radius
        self.decrease = self.creep["B"] if decrease is None else decrease

    def friction(self, slip):
        """The paper's falling friction coefficient at a slip in m/s."""
        a = self.creep["A"]
        return self.creep["mu_0"] * ((1.0 - a) * np.exp(-self.decrease * slip) + a)

    def motion(self, place, local):
        """Centre, axis to the left, velocity and rotation of a wheel with its six turns of axes."""
        beta, gamma = local[4:6]
        turn_y = np.array(
            [[np.cos(beta), 0, np.sin(beta)], [0, 1, 0], [-np.sin(beta), 0, np.cos(beta)]]
        )
        axis = TO_VEHICLE @ turn_y @ [np.cos(gamma), np.sin(gamma), 0.0]
        about_y, about_z = TO_VEHICLE[:, 1], TO_VEHICLE @ turn_y[:, 2]
        hub = TO_VEHICLE @ (place + local[:3])
        velocity = np.cross(self.turning, hub - self.centre) + TO_VEHICLE @ local[6:9]
        spin = self.spin_rate + local[12] + local[9]
        rotation = self.turning + about_y * local[10] + about_z * local[11] + spin * axis
        return hub, axis, velocity, rotation, (about_y, about_z)

    def touches(self, side, hub, axis):
        """Contacts (kind, Touch) of a wheel that carry load."""
        found = (
            ("tread", contact.tread_contact(self.arcs, self.radius, side, hub, axis)),
            ("root", contact.root_contact(self.arcs, self.radius, side, hub, axis)),
        )
        return [(kind, t) for kind, t in found if t is not None and t.depth > 0.0]

    def contact(self, kind, touch, side, hub, velocity, rotation):
        """Force, moment and what the contact shows."""
        relative = touch.relative if self.choice.skewed else contact.silhouette(touch.relative)
        patch = contact.hertz(touch.depth, relative, self.modulus)
        arm = touch.point - hub
        material = velocity + np.cross(rotation, arm)
        across = np.cross(touch.normal, touch.rolling)
        slip = np.array([material @ touch.rolling, material @ across, material @ touch.normal])
        rolling_speed = np.linalg.norm(np.cross(self.turning, touch.point - self.centre))
        creepage = (*(slip[:2] / rolling_speed), rotation @ touch.normal / rolling_speed)
        limit = self.friction(np.hypot(*slip[:2])) * patch.force
        f_x, f_y, m_n = self.law.forces(patch.form, limit, creepage)
        tangential = f_x * touch.rolling + f_y * across
        force = patch.force * touch.normal + tangential
        curvatures, directions = np.linalg.eigh(touch.relative)
        first = directions[:, 0] * np.sign(directions[0, 0])
        return Result(
            kind,
            force,
            np.cross(arm, force) + m_n * touch.normal,
            patch.force,
            force[2],
            np.arctan2(-side * touch.normal[1], touch.normal[2]),
            arm @ touch.rolling,
            slip,
            -(f_x * slip[0] + f_y * slip[1] + m_n * (rotation @ touch.normal)),
            patch.force * slip[2],
            curvatures,
            np.arctan2(first[1], first[0]),
        )

    def on_wheel(self, place, side, local):
        """Generalised forces (7,) on the rim's six coordinates and the spin; contacts."""
        hub, axis, velocity, rotation, about = self.motion(place, local)
        out, results = np.zeros(7), []
        for kind, touch in self.touches(side, hub, axis):
            r = self.contact(kind, touch, side, hub, velocity, rotation)
            own = r.moment @ axis
            out[:3] += TO_VEHICLE.T @ r.force
            out[3:] += [own, r.moment @ about[0], r.moment @ about[1], own]
            results.append(r)
        return out, results

    def jacobian(self, place, side, local):
        """Derivatives (7, 13) of `on_wheel` by central differences."""
        columns = []
        for k, step in enumerate(STEPS):
            ends = []
            for sign in (1.0, -1.0):
                shifted = local.copy()
                shifted[k] += sign * step
                ends.append(self.on_wheel(place, side, shifted)[0])
            columns.append((ends[0] - ends[1]) / (2.0 * step))
        return np.array(columns).T

    def precession(self, axis_angles, inertia):
        """Moments on (beta, gamma) of a part that spins while the frame turns with the curve."""
        beta, gamma = axis_angles
        axis = np.array([np.cos(beta) * np.cos(gamma), np.sin(gamma), -np.sin(beta)])
        moment = -inertia * self.spin_rate * np.cross([0.0, 0.0, self.turning[2]], axis)
        return moment[1:]
