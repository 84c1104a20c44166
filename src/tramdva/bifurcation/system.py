"""Smooth dynamical systems x' = f(x, p) and their derivatives."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

_COMPLEX_STEP = 1e-30


@dataclass(frozen=True)
class Kernels:
    """Compiled functions of a system, and the change of variables that belongs to them.

    Attributes
    ----------
    functions : tuple
        C functions of `tramdva.bifurcation.compiled.c_functions`.
    origin, state, rate : (n,) array or number
        x = origin + state * xi; d(xi)/d(tau) = rate * f.
    parameters : (q,) array or number
        Scales of the parameters.
    """

    functions: tuple[Any, ...]
    origin: np.ndarray | float = 0.0
    state: np.ndarray | float = 1.0
    rate: np.ndarray | float = 1.0
    parameters: np.ndarray | float = 1.0


@dataclass(frozen=True)
class DynamicalSystem:
    """A smooth system x' = f(x, p) with its Jacobian matrix.

    Both functions take many states at once and must accept complex arguments (be analytic in x and
    p): all further derivatives are complex steps, exact to rounding.

    Attributes
    ----------
    rhs : callable
        ``rhs(states (m, n), parameters (q,)) -> (m, n)``.
    jacobian : callable
        ``jacobian(states (m, n), parameters (q,)) -> (m, n, n)``, ``[i, j, k] = df_j/dx_k`` at
        state i.
    dimension : int
        Number n of states.
    parameter_names : tuple of str
        Names of the q parameters.
    kernels : Kernels, optional
        The same functions compiled. Without them the compiled correctors call the Python functions
        back: the numbers are the same, the time is that of Python.
    """

    rhs: Callable[[np.ndarray, np.ndarray], np.ndarray]
    jacobian: Callable[[np.ndarray, np.ndarray], np.ndarray]
    dimension: int
    parameter_names: tuple[str, ...]
    kernels: Kernels | None = None

    def index(self, parameter: str) -> int:
        """Position of a parameter in the vector p."""
        return self.parameter_names.index(parameter)

    def rhs_parameter_derivative(
        self, states: np.ndarray, parameters: np.ndarray, index: int
    ) -> np.ndarray:
        """df/dp_index at every state, (m, n)."""
        return self.rhs(states, _step(parameters, index)).imag / _COMPLEX_STEP

    def jacobian_derivatives(
        self,
        state: np.ndarray,
        parameters: np.ndarray,
        directions: np.ndarray,
        indices: Sequence[int],
    ) -> tuple[np.ndarray, np.ndarray]:
        """Derivatives of J at one state along directions and in parameters.

        Parameters
        ----------
        state : (n,) array
        parameters : (q,) array
        directions : (d, n) array
            Real directions v.
        indices : sequence of int
            Positions of parameters.

        Returns
        -------
        tuple of arrays
            d/ds J(x + s v) at s = 0, (d, n, n); since second derivatives commute, column k is also
            d/dx_k (J v). And dJ/dp, (len(indices), n, n).
        """
        d, steps = len(directions), len(directions) + len(indices)
        states = np.array(np.broadcast_to(state, (steps, state.size)), complex)
        states[:d].imag += _COMPLEX_STEP * directions
        stepped = np.array(np.broadcast_to(parameters[:, None], (parameters.size, steps)), complex)
        for column, index in enumerate(indices, start=d):
            stepped[index, column] += 1j * _COMPLEX_STEP
        derivatives = self.jacobian(states, stepped).imag / _COMPLEX_STEP
        return derivatives[:d], derivatives[d:]

    def rhs_parameter_derivatives(
        self, state: np.ndarray, parameters: np.ndarray, indices: Sequence[int]
    ) -> np.ndarray:
        """df/dp at one state for several parameters, (len(indices), n)."""
        count = len(indices)
        stepped = np.array(np.broadcast_to(parameters[:, None], (parameters.size, count)), complex)
        stepped[list(indices), np.arange(count)] += 1j * _COMPLEX_STEP
        states = np.array(np.broadcast_to(state, (count, state.size)))
        return self.rhs(states, stepped).imag / _COMPLEX_STEP


def _step(parameters: np.ndarray, index: int) -> np.ndarray:
    stepped = np.array(parameters, dtype=complex)
    stepped[index] += 1j * _COMPLEX_STEP
    return stepped


@dataclass(frozen=True)
class Scaling:
    """Affine change of variables: x = origin + state * xi, t = time * tau, p = parameters * pi."""

    origin: np.ndarray
    state: np.ndarray
    time: float
    parameters: np.ndarray

    def to_states(self, scaled: np.ndarray) -> np.ndarray:
        """States (..., n) from scaled states."""
        return self.origin + self.state * scaled

    def from_states(self, states: np.ndarray) -> np.ndarray:
        """Scaled states from states (..., n)."""
        return (states - self.origin) / self.state


def rescaled(system: DynamicalSystem, scaling: Scaling) -> DynamicalSystem:
    """The same system in scaled variables.

    Parameters
    ----------
    system : DynamicalSystem
        System in physical units.
    scaling : Scaling
        Scales, each of the physical unit.

    Returns
    -------
    DynamicalSystem
        d(xi)/d(tau) = (time / state) f(origin + state xi, parameters pi).
    """
    rate = scaling.time / scaling.state
    matrix = rate[:, None] * scaling.state

    def physical(parameters: np.ndarray) -> np.ndarray:
        return (parameters.T * scaling.parameters).T

    def rhs(states: np.ndarray, parameters: np.ndarray) -> np.ndarray:
        return rate * system.rhs(scaling.to_states(states), physical(parameters))

    def jacobian(states: np.ndarray, parameters: np.ndarray) -> np.ndarray:
        return matrix * system.jacobian(scaling.to_states(states), physical(parameters))

    kernels = system.kernels
    if kernels is not None:
        kernels = replace(
            kernels,
            origin=kernels.origin + kernels.state * scaling.origin,
            state=kernels.state * scaling.state,
            rate=kernels.rate * rate,
            parameters=kernels.parameters * scaling.parameters,
        )
    return DynamicalSystem(rhs, jacobian, system.dimension, system.parameter_names, kernels)
