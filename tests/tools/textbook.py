"""Textbook systems with known bifurcations, as `DynamicalSystem`."""

import numpy as np

from tramdva.bifurcation.hopf import HopfPoint, solve_hopf_point
from tramdva.bifurcation.system import DynamicalSystem


def _stack(*rows):
    """Matrices (m, n, n) from rows of entries that broadcast over states."""
    arrays = np.broadcast_arrays(*[entry for row in rows for entry in row])
    n = len(rows)
    return np.stack(arrays, axis=-1).reshape(*arrays[0].shape, n, n)


def normal_form(growth, growth_names, omega=1.0, cubic=-1.0, shear=0.0, quintic=0.0):
    """z' = (growth(p) + i omega) z + (cubic + i shear) z|z|^2 + quintic z|z|^4, z = x + i y."""

    def rhs(states, p):
        x, y = states.T
        r2 = x * x + y * y
        a = growth(p) + cubic * r2 + quintic * r2 * r2
        b = omega + shear * r2
        return np.column_stack([a * x - b * y, b * x + a * y])

    def jacobian(states, p):
        x, y = states.T
        r2 = x * x + y * y
        a, b = growth(p) + cubic * r2 + quintic * r2 * r2, omega + shear * r2
        da, db = 2 * cubic + 4 * quintic * r2, 2 * shear
        return _stack(
            [a + (da * x - db * y) * x, -b + (da * x - db * y) * y],
            [b + (db * x + da * y) * x, a + (db * x + da * y) * y],
        )

    return DynamicalSystem(rhs, jacobian, 2, growth_names)


def van_der_pol():
    """x'' - (mu - x^2) x' + x = 0: Hopf point at mu = 0; with x / sqrt(mu) the usual form."""

    def rhs(states, p):
        x, v = states.T
        return np.column_stack([v, (p[0] - x * x) * v - x])

    def jacobian(states, p):
        x, v = states.T
        return _stack([0 * x, 1 + 0 * x], [-2 * x * v - 1, p[0] - x * x])

    return DynamicalSystem(rhs, jacobian, 2, ("mu",))


def brusselator():
    """x' = a - (b + 1) x + x^2 y, y' = b x - x^2 y: Hopf point at b = 1 + a^2, omega = a."""

    def rhs(states, p):
        x, y = states.T
        return np.column_stack([p[0] - (p[1] + 1) * x + x * x * y, p[1] * x - x * x * y])

    def jacobian(states, p):
        x, y = states.T
        return _stack([2 * x * y - p[1] - 1, x * x], [p[1] - 2 * x * y, -x * x])

    return DynamicalSystem(rhs, jacobian, 2, ("a", "b"))


def roessler():
    """x' = -y - z, y' = x + a y, z' = b + z (x - c)."""

    def rhs(states, p):
        x, y, z = states.T
        return np.column_stack([-y - z, x + p[0] * y, p[1] + z * (x - p[2])])

    def jacobian(states, p):
        x, _, z = states.T
        o = 0 * x
        return _stack([o, o - 1, o - 1], [o + 1, o + p[0], o], [z, o, x - p[2]])

    return DynamicalSystem(rhs, jacobian, 3, ("a", "b", "c"))


def langford(beta=0.7, omega=3.5, alpha=0.95, rho=0.25):
    """Hopf-steady-state interaction with a torus bifurcation, parameter lambda."""

    def rhs(states, p):
        x, y, z = states.T
        r2 = x * x + y * y
        return np.column_stack(
            [
                (z - beta) * x - omega * y,
                omega * x + (z - beta) * y,
                p[0] + alpha * z - z * z * z / 3 - r2 * (1 + rho * z),
            ]
        )

    def jacobian(states, p):
        x, y, z = states.T
        o = 0 * x + 0 * p[0]
        r2 = x * x + y * y
        return _stack(
            [z - beta, o - omega, x],
            [o + omega, z - beta, y],
            [-2 * x * (1 + rho * z), -2 * y * (1 + rho * z), alpha - z * z - r2 * rho],
        )

    return DynamicalSystem(rhs, jacobian, 3, ("lambda",))


def hopf_point(system, state, parameters, free) -> HopfPoint:
    """Converged Hopf point from a guess."""
    point = solve_hopf_point(system, np.array(state, float), np.array(parameters, float), free)
    assert point.converged
    return point
