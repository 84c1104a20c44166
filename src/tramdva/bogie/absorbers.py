"""Absorbers of any stiffness and damping on the bogie, and the tuning of them."""

from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize

from tramdva.bogie.curving import Linearisation, System, linearise, linearised
from tramdva.bogie.modes import modes_of
from tramdva.bogie.names import ENERGY_CLASSES
from tramdva.bogie.parameters import BogieAbsorber
from tramdva.bogie.tram import BogieLine, Running, changed
from tramdva.bogie.vehicle import with_absorber_values


class AbsorberFamily(NamedTuple):
    """A bogie with its absorbers at a state of equilibrium, for any stiffness and damping of them.

    At rest an absorber transmits its weight, whatever its stiffness and damping: rims, contacts
    and their Jacobian are the same for all. A rotating one transmits nothing.

    system : with the absorbers `design`; contact_jacobian : (24, 44)
    """

    system: System
    design: BogieAbsorber
    contact_jacobian: np.ndarray

    def member(self, c_T: float, d_T: float) -> tuple[System, Linearisation]:
        """System and linearisation with a stiffness (N m/rad, N/m) and damping (N m s/rad)."""
        vehicle = with_absorber_values(self.system.vehicle, self.design, c_T, d_T)
        system = self.system._replace(vehicle=vehicle)
        return system, linearised(system, self.contact_jacobian)


def absorber_family(line: BogieLine, known: Running) -> AbsorberFamily:
    """Absorbers of the line in the curve."""
    design = line.bogie.absorber
    return family_of(design, changed(line, design, known))


def family_of(design: BogieAbsorber, run: Running) -> AbsorberFamily:
    """Absorbers of any stiffness and damping from the vehicle that runs with one of them."""
    linear = linearise(run.curve, run.equilibrium.state)
    return AbsorberFamily(run.curve, design, linear.contact_jacobian)


def tuned_absorber(
    family: AbsorberFamily, limits: tuple[float, float], start: tuple[float, float]
) -> tuple[float, float]:
    """Stiffness and damping that damp antisymmetric bending most; inertia as configured.

    Parameters
    ----------
    family : AbsorberFamily
    limits : Hz, of the oscillations that count
    start : stiffness (N m/rad, or N/m) and damping (N m s/rad, or N s/m)

    Notes
    -----
    The aim is the largest growth rate of the modes with more than half of their strain energy in
    antisymmetric bending and in the absorbers; others, which no absorber reaches, do not count.
    """
    classes = [ENERGY_CLASSES.index(name) for name in ("antisymmetric_bending", "absorber")]

    def growth(c_T: float, d_T: float) -> float:
        found = modes_of(*family.member(c_T, d_T), limits)
        reached = found.share[:, classes].sum(axis=(1, 2)) > 0.5
        return float(found.eigenvalue.real[reached].max()) if reached.any() else np.inf

    found = minimize(
        lambda logarithms: growth(*np.exp(logarithms)),
        np.log(start),
        method="Nelder-Mead",
        options={"xatol": 2e-3, "fatol": 1e-3, "maxfev": 80},
    )
    return tuple(map(float, np.exp(found.x)))


def carried_over(inertia: float, m_T: float, c_T: float, d_T: float) -> tuple[float, float]:
    """Stiffness and damping that give `inertia` the frequency and damping ratio of an absorber."""
    return inertia * c_T / m_T, inertia * d_T / m_T
