"""Systems with kernels and the same systems as plain Python functions."""

from dataclasses import replace

import numpy as np
import pytest
from numba import carray
from numpy.testing import assert_allclose, assert_array_equal
from textbook import brusselator, normal_form

from tramdva.bifurcation import compiled, hopf
from tramdva.bifurcation.compiled import Evaluation
from tramdva.bifurcation.continuation import StepControl
from tramdva.bifurcation.limit_cycle import LimitCycleCurve, follow
from tramdva.bifurcation.system import DynamicalSystem, Kernels, Scaling, rescaled


def brusselator_rhs(states, m, n, parameters, rows, q, out):
    x, p, f = carray(states, (m, n)), carray(parameters, (rows, q)), carray(out, (m, n))
    for i in range(m):
        a, b = p[i if rows > 1 else 0]
        square = x[i, 0] * x[i, 0] * x[i, 1]
        f[i, 0] = a - (b + 1) * x[i, 0] + square
        f[i, 1] = b * x[i, 0] - square


def brusselator_jacobian(states, m, n, parameters, rows, q, out):
    x, p, J = carray(states, (m, n)), carray(parameters, (rows, q)), carray(out, (m, n, n))
    for i in range(m):
        b = p[i if rows > 1 else 0, 1]
        J[i, 0, 0] = 2 * x[i, 0] * x[i, 1] - b - 1
        J[i, 0, 1] = x[i, 0] * x[i, 0]
        J[i, 1, 0] = b - 2 * x[i, 0] * x[i, 1]
        J[i, 1, 1] = -x[i, 0] * x[i, 0]


@pytest.fixture(scope="module")
def fast() -> DynamicalSystem:
    functions = compiled.c_functions(brusselator_rhs, brusselator_jacobian)
    return replace(brusselator(), kernels=Kernels(functions))


SCALING = Scaling(np.array([0.3, -0.2]), np.array([2.0, 0.5]), 0.7, np.array([1.5, 3.0]))


@pytest.mark.parametrize("kind", [float, complex])
@pytest.mark.parametrize("rows", [1, 5])
def test_kernels_see_the_functions_that_python_sees(fast, kind, rows):
    rng = np.random.default_rng(1)
    states, p = rng.random((5, 2)).astype(kind), rng.random((rows, 2)).astype(kind)
    if kind is complex:
        states += 1j * rng.random((5, 2))
        p += 1j * rng.random((rows, 2))
    seen = p[0] if rows == 1 else p.T
    for system in (fast, replace(fast, kernels=None)):
        scaled = rescaled(system, SCALING)
        evaluation = Evaluation(scaled)
        f = compiled.right_hand_sides(evaluation.evaluator, states, p)
        J = compiled.jacobian_matrices(evaluation.evaluator, states, p)
        evaluation.check()
        assert_allclose(f, scaled.rhs(states, seen), rtol=1e-14, atol=1e-15)
        assert_allclose(J, scaled.jacobian(states, seen), rtol=1e-14, atol=1e-15)


def analysed(system):
    """A Hopf point, a Hopf curve and a branch of limit cycles."""
    point = hopf.solve_hopf_point(system, np.array([1.0, 2.0]), np.array([1.0, 2.1]), "b")
    steps = StepControl(0.05, 1e-6, 0.05, 10, comfortable_iterations=5)
    window = {"a": (0.3, 3.0), "b": (1.0, 9.0)}
    curve = hopf.hopf_curve(system, point, ("b", "a"), window, steps, direction=1, component=0)
    cycles = LimitCycleCurve(system, "b")
    branch = follow(cycles, cycles.start(point, 20, 4), steps, (1.0, 9.0))
    return point, curve, branch


def test_plain_functions_give_the_numbers_of_compiled_ones(fast):
    one, other = analysed(fast), analysed(brusselator())
    assert_allclose(one[0].state, other[0].state, rtol=1e-13)
    assert_allclose(one[0].parameters, [1.0, 2.0], rtol=1e-13)  # b = 1 + a^2
    assert len(one[1].points) == len(other[1].points) == 10
    for a, b in zip(one[1].points, other[1].points, strict=True):
        assert_allclose(a.parameters, b.parameters, rtol=1e-12)
    assert_allclose(
        one[1].first_lyapunov_coefficients, other[1].first_lyapunov_coefficients, rtol=1e-10
    )
    assert len(one[2].points) == len(other[2].points)
    for a, b in zip(one[2].points, other[2].points, strict=True):
        assert_allclose(a.period, b.period, rtol=1e-10)
        assert_allclose(a.nodal, b.nodal, rtol=1e-9)


def test_an_error_in_a_plain_function_arrives():
    def broken(states, p):
        raise ZeroDivisionError("in the right-hand side")

    system = replace(brusselator(), rhs=broken)
    with pytest.raises(ZeroDivisionError, match="in the right-hand side"):
        hopf.solve_hopf_point(system, np.array([1.0, 2.0]), np.array([1.0, 2.1]), "b")
    # and the next analysis knows nothing of it
    assert hopf.solve_hopf_point(
        brusselator(), np.array([1.0, 2.0]), np.array([1.0, 2.1]), "b"
    ).converged


def test_the_corrector_ends_at_one_orbit_with_and_without_the_last_matrix():
    system = normal_form(lambda p: p[0], ("mu",))
    point = hopf.solve_hopf_point(system, np.zeros(2), np.array([0.01]), "mu")
    curve = LimitCycleCurve(system, "mu")
    steps = StepControl(0.05, 1e-6, 0.05, 3, comfortable_iterations=5)
    last = follow(curve, curve.start(point, 10, 4), steps, (-1.0, 1.0)).points[-1]
    assert last.linearisation is None
    matrix = curve.correct(curve.predict(last, 0.0))[0].linearisation
    newton = curve.correct(curve.predict(last, 0.05))[0]
    chord = curve.correct(curve.predict(replace(last, linearisation=matrix), 0.05))[0]
    assert_allclose(chord.nodal, newton.nodal, atol=1e-9)
    assert_array_equal(chord.mesh, newton.mesh)
