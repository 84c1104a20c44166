"""The axle bridge: a flexible beam with dropped centre that carries stubs, hubs and wheels.

Beam elements of Euler and Bernoulli along y (vertical and lateral bending, torsion, axial),
reduced to the six rigid-body motions and the free elastic modes below a frequency. A node has the
displacements x, y, z and the rotations about x, y, z (roll, pitch, yaw).

References
----------
J. S. Przemieniecki, Theory of Matrix Structural Analysis, 1968, sections 5.6 and 11.4.
"""

from __future__ import annotations

from collections.abc import Set
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import scipy  # its parts load when they are used: many short jobs need none

if TYPE_CHECKING:
    from tramdva.bogie.parameters import AxleBridge, BareBogie

X, Y, Z, ROLL, PITCH, YAW = range(6)
NODE = 6
KINDS = ("vertical_bending", "lateral_bending", "torsion", "axial")


class BeamElement(NamedTuple):
    """Properties of one element: stiffnesses in N m^2 (axial N), mass in kg/m, inertia in kg m."""

    length: float
    vertical_stiffness: float
    lateral_stiffness: float
    torsional_stiffness: float
    axial_stiffness: float
    mass: float
    polar_inertia: float


def skew(r: np.ndarray) -> np.ndarray:
    """Matrix (3, 3) of the cross product with r (3,), in its unit: skew(r) @ w = r x w."""
    return np.array([[0.0, -r[2], r[1]], [r[2], 0.0, -r[0]], [-r[1], r[0], 0.0]])


def rigid_offset(offset: np.ndarray) -> np.ndarray:
    """Motion (6,) of a point from the motion of a rigidly connected one at -offset (m): (6, 6)."""
    transfer = np.eye(NODE)
    transfer[:3, 3:] = -skew(np.asarray(offset, float))
    return transfer


def _bending(length: float, stiffness: float, mass: float) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and consistent mass for (w1, w1', w2, w2')."""
    h = length
    k = np.array(
        [
            [12.0, 6 * h, -12.0, 6 * h],
            [6 * h, 4 * h * h, -6 * h, 2 * h * h],
            [-12.0, -6 * h, 12.0, -6 * h],
            [6 * h, 2 * h * h, -6 * h, 4 * h * h],
        ]
    )
    m = np.array(
        [
            [156.0, 22 * h, 54.0, -13 * h],
            [22 * h, 4 * h * h, 13 * h, -3 * h * h],
            [54.0, 13 * h, 156.0, -22 * h],
            [-13 * h, -3 * h * h, -22 * h, 4 * h * h],
        ]
    )
    return stiffness / h**3 * k, mass * h / 420.0 * m


def _rod(length: float, stiffness: float, mass: float) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and consistent mass for two ends of a rod or shaft."""
    k = stiffness / length * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return k, mass * length / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])


# Places and signs of (w1, w1', w2, w2') in an element: z' = roll, x' = -yaw.
_VERTICAL = ([Z, ROLL, NODE + Z, NODE + ROLL], np.array([1.0, 1.0, 1.0, 1.0]))
_LATERAL = ([X, YAW, NODE + X, NODE + YAW], np.array([1.0, -1.0, 1.0, -1.0]))


