"""Basic model of the leading wheelset: axle with hub, absorber, rim of the inner wheel (figure 1).

Coordinates are the lateral positions y of axle and hub (A), absorber (T) and rim (R), measured from
the outer rail towards the centre of the curve. The state is ``[y_A, y_T, y_R, y_A', y_T', y_R']``
in m and m/s, or ``[y_A, y_R, y_A', y_R']`` without absorber. The creep force ``F_y`` acts on the
rim in the negative direction when the rim slips in the positive one.

References
----------
Equations (1)-(8) and the system matrix of the appendix of the paper.
"""

from collections.abc import Mapping
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numba import carray

from tramdva.bifurcation import compiled
from tramdva.bifurcation.system import DynamicalSystem, Kernels, Scaling, rescaled
from tramdva.contact.creep_force import (
    creep_force,
    creep_force_derivatives,
    jit,
    saturation_derivatives,
)


class WheelsetParameters(NamedTuple):
    """Parameters of the basic model in SI units, in the order of the parameter vector."""

    m_A: float  # reduced mass of axle and hub
    m_T: float  # absorber mass
    m_R: float  # equivalent mass of the rim
    c_A: float  # effective stiffness of axle and primary suspension
    c_T: float  # absorber stiffness
    c_R: float  # effective stiffness of the resilient wheel
    d_A: float
    d_T: float
    d_R: float
    L: float  # lateral position of the unloaded axle, l in eq. (1)
    r_C: float  # curve radius at the outer wheel
    gamma: float  # angle of attack
    Omega: float  # yaw rate
    F_N: float
    mu_0: float
    A: float
    B: float
    C_22: float  # Kalker's linear creep stiffness G a b c_22
    k_A: float
    k_S: float


def wheelset_parameters(
    sections: Mapping[str, Mapping[str, Any]], **changes: float
) -> WheelsetParameters:
    """Parameter vector from the sections of a line's configuration.

    Parameters
    ----------
    sections : mapping
        Sections ``curve``, ``creep_force``, ``wheelset`` and ``absorber`` with the symbols of
        Tables 1 and 2 as keys, SI units. Values that a stage sweeps (c_A, c_T, d_T) may be missing.
    **changes : float
        Values that replace those of the sections, by symbol.

    Returns
    -------
    WheelsetParameters
        Missing swept values are NaN.
    """
    curve, creep = sections["curve"], sections["creep_force"]
    wheelset, absorber = sections["wheelset"], sections.get("absorber", {})
    values = {
        "m_T": np.nan,
        "c_A": np.nan,
        "c_T": np.nan,
        "d_T": np.nan,
        **wheelset,
        **absorber,
        "r_C": curve["r_C"],
        "gamma": curve["gamma"],
        "Omega": curve["outer_speed"] / curve["r_C"],
        "C_22": creep["G"] * creep["a"] * creep["b"] * creep["c_22"],
        **{key: creep[key] for key in ("F_N", "mu_0", "A", "B", "k_A", "k_S")},
        **changes,
    }
    return WheelsetParameters(**{name: float(values[name]) for name in WheelsetParameters._fields})


@jit
def _named(p):
    return WheelsetParameters(
        p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], p[9],
        p[10], p[11], p[12], p[13], p[14], p[15], p[16], p[17], p[18], p[19],
    )  # fmt: skip


@jit
def _steady_creep_force(p, V_0):
    """Creep force at w = -gamma V_0 and its derivative in V_0, N and N s/m.

    Along the steady state eps changes with V_0 only through mu(w).
    """
    sign = -1.0 if p.gamma.real > 0.0 else 1.0
    slip = -sign * p.gamma * V_0
    decay = p.mu_0 * (1.0 - p.A) * np.exp(-p.B * slip)
    mu = decay + p.mu_0 * p.A
    eps = -0.25 * np.pi * p.C_22 * sign * p.gamma / (p.F_N * mu)
    h, h1, _, _ = saturation_derivatives(eps, p.k_A, p.k_S)
    scale = sign * 2.0 * p.F_N / np.pi
    return scale * mu * h, scale * (-p.B * decay) * (-sign * p.gamma) * (h - eps * h1)


