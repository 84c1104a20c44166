"""Evolution tendency with any absorbers, from the vehicle without absorbers in its equilibrium."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tramdva import evolution
from tramdva.bogie import attached_absorbers
from tramdva.bogie.curving import Equilibrium, System
from tramdva.bogie.line import BogieLine
from tramdva.bogie.rough_wheels import rough_bogie
from tramdva.evolution_stages import wear_in_equilibrium, worn_wheels


class AnyAbsorber(NamedTuple):
    """What tells the tendency with every stiffness and damping of the absorbers.

    bare : responses of the vehicle without absorbers
    output : (f, wheels, 44), wear of the wheels out of round per local variables of the contacts
    direct : (f, wheels), wear by the radius deviation itself
    inertia : of the absorber, kg m^2 (kg if it translates)
    """

    bare: attached_absorbers.Receptances
    output: np.ndarray
    direct: np.ndarray
    inertia: float

    def without(self) -> np.ndarray:
        """Evolution tendency (f, wheels) without absorbers."""
        moved = np.einsum("fko,fo->fk", self.output, self.bare.local_by_wave)
        return evolution.evolution_tendency(moved + self.direct)

    def tendency(self, c_T: float, d_T: float) -> np.ndarray:
        """Evolution tendency (f, wheels) with a stiffness and damping of the absorbers."""
        moved = attached_absorbers.attach(self.bare, self.inertia, c_T, d_T, self.output)
        return evolution.evolution_tendency(moved + self.direct)


def any_absorber(
    cfg: Mapping[str, Any],
    line: BogieLine,
    system: System,
    equilibrium: Equilibrium,
    frequency: np.ndarray,
) -> AnyAbsorber:
    """Prepare the tendency with any absorbers.

    Parameters
    ----------
    cfg : sections ``wear``, ``out_of_roundness.wheels``, ``numerics``
    line : BogieLine, for places and inertia of the absorbers
    system, equilibrium : of the vehicle without absorbers
    frequency : (f,) Hz

    Returns
    -------
    AnyAbsorber
    """
    bogie, wheels = rough_bogie(system, equilibrium), worn_wheels(cfg)
    rows = evolution.wear_rows(
        bogie,
        wear_in_equilibrium(cfg, bogie, system.contacts.law),
        frequency,
        system.contacts.places.speed,
        line.bogie.wheel.radius,
        cfg["out_of_roundness"]["wheels"],
    )
    absorber = line.bogie.absorber
    bare = attached_absorbers.receptances(
        system, equilibrium, bogie, absorber, 2.0 * np.pi * frequency, rows.source
    )
    return AnyAbsorber(bare, rows.output(wheels), rows.direct[:, wheels], absorber.I_T)
