"""Steady running in a curve and small motions about it, on a vehicle built with Exudyn.

One frame turns with the bogie's centre about the curve's centre. There the bodies rest, the spins
of the wheels are unknown rates. Two structures:

* linear: Exudyn's matrices of the undeformed vehicle, as in the model that is to be checked;
* nonlinear: Exudyn's static solver with its geometrically exact beams and finite rotations of
  joints, the contacts as user functions; then its matrices about the deformed vehicle.
"""

import exact_wheels
import exudyn as exu
import exudyn.itemInterface as items
import exudyn_axle
import exudyn_vehicle as vehicle
import numpy as np

COARSE = 0.025  # m, longest beam element; half of it adds 0.003 1/s to the growth rate
LARGEST = [1e-3, 1e-3, 5e-5, 8e-3, 8e-3, 8e-3]  # m, rad, change of a rim per step


class Curve:
    """A vehicle, its loads in a curve and the maps to the wheels."""

    def __init__(self, values, absorbers=False):
        self.values = values
        self.position = exudyn_axle.mesh(values["bogie"], COARSE)
        self.model = vehicle.build(values, self.position, absorbers)
        self.model.mbs.Assemble()
        self.mass, self.stiffness, self.damping = exudyn_axle.linearised(self.model.mbs)
        self.size = len(self.mass)
        mbs, wheels = self.model.mbs, self.model.wheels
        first = vehicle.first_coordinate
        self.rims = [first(mbs, w.rim) + np.arange(6) for w in wheels]
        self.spins = np.array([first(mbs, w.spin) for w in wheels])
        self.ends = [first(mbs, w.end) + np.arange(6) for w in wheels]
        self.places = [
            np.array(mbs.GetNodeParameter(w.rim, "referenceCoordinates")[:3]) for w in wheels
        ]
        self.pulled = first(mbs, self.model.car) + 1

    def loads(self, rails):
        """Weight and centrifugal force (n,) where the nodes are at rest, spins in the curve."""
        mbs, acceleration = self.model.mbs, np.zeros(self.size)
        axles = [node for axle in self.model.axles for node in axle.nodes]
        for node in (self.model.car, self.model.frame, *axles, *(w.rim for w in self.model.wheels)):
            start = vehicle.first_coordinate(mbs, node)
            place = np.array(mbs.GetNodeParameter(node, "referenceCoordinates")[:3])
            arm = exact_wheels.TO_VEHICLE @ place - rails.centre
            outwards = rails.turning[2] ** 2 * np.array([arm[0], arm[1], 0.0])
            outwards[2] = -self.values["track"]["gravity"]
            acceleration[start : start + 3] = exact_wheels.TO_VEHICLE.T @ outwards
        load = self.mass @ acceleration
        wheel = self.values["bogie"]["wheel"]
        hub, rim = wheel["hub"]["spin_inertia"], wheel["rim"]["spin_inertia"]
        drag = wheel["bearing_damping"] * rails.spin_rate
        for k in range(4):
            load[self.rims[k][4:]] += rails.precession((0.0, 0.0), rim)
            load[self.ends[k][4:]] += rails.precession((0.0, 0.0), hub)
            load[self.spins[k]] -= drag
            load[self.ends[k][3]] += drag
        return load

    def local(self, k, q, v):
        """Local variables (13,) of wheel k."""
        return np.concatenate([q[self.rims[k]], v[self.rims[k]], v[self.spins[k : k + 1]]])

    def own(self, k):
        """Places (7,) of the coordinates that the rail works on."""
        return np.append(self.rims[k], self.spins[k])

    def contacts(self, rails, q, v):
        """Generalised forces (n,) of the rails and their results by wheel."""
        force, results = np.zeros(self.size), []
        for k, wheel in enumerate(self.model.wheels):
            f, r = rails.on_wheel(self.places[k], wheel.side, self.local(k, q, v))
            force[self.own(k)] += f
            results.append(r)
        return force, results

    def contact_matrices(self, rails, q, v):
        """Derivatives (n, n) of the rails' forces in positions and in rates."""
        by_place, by_rate = np.zeros((2, self.size, self.size))
        for k, wheel in enumerate(self.model.wheels):
            j = rails.jacobian(self.places[k], wheel.side, self.local(k, q, v))
            by_place[np.ix_(self.own(k), self.rims[k])] += j[:, :6]
            by_rate[np.ix_(self.own(k), np.append(self.rims[k], self.spins[k]))] += j[:, 6:]
        return by_place, by_rate


