"""An axle bridge on its primary springs, built with Exudyn: modes and a static response.

    python make_exudyn_reference.py vehicle_heavy_arms.yaml axle_heavy_arms.csv

(Exudyn 1.13.6, NumPy, SciPy, PyYAML; bridge, stubs and hubs: `exudyn_axle.py`.) The springs stand
between the bridge and the ground. Axes: X = y of the vehicle (left), Y = -x (backward), Z = z (up).
Frequencies are those of two meshes, 2 : 1, without the error of second order.
"""

import csv
import sys
from pathlib import Path

import exudyn as exu
import exudyn.itemInterface as items
import exudyn_axle
import numpy as np
from exudyn_vehicle import marker, parameters, six
from scipy.linalg import eigh

SIZE = 0.02  # m, longest element of the coarse mesh
MODES = 14
FORCE = 1000.0  # N, up, on the left wheel centre


def build(mbs, bogie, position):
    """Add the bridge and its springs."""
    axle = exudyn_axle.add_axle(mbs, bogie, 0.0, position)
    ground, spring = mbs.AddObject(items.ObjectGround()), bogie["primary"]
    for side in exudyn_axle.SIDES:
        y = side * spring["lateral_position"]
        place = exudyn_axle.at(0.0, y, spring["height"])
        on_ground = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=ground, localPosition=place))
        on_axle = marker(mbs, axle.node_at(y), axle.local(y, spring["height"]))
        mbs.AddObject(
            items.ObjectConnectorRigidBodySpringDamper(
                markerNumbers=[on_ground, on_axle],
                stiffness=six(spring["stiffness"], pitch=spring["pitch_stiffness"]),
                damping=np.zeros((6, 6)),
            )
        )
    return axle


def solved(bogie, position):
    """Axle, stiffness, frequencies (Hz, rising) and shapes of the lowest modes."""
    system = exu.SystemContainer()
    mbs = system.AddSystem()
    axle = build(mbs, bogie, position)
    mbs.Assemble()
    mass, stiffness, _ = exudyn_axle.linearised(mbs)
    mass, stiffness = 0.5 * (mass + mass.T), 0.5 * (stiffness + stiffness.T)
    # As largest 1 / omega^2, the low ones keep their digits beside stiff rods.
    last = len(mass) - 1
    inverse, vectors = eigh(mass, stiffness, subset_by_index=[last + 1 - MODES, last])
    return axle, stiffness, 1.0 / np.sqrt(inverse[::-1]) / (2.0 * np.pi), vectors[:, ::-1]


def main(source, target):
    """Write frequencies, mode shapes at the ends and the static displacements."""
    bogie = parameters(source)["bogie"]
    position = exudyn_axle.mesh(bogie, SIZE)
    _, _, coarse, _ = solved(bogie, position)
    axle, stiffness, fine, vectors = solved(bogie, exudyn_axle.halved(position))
    rows = []
    for k, frequency in enumerate((4.0 * fine - coarse) / 3.0):
        shape = vectors[:, k].reshape(-1, 6)
        left, right = shape[-1], shape[0]
        sign = np.sign(left[np.argmax(np.abs(left))])
        ends = sign * np.concatenate([left[:3], right[:3]]) / np.abs(shape[:, :3]).max()
        rows.append(["mode", f"{frequency:.6f}", *(f"{value:.6f}" for value in ends)])
    wheel = bogie["wheel"]
    arm = np.array(axle.local(wheel["half_distance"], wheel["radius"]))
    force = np.zeros(len(stiffness))
    force[-4] = FORCE
    force[-3:] = np.cross(arm, [0.0, 0.0, FORCE])
    motion = np.linalg.solve(stiffness, force).reshape(-1, 6)
    left = motion[-1, :3] + np.cross(motion[-1, 3:], arm)
    right = motion[0, :3] + np.cross(motion[0, 3:], arm * [-1.0, 1.0, 1.0])
    rows.append(["static", "0", *(f"{value:.9e}" for value in [*left, *right])])
    with Path(target).open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["kind", "frequency_Hz", *(f"{s}_{a}" for s in "LR" for a in "XYZ")])
        table.writerows(rows)


if __name__ == "__main__":
    main(*sys.argv[1:])