@jit
def _lateral_equilibrium(p, with_absorber):
    """Newton for the rim position; returns y_A, y_T, y_R in m, V_0 in m/s and the last step in m.

    The position enters the creep force only through V_0 = Omega (r_C - y_R): eliminating y_A and
    y_T by eqs (3) and (2) leaves the scalar equation (1).
    """
    centripetal = p.Omega * p.Omega * p.r_C * np.cos(p.gamma)
    y_R = p.L + 0.0 * p.c_A
    y_A, y_T, V_0, step = y_R, y_R, y_R, y_R
    for _ in range(30):
        V_0 = p.Omega * (p.r_C - y_R)
        F, dF_dV0 = _steady_creep_force(p, V_0)
        y_A = y_R + (p.m_R * (centripetal - p.Omega * p.Omega * y_R) + F) / p.c_R
        dy_A = 1.0 - (p.m_R * p.Omega * p.Omega + p.Omega * dF_dV0) / p.c_R
        residual = (
            p.m_A * (centripetal - p.Omega * p.Omega * y_A)
            + p.c_A * (y_A - p.L)
            - p.c_R * (y_R - y_A)
        )
        slope = (p.c_A + p.c_R - p.m_A * p.Omega * p.Omega) * dy_A - p.c_R
        if with_absorber:
            dy_T = p.c_T / (p.c_T - p.m_T * p.Omega * p.Omega)
            y_T = dy_T * y_A - p.m_T * centripetal / (p.c_T - p.m_T * p.Omega * p.Omega)
            residual -= p.c_T * (y_T - y_A)
            slope -= p.c_T * (dy_T - 1.0) * dy_A
        if (
            abs(step) <= 1e-14 * p.L.real
        ):  # one step beyond: the imaginary part follows the real one
            break
        step = -residual / slope
        y_R = y_R + step
    if not (abs(step) <= 1e-12 * p.L.real and V_0.real > 0.0):
        V_0 = V_0 * np.nan  # no steady rolling within the curve
    return y_A, y_T, y_R, V_0, abs(step)


@jit
def _rhs(states, parameters):
    """Accelerations of eqs (1)-(5) at every state; parameters (1, q) for all or (m, q) for each."""
    p = _named(parameters[0])
    dofs = states.shape[1] // 2
    with_absorber = dofs == 3
    V_0 = _lateral_equilibrium(p, with_absorber)[3]
    centripetal = p.Omega * p.Omega * p.r_C * np.cos(p.gamma)
    out = np.empty_like(states)
    for i in range(states.shape[0]):
        if i > 0 and parameters.shape[0] > 1:
            p = _named(parameters[i])
            V_0 = _lateral_equilibrium(p, with_absorber)[3]
            centripetal = p.Omega * p.Omega * p.r_C * np.cos(p.gamma)
        y_A, y_R = states[i, 0], states[i, dofs - 1]
        v_A, v_R = states[i, dofs], states[i, 2 * dofs - 1]
        w = v_R - p.gamma * V_0
        F_y = creep_force(w, V_0, p.F_N, p.mu_0, p.A, p.B, p.C_22, p.k_A, p.k_S)[0]
        wheel = p.c_R * (y_R - y_A) + p.d_R * (v_R - v_A)
        axle = -p.c_A * (y_A - p.L) - p.d_A * v_A + wheel
        if with_absorber:
            y_T, v_T = states[i, 1], states[i, 4]
            absorber = p.c_T * (y_T - y_A) + p.d_T * (v_T - v_A)
            axle += absorber
            out[i, 1] = v_T
            out[i, 4] = -absorber / p.m_T - centripetal + p.Omega * p.Omega * y_T
        out[i, 0] = v_A
        out[i, dofs - 1] = v_R
        out[i, dofs] = axle / p.m_A - centripetal + p.Omega * p.Omega * y_A
        out[i, 2 * dofs - 1] = (-wheel - F_y) / p.m_R - centripetal + p.Omega * p.Omega * y_R
    return out


@jit
def _jacobian(states, parameters):
    """Derivatives of `_rhs` in the state, shape (m, n, n)."""
    p = _named(parameters[0])
    m, n = states.shape
    dofs = n // 2
    with_absorber = dofs == 3
    V_0 = _lateral_equilibrium(p, with_absorber)[3]
    R = dofs - 1
    out = np.empty((m, n, n), dtype=states.dtype)
    for i in range(m):
        if i > 0 and parameters.shape[0] > 1:
            p = _named(parameters[i])
            V_0 = _lateral_equilibrium(p, with_absorber)[3]
        matrix = out[i]
        for j in range(n):
            for k in range(n):
                matrix[j, k] = 0.0
        for j in range(dofs):
            matrix[j, dofs + j] = 1.0
            matrix[dofs + j, j] = p.Omega * p.Omega
        matrix[dofs, 0] -= p.c_A / p.m_A
        matrix[dofs, dofs] -= p.d_A / p.m_A
        _couple(matrix, dofs, 0, R, p.c_R / p.m_A, p.d_R / p.m_A)
        _couple(matrix, dofs, R, 0, p.c_R / p.m_R, p.d_R / p.m_R)
        if with_absorber:
            _couple(matrix, dofs, 0, 1, p.c_T / p.m_A, p.d_T / p.m_A)
            _couple(matrix, dofs, 1, 0, p.c_T / p.m_T, p.d_T / p.m_T)
        w = states[i, n - 1] - p.gamma * V_0
        slope = creep_force(w, V_0, p.F_N, p.mu_0, p.A, p.B, p.C_22, p.k_A, p.k_S)[1]
        matrix[n - 1, n - 1] -= slope / p.m_R
    return out


