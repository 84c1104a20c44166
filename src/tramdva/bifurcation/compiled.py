"""Right-hand sides as compiled kernels call them: by the address of a C function.

A kernel that took Python functions as arguments would be compiled anew for each system and in each
process. Called by address, one compiled corrector serves all systems, and Numba keeps it on disk.

f(x, p) and its Jacobian matrix are, as C functions, ::

    void function(const T *states, intptr m, intptr n,
                  const T *parameters, intptr rows, intptr q, T *out)

with T double or double complex and arrays in C order: states (m, n), parameters (1, q) for all
states or (m, q) for each, out (m, n) or (m, n, n).
"""

import ctypes
from collections.abc import Callable
from typing import Any, NamedTuple

import numba
import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic, overload

from tramdva.bifurcation.elimination import inner_jit, jit
from tramdva.bifurcation.system import DynamicalSystem, Kernels

STEP = 1e-30  # of complex steps, whose derivatives are exact to rounding
_SIZE, _POINTER = ctypes.c_ssize_t, ctypes.c_void_p
_PROTOTYPE = ctypes.CFUNCTYPE(None, _POINTER, _SIZE, _SIZE, _POINTER, _SIZE, _SIZE, _POINTER)


def c_functions(rhs: Callable, jacobian: Callable) -> tuple[Any, ...] | None:
    """Compile f and J for real and complex arguments.

    Parameters
    ----------
    rhs, jacobian : function
        Python functions with the arguments of the C function above, which Numba can compile:
        pointers become arrays by `numba.carray`. Numba keeps them on disk where they are functions
        of a module (not made inside another function).

    Returns
    -------
    tuple or None
        f of real, f of complex, J of real, J of complex arguments; None where Numba is switched
        off (NUMBA_DISABLE_JIT).
    """
    if numba.config.DISABLE_JIT:
        return None
    compiled = []
    for function in (rhs, jacobian):
        for kind in (types.float64, types.complex128):
            pointer, size = types.CPointer(kind), types.intp
            signature = types.void(pointer, size, size, pointer, size, size, pointer)
            compiled.append(numba.cfunc(signature, cache=True)(function))
    return tuple(compiled)


class Evaluator(NamedTuple):
    """A system as the kernels see it: f and J by address, and a change of variables.

    Attributes
    ----------
    addresses : (4,) int array
        C functions: f of real, f of complex, J of real, J of complex arguments.
    origin, state, rate : (n,) array
        x = origin + state * xi; d(xi)/d(tau) = rate * f.
    parameters : (q,) array
        Scales of the parameters.
    """

    addresses: np.ndarray
    origin: np.ndarray
    state: np.ndarray
    rate: np.ndarray
    parameters: np.ndarray


class Evaluation:
    """The evaluator of a system; it lives as long as its addresses are valid.

    Parameters
    ----------
    system : DynamicalSystem
        With kernels, or with Python functions alone: these are called back, 10 to 20 us each time.
    """

    def __init__(self, system: DynamicalSystem) -> None:
        n = system.dimension
        self._error: BaseException | None = None
        kernels = system.kernels or self._callbacks(system)
        self._functions = kernels.functions
        self.evaluator = Evaluator(
            addresses=np.array([_address(function) for function in kernels.functions], np.intp),
            origin=np.array(np.broadcast_to(kernels.origin, n), float),
            state=np.array(np.broadcast_to(kernels.state, n), float),
            rate=np.array(np.broadcast_to(kernels.rate, n), float),
            parameters=np.array(
                np.broadcast_to(kernels.parameters, len(system.parameter_names)), float
            ),
        )

    def check(self) -> None:
        """Raise what a Python function raised during a kernel, which saw NaN instead."""
        if self._error is not None:
            error, self._error = self._error, None
            raise error

    def _callbacks(self, system: DynamicalSystem) -> Kernels:
        functions = [
            self._callback(function, kind, dimensions)
            for function, dimensions in ((system.rhs, 2), (system.jacobian, 3))
            for kind in (float, complex)
        ]
        return Kernels(tuple(functions))

    def _callback(self, function: Callable[..., Any], kind: type, dimensions: int) -> Any:
        """A C function that calls a Python function; exceptions cannot pass and are kept."""

        def called(
            states: int, m: int, n: int, parameters: int, rows: int, q: int, out: int
        ) -> None:
            values = _at(out, (m, n, n)[:dimensions], kind)
            p = _at(parameters, (rows, q), kind)
            try:
                values[...] = function(_at(states, (m, n), kind), p[0] if rows == 1 else p.T)
            except Exception as error:
                self._error = error
                values[...] = np.nan

        return _PROTOTYPE(called)


