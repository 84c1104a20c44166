import numpy as np
import pytest
from numpy.testing import assert_allclose
from textbook import brusselator, hopf_point, normal_form, roessler

from tramdva.bifurcation import hopf
from tramdva.bifurcation.continuation import StepControl
from tramdva.bifurcation.critical_hopf import critical_hopf_curve, eigenvalue_derivative
from tramdva.bifurcation.limit_cycle import LimitCycleCurve, follow
from tramdva.bifurcation.orbit import extrema


@pytest.mark.parametrize("a", [0.5, 1.0, 2.0])
def test_hopf_point_of_the_brusselator(a):
    point = hopf_point(brusselator(), [a, (1 + a * a) / a], [a, 1.1 + a * a], "b")
    assert_allclose(point.parameters[1], 1 + a * a, rtol=1e-12)
    assert_allclose(point.omega, a, rtol=1e-12)


@pytest.mark.parametrize("a", [0.5, 1.0, 2.0])
def test_first_lyapunov_coefficient_of_the_brusselator(a):
    # Kuznetsov's -(2 + a^2) / (2 a (1 + a^2)) holds for |q_x|^2 = a^2 / (1 + a^2)
    system = brusselator()
    point = hopf_point(system, [a, (1 + a * a) / a], [a, 1.01 + a * a], "b")
    l_1 = hopf.first_lyapunov_coefficient(system, point, 0)
    assert_allclose(l_1, -(2 + a * a) / (2 * a**3), rtol=1e-9)


@pytest.mark.parametrize("a", [0.5, 1.0, 2.0])
def test_first_lyapunov_coefficient_gives_the_amplitude_of_small_cycles(a):
    # growth rate (b - b_H) / 2 balances Re(c_1) |z|^2, the amplitude of x is 2 |z|
    system = brusselator()
    point = hopf_point(system, [a, (1 + a * a) / a], [a, 1.01 + a * a], "b")
    l_1 = hopf.first_lyapunov_coefficient(system, point, 0)
    curve = LimitCycleCurve(system, "b")
    steps = StepControl(initial=0.002, smallest=1e-6, largest=0.002, max_points=4)
    branch = follow(curve, curve.start(point, 20, 4), steps, (0.0, 10.0))
    cycle = branch.points[-1]
    growth = 0.5 * (cycle.parameters[1] - point.parameters[1])
    low, high = extrema(cycle, lambda states: states[:, :1])
    predicted = 2.0 * np.sqrt(growth / (-l_1 * point.omega))
    assert_allclose(
        0.5 * (high[0] - low[0]), predicted, rtol=2e-4
    )  # relative error of order growth


@pytest.mark.parametrize("cubic", [-1.0, 0.7])
def test_first_lyapunov_coefficient_of_the_normal_form(cubic):
    # x = z q + conj: with q_x = 1, x = 2 Re z, so that the cubic coefficient counts four times
    system = normal_form(lambda p: p[0], ("mu",), omega=2.0, cubic=cubic, shear=0.3)
    point = hopf_point(system, [0.0, 0.0], [0.01], "mu")
    l_1 = hopf.first_lyapunov_coefficient(system, point, 0)
    assert_allclose(l_1, 4 * cubic / 2.0, rtol=1e-10)


def test_extended_system_converges_quadratically_and_reports_failure():
    system = brusselator()
    far = hopf.solve_hopf_point(
        system, np.array([1.0, 2.0]), np.array([1.0, 2.3]), "b", max_iterations=1
    )
    assert not far.converged
    near = hopf_point(system, [1.0, 2.0], [1.0, 2.3], "b")
    assert near.residual < 1e-11


def test_real_eigenvalues_are_an_error():
    system = roessler()
    with pytest.raises(ArithmeticError, match="eigenvalues are real"):
        hopf.critical_pair(
            normal_form(lambda p: p[0], ("mu",), omega=0.0), np.zeros(2), np.array([0.1])
        )
    assert hopf.critical_pair(system, np.zeros(3), np.array([0.2, 0.2, 5.7]))[0].imag > 0


def control(step=0.05, points=400):
    return StepControl(initial=step, smallest=1e-6, largest=step, max_points=points)


