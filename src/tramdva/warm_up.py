"""Compile all kernels into Numba's cache, so that the first run does not have to."""

import numpy as np

from tramdva import wheelset
from tramdva.bifurcation.hopf import HopfPoint
from tramdva.bifurcation.limit_cycle import LimitCycleCurve
from tramdva.bifurcation.system import DynamicalSystem

# Only the types matter: the results are thrown away.
_COUNT = len(wheelset.WheelsetParameters._fields)
_NUMBERS = wheelset.WheelsetParameters(*np.linspace(1.0, 2.0, _COUNT).tolist())


def compile_kernels() -> None:
    """Call every compiled function once with each combination of types that the stages use."""
    with np.errstate(all="ignore"):
        _wheelset()
        _collocation()


def _wheelset() -> None:
    parameters = np.array(_NUMBERS)
    wheelset.slip_derivatives(_NUMBERS, 1.0, 1.0)
    for n, mounted in ((4, False), (6, True)):
        for dtype in (float, complex):
            states = np.ones((1, n), dtype)
            wheelset.accelerations(states, parameters)
            wheelset.jacobian(states, parameters)
        wheelset.linearised(_NUMBERS, mounted)
        try:
            wheelset.equilibrium(_NUMBERS, mounted)
        except ArithmeticError:
            continue


def _collocation() -> None:
    """One corrector step on an orbit of x'' - p x' + x = 0, near p = 0."""
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    system = DynamicalSystem(
        rhs=lambda states, p: states @ turn.T + p[0] * states,
        jacobian=lambda states, p: np.tile(turn + p[0] * np.eye(2), (len(states), 1, 1)),
        dimension=2,
        parameter_names=("p",),
    )
    hopf = HopfPoint(np.zeros(2), np.array([1.0, 1.0j]), 1.0, np.zeros(1), 0.0, True)
    curve = LimitCycleCurve(system, "p", max_iterations=1)
    curve.correct(curve.predict(curve.start(hopf, 2, 4), 0.1))
