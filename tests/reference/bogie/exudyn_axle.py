"""An axle bridge with stubs and hubs, built with Exudyn (1.13.6) from its parameters.

Axes here: X = y of the vehicle (left), Y = -x (backward), Z = z (up). The bridge is a chain of
Exudyn's geometrically exact beams with one integration point; with the shear stiffness 12 EI / h^2
such an element has the stiffness of Euler and Bernoulli's cubic one (MacNeal, Computers &
Structures 8 (1978)). Stubs and hubs are rigid bodies on rigid arms off the end nodes.
"""

from itertools import pairwise
from typing import NamedTuple

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np
from scipy.linalg import eigh

SIDES = (-1.0, 1.0)  # right (outer in a left curve), left
FREE = 6
SMALL = 1e-4  # kg m, rotary inertia of a section: 1e-6 of frequencies; without it mass is singular


def at(x, y, z):
    """Place or direction in the axes of this model from that of the vehicle's."""
    return [y, -x, z]


def mesh(bogie, size):
    """Nodes along the beam: ends of sections, suspension and absorbers fall on nodes."""
    axle = bogie["axle"]
    marks = {axle["middle_half_length"], axle["half_length"]}
    marks |= {bogie["primary"]["lateral_position"], bogie["absorber"]["lateral_position"]}
    marks = sorted(m for m in marks if m <= axle["half_length"])
    marks = [*(-m for m in reversed(marks)), *marks]
    nodes = [np.linspace(a, b, round((b - a) / size + 0.5) + 1)[:-1] for a, b in pairwise(marks)]
    return np.append(np.concatenate(nodes), marks[-1])


def halved(nodes):
    """The mesh with twice the elements."""
    return np.sort(np.concatenate([nodes, 0.5 * (nodes[1:] + nodes[:-1])]))


def _section(bogie, middle, length):
    axle = bogie["axle"]
    own = axle["middle" if abs(middle) < axle["middle_half_length"] else "outer"]
    ei, lateral = own["vertical_bending_stiffness"], axle["lateral_bending_stiffness"]
    beam = exu.BeamSection()
    beam.stiffnessMatrix = np.diag(
        [
            axle["axial_stiffness"],
            12.0 * lateral / length**2,
            12.0 * ei / length**2,
            axle["torsional_stiffness"],
            ei,
            lateral,
        ]
    )
    beam.inertia = np.diag([axle["polar_inertia_per_length"], SMALL, SMALL])
    beam.massPerLength = own["mass_per_length"]
    return beam


class Axle(NamedTuple):
    """Nodes of an axle bridge and where they are along it (m); its height and place x (m)."""

    nodes: list
    position: np.ndarray
    height: float
    x: float

    def node_at(self, y):
        """Node beside a place y: beyond the beam its end."""
        return self.nodes[int(np.argmin(np.abs(self.position - y)))]

    def local(self, y, z):
        """Place off that node, in the axes of this model."""
        near = self.position[int(np.argmin(np.abs(self.position - y)))]
        return [y - near, 0.0, z - self.height]


def _shifted_inertia(mass, pitch, roll, yaw, arm):
    """Inertia (xx, yy, zz, yz, xz, xy) about a node of a body at `arm` off it."""
    j = np.diag([pitch, roll, yaw]) + mass * (np.dot(arm, arm) * np.eye(3) - np.outer(arm, arm))
    return [j[0, 0], j[1, 1], j[2, 2], j[1, 2], j[0, 2], j[0, 1]]


def add_axle(mbs, bogie, x, position):
    """Beam with stubs and hubs (without the hubs' inertia about the wheel axis)."""
    wheel, stub = bogie["wheel"], bogie["stub"]
    height = wheel["radius"] - bogie["axle"]["drop"]
    nodes = [
        mbs.AddNode(
            items.NodeRigidBodyRxyz(referenceCoordinates=[*at(x, y, height), 0.0, 0.0, 0.0])
        )
        for y in position
    ]
    for i, (a, b) in enumerate(pairwise(position)):
        mbs.AddObject(
            items.ObjectBeamGeometricallyExact(
                nodeNumbers=[nodes[i], nodes[i + 1]],
                physicsLength=b - a,
                sectionData=_section(bogie, 0.5 * (a + b), b - a),
            )
        )
    axle = Axle(nodes, position, height, x)
    hub = (wheel["hub"]["mass"], 0.0, *2 * [wheel["hub"]["diametral_inertia"]])
    own = (stub["mass"], stub["pitch_inertia"], stub["roll_inertia"], stub["yaw_inertia"])
    for side in SIDES:
        for (mass, *inertia), y, z in (
            (hub, wheel["half_distance"], wheel["radius"]),
            (own, stub["lateral_position"], stub["height"]),
        ):
            arm = np.array(axle.local(side * y, z))
            mbs.AddObject(
                items.ObjectRigidBody(
                    nodeNumber=axle.node_at(side * y),
                    mass=mass,
                    inertia=_shifted_inertia(mass, *inertia, arm),
                    centerOfMass=arm,
                )
            )
    return axle


def linearised(mbs):
    """Mass, stiffness and damping matrix in the present state, by finite differences of Exudyn."""
    settings = exu.SimulationSettings()
    newton = settings.staticSolver.newton
    # The forces are nearly linear over this step, and rounding of stiff rods stays away from the
    # soft springs.
    newton.numericalDifferentiation.relativeEpsilon = 1e-4
    newton.numericalDifferentiation.minimumCoordinateSize = 1e-2
    return [np.array(m) for m in exu.solver.ComputeLinearizedSystem(mbs, settings)]


def free_modes(bogie, position):
    """Mass matrix, angular frequencies (1/s) and shapes of the free axle bridge."""
    system = exu.SystemContainer()
    mbs = system.AddSystem()
    add_axle(mbs, bogie, 0.0, position)
    mbs.Assemble()
    mass, stiffness, _ = linearised(mbs)
    mass = 0.5 * (mass + mass.T)
    square, shape = eigh(0.5 * (stiffness + stiffness.T), mass)
    return mass, np.sqrt(np.maximum(square, 0.0)), shape


def beam_damping(bogie, position):
    """Damping matrix of an axle bridge from ratios of its free modes."""
    mass, omega, shape = free_modes(bogie, position)
    omega, axle = omega[FREE:], bogie["axle"]
    share = np.clip(omega / (2.0 * np.pi * axle["damping_reference_frequency"]), 0.5, 8.0)
    ratio = axle["damping_ratio"] * share ** axle["damping_exponent"]
    momentum = mass @ shape[:, FREE:]
    return (momentum * (2.0 * ratio * omega)) @ momentum.T