def guess(curve, rails):
    """Positions (n,) of a structure at rest under its loads, with the rims set against the flanges.

    The front axle stands outwards, the rear one inwards by the play, both parallel to the bogie.
    """
    half = curve.values["bogie"]["half_wheelbase"]
    play = 6e-3 + curve.values["contact_geometry"]["rail"]["lateral_position"]
    known, value = [curve.pulled], [0.0]
    for k, wheel in enumerate(curve.model.wheels):
        lateral = 0.5 * half**2 / rails.radius + (play if wheel.axle else -play)
        root = (k in (0, 3)) * 5e-4  # these climb the root
        known += [curve.rims[k][0], curve.rims[k][2], curve.rims[k][5], curve.rims[k][1]]
        value += [lateral, 1e-4 + root, 0.0, 1e-3]
    known += list(curve.spins)
    value += 4 * [0.0]
    q, free = np.zeros(curve.size), np.setdiff1d(np.arange(curve.size), known)
    q[known] = value
    load = curve.loads(rails) - curve.stiffness @ q
    q[free] = np.linalg.solve(curve.stiffness[np.ix_(free, free)], load[free])
    return q


def settle(curve, rails, q, v, tolerance=1e-7):
    """Approach steady running of the linear structure by implicit steps of growing length."""
    free = np.setdiff1d(np.arange(curve.size), [curve.pulled])
    turning = np.setdiff1d(free, curve.spins)
    shape = vehicle.reduction(curve.model, curve.values, 3000.0)[free]
    shape = shape[:, shape.any(axis=0)]
    mass = shape.T @ curve.mass[np.ix_(free, free)] @ shape
    load, step = curve.loads(rails), 1e-3
    for _ in range(300):
        force, _ = curve.contacts(rails, q, v)
        by_place, by_rate = curve.contact_matrices(rails, q, v)
        residual = load + force - curve.stiffness @ q - curve.damping @ v
        k = shape.T @ (curve.stiffness - by_place)[np.ix_(free, free)] @ shape
        d = shape.T @ (curve.damping - by_rate)[np.ix_(free, free)] @ shape
        f = shape.T @ residual[free]
        rate = np.linalg.lstsq(shape, v[free], rcond=None)[0]
        spin = np.zeros(curve.size)
        spin[curve.spins] = 1.0
        # The angles of the hubs are cyclic: no stiffness belongs to them.
        moved = np.linalg.solve(mass / step + d + k * step, f - k @ rate * step)
        dv = np.zeros(curve.size)
        dv[free] = shape @ moved
        dq = step * (v + dv) * (1.0 - spin)
        largest = max(
            np.abs(dq[np.concatenate(curve.rims)].reshape(4, 6) / LARGEST).max(),
            np.abs(dv[curve.spins]).max() / 0.2,
        )
        if largest > 3.0:
            step *= 0.25
            continue
        q, v = q + dq, v + dv
        done = largest < tolerance and step > 1e3
        step = min(step * min(max(1.0 / max(largest, 1e-12), 0.5), 30.0), 1e6)
        if done:
            v[turning] = 0.0
            return q, v
    raise ArithmeticError(f"no steady running found, last step {largest:.1e}")


