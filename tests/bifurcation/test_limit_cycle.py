import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from textbook import (
    brusselator,
    hopf_point,
    langford,
    normal_form,
    roessler,
    van_der_pol,
)

from tramdva.bifurcation import collocation
from tramdva.bifurcation.continuation import StepControl
from tramdva.bifurcation.limit_cycle import LimitCycleCurve, follow
from tramdva.bifurcation.orbit import extrema


def control(largest=0.3, points=200):
    return StepControl(0.02, 1e-6, largest, points, comfortable_iterations=5)


def branch_from(system, state, parameters, free, bounds, *, intervals=20, degree=4, steps=None):
    start = hopf_point(system, state, parameters, free)
    curve = LimitCycleCurve(system, free)
    return curve, follow(curve, curve.start(start, intervals, degree), steps or control(), bounds)


def at(curve, branch, value):
    along = [cycle.parameters[curve.index] for cycle in branch.points]
    cycle = curve.at_parameter(
        branch.points[int(np.argmin(np.abs(np.array(along) - value)))], value
    )
    assert cycle is not None
    return cycle


def amplitude(cycle):
    return extrema(cycle, lambda states: states[:, :1])[1][0]


def monodromy(system, cycle):
    """Floquet multipliers by an independent integrator, over one period of the found orbit."""
    n = system.dimension

    def extended(_, z):
        states = z[None, :n]
        f = system.rhs(states, cycle.parameters)[0]
        J = system.jacobian(states, cycle.parameters)[0]
        return np.concatenate([f, (J @ z[n:].reshape(n, n)).ravel()])

    start = np.concatenate([cycle.nodal[0], np.eye(n).ravel()])
    end = solve_ivp(
        extended, (0.0, cycle.period), start, method="DOP853", rtol=1e-12, atol=1e-13
    ).y[:, -1]
    return end[:n], np.linalg.eigvals(end[n:].reshape(n, n))


def test_stuart_landau_amplitude_period_and_floquet_exponent():
    # r = sqrt(mu), omega(r) = 2 + 0.4 mu, multiplier exp(-2 mu T)
    system = normal_form(lambda p: p[0], ("mu",), omega=2.0, cubic=-1.0, shear=0.4)
    _, branch = branch_from(system, [0, 0], [0.01], "mu", (-1.0, 1.0))
    assert branch.ended == "window"
    for cycle in branch.points:
        mu = cycle.parameters[0]
        period = 2 * np.pi / (2 + 0.4 * mu)
        assert_allclose(amplitude(cycle), np.sqrt(mu), rtol=2e-7)
        assert_allclose(cycle.period, period, rtol=1e-9)
        assert_allclose(cycle.multipliers[1], np.exp(-2 * mu * period), rtol=1e-6)
        assert_allclose(cycle.multipliers[0], 1.0, atol=1e-9)
        assert cycle.stable


def test_orbit_between_two_orbits_of_the_branch():
    # r = sqrt(mu) in the normal form, whichever way the orbit is sought
    system = normal_form(lambda p: p[0], ("mu",), omega=2.0, cubic=-1.0, shear=0.4)
    curve, branch = branch_from(system, [0, 0], [0.01], "mu", (-1.0, 1.0))
    before, after = branch.points[2:4]
    mu = 0.5 * (before.parameters[0] + after.parameters[0])

    found = curve.between(before, after, mu)

    assert_allclose(found.parameters[0], mu, rtol=1e-12)
    assert_allclose(amplitude(found), np.sqrt(mu), rtol=2e-7)
    assert_allclose(found.period, 2 * np.pi / (2 + 0.4 * mu), rtol=1e-9)
    beyond = 2.0 * after.parameters[0] - before.parameters[0]
    assert curve.between(before, after, beyond) is None


def test_van_der_pol_period_and_amplitude():
    # period and amplitude of the equation at mu = 1 to 14 digits (Amore 2016; in x / sqrt(mu))
    curve, branch = branch_from(van_der_pol(), [0, 0], [0.01], "mu", (-1, 1.2), intervals=60)
    cycle = at(curve, branch, 1.0)
    assert_allclose(cycle.period, 6.6632868593231301897, rtol=1e-11)
    assert_allclose(amplitude(cycle), 2.0086198608748431365, rtol=1e-9)


