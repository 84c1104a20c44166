import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import fsolve
from wheelset_lines import paper

from tramdva.contact.creep_force import friction_coefficient
from tramdva.wheelset import model

ABSORBER = {"c_T": 2.0e7, "d_T": 7500.0}


def equations_of_motion(p, y, v, V_0):
    """Equations (1)-(5) as printed, in plain Python."""
    (y_A, y_T, y_R), (v_A, v_T, v_R) = y, v
    w = v_R - p.gamma * V_0
    mu = friction_coefficient(w, p.mu_0, p.A, p.B)
    eps = math.pi / 4 * p.C_22 * abs(w) / (V_0 * mu * p.F_N)
    F_y = math.copysign(2 * mu * p.F_N / math.pi * (eps / (1 + eps**2) + math.atan(eps)), w)
    wheel = p.c_R * (y_R - y_A) + p.d_R * (v_R - v_A)
    absorber = p.c_T * (y_T - y_A) + p.d_T * (v_T - v_A)
    forces = (-p.c_A * (y_A - p.L) - p.d_A * v_A + wheel + absorber, -absorber, -wheel - F_y)
    centripetal = p.Omega**2 * p.r_C * math.cos(p.gamma)
    masses = (p.m_A, p.m_T, p.m_R)
    return [
        f / m - centripetal + p.Omega**2 * position
        for f, m, position in zip(forces, masses, y, strict=True)
    ]


def test_right_hand_side_is_equations_1_to_5():
    p = paper(**ABSORBER)
    V_0 = model.equilibrium(p, with_absorber=True).V_0
    y, v = (1.4991, 1.5003, 1.4987), (0.03, -0.2, 0.11)
    out = model.accelerations(np.array([[*y, *v]]), np.array(p))[0]
    assert_allclose(out[:3], v, rtol=0, atol=0)
    assert_allclose(out[3:], equations_of_motion(p, y, v, V_0), rtol=1e-12)


def test_without_absorber_it_is_the_same_wheelset_with_the_absorber_left_out():
    p = paper()
    free = p._replace(c_T=0.0, d_T=0.0)
    V_0 = model.equilibrium(p, with_absorber=False).V_0
    out = model.accelerations(np.array([[1.4991, 1.4987, 0.03, 0.11]]), np.array(p))[0]
    expected = equations_of_motion(free, (1.4991, 0.0, 1.4987), (0.03, 0.0, 0.11), V_0)
    assert_allclose(out[2:], [expected[0], expected[2]], rtol=1e-12)


def test_equilibrium_of_the_baseline():
    found = model.equilibrium(paper(), with_absorber=False)
    assert_allclose(found.y_R, 1.4995387375, atol=5e-11)  # digits given by the source
    assert_allclose(found.V_0, 3.9083, atol=5e-5)
    assert math.isnan(found.y_T)


@pytest.mark.parametrize("mounted", [True, False])
def test_equilibrium_agrees_with_a_general_solver_and_has_no_acceleration(mounted):
    p = paper(**ABSORBER)
    state = model.equilibrium_state(p, mounted)
    residual = model.accelerations(state[None], np.array(p))[0]
    assert_allclose(residual, 0.0, atol=1e-8)  # m/s^2: rounding of terms of 1e5 m/s^2

    def statics(millimetres):
        y = 1.5 + 1e-3 * millimetres
        V_0 = p.Omega * (p.r_C - y[2])
        return equations_of_motion(p, y, (0.0, 0.0, 0.0), V_0)

    if mounted:
        solution = 1.5 + 1e-3 * fsolve(statics, np.zeros(3))
        assert_allclose(solution, state[:3], rtol=1e-11)


def test_a_wheelset_without_steady_rolling_is_an_error():
    with pytest.raises(ArithmeticError, match="no steady rolling"):
        model.equilibrium(paper(c_A=10.0), with_absorber=False)


def test_falling_slope_at_both_values_of_B():
    for B, kappa in ((0.7, -4887.468), (0.4, -2911.6)):
        p = paper(B=B)
        V_0 = model.equilibrium(p, with_absorber=False).V_0
        slope = model.slip_derivatives(p, -p.gamma * V_0, V_0)[1]
        assert_allclose(slope, kappa, rtol=2e-5)  # digits given by the source


@pytest.mark.parametrize("columns", [4, 6])
def test_jacobian_is_the_complex_step_of_the_right_hand_side(columns):
    p = np.array(paper(**ABSORBER))
    rng = np.random.default_rng(1)
    base = np.array([1.5] * (columns // 2) + [0.0] * (columns // 2))
    states = base + 1e-2 * rng.standard_normal((20, columns))
    J = model.jacobian(states, p)
    for k in range(columns):
        step = 1e-30j * np.eye(columns)[k]
        assert_allclose(model.accelerations(states + step, p).imag / 1e-30, J[:, :, k], rtol=1e-12)


def test_jacobian_at_the_equilibrium_is_the_matrix_of_the_appendix():
    p = paper(**ABSORBER)
    state = model.equilibrium_state(p, with_absorber=True)
    J = model.jacobian(state[None], np.array(p))[0]
    assert_allclose(J, model.system_matrix(p), rtol=1e-13, atol=1e-12)


def test_parameter_derivatives_follow_the_equilibrium():
    # V_0 depends on c_A through y_R0: the complex step must see it, as a central difference does
    p = paper(**ABSORBER)
    system, units = model.dynamical_system(p, True), model.scaling(p, True)
    scaled = np.array(p) / units.parameters
    states = units.from_states(model.equilibrium_state(p, True))[None]
    index = system.index("c_A")
    h = 1e-3 * np.eye(len(scaled))[index]
    difference = (system.rhs(states, scaled + h) - system.rhs(states, scaled - h)) / 2e-3
    exact = system.rhs_parameter_derivative(states, scaled, index)
    assert_allclose(exact, difference, rtol=1e-6, atol=1e-12)  # difference: order h^2


def test_linearised_takes_arrays_of_parameters():
    stiffness = np.array([4.0e7, 5.2e7, 9.0e7])
    together = model.linearised(
        paper(**ABSORBER, c_A=stiffness.tolist()[0])._replace(c_A=stiffness), True
    )
    for k, c_A in enumerate(stiffness):
        assert_allclose(together.matrices[k], model.system_matrix(paper(**ABSORBER, c_A=c_A)))


def test_without_damping_and_friction_the_modes_are_undamped():
    p = paper(c_T=2.0e7, d_T=0.0, d_A=0.0, d_R=0.0, F_N=1e-9)
    eigenvalues = np.linalg.eigvals(model.linearised(p, True).matrices[0])
    assert_allclose(eigenvalues.real, 0.0, atol=1e-6)  # 1/s, of frequencies of 1e3 1/s