def spectrum(curve, rails, q, v, structure, cutoff):
    """Eigenvalues (1/s) of small motions about steady running.

    structure : mass, stiffness and damping of the vehicle (n, n); cutoff : Hz
    """
    mass, stiffness, damping = structure
    by_place, by_rate = curve.contact_matrices(rails, q, v)
    free = np.setdiff1d(np.arange(curve.size), [curve.pulled])
    shape = vehicle.reduction(curve.model, curve.values, cutoff)[free]
    shape = shape[:, shape.any(axis=0)]
    m, k, d = (
        shape.T @ a[np.ix_(free, free)] @ shape
        for a in (mass, stiffness - by_place, damping - by_rate)
    )
    state = np.block([[np.zeros_like(m), np.eye(len(m))], [-np.linalg.solve(m, np.hstack([k, d]))]])
    return np.linalg.eigvals(state)


def nonlinear(curve, rails, q, v):
    """Steady running by Exudyn's static solver from a start; structure linearised about it.

    Here the coordinate of a hub's spin stands for its rate: angles are cyclic.

    Returns
    -------
    q, v : (n,) as elsewhere; structure : mass, stiffness, damping (n, n); residual : N, N m
    """
    gravity = curve.values["track"]["gravity"]
    model = vehicle.build(curve.values, curve.position, False, gravity)
    mbs = model.mbs
    nodes = list(range(mbs.systemData.NumberOfNodes()))
    nodes = [n for n in nodes if mbs.GetNode(n)["nodeType"] != "PointGround"]
    order = np.concatenate(
        [
            vehicle.first_coordinate(curve.model.mbs, n) + np.arange(_coordinates(mbs, n))
            for n in nodes
        ]
    )
    mbs.AddObject(items.ObjectGenericODE2(nodeNumbers=nodes, forceVector=curve.loads(rails)[order]))
    carrying = [True]
    for k, wheel in enumerate(model.wheels):

        def force(_mbs, _t, _item, coordinates, _rates, k=k, side=wheel.side):
            if not carrying[0]:
                return np.zeros(7)
            local = np.concatenate([coordinates[:6], np.zeros(6), coordinates[6:]])
            return rails.on_wheel(curve.places[k], side, local)[0]

        mbs.AddObject(
            items.ObjectGenericODE2(nodeNumbers=[wheel.rim, wheel.spin], forceUserFunction=force)
        )
    ground = mbs.AddNode(items.NodePointGround())
    markers = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=n, coordinate=c))
        for n, c in ((ground, 0), (model.car, 1))
    ]
    mbs.AddObject(items.ObjectConnectorCoordinate(markerNumbers=markers))
    mbs.Assemble()
    start = q.copy()
    start[curve.spins] = v[curve.spins]
    mbs.systemData.SetODE2Coordinates(start, configuration=exu.ConfigurationType.Initial)
    settings = exu.SimulationSettings()
    settings.solutionSettings.writeSolutionToFile = False
    newton = settings.staticSolver.newton
    newton.numericalDifferentiation.minimumCoordinateSize = 1.0
    newton.numericalDifferentiation.relativeEpsilon = 1e-7
    newton.relativeTolerance, newton.absoluteTolerance = 3e-8, 1e-6  # rounding ends near 7e-9
    newton.maxIterations = 20
    settings.staticSolver.adaptiveStep = False
    if not mbs.SolveStatic(settings):
        raise ArithmeticError("Exudyn's static solver did not converge")
    found = np.array(mbs.systemData.GetODE2Coordinates())
    mbs.systemData.SetODE2Coordinates(found, configuration=exu.ConfigurationType.Initial)
    carrying[0] = False
    structure = exudyn_axle.linearised(mbs)
    q, v = found.copy(), np.zeros(curve.size)
    v[curve.spins], q[curve.spins] = found[curve.spins], 0.0
    return q, v, structure


def _coordinates(mbs, node):
    return 1 if mbs.GetNode(node)["nodeType"] == "GenericODE2" else 6