def test_relaxation_oscillation_needs_and_gets_an_adapted_mesh():
    curve, branch = branch_from(
        van_der_pol(), [0, 0], [0.01], "mu", (-1, 8.2), intervals=60, steps=control(0.5, 400)
    )
    cycle = at(curve, branch, 8.0)
    h = np.diff(cycle.mesh)
    assert h.max() > 5.0 * h.min()
    _, multipliers = monodromy(van_der_pol(), cycle)
    end, _ = monodromy(van_der_pol(), cycle)
    assert_allclose(end, cycle.nodal[0], rtol=1e-5, atol=1e-5)  # collocation error on 60 intervals
    assert_allclose(np.abs(multipliers).max(), 1.0, rtol=1e-4)


def test_brusselator_agrees_with_an_independent_integrator():
    system = brusselator()
    curve, branch = branch_from(system, [1, 2], [1.0, 2.05], "b", (1.5, 3.0), intervals=40)
    cycle = at(curve, branch, 2.8)
    end, multipliers = monodromy(system, cycle)
    assert_allclose(end, cycle.nodal[0], rtol=1e-8)
    # the trace of J integrates to the sum of the exponents: ln(mu_1 mu_2)
    assert_allclose(np.sort(np.abs(multipliers)), np.sort(np.abs(cycle.multipliers)), rtol=1e-6)


def test_fold_of_cycles_is_located_where_it_is_known():
    # z' = (mu + i) z + z|z|^2 - z|z|^4: fold at mu = -1/4, |z|^2 = 1/2
    system = normal_form(lambda p: p[0], ("mu",), cubic=1.0, quintic=-1.0)
    _, branch = branch_from(system, [0, 0], [0.001], "mu", (-1.0, 0.5), steps=control(0.1))
    folds = [s.point for s in branch.special if s.kind == "fold"]
    assert len(folds) == 1
    assert_allclose(folds[0].parameters[0], -0.25, atol=1e-9)
    assert_allclose(amplitude(folds[0]) ** 2, 0.5, rtol=1e-5)
    before = [cycle for cycle in branch.points if amplitude(cycle) ** 2 < 0.499]
    after = [cycle for cycle in branch.points if amplitude(cycle) ** 2 > 0.501]
    assert not any(cycle.stable for cycle in before)
    assert all(cycle.stable for cycle in after)


def test_branch_ends_at_the_second_hopf_point():
    # growth mu (1 - mu): amplitude sqrt(mu (1 - mu)) vanishes at 0 and 1
    system = normal_form(lambda p: p[0] * (1.0 - p[0]), ("mu",))
    _, branch = branch_from(system, [0, 0], [0.01], "mu", (-1.0, 2.0), steps=control(0.05))
    assert branch.ended == "hopf_point"
    assert branch.special == []
    mu = np.array([cycle.parameters[0] for cycle in branch.points])
    assert 0.99 < mu[-1] < 1.0
    assert_allclose(
        [amplitude(cycle) for cycle in branch.points], np.sqrt(mu * (1 - mu)), rtol=1e-6
    )


def test_period_doubling_of_roessler():
    # a = b = 0.2: Hopf point near c = 0.4, first period doubling near c = 2.83
    system = roessler()
    _, branch = branch_from(
        system, [0.2, -1.0, 1.0], [0.2, 0.2, 0.45], "c", (0.3, 3.2), intervals=40
    )
    found = [s.point for s in branch.special if s.kind == "period_doubling"]
    assert len(found) == 1
    assert_allclose(found[0].parameters[2], 2.8324, atol=2e-4)
    _, multipliers = monodromy(system, found[0])
    assert_allclose(multipliers.real.min(), -1.0, atol=1e-6)


def test_torus_bifurcation_where_it_is_known():
    # cycle at z = beta; trace of the (r, z) system vanishes at r^2 = (alpha - beta^2) / rho
    beta, alpha, rho = 0.7, 0.95, 0.25
    at_hopf = beta**3 / 3 - alpha * beta
    expected = at_hopf + (1 + rho * beta) * (alpha - beta**2) / rho
    system = langford(beta=beta, alpha=alpha, rho=rho)
    _, branch = branch_from(system, [0, 0, beta], [at_hopf], "lambda", (-1.0, 2.5), intervals=30)
    found = [s.point for s in branch.special if s.kind == "torus"]
    assert len(found) == 1
    assert_allclose(found[0].parameters[0], expected, rtol=1e-7)
    pair = found[0].multipliers[1:]
    assert_allclose(np.abs(pair), 1.0, atol=1e-6)
    assert abs(pair[0].imag) > 1e-3


