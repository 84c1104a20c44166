"""The vehicle reduced to two masses at a contact point; second bending found by its shape."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.linalg import expm

from tramdva.bogie import reduction, tracking
from tramdva.bogie.curving import linearise
from tramdva.bogie.modes import modes
from tramdva.bogie.reduction import Chain, chain_of, modes_of_chain, point_modes, undamped_chain
from tramdva.bogie.vehicle import absorber_carriers

TABLE_1 = Chain(400.0, 7250.0, 5.2e7, 125.0, 9500.0, 4.9e7)


@settings(max_examples=40, deadline=None)
@given(st.lists(st.floats(-1.2, 1.2), min_size=6, max_size=6))
def test_a_chain_is_its_own_reduction(logarithms) -> None:
    chain = Chain(*(np.array(TABLE_1) * np.exp(logarithms)))
    found = modes_of_chain(chain)
    assume(len(found) == 2)  # none is overdamped
    # Where both modes strain axle and layer alike, nobody can tell their dampers apart.
    motion = np.array([chain.share_of_axle(mode.pole) for mode in found])
    shares = np.log(motion / np.array([abs(1.0 - motion[0]), 1.0 + motion[1]]))
    assume(abs(shares[0] - shares[1]) > 0.5)

    np.testing.assert_allclose(chain_of(*found), chain, rtol=1e-6)


def test_a_chain_within_a_larger_vehicle_is_found() -> None:
    """Beside it another oscillator, and all coordinates mixed."""
    random = np.random.default_rng(3)
    matrix = np.zeros((6, 6))
    matrix[:4, :4] = TABLE_1.state_matrix()
    matrix[4:, 4:] = [[0.0, 1.0], [-((2 * np.pi * 80.0) ** 2), -20.0]]
    mixing = random.normal(size=(6, 6))
    push, seen = np.zeros(6), np.zeros(6)
    push[3], seen[1] = 1.0 / TABLE_1.m_R, 1.0

    found = point_modes(
        mixing @ matrix @ np.linalg.inv(mixing), mixing @ push, seen @ np.linalg.inv(mixing)
    )

    first, other, second = found
    assert other.frequency == pytest.approx(80.0, rel=1e-3)
    assert other.mass > 1e6 * first.mass
    # Eigenvalues of the mixed matrix are less precise.
    np.testing.assert_allclose(chain_of(first, second), TABLE_1, rtol=1e-5)


def test_modal_masses_say_how_a_push_rings() -> None:
    """Free ringing after a push of 1 N s, from the matrix exponential, against the two modes."""
    matrix, time = TABLE_1.state_matrix(), np.linspace(0.0, 0.1, 50)
    push = np.array([0.0, 0.0, 0.0, 1.0 / TABLE_1.m_R])
    exact = np.array([(expm(matrix * t) @ push)[1] for t in time])

    first, second = undamped_modes = modes_of_chain(TABLE_1)
    ringing = sum(
        np.exp(m.pole.real * time) * np.sin(m.pole.imag * time) / (m.mass * m.pole.imag)
        for m in undamped_modes
    )
    # Modal masses alone leave out the phases of the residues, of the order of the damping ratio.
    assert np.abs(ringing - exact).max() < 0.03 * np.abs(exact).max()
    assert 1 / first.mass + 1 / second.mass == pytest.approx(1 / TABLE_1.m_R, rel=2e-3)


def test_without_damping_the_formulas_are_exact() -> None:
    chain = TABLE_1._replace(d_A=1e-3, d_R=1e-3)

    np.testing.assert_allclose(undamped_chain(*modes_of_chain(chain)), chain, rtol=1e-6)


def test_a_vibration_that_other_wheels_feed_makes_a_damper_below_zero() -> None:
    first, second = modes_of_chain(TABLE_1)
    fed = first._replace(pole=first.pole - 4.0 * first.pole.real)

    chain = chain_of(fed, second)

    assert chain.d_A < 0.0 < chain.d_R
    assert modes_of_chain(chain)[0].pole.real == pytest.approx(fed.pole.real, rel=1e-6)
    assert chain.c_A == pytest.approx(TABLE_1.c_A, rel=0.02)


def test_creep_force_of_the_wheel_is_left_out_and_its_normal_force_kept(running) -> None:
    system, state = running.curve, running.equilibrium.state
    jacobian = linearise(system, state).contact_jacobian

    smooth = reduction.without_own_creep(system, state, jacobian, "front_inner").contact_jacobian

    own, others = slice(6, 12), np.r_[0:6, 12:24]
    np.testing.assert_array_equal(smooth[others], jacobian[others])
    vertical, lateral = smooth[8], smooth[7]
    assert vertical[12] == pytest.approx(jacobian[8, 12], rel=0.05)  # stiffness of the contact
    # Without friction no force depends on how fast the wheel slides or spins.
    assert np.abs(lateral[15:17]).max() < 1e-3 * np.abs(jacobian[7, 15:17]).max()
    assert (smooth[own] != jacobian[own]).any()


def seen_from_inner_wheel(running, bogie):
    system, state = running.curve, running.equilibrium.state
    jacobian = linearise(system, state).contact_jacobian
    linear = reduction.without_own_creep(system, state, jacobian, "front_inner")
    along, _ = absorber_carriers(system.vehicle, bogie.absorber)
    return linear, reduction.reduced(system, linear, "front_inner", 0.3, along, (30.0, 200.0))


def test_chain_answers_a_force_at_the_wheel_as_the_vehicle_does(running, bogie) -> None:
    """At resonance of second bending, by solving both linear systems; other modes add little."""
    system = running.curve
    linear, seen = seen_from_inner_wheel(running, bogie)
    rim = system.vehicle.motion_of["front_inner_rim"]
    point = rim[1] + 0.3 * rim[3]
    omega = abs(seen.bending.pole)

    size = linear.matrix.shape[0]
    answer = np.linalg.solve(1j * omega * np.eye(size) - linear.matrix, linear.input @ point)
    chain = chain_of(seen.bending, seen.wheel)
    push = np.array([0.0, 0.0, 0.0, 1.0 / chain.m_R])
    short = np.linalg.solve(1j * omega * np.eye(4) - chain.state_matrix(), push)

    assert abs(point[: system.size] @ answer[: system.size]) == pytest.approx(
        abs(short[1]), rel=0.15
    )


def test_absorber_of_the_chain_moves_the_pole_as_those_of_the_bogie_do(running, bogie) -> None:
    """Small absorbers of a hundredth of the inertia, tuned far above: they are masses only."""
    system, state = running.curve, running.equilibrium.state
    _, seen = seen_from_inner_wheel(running, bogie)
    chain = chain_of(seen.bending, seen.wheel)
    inertia = 0.01 * bogie.absorber.I_T
    along, _ = absorber_carriers(system.vehicle, bogie.absorber)
    vehicle = system.vehicle._replace(mass=system.vehicle.mass + inertia * along.T @ along)
    heavier = system._replace(vehicle=vehicle)
    jacobian = linearise(system, state).contact_jacobian
    poles = np.linalg.eigvals(
        reduction.without_own_creep(heavier, state, jacobian, "front_inner").matrix
    )
    moved = poles[np.argmin(np.abs(poles - seen.bending.pole))] - seen.bending.pole

    share = chain.share_of_axle(seen.bending.pole)
    mass = reduction.absorber_mass(inertia, seen, share)
    loaded = modes_of_chain(chain._replace(m_A=chain.m_A + mass))[0].pole - seen.bending.pole

    assert abs(moved) == pytest.approx(abs(loaded), rel=0.1)


def test_paper_s_second_bending_is_the_reference(running) -> None:
    found = modes(running.curve, running.equilibrium.state, (30.0, 200.0))

    front = tracking.second_bending(running.curve, found)[0]

    assert front.axle == "front"
    assert found.name[front.index] == "second_bending_front"
    assert front.likeness > 0.9
    others = tracking.likeness(
        tracking.SECOND_BENDING["front"],
        tracking.shape_of_axle(running.curve, "front", found.shape),
    )
    moved = [k for k, name in enumerate(found.name) if name.endswith("front") and k != front.index]
    assert others[moved].max() < 0.5
