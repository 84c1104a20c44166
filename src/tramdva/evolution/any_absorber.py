"""Evolution tendency with any absorbers, from the vehicle without absorbers in its equilibrium."""

from typing import NamedTuple

import numpy as np

from tramdva.bogie.absorber_ports import PortModes, Ports, port_modes, ports, receptances
from tramdva.bogie.curving import Equilibrium, System
from tramdva.bogie.rough_vehicle import rough_bogie
from tramdva.bogie.tram import BogieLine
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


class WearPorts(NamedTuple):
    """The bogie without absorbers as they see it, for the wear of the wheels out of round.

    without_absorbers : (f, wheels) complex wear response
    ports : of the places of the absorbers, whose mass across their direction loads the axle already
    """

    without_absorbers: np.ndarray
    ports: Ports


def wear_ports(
    wearing: Wearing,
    line: BogieLine,
    system: System,
    equilibrium: Equilibrium,
    frequency: np.ndarray,
) -> WearPorts:
    """Wear and motion of the places of the absorbers, by waves and by forces of the absorbers.

    Parameters
    ----------
    wearing : Wearing
    line : BogieLine, for places and inertia of the absorbers
    system, equilibrium : of the vehicle without absorbers
    frequency : (f,) Hz
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
    absorber, turn = line.bogie.absorber, 2.0 * np.pi * frequency
    bare = receptances(system, equilibrium, bogie, absorber, turn, rows.source)
    output, direct = rows.output(wheels), rows.direct[:, wheels]
    alone = np.einsum("fko,fo->fk", output, bare.local_by_wave) + direct
    return WearPorts(alone, ports(bare, absorber.I_T, output, direct))


def any_absorber(
    wearing: Wearing,
    line: BogieLine,
    system: System,
    equilibrium: Equilibrium,
    frequency: np.ndarray,
) -> AnyAbsorber:
    """Prepare the tendency with any absorbers; arguments as in `wear_ports`."""
    found = wear_ports(wearing, line, system, equilibrium, frequency)
    modes = port_modes(found.ports)
    return AnyAbsorber(found.without_absorbers, modes, line.bogie.absorber.I_T)
