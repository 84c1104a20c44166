"""Arithmetic for kernels that compile for numbers and for the complex step.

A complex number whose imaginary part is some 1e-30 of its real part carries a derivative: analytic
operations multiply it by theirs, without the rounding of a difference. Products of two imaginary
parts vanish beside the real part, so that root and quotient need their first order only. That is
a root and a division of real numbers instead of the library's complex ones, which branch for cases
that there are none of. Comparisons are between real parts: the derivative is that of the branch
which the value takes.
"""

from typing import Any

import numpy as np
from numba import types
from numba.extending import overload

STEP = 1e-30


def root(x: Any) -> Any:
    """Square root of a number with a positive real part."""
    return np.sqrt(x)


@overload(root, inline="always")
def _root(x):
    if not isinstance(x, types.Complex):
        return lambda x: np.sqrt(x)

    def first_order(x):
        size = np.sqrt(x.real)
        return complex(size, 0.5 * x.imag / size)

    return first_order


def quotient(x: Any, y: Any) -> Any:
    """x / y."""
    return x / y


@overload(quotient, inline="always")
def _quotient(x, y):
    if not isinstance(y, types.Complex):
        if not isinstance(x, types.Complex):
            return lambda x, y: x / y
        return lambda x, y: complex(x.real / y, x.imag / y)

    def first_order(x, y):
        over = 1.0 / y.real
        found = x * over
        return complex(found.real, found.imag - found.real * y.imag * over)

    return first_order
