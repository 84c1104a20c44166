"""The vehicle: bodies, joints, absorbers and frames of reference, assembled into matrices.

Coordinates are small displacements (x, y, z in m) and rotations (roll, pitch, yaw in rad) relative
to frames that follow the track: car body and bogie frame to the centre frame, axles with their
wheels to the frame of their axle. The traction body pulls the car body: it has no x. Spins are
deviations from V / r_0; that of a rim counts from its hub.

The equations of motion (docs/bogie.md) are

    M v' + (D + G) v + K q = contact forces + loads(frames)

with D from dampers, G from spinning parts, K from springs and from the dampers of the layers that
turn with the wheels.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tramdva.bogie import track
from tramdva.bogie.axle import FlexibleAxle, flexible_axle, rigid_offset
from tramdva.bogie.names import AXLE_OF_WHEEL, AXLES, FORCES, LOCAL, SIDE, WHEELS

if TYPE_CHECKING:
    from tramdva.bogie.parameters import BareBogie, BogieAbsorber


class Vehicle(NamedTuple):
    """Matrices of a vehicle with n coordinates, the spins of the four hubs last.

    mass, damping, gyroscopic, stiffness : (n, n)
    strain : stiffness per class of `ENERGY_CLASSES` and axle ("" where it has none), symmetric
    frame_motion : (n, 9) motion of all coordinates with the frames (`track.FRAMES` x 3)
    rise : (n,) motion with a vertical displacement of everything
    constant_load : (n,) N, N m: drag of the bearings at running speed
    local_position, local_velocity : (44, n), local variables of the contacts from q and v
    force_input : (n, 24), generalised forces from the forces of the contacts
    names : (n,) texts
    axles : flexible axle bridge, the same for both axles
    motion_of : body -> (6, n), its motion at its centre
    spin_rate : rad/s, V / r_0
    """

    mass: np.ndarray
    damping: np.ndarray
    gyroscopic: np.ndarray
    stiffness: np.ndarray
    strain: dict[tuple[str, str], np.ndarray]
    frame_motion: np.ndarray
    rise: np.ndarray
    constant_load: np.ndarray
    local_position: np.ndarray
    local_velocity: np.ndarray
    force_input: np.ndarray
    names: tuple[str, ...]
    axle: FlexibleAxle
    motion_of: dict[str, np.ndarray]
    spin_rate: float


class _Layout:
    """Places of the coordinates and the motion of points (6, n) by them."""

    def __init__(self, axle: FlexibleAxle, absorbers: int):
        self.names: list[str] = []
        self.place: dict[str, slice] = {}
        rigid = ["x", "y", "z", "roll", "pitch", "yaw"]
        modes = [f"mode {k + 1}" for k in range(axle.frequency.size)]
        self._add("car_body", rigid[1:])
        self._add("frame", rigid)
        for name in AXLES:
            self._add(f"{name}_axle", rigid + modes)
        for name in WHEELS:
            self._add(f"{name}_rim", ["x", "y", "z", "roll", "spin from hub", "yaw"])
        for k in range(absorbers):
            self._add(f"{WHEELS[k]}_absorber", ["motion"])
        for name in WHEELS:
            self._add(f"{name}_hub", ["spin"])
        self.size = len(self.names)
        self.axle = axle

    def _add(self, body: str, coordinates: list[str]) -> None:
        start = len(self.names)
        self.names += [f"{body} {c}" for c in coordinates]
        self.place[body] = slice(start, len(self.names))

    def body(self, name: str, offset=(0.0, 0.0, 0.0)) -> np.ndarray:
        """Motion of a point at `offset` (m) from the centre of car body, frame or rim."""
        centre = np.zeros((6, self.size))
        place = self.place[name]
        centre[np.arange(6 - (place.stop - place.start), 6), np.arange(place.start, place.stop)] = 1
        if name.endswith("_rim"):
            centre[4, self.place[name.replace("_rim", "_hub")]] = 1.0
        return rigid_offset(np.asarray(offset)) @ centre

    def on_axle(self, axle: str, lateral_position: float, height: float) -> np.ndarray:
        """Motion of a point of an axle bridge."""
        motion = np.zeros((6, self.size))
        motion[:, self.place[f"{axle}_axle"]] = self.axle.motion(lateral_position, height)
        return motion

    def hub(self, wheel: int, bogie) -> np.ndarray:
        """Motion of a hub: that of the end of the axle, with a spin of its own."""
        side, axle = SIDE[wheel], AXLES[AXLE_OF_WHEEL[wheel]]
        motion = self.on_axle(axle, side * bogie.wheel.half_distance, bogie.wheel.radius)
        motion[4] = 0.0
        motion[4, self.place[f"{WHEELS[wheel]}_hub"]] = 1.0
        return motion


class _Assembly:
    """Sums of the matrices."""

    def __init__(self, size: int):
        self.mass, self.damping, self.gyroscopic, self.circulatory = np.zeros((4, size, size))
        self.strain: dict[tuple[str, str], np.ndarray] = {}

    def add_strain(self, kind: str, axle: str, stiffness: np.ndarray) -> None:
        key = (kind, axle)
        self.strain[key] = self.strain.get(key, 0.0) + stiffness

    def add_body(self, motion: np.ndarray, mass: float, inertia) -> None:
        self.mass += motion.T @ np.diag([mass] * 3 + list(inertia)) @ motion

    def add_bushing(self, kind: str, axle: str, relative, stiffness, damping) -> None:
        """Spring and damper between two points with `relative` motion (6, n)."""
        self.add_strain(kind, axle, relative.T @ np.diag(stiffness) @ relative)
        self.damping += relative.T @ np.diag(damping) @ relative

    def add_spin(self, motion: np.ndarray, angular_momentum: float) -> None:
        """Gyroscopic moment of a part that spins about y."""
        coupling = angular_momentum * np.outer(motion[5], motion[3])
        self.gyroscopic += coupling - coupling.T


def build_vehicle(
    bogie: BareBogie,
    speed: float,
    cutoff_frequency: float,
    elements_per_section: int = 4,
    absorber: BogieAbsorber | None = None,
) -> Vehicle:
    """Assemble the vehicle.

    Parameters
    ----------
    bogie : masses, rubber and axles
    speed : m/s
    cutoff_frequency : Hz, of the axle's elastic modes
    elements_per_section : finite elements per section of the axle bridge
    absorber : of each end of the axles, or None for the bogie without absorbers
    """
    axle = flexible_axle(bogie, cutoff_frequency, elements_per_section)
    layout = _Layout(axle, 0 if absorber is None else 4)
    sums = _Assembly(layout.size)
    _add_car_and_frame(sums, layout, bogie)
    for name, x in zip(AXLES, (bogie.half_wheelbase, -bogie.half_wheelbase), strict=True):
        _add_axle(sums, layout, bogie, name, x)
    spin_rate = speed / bogie.wheel.radius
    constant_load = np.zeros(layout.size)
    for wheel in range(4):
        constant_load += _add_wheel(sums, layout, bogie, wheel, spin_rate)
        if absorber is not None:
            _add_absorber(sums, layout, absorber, wheel)
    frame_motion, rise = _frame_motion(layout, bogie, absorber)
    position, velocity, force_input = _contact_maps(layout)
    bodies = ["car_body", "frame", *(f"{w}_rim" for w in WHEELS)]
    motion_of = {name: layout.body(name) for name in bodies}
    for name in AXLES:
        motion_of[f"{name}_axle"] = layout.on_axle(name, 0.0, bogie.wheel.radius)
    return Vehicle(
        sums.mass,
        sums.damping,
        sums.gyroscopic,
        sum(sums.strain.values()) + sums.circulatory,
        sums.strain,
        frame_motion,
        rise,
        constant_load,
        position,
        velocity,
        force_input,
        tuple(layout.names),
        axle,
        motion_of,
        spin_rate,
    )


def _six(translations, rotations=(0.0, 0.0, 0.0)) -> list[float]:
    t = translations
    return [t.longitudinal, t.lateral, t.vertical, *rotations]


def _add_car_and_frame(sums: _Assembly, layout: _Layout, bogie) -> None:
    car, frame, support, spring = bogie.car_body, bogie.frame, bogie.car_support, bogie.secondary
    for name, body in (("car_body", car), ("frame", frame)):
        inertia = (body.roll_inertia, body.pitch_inertia, body.yaw_inertia)
        sums.add_body(layout.body(name), body.mass, inertia)
    stiffness = [0.0] * 3 + [support.roll_stiffness, support.pitch_stiffness, support.yaw_stiffness]
    damping = [0.0] * 3 + [support.roll_damping, support.pitch_damping, support.yaw_damping]
    sums.add_bushing("car_support", "", layout.body("car_body"), stiffness, damping)
    for side in (-1.0, 1.0):
        y = side * spring.lateral_position
        relative = layout.body("car_body", (0.0, y, spring.height - car.height))
        relative = relative - layout.body("frame", (0.0, y, spring.height - frame.height))
        sums.add_bushing("secondary", "", relative, _six(spring.stiffness), _six(spring.damping))


def _add_axle(sums: _Assembly, layout: _Layout, bogie, name: str, x: float) -> None:
    axle, spring = layout.axle, bogie.primary
    place = layout.place[f"{name}_axle"]
    sums.mass[place, place] += axle.mass
    sums.damping[place, place] += axle.damping
    for kind, part in _axle_strain(axle).items():
        stiffness = np.zeros((layout.size, layout.size))
        stiffness[place, place] = part
        sums.add_strain(kind, name, stiffness)
    for side in (-1.0, 1.0):
        y = side * spring.lateral_position
        relative = layout.on_axle(name, y, spring.height)
        relative = relative - layout.body("frame", (x, y, spring.height - bogie.frame.height))
        stiffness = _six(spring.stiffness, (0.0, spring.pitch_stiffness, 0.0))
        damping = _six(spring.damping, (0.0, spring.pitch_damping, 0.0))
        sums.add_bushing("primary", name, relative, stiffness, damping)


def _axle_strain(axle: FlexibleAxle) -> dict[str, np.ndarray]:
    """Stiffness of the axle per class; vertical bending is split by the symmetry of the modes.

    Symmetric and antisymmetric modes are orthogonal in every kind of deformation.
    """
    kinds = axle.stiffness_of_kind
    antisymmetric = np.concatenate([np.zeros(6), axle.antisymmetric])
    vertical = kinds["vertical_bending"] + kinds["axial"]
    split = np.outer(antisymmetric, antisymmetric)
    return {
        "symmetric_bending": vertical * np.outer(1.0 - antisymmetric, 1.0 - antisymmetric),
        "antisymmetric_bending": vertical * split,
        "lateral_bending": kinds["lateral_bending"],
        "axle_torsion": kinds["torsion"],
    }


def _add_wheel(sums: _Assembly, layout: _Layout, bogie, wheel: int, spin_rate: float) -> np.ndarray:
    """Add rim, layer and spin of a hub; returns the drag of its bearing (n,)."""
    parts, layer = bogie.wheel, bogie.wheel.layer
    hub, rim = layout.hub(wheel, bogie), layout.body(f"{WHEELS[wheel]}_rim")
    diametral, spin = parts.rim.diametral_inertia, parts.rim.spin_inertia
    sums.add_body(rim, parts.rim.mass, (diametral, spin, diametral))
    sums.mass += parts.hub.spin_inertia * np.outer(hub[4], hub[4])
    sums.add_spin(rim, spin * spin_rate)
    sums.add_spin(hub, parts.hub.spin_inertia * spin_rate)
    relative = rim - hub
    stiffness = [layer.radial_stiffness, layer.axial_stiffness, layer.radial_stiffness]
    stiffness += [layer.tilting_stiffness, layer.torsional_stiffness, layer.tilting_stiffness]
    damping = [layer.radial_damping, layer.axial_damping, layer.radial_damping]
    damping += [layer.tilting_damping, layer.torsional_damping, layer.tilting_damping]
    axle = AXLES[AXLE_OF_WHEEL[wheel]]
    sums.add_bushing("resilient_wheel", axle, relative, stiffness, damping)
    # The dampers turn with the wheel: their force is -d (u' - spin x u).
    for first, last, d in ((0, 2, damping[0]), (3, 5, damping[3])):
        coupling = d * spin_rate * np.outer(relative[first], relative[last])
        sums.circulatory += coupling.T - coupling
    bearing = hub[4] - layout.on_axle(axle, SIDE[wheel] * parts.half_distance, parts.radius)[4]
    sums.damping += parts.bearing_damping * np.outer(bearing, bearing)
    return -parts.bearing_damping * spin_rate * bearing


def _absorber_carrier(layout: _Layout, absorber, wheel: int) -> tuple[np.ndarray, np.ndarray]:
    """Motion (6, n) of the axle where an absorber sits, and that part along its direction (n,)."""
    axle = AXLES[AXLE_OF_WHEEL[wheel]]
    point = layout.on_axle(axle, SIDE[wheel] * absorber.lateral_position, absorber.height)
    direction = unit_direction(absorber)
    rows = point[3:] if absorber.motion == "rotation" else point[:3]
    return point, direction @ rows


def absorber_carriers(vehicle: Vehicle, absorber: BogieAbsorber) -> tuple[np.ndarray, np.ndarray]:
    """Where absorbers could be attached to a vehicle without absorbers.

    Parameters
    ----------
    vehicle : with n coordinates
    absorber : its place (m), its direction and how it moves

    Returns
    -------
    along : (4, n), motion of the axles along the absorbers' directions
    across : (k, n), motions that a translating absorber follows as a mass; none if it rotates
    """
    layout = _Layout(vehicle.axle, 0)
    along, across = [], []
    for wheel in range(4):
        point, direction = _absorber_carrier(layout, absorber, wheel)
        along.append(direction)
        if absorber.motion == "translation":
            across += list(np.linalg.svd(unit_direction(absorber)[None])[2][1:] @ point[:3])
    return np.array(along), np.array(across).reshape(-1, layout.size)


def unit_direction(absorber: BogieAbsorber) -> np.ndarray:
    """Direction (3,) of an absorber's motion."""
    d = np.array([absorber.direction.x, absorber.direction.y, absorber.direction.z])
    return d / np.linalg.norm(d)


