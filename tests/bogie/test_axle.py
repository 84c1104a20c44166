"""The axle bridge against closed forms and against the same bridge built with Exudyn."""

import csv
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.linalg import eigh

from tramdva.bogie import axle
from tramdva.bogie.parameters import Bogie

REFERENCE = Path(__file__).parents[1] / "reference/bogie"
LENGTH, EI, MASS = 1.2, 2.0e5, 330.0


def uniform_beam(elements: int) -> axle.Beam:
    part = axle.BeamElement(LENGTH / elements, EI, 5e6, 1.2e6, 1e9, MASS, 0.6)
    return axle.assemble_beam(np.linspace(0.0, LENGTH, elements + 1), elements * [part])


def frequencies(stiffness: np.ndarray, mass: np.ndarray, free: np.ndarray) -> np.ndarray:
    grid = np.ix_(free, free)
    return np.sqrt(np.maximum(eigh(stiffness[grid], mass[grid], eigvals_only=True), 0.0))


def test_free_beam_has_its_closed_frequencies():
    beam = uniform_beam(24)
    vertical = np.sort(np.r_[axle.Z : beam.mass.shape[0] : 6, axle.ROLL : beam.mass.shape[0] : 6])
    found = frequencies(beam.stiffness["vertical_bending"], beam.mass, vertical)[2:5]
    roots = np.array([4.730040745, 7.853204624, 10.99560784])  # cos x cosh x = 1
    expected = (roots / LENGTH) ** 2 * np.sqrt(EI / MASS)
    np.testing.assert_allclose(found, expected, rtol=1e-4)  # error of elements, h^4


def test_simply_supported_beam_has_its_closed_frequencies_of_fourth_order():
    errors = []
    for elements in (4, 8):
        beam = uniform_beam(elements)
        size = beam.mass.shape[0]
        vertical = np.sort(np.r_[axle.Z : size : 6, axle.ROLL : size : 6])
        free = np.setdiff1d(vertical, [axle.Z, size - 6 + axle.Z])
        found = frequencies(beam.stiffness["vertical_bending"], beam.mass, free)[0]
        errors.append(found / ((np.pi / LENGTH) ** 2 * np.sqrt(EI / MASS)) - 1.0)
    assert 3.8 < np.log2(errors[0] / errors[1]) < 4.2
    np.testing.assert_allclose(errors[1], (np.pi / 8) ** 4 / 1440.0, rtol=0.05)  # leading term


def test_torsion_and_axial_vibration_of_a_free_rod():
    beam = uniform_beam(40)
    for kind, place, ratio in (("torsion", axle.PITCH, 1.2e6 / 0.6), ("axial", axle.Y, 1e9 / MASS)):
        free = np.arange(place, beam.mass.shape[0], 6)
        found = frequencies(beam.stiffness[kind], beam.mass, free)[1]
        np.testing.assert_allclose(found, np.pi / LENGTH * np.sqrt(ratio), rtol=1e-3)  # h^2