def period_by_return(system, mu):
    """Period of the attracting cycle: time between crossings of x' = 0, after the transient."""

    def crossing(_, z):
        return z[1]

    crossing.direction = -1.0
    out = solve_ivp(
        lambda _, z: system.rhs(z[None], np.array([mu]))[0],
        (0.0, 200.0),
        [1.4, 0.0],
        method="DOP853",
        rtol=1e-13,
        atol=1e-14,
        events=crossing,
    )
    return np.diff(out.t_events[0])[-1]


@pytest.mark.parametrize("degree", [2, 3, 4])
def test_period_converges_with_twice_the_degree(degree):
    exact = period_by_return(van_der_pol(), 0.5)
    errors = []
    intervals = np.array([10, 20, 40]) if degree > 2 else np.array([40, 80, 160])
    for count in intervals:
        curve, branch = branch_from(
            van_der_pol(), [0, 0], [0.01], "mu", (-1, 0.6), intervals=int(count), degree=degree
        )
        errors.append(abs(at(curve, branch, 0.5).period - exact))
    slopes = np.diff(np.log(errors)) / np.diff(np.log(intervals))
    assert slopes[-1] < -(2 * degree - 1.0) or errors[-1] < 5e-12


def test_bordered_solver_agrees_with_a_dense_one():
    rng = np.random.default_rng(3)
    N, m, n, period = 5, 3, 2, 1.7
    base = collocation.basis(m)
    h = rng.uniform(0.5, 1.5, N)
    h /= h.sum()
    J = rng.standard_normal((N, m, n, n))
    f, f_p, phase, arc = rng.standard_normal((4, N, m, n))
    scalars, border = (0.3, -0.8), (0.4, -1.1)
    residual = rng.standard_normal((N, m, n))
    factors = collocation.factorise(base, h, period, J, f, f_p, phase, arc, scalars)
    nodal, T, p = collocation.solve(factors, residual, border)

    size = (N * m + 1) * n
    dense = np.zeros((N * m * n + n + 2, size + 2))
    right = np.concatenate([residual.ravel(), np.zeros(n), border])
    for j in range(N):
        for c in range(m):
            rows = (j * m + c) * n + np.arange(n)
            for i in range(m + 1):
                columns = (j * m + i) * n + np.arange(n)
                block = base.derivatives[c, i] / h[j] * np.eye(n)
                dense[np.ix_(rows, columns)] += block - period * base.values[c, i] * J[j, c]
                weight = base.weights[c] * h[j] * base.values[c, i]
                dense[-2, columns] += weight * phase[j, c]
                dense[-1, columns] += weight * arc[j, c]
            dense[rows, size] = -f[j, c]
            dense[rows, size + 1] = -period * f_p[j, c]
    closure = N * m * n + np.arange(n)
    dense[closure, np.arange(n)] = 1.0
    dense[closure, N * m * n + np.arange(n)] = -1.0
    dense[-1, size:] = scalars
    expected = np.linalg.solve(dense, right)
    assert_allclose(np.append(nodal.ravel(), [T, p]), expected, rtol=1e-9, atol=1e-10)


def test_extrema_are_those_of_the_polynomial_not_of_the_mesh():
    system = normal_form(lambda p: p[0], ("mu",))
    _, branch = branch_from(system, [0, 0], [0.01], "mu", (-1.0, 1.0), intervals=10)
    cycle = branch.points[-1]
    coarse = np.abs(cycle.nodal[:, 0]).max()
    low, high = extrema(cycle, lambda states: np.column_stack([states[:, 0], states[:, 1] ** 2]))
    exact = np.sqrt(cycle.parameters[0])
    assert_allclose([high[0], -low[0], high[1]], [exact, exact, exact**2], rtol=2e-5)
    assert coarse < high[0]
    assert_allclose(low[1], 0.0, atol=1e-9)