def _add_absorber(sums: _Assembly, layout: _Layout, absorber, wheel: int) -> None:
    own = np.zeros(layout.size)
    own[layout.place[f"{WHEELS[wheel]}_absorber"]] = 1.0
    point, along = _absorber_carrier(layout, absorber, wheel)
    sums.mass += absorber.I_T * np.outer(own, own)
    if absorber.motion == "translation":
        # Across its direction the absorber's mass moves with the axle.
        direction = unit_direction(absorber)
        across = np.eye(3) - np.outer(direction, direction)
        sums.mass += absorber.I_T * point[:3].T @ across @ point[:3]
    relative = own - along
    axle = AXLES[AXLE_OF_WHEEL[wheel]]
    sums.add_strain("absorber", axle, absorber.c_T * np.outer(relative, relative))
    sums.damping += absorber.d_T * np.outer(relative, relative)


def with_absorber_values(
    vehicle: Vehicle, before: BogieAbsorber, c_T: float, d_T: float
) -> Vehicle:
    """Return the vehicle with another stiffness and damping of its absorbers.

    Parameters
    ----------
    vehicle : built with the absorber `before`
    c_T : N m/rad, or N/m of a translating absorber; d_T : N m s/rad, or N s/m
    """
    parts = {key: part for key, part in vehicle.strain.items() if key[0] == "absorber"}
    unit = sum(parts.values()) / before.c_T
    return vehicle._replace(
        stiffness=vehicle.stiffness + (c_T - before.c_T) * unit,
        damping=vehicle.damping + (d_T - before.d_T) * unit,
        strain=vehicle.strain | {key: c_T / before.c_T * part for key, part in parts.items()},
    )


