"""The whole bogie with its share of the car body, built with Exudyn (1.13.6) from its parameters.

Axes as in `exudyn_axle.py`; origin on the track under the bogie's centre. Joints are
six-dimensional spring-dampers. Hubs and rims do not spin here: they are axisymmetric, so that the
spin is one coordinate per wheel, and its gyroscopic moments are added as a matrix.
"""

from pathlib import Path
from typing import NamedTuple

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np
import yaml
from exudyn_axle import SIDES, add_axle, at, beam_damping, free_modes

NODE = 6
WEIGHTLESS = 1e-8  # kg, kg m^2


def parameters(path):
    """Read the parameters of a vehicle."""
    return yaml.safe_load(Path(path).read_text(encoding="utf-8"))


def six(t, roll=0.0, pitch=0.0, yaw=0.0):
    """Diagonal (6, 6) in the axes of this model from values along those of the vehicle."""
    translations = [t["lateral"], t["longitudinal"], t["vertical"]]
    return np.diag([*translations, pitch, roll, yaw]).astype(float)


class Wheel(NamedTuple):
    """A wheel: nodes of rim, spin and axle end, side (+1 left), axle."""

    rim: int
    spin: int
    end: int
    side: float
    axle: int


class Model(NamedTuple):
    """An Exudyn system with its car body, frame, axles and wheels."""

    system: exu.SystemContainer
    mbs: exu.MainSystem
    car: int
    frame: int
    axles: list
    wheels: list


def _bushing(mbs, first, last, stiffness, damping, sag=0.0):
    """Joint; `sag` (m) is the rise of its last marker at which it exerts no vertical force."""
    mbs.AddObject(
        items.ObjectConnectorRigidBodySpringDamper(
            markerNumbers=[first, last],
            stiffness=stiffness,
            damping=damping,
            offset=[0.0, 0.0, sag, 0.0, 0.0, 0.0],
        )
    )


def marker(mbs, node, local):
    """Marker on a point rigidly connected to a node at `local` (m).

    Only bodies carry such points: a body of no weight is added to the node.
    """
    body = mbs.AddObject(
        items.ObjectRigidBody(
            nodeNumber=node, mass=WEIGHTLESS, inertia=[*3 * [WEIGHTLESS], 0, 0, 0]
        )
    )
    return mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=local))


def _rigid(mbs, x, y, z, mass, pitch, roll, yaw):
    node = mbs.AddNode(items.NodeRigidBodyRxyz(referenceCoordinates=[*at(x, y, z), 0, 0, 0]))
    mbs.AddObject(
        items.ObjectRigidBody(nodeNumber=node, mass=mass, inertia=[pitch, roll, yaw, 0, 0, 0])
    )
    return node


def _add_car_and_frame(mbs, bogie, ground, gravity):
    own = []
    for name in ("car_body", "frame"):
        b = bogie[name]
        inertia = (b["pitch_inertia"], b["roll_inertia"], b["yaw_inertia"])
        own.append(_rigid(mbs, 0.0, 0.0, b["height"], b["mass"], *inertia))
    car, frame = own
    support, none = bogie["car_support"], {"lateral": 0, "longitudinal": 0, "vertical": 0}
    kinds = [
        six(none, *(support[f"{axis}_{kind}"] for axis in ("roll", "pitch", "yaw")))
        for kind in ("stiffness", "damping")
    ]
    place = at(0.0, 0.0, bogie["car_body"]["height"])
    on_ground = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=ground, localPosition=place))
    _bushing(mbs, on_ground, marker(mbs, car, [0, 0, 0]), *kinds)
    spring = bogie["secondary"]
    for side in SIDES:
        first, last = (
            marker(
                mbs,
                node,
                [side * spring["lateral_position"], 0.0, spring["height"] - bogie[name]["height"]],
            )
            for node, name in ((frame, "frame"), (car, "car_body"))
        )
        sag = 0.5 * bogie["car_body"]["mass"] * gravity / spring["stiffness"]["vertical"]
        _bushing(mbs, first, last, six(spring["stiffness"]), six(spring["damping"]), sag)
    return car, frame


