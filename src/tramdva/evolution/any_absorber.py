"""Evolution tendency with any absorbers, from the vehicle without absorbers in its equilibrium."""

from typing import NamedTuple

import numpy as np

from tramdva.bogie.absorber_ports import (
    ABSORBERS,
    Attachable,
    PortModes,
    Ports,
    port_modes,
    ports,
    receptances,
)
from tramdva.bogie.absorber_weight import carrying
from tramdva.bogie.conditions import State
from tramdva.bogie.rough_vehicle import rough_bogie
from tramdva.evolution.tendency import Wearing, evolution_tendency, wear_rows, wear_sensitivity


class AnyAbsorber(NamedTuple):
    """What tells the tendency with every stiffness and damping of the absorbers.

    without_absorbers : (f, wheels) complex wear response
    modes : wear of the wheels out of round and motion of the absorbers' places
    inertia : of the absorber, kg m^2 (kg if it translates)
    """

    without_absorbers: np.ndarray
    modes: PortModes
    inertia: float

    def without(self) -> np.ndarray:
        """Evolution tendency (f, wheels) without absorbers."""
        return evolution_tendency(self.without_absorbers)

    def tendency(self, c_T: float, d_T: float) -> np.ndarray:
        """Evolution tendency (f, wheels) with a stiffness and damping (SI) of the absorbers."""
        return evolution_tendency(self.modes.response(self.inertia, c_T, d_T))


def wear_ports(wearing: Wearing, bare: State, laden: State, frequency: np.ndarray) -> Attachable:
    """Wear of the wheels out of round, to which absorbers can be attached.

    Parameters
    ----------
    wearing : Wearing
    bare : vehicle without absorbers in its equilibrium; its line says their places and inertia
    laden : the same under the weight of the absorbers, as from `carrying`
    frequency : (f,) Hz
    """
    alone, place, found = _answers(wearing, bare, frequency)
    if laden is not bare:
        _, _, found = _answers(wearing, laden, frequency)
    return Attachable(alone, place, found)


def _answers(
    wearing: Wearing, state: State, frequency: np.ndarray
) -> tuple[np.ndarray, np.ndarray, Ports]:
    """Wear response and motion of the places alone, and ports, of a vehicle without absorbers."""
    system, equilibrium = state.system, state.equilibrium
    bogie, wheels = rough_bogie(system, equilibrium), wearing.places
    rows = wear_rows(
        bogie,
        wear_sensitivity(bogie, system.contacts.law, wearing),
        frequency,
        system.contacts.places.speed,
        state.line.bogie.wheel.radius,
        wearing.wheels,
    )
    absorber, turn = state.line.bogie.absorber, 2.0 * np.pi * frequency
    seen = receptances(system, equilibrium, bogie, absorber, turn, rows.source)
    output, direct = rows.output(wheels), rows.direct[:, wheels]
    alone = np.einsum("fko,fo->fk", output, seen.local_by_wave) + direct
    return alone, seen.place_by_wave[:, :ABSORBERS], ports(seen, absorber.I_T, output, direct)


def any_absorber(wearing: Wearing, bare: State, frequency: np.ndarray) -> AnyAbsorber:
    """Prepare the tendency with any absorbers.

    Parameters
    ----------
    wearing : Wearing
    bare : vehicle without absorbers in its equilibrium; its line says their places and inertia
    frequency : (f,) Hz

    Notes
    -----
    Where their weight leaves no steady running, the tendency with absorbers is not a number.
    """
    laden = carrying(bare)
    runs = laden.equilibrium.status == "converged"
    found = wear_ports(wearing, bare, laden if runs else bare, frequency)
    modes = port_modes(found.ports)
    if not runs:
        modes = PortModes(*(np.full_like(values, np.nan) for values in modes))
    return AnyAbsorber(found.without_absorbers, modes, bare.line.bogie.absorber.I_T)
