"""The vehicle near an equilibrium in modal coordinates."""

from typing import NamedTuple

import numpy as np

from tramdva.bogie import wheel_forces
from tramdva.bogie.curving import Equilibrium, System, linearise
from tramdva.bogie.integration import ModalContacts


class ModalBasis(NamedTuple):
    """Vehicle near an equilibrium in modal coordinates: m real or pairs of conjugate modes.

    Modal states are packed: m real parts, then m imaginary parts.

    eigenvalue : (m,) complex, 1/s
    state : (nx,) of the equilibrium; to_modal : (m, nx); to_state : (nx, m), real part counts
    load : (m, n) complex, modal forcing from generalised forces
    contact : ModalContacts, all that the compiled steps need
    """

    eigenvalue: np.ndarray
    state: np.ndarray
    to_modal: np.ndarray
    to_state: np.ndarray
    load: np.ndarray
    contact: ModalContacts


def modal_basis(system: System, equilibrium: Equilibrium) -> ModalBasis:
    """Modal coordinates about an equilibrium, scaled to velocities of at most 1 m/s or rad/s."""
    linear = linearise(system, equilibrium.state)
    values, vectors = np.linalg.eig(linear.matrix)
    vectors = vectors / np.abs(vectors[system.size :]).max(axis=0)
    inverse = np.linalg.inv(vectors)
    kept = values.imag >= 0.0
    values, left = values[kept], inverse[kept]
    right = vectors[:, kept] * np.where(values.imag > 0.0, 2.0, 1.0)
    output = linear.output @ right
    load = left @ linear.input
    forcing = load @ system.vehicle.force_input
    force, _ = wheel_forces.contact_forces(
        system.contacts, system.curvatures, system.local(equilibrium.state)
    )
    return ModalBasis(
        values,
        equilibrium.state,
        left,
        right,
        load,
        ModalContacts(
            np.ascontiguousarray(np.vstack([output.real.T, -output.imag.T])),
            np.ascontiguousarray(np.hstack([forcing.real.T, forcing.imag.T])),
            system.local(equilibrium.state),
            force,
            linear.contact_jacobian,
        ),
    )


def packed(z: np.ndarray) -> np.ndarray:
    """Modal state (m,) complex as (2 m,) real."""
    return np.concatenate([z.real, z.imag])


def modal_state(basis: ModalBasis, state: np.ndarray) -> np.ndarray:
    """Packed modal state of a state of the vehicle (m, rad and per s)."""
    return packed(basis.to_modal @ (state - basis.state))


def vehicle_state(basis: ModalBasis, modal: np.ndarray) -> np.ndarray:
    """State of the vehicle (m, rad and per s) of a packed modal state."""
    m = basis.eigenvalue.size
    return basis.state + (basis.to_state @ (modal[:m] + 1j * modal[m:])).real
