"""The whole vehicle against an independent model built with Exudyn.

The models share parameters alone: `tests/reference/bogie/vehicle_*.yaml`.
"""

import csv
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.linalg import eigh

from tramdva.bogie.axle import rigid_offset
from tramdva.bogie.names import WHEELS
from tramdva.bogie.parameters import Bogie
from tramdva.bogie.vehicle import build_vehicle

REFERENCE = Path(__file__).parents[1] / "reference/bogie"
VEHICLES = ("heavy_arms", "heavy_middle")
# Under front right, front left, rear right, rear left wheel along x, y, z: N/m and N s/m.
STIFFNESS = np.array(
    [(2e6, 4e7, 1e9), (1e6, 5e6, 0.9e9), (3e6, 1e7, 1.1e9), (4e6, 2e7, 0.8e9)]
)  # fmt: skip
DAMPING = np.array([(9e3, 6e3, 2e3), (8e3, 9e3, 1e3), (7e3, 5e3, 1.5e3), (6e3, 8e3, 0.5e3)])


def parameters(name: str) -> dict:
    return yaml.safe_load((REFERENCE / f"vehicle_{name}.yaml").read_text(encoding="utf-8"))


def rows(path: str) -> list[dict[str, str]]:
    with (REFERENCE / path).open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def on_springs(bogie: Bogie, speed: float, cutoff: float, absorber) -> tuple[np.ndarray, ...]:
    """Mass, damping and stiffness of the vehicle on springs at its wheels; a fine mesh."""
    vehicle = build_vehicle(bogie, speed, cutoff, 16, absorber)
    stiffness, damping = vehicle.stiffness.copy(), vehicle.damping + vehicle.gyroscopic
    below = rigid_offset(np.array([0.0, 0.0, -bogie.wheel.radius]))
    for wheel, k, d in zip(WHEELS, STIFFNESS, DAMPING, strict=True):
        point = (below @ vehicle.motion_of[f"{wheel}_rim"])[:3]
        stiffness += point.T @ np.diag(k) @ point
        damping += point.T @ np.diag(d) @ point
    return vehicle.mass, damping, stiffness


def reference_eigenvalues(name: str, absorbers: bool, kind: str) -> np.ndarray:
    chosen = [
        row
        for row in rows(f"structure_{name}.csv")
        if row["absorbers"] == str(int(absorbers)) and row["kind"] == kind
    ]
    frequency, real, error = (
        np.array([float(row[column]) for row in chosen])
        for column in ("frequency_Hz", "real_part", "error")
    )
    # All to 300 Hz: a list that is cut short would agree with anything.
    assert len(chosen) > 40
    assert frequency[-1] > 240.0
    assert (error < 5e-5 * 2.0 * np.pi * frequency).all()
    return real + 2j * np.pi * frequency


@pytest.mark.parametrize("absorbers", [False, True])
@pytest.mark.parametrize("name", VEHICLES)
def test_undamped_frequencies_to_300_hz_agree_with_exudyn(name, absorbers):
    """All flexibility of the axle bridges; both meshes are fine enough not to count."""
    values = parameters(name)
    bogie = Bogie.model_validate(values["bogie"])
    expected = reference_eigenvalues(name, absorbers, "undamped").imag
    mass, _, stiffness = on_springs(bogie, 4.0, 1e9, bogie.absorber if absorbers else None)
    # Without rubber that turns with the wheels the stiffness is symmetric.
    square = eigh(0.5 * (stiffness + stiffness.T), mass, eigvals_only=True)
    found = np.sqrt(square)
    assert found[expected.size] > 2.0 * np.pi * 300.0
    np.testing.assert_allclose(found[: expected.size], expected, rtol=1e-4)


@pytest.mark.parametrize("absorbers", [False, True])
@pytest.mark.parametrize("name", VEHICLES)
def test_damped_eigenvalues_to_300_hz_agree_with_exudyn(name, absorbers):
    """With modal damping of the axle bridges to 800 Hz, gyroscopic moments and turning rubber."""
    values = parameters(name)
    bogie = Bogie.model_validate(values["bogie"])
    absorber = bogie.absorber if absorbers else None
    expected = reference_eigenvalues(name, absorbers, "damped")
    mass, damping, stiffness = on_springs(bogie, values["track"]["speed"], 800.0, absorber)
    inverse, unit = np.linalg.inv(mass), np.eye(len(mass))
    matrix = np.block([[0.0 * unit, unit], [-inverse @ stiffness, -inverse @ damping]])
    found = np.linalg.eigvals(matrix)
    found = found[found.imag > 1e-3]
    found = found[np.argsort(found.imag)]
    assert found[expected.size].imag > 2.0 * np.pi * 300.0
    np.testing.assert_allclose(found[: expected.size], expected, rtol=1e-4)
