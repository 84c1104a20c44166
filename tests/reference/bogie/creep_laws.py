"""Creep forces on an ellipse that may be turned against the rolling direction. NumPy and SciPy.

FASTSIM (Kalker 1982) on strips along the rolling direction, and the law of Shen, Hedrick and Elkins
(1983). Creepages: velocity of the wheel over the rail, divided by the speed of rolling; forces act
on the wheel. x along rolling, y = normal x rolling.
"""

import numpy as np
from scipy.interpolate import CubicSpline

# Kalker (1990): C11, C22, C23 at a/b, for Poisson's ratios 0, 1/4, 1/2.
_RATIO = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0,
          1/0.9, 1/0.8, 1/0.7, 1/0.6, 1/0.5, 1/0.4, 1/0.3, 1/0.2, 1/0.1]  # fmt: skip
_C11 = [[2.51, 2.59, 2.68, 2.78, 2.88, 2.98, 3.09, 3.19, 3.29, 3.40,
         3.51, 3.65, 3.82, 4.06, 4.37, 4.84, 5.57, 6.96, 10.7],
        [3.31, 3.37, 3.44, 3.53, 3.62, 3.72, 3.81, 3.91, 4.01, 4.12,
         4.22, 4.36, 4.54, 4.78, 5.10, 5.57, 6.34, 7.78, 11.7],
        [4.85, 4.81, 4.80, 4.82, 4.83, 4.91, 4.97, 5.05, 5.12, 5.20,
         5.30, 5.42, 5.58, 5.80, 6.11, 6.57, 7.34, 8.82, 12.9]]  # fmt: skip
_C22 = [[2.51, 2.59, 2.68, 2.78, 2.88, 2.98, 3.09, 3.19, 3.29, 3.40,
         3.51, 3.65, 3.82, 4.06, 4.37, 4.84, 5.57, 6.96, 10.7],
        [2.52, 2.63, 2.75, 2.88, 3.01, 3.14, 3.28, 3.41, 3.54, 3.67,
         3.81, 3.99, 4.21, 4.50, 4.90, 5.48, 6.40, 8.14, 12.8],
        [2.53, 2.66, 2.81, 2.98, 3.14, 3.31, 3.48, 3.65, 3.82, 3.98,
         4.16, 4.39, 4.67, 5.04, 5.56, 6.31, 7.51, 9.79, 16.0]]  # fmt: skip
_C23 = [[0.334, 0.483, 0.607, 0.720, 0.827, 0.930, 1.03, 1.13, 1.23, 1.33,
         1.44, 1.58, 1.76, 2.01, 2.35, 2.88, 3.79, 5.72, 12.2],
        [0.473, 0.603, 0.715, 0.823, 0.929, 1.03, 1.14, 1.25, 1.36, 1.47,
         1.59, 1.75, 1.95, 2.23, 2.62, 3.24, 4.32, 6.63, 14.6],
        [0.731, 0.809, 0.889, 0.977, 1.07, 1.18, 1.29, 1.40, 1.51, 1.63,
         1.77, 1.94, 2.18, 2.50, 2.96, 3.70, 5.01, 7.89, 18.0]]  # fmt: skip


def kalker(poisson):
    """Function of ln(a/b): C11, C22, C23."""
    inverse = 1.0 / np.array([_C11, _C22, _C23])  # (3, nu, ratio)
    nodes = np.array([0.0, 0.25, 0.5])
    weight = [np.prod([(poisson - o) / (n - o) for o in nodes if o != n]) for n in nodes]
    spline = CubicSpline(np.log(_RATIO), np.einsum("cnr,n->rc", inverse, np.array(weight)))
    return lambda logarithm: 1.0 / spline(logarithm)


class CreepLaw:
    """Creep forces for a material, a friction coefficient given from outside.

    kind : 'fastsim' or 'she'; bound : exponents (across, along) of the traction bound
        (1 - y^2)^across (1 - x^2)^along, (1, 1) parabolic, (1/2, 1/2) Hertzian
    """

    def __init__(self, youngs, poisson, kind="fastsim", bound=(0.5, 0.75), cells=(60, 40)):
        self.shear, self.kind = 0.5 * youngs / (1.0 + poisson), kind
        self.coefficients = kalker(poisson)
        # Strips by the angle in y = sin(angle): their ends are dense where they are short.
        angle = (np.arange(cells[1]) + 0.5) / cells[1] * np.pi - 0.5 * np.pi
        self.y = np.sin(angle)
        self.half = np.cos(angle)
        width = np.cos(angle) * np.pi / cells[1]
        edge = np.cos(np.linspace(0.0, np.pi, cells[0] + 1))  # leading edge 1, trailing -1
        self.step = edge[:-1] - edge[1:]
        self.middle = 0.5 * (edge[1:] + edge[:-1])
        limit = ((1.0 - self.y**2) ** bound[0])[None] * ((1.0 - self.middle**2) ** bound[1])[
            :, None
        ]
        self.area = self.step[:, None] * (self.half * width)[None]
        self.limit = limit / (self.area * limit).sum()

    def forces(self, form, limit, creepage):
        """Force along x, along y (N) and moment about the normal (N m) on the wheel.

        form : (2, 2) of the ellipse; limit : N, friction times normal force
        creepage : x, y, and spin in 1/m
        """
        a = form[0, 0] ** -0.5
        lean = -form[0, 1] / form[0, 0]  # of the middles of the strips
        b = (form[1, 1] - form[0, 1] ** 2 / form[0, 0]) ** -0.5
        c11, c22, c23 = self.coefficients(np.log(a / b))
        if self.kind == "she":
            return self._saturated(a, b, c11, c22, c23, limit, creepage)
        flexibility = [8 * a / (3 * c11 * self.shear), 8 * a / (3 * c22 * self.shear),
                       np.pi * a * np.sqrt(a / b) / (4 * c23 * self.shear)]  # fmt: skip
        rate = np.array(creepage) / flexibility
        y = b * self.y
        traction = np.zeros((2, y.size))
        total, moment = np.zeros(2), 0.0
        edge = 1.0
        for step, bound, area in zip(
            self.step, self.limit * (limit / (a * b)), self.area * (a * b), strict=True
        ):
            # To the middle of the cell: half of this step and of the one before.
            edge_middle = edge - 0.5 * step
            traction = self._advance(traction, 0.5 * step, edge - 0.25 * step, a, lean, y, rate)
            size = np.hypot(*traction)
            traction = traction * np.minimum(1.0, bound / np.maximum(size, 1e-300))
            total += traction @ area
            x = lean * y + a * self.half * edge_middle
            moment += (x * traction[1] - y * traction[0]) @ area
            traction = self._advance(traction, 0.5 * step, edge - 0.75 * step, a, lean, y, rate)
            edge -= step
        return *total, moment

    def _advance(self, traction, step, place, a, lean, y, rate):
        length = step * a * self.half
        x = lean * y + a * self.half * place
        return traction - length * np.array([rate[0] - rate[2] * y, rate[1] + rate[2] * x])

    def _saturated(self, a, b, c11, c22, c23, limit, creepage):
        nu_x, nu_y, spin = creepage
        stiff, size = self.shear * a * b, np.sqrt(a * b)
        linear = -stiff * np.array([c11 * nu_x, c22 * nu_y + size * c23 * spin])
        ratio = np.hypot(*linear) / limit
        used = 1.0 if ratio >= 3.0 else ratio - ratio**2 / 3.0 + ratio**3 / 27.0
        scale = used / max(ratio, 1e-300)
        return *(scale * linear), scale * stiff * size * c23 * nu_y