def test_hopf_curve_of_the_brusselator_is_the_parabola():
    system = brusselator()
    start = hopf_point(system, [1.0, 2.0], [1.0, 2.1], "b")
    window = {"a": (0.3, 3.0), "b": (1.0, 9.0)}
    curve = hopf.hopf_curve(system, start, ("b", "a"), window, control(), direction=1, component=0)
    a, b = np.array([point.parameters for point in curve.points]).T
    assert_allclose(b, 1 + a * a, rtol=1e-10)
    assert curve.ended == "window"
    assert a[-1] > 2.5


def test_bautin_point_is_found_on_the_hopf_curve():
    # z' = (mu + i) z + beta z|z|^2 - z|z|^4: the Hopf curve is mu = 0, degenerate at beta = 0
    def growth(p):
        return p[0]

    def system_at_beta():
        base = normal_form(growth, ("mu", "beta"), cubic=0.0, quintic=-1.0)

        def rhs(states, p):
            r2 = (states**2).sum(axis=1, keepdims=True)
            return base.rhs(states, p) + np.reshape(p[1], (-1, 1)) * r2 * states

        def jacobian(states, p):
            r2 = (states**2).sum(axis=1)[:, None, None]
            outer = states[:, :, None] * states[:, None, :]
            beta = np.reshape(p[1], (-1, 1, 1))
            return base.jacobian(states, p) + beta * (r2 * np.eye(2) + 2 * outer)

        return type(base)(rhs, jacobian, 2, ("mu", "beta"))

    system = system_at_beta()
    start = hopf_point(system, [0.0, 0.0], [0.0, -1.03], "mu")
    window = {"mu": (-1.0, 1.0), "beta": (-2.0, 2.0)}
    curve = hopf.hopf_curve(
        system, start, ("mu", "beta"), window, control(), direction=1, component=0
    )
    found = [point.parameters for kind, point in curve.special if kind == "generalised_hopf"]
    assert_allclose(found, [[0.0, 0.0]], atol=1e-8)


def test_closed_hopf_curve_ends_where_it_began():
    system = normal_form(lambda p: 1.0 - p[0] ** 2 - p[1] ** 2, ("p", "q"))
    start = hopf_point(system, [0.0, 0.0], [0.99, 0.0], "p")
    window = {"p": (-3.0, 3.0), "q": (-3.0, 3.0)}
    curve = hopf.hopf_curve(system, start, ("p", "q"), window, control(), direction=1, component=0)
    assert curve.ended == "closed"
    extrema = [point.parameters[1] for kind, point in curve.special if kind == "critical"]
    assert_allclose(sorted(extrema), [-1.0, 1.0], atol=1e-10)


def tangent_family():
    """Growth rate p_2 - (p_1 - p_3)^2 + p_3^2: touches zero at p_1 = p_3, p_2 = -p_3^2."""
    return normal_form(lambda p: p[1] - (p[0] - p[2]) ** 2 + p[2] ** 2, ("p_1", "p_2", "p_3"))


def test_critical_curve_of_a_family_with_known_tangency():
    system = tangent_family()
    parameters = np.array([0.52, -0.23, 0.5])
    eigenvalue, vector = hopf.critical_pair(system, np.zeros(2), parameters)
    start = hopf.HopfPoint(np.zeros(2), vector, eigenvalue.imag, parameters, np.inf, False)
    curve = critical_hopf_curve(
        system,
        start,
        ("p_1", "p_2", "p_3"),
        control(),
        lambda free: "window" if abs(free[2]) > 1.5 else None,
        direction=-1,
    )
    p = np.array([point.parameters for point in curve.points])
    assert_allclose(p[:, 0], p[:, 2], atol=1e-9)
    assert_allclose(p[:, 1], -(p[:, 2] ** 2), atol=1e-10)
    largest = [point.parameters for kind, _, point in curve.special if kind == "largest"]
    assert_allclose(largest, [[0.0, 0.0, 0.0]], atol=1e-8)


def test_eigenvalue_derivative_follows_the_equilibrium():
    # Brusselator: the equilibrium moves with a; compare with differences of the eigenvalue itself
    system = brusselator()

    def eigenvalue(a):
        state = np.array([a, 2.3 / a])
        return hopf.critical_pair(system, state, np.array([a, 2.3]))[0]

    slope = eigenvalue_derivative(
        system, np.array([1.0, 2.3]), np.array([1.0, 2.3]), eigenvalue(1.0), 0
    )
    difference = (eigenvalue(1.0 + 1e-5) - eigenvalue(1.0 - 1e-5)) / 2e-5
    assert_allclose(slope, difference, rtol=1e-8)  # difference: order h^2