@pytest.fixture(scope="module", params=["heavy_arms", "heavy_middle"])
def on_springs(request):
    """Full axle bridge on its primary springs, fixed to the ground; its half length; reference.

    The heavy middle is the paper's line; `test_vehicle_reference.py` has both in the vehicle.
    """
    name = request.param
    values = yaml.safe_load((REFERENCE / f"vehicle_{name}.yaml").read_text(encoding="utf-8"))
    bogie = Bogie.model_validate(values["bogie"])
    flexible = axle.flexible_axle(bogie, 1e9, 16)
    stiffness, primary = flexible.stiffness.copy(), bogie.primary
    s = primary.stiffness
    diagonal = np.diag([s.longitudinal, s.lateral, s.vertical, 0.0, primary.pitch_stiffness, 0.0])
    for side in (-1.0, 1.0):
        motion = flexible.motion(side * primary.lateral_position, primary.height)
        stiffness += motion.T @ diagonal @ motion
    with (REFERENCE / f"axle_{name}.csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(file))
    expected = {
        kind: np.array([row[1:] for row in rows if row[0] == kind], dtype=float)
        for kind in ("mode", "static")
    }
    return flexible, stiffness, bogie.axle.half_length, expected


def test_frequencies_agree_with_exudyn(on_springs):
    flexible, stiffness, _, expected = on_springs
    found = np.sqrt(eigh(stiffness, flexible.mass, eigvals_only=True))[:14] / (2.0 * np.pi)
    np.testing.assert_allclose(found, expected["mode"][:, 0], rtol=1e-4)


def test_mode_shapes_agree_with_exudyn(on_springs):
    flexible, stiffness, half, reference = on_springs
    _, vectors = eigh(stiffness, flexible.mass)
    ends = [flexible.motion(y, flexible.beam_height)[:3] for y in (half, -half)]
    for mode, expected in enumerate(reference["mode"][:8, 1:]):
        x, y, z = np.array([end @ vectors[:, mode] for end in ends]).T
        found = np.array([y, -x, z]).T.ravel()  # the axes of the reference
        alike = abs(found @ expected) / np.linalg.norm(found) / np.linalg.norm(expected)
        assert alike > 1.0 - 1e-5, mode


def test_static_response_agrees_with_exudyn(on_springs):
    flexible, stiffness, _, expected = on_springs
    wheels = [flexible.motion(y, flexible.height) for y in (0.75, -0.75)]
    moved = np.linalg.solve(stiffness, 1000.0 * wheels[0][2])
    x, y, z = np.array([wheel[:3] @ moved for wheel in wheels]).T
    found = np.array([y, -x, z]).T.ravel()
    np.testing.assert_allclose(found, expected["static"][0, 1:], rtol=1e-4, atol=1e-9)


def test_reduced_axle_keeps_rigid_body_and_modes(bogie):
    full, reduced = (axle.flexible_axle(bogie, cutoff, 4) for cutoff in (1e9, 2000.0))
    assert reduced.frequency.size >= 12
    np.testing.assert_allclose(reduced.frequency, full.frequency[: reduced.frequency.size])
    np.testing.assert_allclose(reduced.mass[:6, :6], full.mass[:6, :6], rtol=1e-12)
    # Elastic modes are orthogonal to rigid motions.
    scale = np.sqrt(np.outer(np.diag(full.mass), np.diag(full.mass)))
    assert np.abs((full.mass / scale)[:6, 6:]).max() < 1e-8


def test_a_point_between_nodes_moves_with_the_beam(bogie):
    flexible = axle.flexible_axle(bogie, 800.0, 4)
    i = 3
    at_node = flexible.motion(flexible.beam.position[i], flexible.beam_height)
    np.testing.assert_allclose(at_node, flexible.shape[6 * i : 6 * i + 6], atol=1e-12)


def test_nodes_stand_where_the_beam_carries_springs_and_absorbers(bogie):
    """A pitching moment between nodes would miss compliance, up to length / (4 GJ)."""
    values = bogie.model_dump()
    values["primary"]["lateral_position"], values["absorber"]["lateral_position"] = 0.5, 0.41
    moved = type(bogie).model_validate(values)
    coarse, fine = (axle.flexible_axle(moved, 1e9, elements) for elements in (4, 16))
    for y in (0.5, 0.41):
        assert np.abs(np.abs(coarse.beam.position) - y).min() < 1e-12
    twists = []
    for flexible in (coarse, fine):
        ends = [flexible.motion(side * 0.5, flexible.beam_height)[axle.PITCH] for side in (1, -1)]
        twist = (ends[0] - ends[1])[6:]
        twists.append(twist @ np.linalg.solve(flexible.stiffness[6:, 6:], twist))
    # Opposite unit moments 1 m apart twist a shaft by 1 / GJ, exactly on any mesh with these nodes.
    np.testing.assert_allclose(twists, 1.0 / bogie.axle.torsional_stiffness, rtol=1e-7)
