import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq
from wheelset_lines import paper, reference, sections

from tramdva.stages import hopf_points
from tramdva.wheelset import hopf, model, stability

HOPF_POINTS = reference("auto/hopf_points.csv")


def solved(row):
    mounted = row["DVA"] != "none"
    values = paper(c_A=1.002 * float(row["c_A_direct"]))
    if mounted:
        values = values._replace(c_T=float(row["c_T"]), d_T=float(row["d_T"]))
    return hopf.solve_hopf_point(values, mounted, "c_A")


@pytest.mark.parametrize("row", HOPF_POINTS, ids=lambda row: f"{row['DVA']}-{row['index']}")
def test_hopf_points_of_the_reference(row):
    point = solved(row)
    assert point.converged
    assert_allclose(point.values.c_A, float(row["c_A_direct"]), rtol=5e-11)
    assert_allclose(point.frequency, float(row["freq_Hz"]), rtol=1e-10)
    assert_allclose(point.first_lyapunov_coefficient, float(row["l1_vR"]), rtol=1e-9)
    assert point.scaled.residual < 1e-11


@pytest.mark.parametrize("row", HOPF_POINTS, ids=lambda row: f"{row['DVA']}-{row['index']}")
def test_extended_system_agrees_with_the_growth_rate(row):
    point = solved(row)
    growth = hopf.growth_along(point.values, point.with_absorber, "c_A")
    zero = brentq(growth, 0.99 * point.values.c_A, 1.01 * point.values.c_A, xtol=1e-3)
    assert_allclose(point.values.c_A, zero, rtol=1e-9)  # eigenvalues: 1e-12 of 1e3 1/s


def test_first_lyapunov_coefficient_from_the_derivatives_of_the_creep_force():
    # the force is the only nonlinearity: B and C act on the rim's velocity alone
    point = solved(HOPF_POINTS[0])
    p = point.values
    n, v_R = 4, 3
    J = model.linearised(p, False).matrices[0]
    omega = 2 * np.pi * point.frequency
    values, vectors = np.linalg.eig(J)
    k = int(np.argmin(np.abs(values - 1j * omega)))
    q = vectors[:, k] / vectors[v_R, k]
    left = np.linalg.inv(vectors)[k] * vectors[v_R, k]
    V_0 = model.equilibrium(p, False).V_0
    _, _, F2, F3 = model.slip_derivatives(p, -p.gamma * V_0, V_0)
    e = np.eye(n)[v_R]

    def B(u, v):
        return -F2 / p.m_R * u[v_R] * v[v_R] * e

    h_20 = np.linalg.solve(2j * omega * np.eye(n) - J, B(q, q))
    h_11 = np.linalg.solve(J, B(q, q.conj()))
    C = -F3 / p.m_R * e
    l_1 = (left @ (C - 2 * B(q, h_11) + B(q.conj(), h_20))).real / (2 * omega)
    assert_allclose(point.first_lyapunov_coefficient, l_1, rtol=1e-8)


def test_softer_patch_makes_the_bifurcation_supercritical_and_a_stiffer_one_subcritical():
    C_22 = paper().C_22
    for a, sign in ((4.2e-3, -1.0), (6.2e-3, -1.0), (6.4e-3, 1.0), (6.5e-3, 1.0)):
        values = paper(c_A=4.7e7, C_22=C_22 * (a / 4.2e-3) ** 2)
        point = hopf.solve_hopf_point(values, False, "c_A")
        assert np.sign(point.first_lyapunov_coefficient) == sign  # it changes at 6.31 mm


def test_sign_changes_finds_pairs_hidden_between_samples():
    axis = np.linspace(0.0, 1.0, 6)  # the bump from 0.43 to 0.47 lies between two samples

    def bump(x):
        return -((x - 0.43) * (x - 0.47))

    zeros = hopf.sign_changes(axis, bump(axis), bump)
    assert_allclose(zeros, [0.43, 0.47], atol=1e-9)
    assert hopf.sign_changes(axis, -1.0 - axis, lambda x: -1.0 - x) == []


def test_no_hopf_point_where_the_growth_rate_stays_negative():
    values = paper(B=0.4)
    axis = np.geomspace(1e7, 4e8, 101)
    assert hopf.hopf_points_along(values, False, "c_A", axis) == []


def test_stage_starts_from_the_sign_changes_of_the_map():
    axis = np.linspace(1e5, 2.5e8, 41)
    p = paper()
    variants = [
        {"name": "soft", "c_T": 1e7, "d_T": 7500.0},
        {"name": "hard", "c_T": 2e7, "d_T": 7500.0},
    ]
    rates = [stability.growth_rate(p._replace(c_A=axis), False)]
    for v in variants:
        rates.append(stability.growth_rate(p._replace(c_A=axis, c_T=v["c_T"], d_T=v["d_T"]), True))
    cfg = {
        **sections(p),
        "absorber_variants": variants,
        "numerics": {"tolerance": 1e-11, "max_iterations": 20},
    }
    out = hopf_points.compute(cfg, {"c_A": axis, "baseline_growth_rate": np.array(rates)})
    assert out["absorber"].tolist() == ["none", "none", "hard", "hard"]
    expected = [float(row["c_A_direct"]) for row in HOPF_POINTS]
    assert_allclose(out["c_A"], expected, rtol=5e-11)
    assert set(out["status"]) == {"converged"}