def element_matrices(element: BeamElement) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Stiffness (12, 12) per kind of deformation and mass (12, 12) of an element along y."""
    e = element
    stiffness = {kind: np.zeros((2 * NODE, 2 * NODE)) for kind in KINDS}
    mass = np.zeros((2 * NODE, 2 * NODE))
    for kind, (places, signs), bending in (
        ("vertical_bending", _VERTICAL, e.vertical_stiffness),
        ("lateral_bending", _LATERAL, e.lateral_stiffness),
    ):
        k, m = _bending(e.length, bending, e.mass)
        grid = np.ix_(places, places)
        stiffness[kind][grid] += np.outer(signs, signs) * k
        mass[grid] += np.outer(signs, signs) * m
    for kind, place, rod, inertia in (
        ("torsion", PITCH, e.torsional_stiffness, e.polar_inertia),
        ("axial", Y, e.axial_stiffness, e.mass),
    ):
        k, m = _rod(e.length, rod, inertia)
        grid = np.ix_([place, NODE + place], [place, NODE + place])
        stiffness[kind][grid] += k
        mass[grid] += m
    return stiffness, mass


class Beam(NamedTuple):
    """Assembled beam: node positions (k,) in m, stiffness per kind and mass (6 k, 6 k)."""

    position: np.ndarray
    stiffness: dict[str, np.ndarray]
    mass: np.ndarray


def assemble_beam(position: np.ndarray, elements: list[BeamElement]) -> Beam:
    """Assemble elements between successive nodes at `position` (k,) in m."""
    size = NODE * position.size
    stiffness = {kind: np.zeros((size, size)) for kind in KINDS}
    mass = np.zeros((size, size))
    for i, element in enumerate(elements):
        part = slice(NODE * i, NODE * (i + 2))
        k, m = element_matrices(element)
        for kind in KINDS:
            stiffness[kind][part, part] += k[kind]
        mass[part, part] += m
    return Beam(position, stiffness, mass)


def carrying_places(bogie: BareBogie) -> set[float]:
    """Distances (m) from the track centre at which the beam carries springs or absorbers."""
    places = {bogie.primary.lateral_position}
    absorber = getattr(bogie, "absorber", None)  # a bogie may be configured without
    if absorber is not None:
        places.add(absorber.lateral_position)
    return places


def stepped_beam(
    axle: AxleBridge, elements_per_section: int, places: Set[float] = frozenset()
) -> Beam:
    """Beam of an axle bridge: outer, middle, outer section; m, kg, N m^2.

    Nodes stand at the ends of sections and at `places` (m from the track centre): a force or
    moment between nodes leaves an error of first order in the length of an element.
    """
    ends = (-axle.half_length, -axle.middle_half_length, axle.middle_half_length, axle.half_length)
    nodes, elements = [ends[0]], []
    for left, right, section in zip(
        ends[:-1], ends[1:], (axle.outer, axle.middle, axle.outer), strict=True
    ):
        inside = {side * y for y in places for side in (-1.0, 1.0) if left < side * y < right}
        for start, end in pairwise(sorted({left, right} | inside)):
            count = max(1, round(elements_per_section * (end - start) / (right - left)))
            grid = np.linspace(start, end, count + 1)
            nodes += list(grid[1:])
            elements += count * [
                BeamElement(
                    grid[1] - grid[0],
                    section.vertical_bending_stiffness,
                    axle.lateral_bending_stiffness,
                    axle.torsional_stiffness,
                    axle.axial_stiffness,
                    section.mass_per_length,
                    axle.polar_inertia_per_length,
                )
            ]
    return assemble_beam(np.array(nodes), elements)


def lump_mass(mass: float, inertia: tuple[float, float, float], offset: np.ndarray) -> np.ndarray:
    """Mass matrix (6, 6) at a node of a body at `offset` (m) with principal inertias (kg m^2)."""
    transfer = rigid_offset(offset)
    return transfer.T @ np.diag([mass] * 3 + list(inertia)) @ transfer


class FlexibleAxle(NamedTuple):
    """Axle bridge in its reduced coordinates: six rigid-body motions, then elastic modes.

    The rigid motions are those of the reference point on the track centre at `height`.

    beam : Beam with nodes at height `beam_height` (m)
    shape : (6 k, 6 + modes), motion of the nodes per coordinate
    mass, stiffness, damping : (6 + modes, 6 + modes)
    stiffness_of_kind : stiffness per kind of deformation
    frequency : (modes,) in Hz of the free axle bridge
    antisymmetric : (modes,) bool, whether the vertical motion of both ends is opposite
    """

    beam: Beam
    beam_height: float
    height: float
    shape: np.ndarray
    mass: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray
    stiffness_of_kind: dict[str, np.ndarray]
    frequency: np.ndarray
    antisymmetric: np.ndarray

    def motion(self, lateral_position: float, height: float) -> np.ndarray:
        """Motion (6, 6 + modes) of a point rigidly connected to the beam's section beside it.

        Beyond the beam the point moves with the end of the beam (cranked arm).
        """
        y = self.beam.position
        place = min(max(lateral_position, y[0]), y[-1])
        i = min(int(np.searchsorted(y, place, side="right")) - 1, y.size - 2)
        at_node = interpolation(y[i + 1] - y[i], (place - y[i]) / (y[i + 1] - y[i]))
        at_node = at_node @ self.shape[NODE * i : NODE * (i + 2)]
        offset = np.array([0.0, lateral_position - place, height - self.beam_height])
        return rigid_offset(offset) @ at_node


def interpolation(length: float, fraction: float) -> np.ndarray:
    """Motion (6, 12) inside an element from that of its ends."""
    t, h = fraction, length
    value = [1 - 3 * t**2 + 2 * t**3, h * (t - 2 * t**2 + t**3), 3 * t**2 - 2 * t**3]
    value.append(h * (t**3 - t**2))
    slope = [6 * (t**2 - t) / h, 1 - 4 * t + 3 * t**2, 6 * (t - t**2) / h, 3 * t**2 - 2 * t]
    out = np.zeros((NODE, 2 * NODE))
    for displacement, rotation, sign, (places, signs) in (
        (Z, ROLL, 1.0, _VERTICAL),
        (X, YAW, -1.0, _LATERAL),
    ):
        out[displacement, places] = signs * value
        out[rotation, places] = sign * signs * slope
    for place in (Y, PITCH):
        out[place, [place, NODE + place]] = 1.0 - t, t
    return out


def rigid_motions(position: np.ndarray, height: float) -> np.ndarray:
    """Motion (6 k, 6) of nodes at `height` (m) over the reference point by its rigid motions."""
    offsets = [np.array([0.0, y, height]) for y in position]
    return np.vstack([rigid_offset(offset) for offset in offsets])


def flexible_axle(
    bogie: BareBogie, cutoff_frequency: float, elements_per_section: int
) -> FlexibleAxle:
    """Axle bridge with stubs and hubs, reduced to its free modes.

    Parameters
    ----------
    bogie : its axle bridge, stubs and wheels
    cutoff_frequency : Hz, elastic modes of the free axle bridge up to here are kept
    elements_per_section : beam elements in each of the three sections

    Notes
    -----
    Damping ratio of mode k: zeta clip(f_k / f_ref, 0.5, 8)^exponent. The hub's inertia about the
    wheel axis does not move with the axle: the hub turns on its bearing.
    """
    axle, stub, wheel = bogie.axle, bogie.stub, bogie.wheel
    beam = stepped_beam(axle, elements_per_section, carrying_places(bogie))
    height = wheel.radius - axle.drop
    mass = beam.mass.copy()
    hub = (wheel.hub.diametral_inertia, 0.0, wheel.hub.diametral_inertia)
    for side, node in ((1.0, beam.position.size - 1), (-1.0, 0)):
        y = beam.position[node]
        at_stub = np.array([0.0, side * stub.lateral_position - y, stub.height - height])
        at_hub = np.array([0.0, side * wheel.half_distance - y, axle.drop])
        part = slice(NODE * node, NODE * (node + 1))
        inertia = (stub.roll_inertia, stub.pitch_inertia, stub.yaw_inertia)
        mass[part, part] += lump_mass(stub.mass, inertia, at_stub)
        mass[part, part] += lump_mass(wheel.hub.mass, hub, at_hub)
    stiffness = sum(beam.stiffness.values())
    square, vectors = scipy.linalg.eigh(stiffness, mass)
    frequency = np.sqrt(np.maximum(square, 0.0)) / (2.0 * np.pi)
    # The first six are rigid-body motions.
    kept = np.flatnonzero(frequency[NODE:] <= cutoff_frequency) + NODE
    shape = np.hstack([rigid_motions(beam.position, -axle.drop), vectors[:, kept]])
    f = frequency[kept]
    ratio = axle.damping_ratio * np.clip(f / axle.damping_reference_frequency, 0.5, 8.0) ** (
        axle.damping_exponent
    )
    elastic = np.concatenate([np.zeros(NODE), 2.0 * ratio * 2.0 * np.pi * f])
    ends = vectors[Z, kept] * vectors[NODE * (beam.position.size - 1) + Z, kept]
    return FlexibleAxle(
        beam,
        height,
        wheel.radius,
        shape,
        shape.T @ mass @ shape,
        np.diag(np.concatenate([np.zeros(NODE), square[kept]])),
        np.diag(elastic),
        {kind: shape.T @ k @ shape for kind, k in beam.stiffness.items()},
        f,
        ends < 0.0,
    )
