"""The axle bridge on its primary springs, built with Exudyn: modes and a static response.

    python make_exudyn_reference.py axle_exudyn.csv        (Exudyn 1.13.6, NumPy, SciPy)

The bridge is a chain of geometrically exact beams (shear-deformable; the shear stiffness is raised
until they are Euler-Bernoulli beams). Stub and hub are rigid bodies off the end nodes, the
primary springs six-dimensional spring-dampers to the ground. Axes of Exudyn here: X = y of the
vehicle (left), Y = -x (backward), Z = z (up).
"""

import csv
import sys
from itertools import pairwise
from pathlib import Path

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np
from scipy.linalg import eigh

HALF, MIDDLE, RADIUS, DROP, WHEEL = 0.6, 0.25, 0.3, 0.17, 0.75  # m
EI = {"outer": 2.0e5, "middle": 1.15e5}  # N m^2, vertical
MASS = {"outer": 330.0, "middle": 380.0}  # kg/m
EI_LATERAL, GJ, EA, POLAR, SHEAR = 5.0e6, 1.2e6, 1.0e9, 0.6, 1.0e11
MASS_END = 124.0 + 45.0  # kg, stub and hub, both at the wheel centre
INERTIA_END = np.diag([2.0, 0.8 + 0.7, 0.8 + 0.7])  # pitch, roll, yaw of the vehicle, kg m^2
SPRING = (8.2e6, 2.0e7, 1.2e6)  # N/m along X, Y, Z
SPRING_Y, SPRING_Z, PITCH = 0.6, 0.36, 5.0e5
ELEMENTS = 60  # per section
FORCE = 1000.0  # N, up, on the left wheel centre


def section(kind):
    """Stiffness and mass of a section."""
    beam = exu.BeamSection()
    beam.stiffnessMatrix = np.diag([EA, SHEAR, SHEAR, GJ, EI[kind], EI_LATERAL])
    beam.inertia = np.diag([POLAR, 1e-5, 1e-5])
    beam.massPerLength = MASS[kind]
    return beam


def build(mbs):
    """Add nodes, beams, ends and springs."""
    ends = (-HALF, -MIDDLE, MIDDLE, HALF)
    x = np.concatenate([np.linspace(a, b, ELEMENTS + 1)[:-1] for a, b in pairwise(ends)])
    x = np.append(x, HALF)
    nodes = [
        mbs.AddNode(items.NodeRigidBodyRxyz(referenceCoordinates=[p, 0, RADIUS - DROP, 0, 0, 0]))
        for p in x
    ]
    kinds = ELEMENTS * ["outer"] + ELEMENTS * ["middle"] + ELEMENTS * ["outer"]
    for i, kind in enumerate(kinds):
        mbs.AddObject(
            items.ObjectBeamGeometricallyExact(
                nodeNumbers=[nodes[i], nodes[i + 1]],
                physicsLength=x[i + 1] - x[i],
                sectionData=section(kind),
            )
        )
    ground = mbs.AddObject(items.ObjectGround())
    for side, node in ((1.0, nodes[-1]), (-1.0, nodes[0])):
        arm = np.array([side * (WHEEL - HALF), 0.0, DROP])
        steiner = MASS_END * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        j = INERTIA_END + steiner
        body = mbs.AddObject(
            items.ObjectRigidBody(
                nodeNumber=node,
                mass=MASS_END,
                inertia=[j[0, 0], j[1, 1], j[2, 2], j[1, 2], j[0, 2], j[0, 1]],
                centerOfMass=arm,
            )
        )
        place = np.array([side * SPRING_Y, 0.0, SPRING_Z])
        local = place - np.array([side * HALF, 0.0, RADIUS - DROP])
        on_body = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=local))
        on_ground = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=ground, localPosition=place))
        mbs.AddObject(
            items.ObjectConnectorRigidBodySpringDamper(
                markerNumbers=[on_ground, on_body],
                stiffness=np.diag([*SPRING, PITCH, 0.0, 0.0]),
                damping=np.zeros((6, 6)),
            )
        )


def main(path):
    """Write frequencies, mode shapes at the ends and the static displacements."""
    system = exu.SystemContainer()
    mbs = system.AddSystem()
    build(mbs)
    mbs.Assemble()
    mass, stiffness, _ = (np.array(m) for m in exu.solver.ComputeLinearizedSystem(mbs))
    mass, stiffness = 0.5 * (mass + mass.T), 0.5 * (stiffness + stiffness.T)
    values, vectors = eigh(stiffness, mass, subset_by_index=[0, 13])
    frequency = np.sqrt(values) / (2.0 * np.pi)
    rows = []
    for k in range(14):
        shape = vectors[:, k].reshape(-1, 6)
        left, right = shape[-1], shape[0]
        biggest = np.abs(shape[:, :3]).max()
        sign = np.sign(left[np.argmax(np.abs(left))])
        ends = sign * np.concatenate([left[:3], right[:3]]) / biggest
        rows.append(["mode", f"{frequency[k]:.6f}", *(f"{value:.6f}" for value in ends)])
    arm = np.array([WHEEL - HALF, 0.0, DROP])
    force = np.zeros(len(stiffness))
    force[-4] = FORCE
    force[-3:] = np.cross(arm, [0.0, 0.0, FORCE])
    motion = np.linalg.solve(stiffness, force).reshape(-1, 6)
    left = motion[-1, :3] + np.cross(motion[-1, 3:], arm)
    right = motion[0, :3] + np.cross(motion[0, 3:], arm * [-1.0, 1.0, 1.0])
    rows.append(["static", "0", *(f"{value:.9e}" for value in [*left, *right])])
    with Path(path).open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["kind", "frequency_Hz", *(f"{s}_{a}" for s in "LR" for a in "XYZ")])
        table.writerows(rows)


if __name__ == "__main__":
    main(sys.argv[1])
