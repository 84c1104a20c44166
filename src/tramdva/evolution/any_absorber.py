"""Evolution tendency with any absorbers, from the vehicle without absorbers in its equilibrium."""

from typing import NamedTuple

import numpy as np

from tramdva.bogie.absorbers import Receptances, attach, receptances
from tramdva.bogie.curving import Equilibrium, System
from tramdva.bogie.rough_wheels import rough_bogie
from tramdva.bogie.tram import BogieLine
from tramdva.evolution.tendency import Wearing, evolution_tendency, wear_rows, wear_sensitivity


class AnyAbsorber(NamedTuple):
    """What tells the tendency with every stiffness and damping of the absorbers.

    bare : responses of the vehicle without absorbers
    output : (f, wheels, 40), wear of the wheels out of round per local variables of the contacts
    direct : (f, wheels), wear by the radius deviation itself
    inertia : of the absorber, kg m^2 (kg if it translates)
    """

    bare: Receptances
    output: np.ndarray
    direct: np.ndarray
    inertia: float

    def without(self) -> np.ndarray:
        """Evolution tendency (f, wheels) without absorbers."""
        moved = np.einsum("fko,fo->fk", self.output, self.bare.local_by_wave)
        return evolution_tendency(moved + self.direct)

    def tendency(self, c_T: float, d_T: float) -> np.ndarray:
        """Evolution tendency (f, wheels) with a stiffness and damping of the absorbers."""
        moved = attach(self.bare, self.inertia, c_T, d_T, self.output)
        return evolution_tendency(moved + self.direct)


def any_absorber(
    wearing: Wearing,
    line: BogieLine,
    system: System,
    equilibrium: Equilibrium,
    frequency: np.ndarray,
) -> AnyAbsorber:
    """Prepare the tendency with any absorbers.

    Parameters
    ----------
    wearing : Wearing
    line : BogieLine, for places and inertia of the absorbers
    system, equilibrium : of the vehicle without absorbers
    frequency : (f,) Hz

    Returns
    -------
    AnyAbsorber
    """
    bogie, wheels = rough_bogie(system, equilibrium), wearing.places
    rows = wear_rows(
        bogie,
        wear_sensitivity(bogie, system.contacts.law, wearing),
        frequency,
        system.contacts.places.speed,
        line.bogie.wheel.radius,
        wearing.wheels,
    )
    absorber = line.bogie.absorber
    bare = receptances(system, equilibrium, bogie, absorber, 2.0 * np.pi * frequency, rows.source)
    return AnyAbsorber(bare, rows.output(wheels), rows.direct[:, wheels], absorber.I_T)