def _address(function: Any) -> int:
    """Address of a compiled, or of a called back, function."""
    address = getattr(function, "address", None)
    return ctypes.cast(function, _POINTER).value if address is None else address


def _at(address: int, shape: tuple[int, ...], kind: type) -> np.ndarray:
    """Array over memory at an address."""
    size = int(np.prod(shape)) * np.dtype(kind).itemsize
    return np.frombuffer((ctypes.c_char * size).from_address(address), kind).reshape(shape)


def call(address: int, states: np.ndarray, parameters: np.ndarray, out: np.ndarray) -> None:
    """Call the C function at an address; without Numba this is what its kernels use."""
    pointers = [array.ctypes.data for array in (states, parameters, out)]
    function = _PROTOTYPE(int(address))
    function(pointers[0], *states.shape, pointers[1], *parameters.shape, pointers[2])


@overload(call)
def _compiled_call(address, states, parameters, out):
    return lambda address, states, parameters, out: _jump(address, states, parameters, out)


@intrinsic
def _jump(typingctx, address, states, parameters, out):
    """The machine code of `call`."""

    def codegen(context, builder, signature, args):
        size = context.get_value_type(types.intp)
        values, kinds = [], []
        for i in (1, 2, 3):
            array = context.make_array(signature.args[i])(context, builder, args[i])
            values.append(array.data)
            kinds.append(array.data.type)
            if i < 3:  # the shape of the result follows
                values += [builder.extract_value(array.shape, axis) for axis in (0, 1)]
                kinds += [size, size]
        function = ir.FunctionType(ir.VoidType(), kinds)
        pointer = builder.inttoptr(args[0], function.as_pointer())
        builder.call(pointer, values)
        return context.get_dummy_value()

    return types.void(types.intp, states, parameters, out), codegen


@jit
def right_hand_sides(system, states, parameters):
    """f at scaled states (m, n) and parameters (1, q), or (m, q) for each state, (m, n)."""
    m, n = states.shape
    out = np.empty_like(states)
    address = system.addresses[1 if np.iscomplexobj(states) else 0]
    call(address, _physical_states(system, states), _physical_parameters(system, parameters), out)
    for i in range(m):
        for j in range(n):
            out[i, j] = system.rate[j] * out[i, j]
    return out


@jit
def jacobian_matrices(system, states, parameters):
    """J at scaled states and parameters as in `right_hand_sides`, (m, n, n)."""
    m, n = states.shape
    out = np.empty((m, n, n), states.dtype)
    address = system.addresses[3 if np.iscomplexobj(states) else 2]
    call(address, _physical_states(system, states), _physical_parameters(system, parameters), out)
    for i in range(m):
        for j in range(n):
            for k in range(n):
                out[i, j, k] = (system.rate[j] * system.state[k]) * out[i, j, k]
    return out


@inner_jit
def _physical_states(system, states):
    out = np.empty_like(states)
    for i in range(states.shape[0]):
        for j in range(states.shape[1]):
            out[i, j] = system.origin[j] + system.state[j] * states[i, j]
    return out


@inner_jit
def _physical_parameters(system, parameters):
    out = np.empty_like(parameters)
    for i in range(parameters.shape[0]):
        for j in range(parameters.shape[1]):
            out[i, j] = parameters[i, j] * system.parameters[j]
    return out


@inner_jit
def fill(out, values):
    """Copy element by element: an assignment of arrays compiles seconds of error messages."""
    flat = values.reshape(-1)
    for k in range(out.size):
        out[k] = flat[k]