def _add_primary(mbs, bogie, frame, axle, gravity):
    spring = bogie["primary"]
    weight = (bogie["car_body"]["mass"] + bogie["frame"]["mass"]) * gravity
    sag = -0.25 * weight / spring["stiffness"]["vertical"]
    for side in SIDES:
        y = side * spring["lateral_position"]
        on_frame = at(axle.x, y, spring["height"] - bogie["frame"]["height"])
        first = marker(mbs, frame, on_frame)
        last = marker(mbs, axle.node_at(y), axle.local(y, spring["height"]))
        stiffness = six(spring["stiffness"], pitch=spring["pitch_stiffness"])
        damping = six(spring["damping"], pitch=spring["pitch_damping"])
        _bushing(mbs, first, last, stiffness, damping, sag)


def _layer_matrices(layer, spin_rate):
    """Stiffness and damping of the rubber; its dampers turn with the wheel about X.

    They see the rate u' - w x u, so that d w x u goes into the stiffness. The spring about the
    wheel's axis is a joint of its own.
    """
    t = {"lateral": "axial", "longitudinal": "radial", "vertical": "radial"}
    stiffness, damping = (
        six(
            {axis: layer[f"{name}_{kind}"] for axis, name in t.items()},
            roll=layer[f"tilting_{kind}"],
            yaw=layer[f"tilting_{kind}"],
        )
        for kind in ("stiffness", "damping")
    )
    for first in (0, 3):
        d = damping[first + 1, first + 1] * spin_rate
        # w x u = w (-u_Z e_Y + u_Y e_Z); the force is - d (u' - w x u)
        stiffness[first + 1, first + 2] += d
        stiffness[first + 2, first + 1] -= d
    return stiffness, damping


def _coordinate_joint(mbs, first, last, stiffness, damping):
    """Spring and damper between two coordinates, each (node, number) or None for the ground."""
    markers = []
    for place in (first, last):
        if place is None:
            ground = mbs.AddNode(items.NodePointGround())
            place = (ground, 0)
        node, number = place
        markers.append(
            mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=number))
        )
    mbs.AddObject(
        items.ObjectConnectorCoordinateSpringDamper(
            markerNumbers=markers, stiffness=stiffness, damping=damping
        )
    )


def _add_wheel(mbs, bogie, side, axle, number, spin_rate):
    wheel, layer = bogie["wheel"], bogie["wheel"]["layer"]
    y, radius, rim = side * wheel["half_distance"], wheel["radius"], wheel["rim"]
    inertia = (rim["spin_inertia"], *2 * [rim["diametral_inertia"]])
    node = _rigid(mbs, axle.x, y, radius, rim["mass"], *inertia)
    end = axle.node_at(y)
    first, last = marker(mbs, end, axle.local(y, radius)), marker(mbs, node, [0, 0, 0])
    _bushing(mbs, first, last, *_layer_matrices(layer, spin_rate))
    # The rim's turn about the wheel's axis counts from the hub: see `_spin_matrices`.
    _coordinate_joint(
        mbs, None, (node, 3), layer["torsional_stiffness"], layer["torsional_damping"]
    )
    spin = mbs.AddNode(items.NodeGenericODE2(referenceCoordinates=[0.0], initialCoordinates=[0.0],
                                             initialCoordinates_t=[0.0],
                                             numberOfODE2Coordinates=1))  # fmt: skip
    mass, damping = _spin_matrices(wheel, spin_rate)
    mbs.AddObject(
        items.ObjectGenericODE2(
            nodeNumbers=[node, end, spin], massMatrix=mass, dampingMatrix=damping
        )
    )
    return Wheel(node, spin, end, side, number)