def _frame_motion(layout: _Layout, bogie, absorber) -> tuple[np.ndarray, np.ndarray]:
    """Motion of the coordinates with their frames (n, 9), and with a rise of everything (n,)."""
    out, rise = np.zeros((layout.size, 9)), np.zeros(layout.size)

    def add(coordinates: np.ndarray, frame: int, place: tuple[float, float]) -> None:
        # Motion (6,) of the point (0, y, z) of a frame per lateral offset, yaw and roll.
        y, z = place
        point = np.array([[0, 1, 0, 0, 0, 0], [-y, 0, 0, 0, 0, 1], [0, -z, y, 1, 0, 0]], float)
        out[:, 3 * frame : 3 * frame + 3] += coordinates @ point.T
        rise[:] += coordinates[:, 2]

    def rigid(name: str) -> np.ndarray:
        coordinates = layout.body(name).T.copy()
        coordinates[:, 4] = 0.0  # spins do not move with the frames
        return coordinates

    add(rigid("car_body"), 0, (0.0, bogie.car_body.height))
    add(rigid("frame"), 0, (0.0, bogie.frame.height))
    for k, name in enumerate(AXLES):
        coordinates = np.zeros((layout.size, 6))
        start = layout.place[f"{name}_axle"].start
        coordinates[start : start + 6] = np.eye(6)
        add(coordinates, k + 1, (0.0, bogie.wheel.radius))
    for wheel, name in enumerate(WHEELS):
        frame = AXLE_OF_WHEEL[wheel] + 1
        place = (SIDE[wheel] * bogie.wheel.half_distance, bogie.wheel.radius)
        add(rigid(f"{name}_rim"), frame, place)
        if absorber is not None:
            coordinates = np.zeros((layout.size, 6))
            part = slice(3, 6) if absorber.motion == "rotation" else slice(0, 3)
            row = layout.place[f"{name}_absorber"].start
            coordinates[row, part] = unit_direction(absorber)
            add(coordinates, frame, (SIDE[wheel] * absorber.lateral_position, absorber.height))
    return out, rise