@jit
def _couple(matrix, dofs, body, other, stiffness, damping):
    """Acceleration of a body by a spring and damper (per unit of its mass) to another body."""
    matrix[dofs + body, body] -= stiffness
    matrix[dofs + body, other] += stiffness
    matrix[dofs + body, dofs + body] -= damping
    matrix[dofs + body, dofs + other] += damping


@jit
def _linearised(parameters, with_absorber):
    """System matrix, rolling speed and creep slope at the equilibrium of every parameter vector."""
    count = parameters.shape[0]
    n = 6 if with_absorber else 4
    matrices = np.empty((count, n, n))
    V_0 = np.empty(count)
    slopes = np.empty(count)
    steady = np.zeros((1, n))
    for i in range(count):
        p = _named(parameters[i])
        V_0[i] = _lateral_equilibrium(p, with_absorber)[3]
        w = -p.gamma * V_0[i]
        slopes[i] = creep_force(w, V_0[i], p.F_N, p.mu_0, p.A, p.B, p.C_22, p.k_A, p.k_S)[1]
        matrix = _jacobian(steady, parameters[i : i + 1])[0]
        for j in range(n):
            for k in range(n):
                matrices[i, j, k] = matrix[j, k]
    return matrices, V_0, slopes


def _prepared(states: np.ndarray, parameters: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """States and rows of parameters of one type, as the kernels take them."""
    dtype = complex if np.iscomplexobj(states) or np.iscomplexobj(parameters) else float
    rows = np.ascontiguousarray(np.atleast_2d(parameters.T), dtype)
    return np.ascontiguousarray(states, dtype), rows


def accelerations(states: np.ndarray, parameters: np.ndarray) -> np.ndarray:
    """Right-hand side of the equations of motion (1)-(5), y' = f(y, p).

    Parameters
    ----------
    states : (m, 6) or (m, 4) array
        States in m and m/s, with or without absorber.
    parameters : (20,) or (20, m) array
        `WheelsetParameters` as a vector, for all states or for each; real or complex.

    Returns
    -------
    (m, 6) or (m, 4) array
        Velocities in m/s and accelerations in m/s^2. ``V_0`` is that of the equilibrium at these
        parameters.
    """
    return _rhs(*_prepared(states, parameters))


def jacobian(states: np.ndarray, parameters: np.ndarray) -> np.ndarray:
    """Derivative of `accelerations` in the state, (m, n, n), SI units; arguments as there."""
    return _jacobian(*_prepared(states, parameters))


class Equilibrium(NamedTuple):
    """Steady state in the curve: positions in m, rolling speed in m/s."""

    y_A: float
    y_T: float
    y_R: float
    V_0: float


def equilibrium(values: WheelsetParameters, with_absorber: bool) -> Equilibrium:
    """Steady state of the wheelset in the curve, by Newton's method.

    Parameters
    ----------
    values : WheelsetParameters
        SI units.
    with_absorber : bool
        Whether the absorber is mounted; ``y_T`` is NaN otherwise.

    Returns
    -------
    Equilibrium

    Raises
    ------
    ArithmeticError
        If Newton's method does not converge.
    """
    y_A, y_T, y_R, V_0, step = _lateral_equilibrium(WheelsetParameters(*values), with_absorber)
    if not np.isfinite(V_0):
        raise ArithmeticError(f"no steady rolling in the curve: Newton's last step is {step:.1e} m")
    return Equilibrium(y_A, y_T if with_absorber else np.nan, y_R, V_0)


def equilibrium_state(values: WheelsetParameters, with_absorber: bool) -> np.ndarray:
    """State vector of the equilibrium, (6,) or (4,), m and m/s."""
    y_A, y_T, y_R, _ = equilibrium(values, with_absorber)
    positions = [y_A, y_T, y_R] if with_absorber else [y_A, y_R]
    return np.array(positions + [0.0] * len(positions))


def slip_derivatives(
    values: WheelsetParameters, slip_velocity: float, V_0: float
) -> tuple[float, ...]:
    """Creep force in N and its three derivatives at a slip and a rolling speed in m/s."""
    p = values
    return creep_force_derivatives(
        slip_velocity, V_0, p.F_N, p.mu_0, p.A, p.B, p.C_22, p.k_A, p.k_S
    )


def system_matrix(values: WheelsetParameters) -> np.ndarray:
    """System matrix A of the appendix, with absorber, term by term, (6, 6), SI units.

    Notes
    -----
    ``k_2 k_3 / v_0`` of the appendix is the slope k of eq. (6) over V_0, that is dF_y/dy_R'.
    """
    p = values
    V_0 = equilibrium(p, with_absorber=True).V_0
    kappa = slip_derivatives(p, -p.gamma * V_0, V_0)[1]
    Omega2 = p.Omega**2
    return np.array(
        [
            [0, 0, 0, 1, 0, 0],
            [0, 0, 0, 0, 1, 0],
            [0, 0, 0, 0, 0, 1],
            [
                -p.c_A / p.m_A - p.c_T / p.m_A - p.c_R / p.m_A + Omega2,
                p.c_T / p.m_A,
                p.c_R / p.m_A,
                -p.d_A / p.m_A - p.d_T / p.m_A - p.d_R / p.m_A,
                p.d_T / p.m_A,
                p.d_R / p.m_A,
            ],
            [p.c_T / p.m_T, -p.c_T / p.m_T + Omega2, 0, p.d_T / p.m_T, -p.d_T / p.m_T, 0],
            [
                p.c_R / p.m_R,
                0,
                -p.c_R / p.m_R + Omega2,
                p.d_R / p.m_R,
                0,
                -p.d_R / p.m_R - kappa / p.m_R,
            ],
        ]
    )


class Linearisation(NamedTuple):
    """Linearised wheelset at the equilibria of many parameter sets.

    ``matrices`` (k, n, n) in SI units, rolling speeds ``V_0`` (k,) in m/s, slopes ``kappa`` =
    dF_y/dy_R' (k,) in N s/m.
    """

    matrices: np.ndarray
    V_0: np.ndarray
    kappa: np.ndarray


def linearised(values: WheelsetParameters, with_absorber: bool) -> Linearisation:
    """Linearisation at the equilibrium for parameters that are numbers or arrays.

    Parameters
    ----------
    values : WheelsetParameters
        Fields broadcast against each other; SI units.
    with_absorber : bool
        Whether the absorber is mounted.

    Returns
    -------
    Linearisation
        Flattened to one axis of length k.
    """
    stacked = np.stack(np.broadcast_arrays(*values), axis=-1).reshape(-1, len(values))
    return Linearisation(*_linearised(np.ascontiguousarray(stacked, float), with_absorber))


# Millimetres, milliseconds, kN/mm and kN s/m: with SI units the bordered matrices span ten decades.
_PARAMETER_SCALE = {"c_A": 1e6, "c_T": 1e6, "c_R": 1e6, "d_A": 1e3, "d_T": 1e3, "d_R": 1e3}


def scaling(values: WheelsetParameters, with_absorber: bool) -> Scaling:
    """Scales of states (mm about L, mm/ms), time (ms) and parameters (kN/mm, kN s/m)."""
    dofs = 3 if with_absorber else 2
    return Scaling(
        origin=np.array([values.L] * dofs + [0.0] * dofs),
        state=np.array([1e-3] * dofs + [1.0] * dofs),
        time=1e-3,
        parameters=np.array([_PARAMETER_SCALE.get(name, 1.0) for name in values._fields]),
    )


def dynamical_system(values: WheelsetParameters, with_absorber: bool) -> DynamicalSystem:
    """The wheelset as a smooth system for `tramdva.bifurcation`, in the units of `scaling`."""
    system = DynamicalSystem(
        rhs=accelerations,
        jacobian=jacobian,
        dimension=6 if with_absorber else 4,
        parameter_names=values._fields,
        kernels=_kernels(),
    )
    return rescaled(system, scaling(values, with_absorber))


def _rhs_by_address(states, m, n, parameters, rows, q, out):
    """`_rhs` as `tramdva.bifurcation.compiled` calls it."""
    compiled.fill(carray(out, m * n), _rhs(carray(states, (m, n)), carray(parameters, (rows, q))))


def _jacobian_by_address(states, m, n, parameters, rows, q, out):
    """`_jacobian` likewise."""
    compiled.fill(
        carray(out, m * n * n), _jacobian(carray(states, (m, n)), carray(parameters, (rows, q)))
    )


@cache
def _kernels() -> Kernels | None:
    functions = compiled.c_functions(_rhs_by_address, _jacobian_by_address)
    return None if functions is None else Kernels(functions)