def _spin_matrices(wheel, spin_rate):
    """Mass and damping (13, 13) over rim (6), axle end (6) and the spin of the hub.

    The rim's rate of spin is that of the hub plus that of its own turn. The bearing resists the
    spin of the hub relative to the axle. A part that spins about X with angular momentum h turns
    the moment -h (w x e_X) = -h (w_Z e_Y - w_Y e_Z) on the body that carries it.
    """
    mass, damping = np.zeros((2, 13, 13))
    hub, rim = wheel["hub"]["spin_inertia"], wheel["rim"]["spin_inertia"]
    mass[12, 12] = hub + rim
    mass[12, 3] = mass[3, 12] = rim
    for start, inertia in ((0, rim), (6, hub)):
        damping[start + 4, start + 5] = inertia * spin_rate
        damping[start + 5, start + 4] = -inertia * spin_rate
    relative = np.zeros(13)
    relative[[12, 9]] = 1.0, -1.0
    return mass, damping + wheel["bearing_damping"] * np.outer(relative, relative)


def _add_absorber(mbs, absorber, axle, side):
    """Rotor about the longitudinal axis on the axle bridge."""
    d = absorber["direction"]
    if absorber["motion"] != "rotation" or d["y"] or d["z"]:
        raise ValueError("only absorbers that rotate about the longitudinal axis are modelled")
    own = mbs.AddNode(
        items.NodeGenericODE2(
            referenceCoordinates=[0.0],
            initialCoordinates=[0.0],
            initialCoordinates_t=[0.0],
            numberOfODE2Coordinates=1,
        )
    )
    mbs.AddObject(items.ObjectGenericODE2(nodeNumbers=[own], massMatrix=[[absorber["I_T"]]]))
    carrier = axle.node_at(side * absorber["lateral_position"])
    _coordinate_joint(mbs, (carrier, 4), (own, 0), absorber["c_T"], absorber["d_T"])


def build(values, position, absorbers, gravity=0.0):
    """Build the vehicle with beam nodes at `position` (m); not yet assembled.

    Springs carry car body and frame without deflection at `gravity` (m/s^2): the parameters' places
    are those of the loaded vehicle. The axle's modal damping is one dense matrix over the nodes of
    a bridge.
    """
    bogie = values["bogie"]
    spin_rate = values["track"]["speed"] / bogie["wheel"]["radius"]
    damping = beam_damping(bogie, position)
    system = exu.SystemContainer()
    mbs = system.AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    car, frame = _add_car_and_frame(mbs, bogie, ground, gravity)
    axles, wheels = [], []
    for number, x in enumerate((bogie["half_wheelbase"], -bogie["half_wheelbase"])):
        axle = add_axle(mbs, bogie, x, position)
        axles.append(axle)
        _add_primary(mbs, bogie, frame, axle, gravity)
        mbs.AddObject(items.ObjectGenericODE2(nodeNumbers=axle.nodes, dampingMatrix=damping))
        for side in SIDES:
            wheels.append(_add_wheel(mbs, bogie, side, axle, number, spin_rate))
            if absorbers:
                _add_absorber(mbs, bogie["absorber"], axle, side)
    return Model(system, mbs, car, frame, axles, wheels)


def first_coordinate(mbs, node):
    """Place of a node's first coordinate in the system's vector."""
    return mbs.GetNodeODE2Index(node)


def reduction(model, values, cutoff):
    """Matrix (n, m) that leaves the axle bridges their free modes up to a cutoff (Hz).

    The other coordinates stay.
    """
    mbs = model.mbs
    places = [[first_coordinate(mbs, n) + np.arange(NODE) for n in a.nodes] for a in model.axles]
    own = np.array(places).reshape(len(model.axles), -1)
    size = mbs.systemData.ODE2Size()
    others = np.setdiff1d(np.arange(size), own)
    blocks = [np.eye(size)[:, others]]
    for axle, place in zip(model.axles, own, strict=True):
        _, omega, shape = free_modes(values["bogie"], axle.position)
        shape = shape[:, omega < 2.0 * np.pi * cutoff]
        block = np.zeros((size, shape.shape[1]))
        block[place] = shape
        blocks.append(block)
    return np.hstack(blocks)