def _contact_maps(layout: _Layout) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Local variables of the contacts from q and v (44, n) each, forces on coordinates (n, 24)."""
    position, velocity = np.zeros((2, 4 * len(LOCAL), layout.size))
    force = np.zeros((layout.size, 4 * len(FORCES)))
    for wheel, name in enumerate(WHEELS):
        rim = layout.body(f"{name}_rim")
        rows = slice(len(LOCAL) * wheel, len(LOCAL) * (wheel + 1))
        position[rows][:4] = rim[[1, 2, 3, 5]]
        velocity[rows][4:10] = rim
        position[rows][10] = rim[0]
        force[:, len(FORCES) * wheel : len(FORCES) * (wheel + 1)] = rim.T
    return position, velocity, force


def frame_loads(vehicle: Vehicle, frames: track.FrameMotion, gravity: float) -> np.ndarray:
    """Generalised loads (n,) of weight, curvature and cant; gravity in m/s^2."""
    acceleration = frames.acceleration.copy()
    acceleration[:, track.LATERAL] += gravity * frames.gravity
    inertia = vehicle.frame_motion @ acceleration.ravel() + gravity * vehicle.rise
    return (
        vehicle.constant_load
        - vehicle.mass @ inertia
        - vehicle.stiffness @ (vehicle.frame_motion @ frames.offset.ravel())
        - vehicle.damping @ (vehicle.frame_motion @ frames.rate.ravel())
        - vehicle.gyroscopic @ (vehicle.frame_motion @ frames.turning.ravel())
    )
