"""Eigenvalues of the whole vehicle on springs at its wheels, built with Exudyn.

    python make_structure_reference.py vehicle_heavy_arms.yaml structure_heavy_arms.csv

(Exudyn 1.13.6, NumPy, SciPy, PyYAML; the model is in `exudyn_vehicle.py`.) Each wheel stands on
three springs and dampers under its centre, which differ from wheel to wheel, so that no two modes
coincide. Three meshes, each with twice the elements of the one before, are extrapolated to none.
Two problems:

* undamped: mass and stiffness alone, with all flexibility of the axle bridges;
* damped: with dampers and modal damping of the bridges, with gyroscopic moments and rubber that
  turns with the wheels at the speed of the parameters. The bridges have their free modes to CUTOFF
  only: the ratios of higher ones would be a guess, and their sum converges slowly.
"""

import csv
import sys
from pathlib import Path

import exudyn as exu
import exudyn.itemInterface as items
import exudyn_axle
import exudyn_vehicle as vehicle
import numpy as np
from scipy.linalg import eigh

# Per wheel: front right, front left, rear right, rear left; N/m and N s/m along x, y, z.
STIFFNESS = [
    (2.0e6, 4.0e7, 1.0e9), (1.0e6, 5.0e6, 0.9e9), (3.0e6, 1.0e7, 1.1e9), (4.0e6, 2.0e7, 0.8e9),
]  # fmt: skip
DAMPING = [
    (9.0e3, 6.0e3, 2.0e3), (8.0e3, 9.0e3, 1.0e3), (7.0e3, 5.0e3, 1.5e3), (6.0e3, 8.0e3, 0.5e3),
]  # fmt: skip
LIMIT = 300.0  # Hz
CUTOFF = 800.0  # Hz, of the free modes of an axle bridge in the damped problem
COARSE = 0.04  # m, longest element of the coarsest mesh


def matrices(values, position, absorbers):
    """The vehicle on its springs, and its mass, stiffness and damping."""
    model = vehicle.build(values, position, absorbers)
    mbs, radius = model.mbs, values["bogie"]["wheel"]["radius"]
    # The point under a wheel moves with the rim's six coordinates and with the spin of the hub.
    point = np.zeros((3, 7))
    point[:, :3] = np.eye(3)
    point[:, 3:6] = np.cross(np.eye(3), [0.0, 0.0, -radius]).T
    point[:, 6] = point[:, 3]
    for wheel, stiffness, damping in zip(model.wheels, STIFFNESS, DAMPING, strict=True):
        k, d = (np.diag(np.array(v)[[1, 0, 2]]) for v in (stiffness, damping))
        mbs.AddObject(
            items.ObjectGenericODE2(
                nodeNumbers=[wheel.rim, wheel.spin],
                stiffnessMatrix=point.T @ k @ point,
                dampingMatrix=point.T @ d @ point,
            )
        )
    mbs.Assemble()
    return model, exudyn_axle.linearised(mbs)


def spectra(values, position, absorbers):
    """Eigenvalues in 1/s by rising frequency of the undamped and of the damped vehicle."""
    model, (mass, stiffness, damping) = matrices(values, position, absorbers)
    # Exudyn's Y of the car body is -x: the car body is pulled at constant speed.
    pulled = vehicle.first_coordinate(model.mbs, model.car) + 1
    kept = np.delete(np.arange(len(mass)), pulled)
    # As largest 1 / omega^2, the low ones keep their digits beside stiff rods.
    inverse = eigh(*(0.5 * (m + m.T)[np.ix_(kept, kept)] for m in (mass, stiffness)),
                   eigvals_only=True)[::-1]  # fmt: skip
    shape = vehicle.reduction(model, values, CUTOFF)[kept]
    shape = shape[:, shape.any(axis=0)]
    m, k, d = (shape.T @ a[np.ix_(kept, kept)] @ shape for a in (mass, stiffness, damping))
    state = np.block([[np.zeros_like(m), np.eye(len(m))], [-np.linalg.solve(m, np.hstack([k, d]))]])
    damped = np.linalg.eigvals(state)
    damped = damped[damped.imag > 1e-3]
    return 1j / np.sqrt(inverse[inverse > 1e-9]), damped[np.argsort(damped.imag)]


def extrapolated(values, absorbers):
    """Both spectra to LIMIT without error of the mesh, and the last change of extrapolation."""
    position, levels = exudyn_axle.mesh(values["bogie"], COARSE), []
    for _ in range(3):
        levels.append(spectra(values, position, absorbers))
        position = exudyn_axle.halved(position)
    out = []
    for kind in range(2):
        size = min(len(level[kind]) for level in levels)
        coarse, middle, fine = (level[kind][:size] for level in levels)
        first, second = (4.0 * middle - coarse) / 3.0, (4.0 * fine - middle) / 3.0
        best = (16.0 * second - first) / 15.0
        inside = best.imag < 2.0 * np.pi * LIMIT
        out.append((best[inside], np.abs(best - second)[inside]))
    return out


def main(source, target):
    """Write eigenvalues without and with absorbers."""
    values = vehicle.parameters(source)
    found = [extrapolated(values, absorbers) for absorbers in (False, True)]
    with Path(target).open("w", newline="", encoding="utf-8") as file:
        file.write(
            f"# {Path(__file__).name} with Exudyn {exu.config.Version()}, parameters"
            f" {Path(source).name}: eigenvalues of the vehicle on springs at its wheels\n"
            f"# springs {STIFFNESS} N/m, dampers {DAMPING} N s/m along x, y, z under front right,"
            " front left, rear right, rear left wheel\n"
            f"# undamped: all flexibility of the axle bridges; damped: their free modes to {CUTOFF}"
            " Hz. error: last change by extrapolation of the mesh, 1/s\n"
        )
        table = csv.writer(file)
        table.writerow(["absorbers", "kind", "frequency_Hz", "real_part", "error"])
        for absorbers, spectra_ in enumerate(found):
            for kind, (value, error) in zip(("undamped", "damped"), spectra_, strict=True):
                for v, e in zip(value, error, strict=True):
                    frequency = v.imag / (2.0 * np.pi)
                    row = [absorbers, kind, f"{frequency:.7f}", f"{v.real:.7f}", f"{e:.1e}"]
                    table.writerow(row)


if __name__ == "__main__":
    main(*sys.argv[1:])
