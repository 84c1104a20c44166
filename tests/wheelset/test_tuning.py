import numpy as np
import pytest
from numpy.testing import assert_allclose
from wheelset_lines import paper, reference, sections

from tramdva.stages import absorber_tuning, frequency_response
from tramdva.wheelset import stability
from tramdva.wheelset.model import linearised
from tramdva.wheelset.response import peak_receptance, response
from tramdva.wheelset.tuning import (
    den_hartog,
    den_hartog_sqrt2,
    h_infinity,
    minimal_abscissa_damping,
    minimal_spectral_abscissa,
)

FREQUENCY = np.linspace(1.0, 300.0, 2000)
TABLE_2 = {"c_T": 4.3e6, "d_T": 6850.0}


def forced(**changes):
    return paper(B=0.4, **changes)


@pytest.mark.parametrize(("column", "mounted"), [("none", False), ("table2", True)])
def test_frequency_response_of_the_reference(column, mounted):
    rows = reference("auto/frequency_response.csv")
    f = np.array([float(row["f_Hz"]) for row in rows])
    out = response(forced(**TABLE_2), mounted, f).receptance
    amplitude = [float(row[f"abs_{column}"]) for row in rows]
    # the reference keeps V_0 of the wheelset without absorber, which moves the slope by 3e-10
    assert_allclose(np.abs(out), amplitude, rtol=5e-10)
    phase = [float(row[f"phase_{column}"]) for row in rows]
    assert_allclose(np.angle(out), phase, atol=5e-10)


@pytest.mark.parametrize("mounted", [True, False])
def test_response_agrees_with_the_state_matrix(mounted):
    p = forced(**TABLE_2)
    f = np.array([5.0, 48.3, 120.0, 250.0])
    A = linearised(p, mounted).matrices[0]
    n = len(A)
    force = np.eye(n)[n - 1] / p.m_R
    states = [np.linalg.solve(2j * np.pi * x * np.eye(n) - A, force) for x in f]
    out = response(p, mounted, f)
    dofs = n // 2
    assert_allclose(out.receptance, [y[dofs - 1] for y in states], rtol=1e-10)
    if mounted:
        assert_allclose(out.stroke, [y[1] - y[0] for y in states], rtol=1e-9)


def test_peaks_of_figure_7():
    bare = peak_receptance(forced(), False, FREQUENCY)
    assert_allclose(bare, (1.7796e-6, 48.345), rtol=3e-5)  # digits given by the source
    mounted = peak_receptance(forced(**TABLE_2), True, FREQUENCY)
    assert_allclose(mounted, (3.1136e-7, 45.249), rtol=3e-5)
    assert_allclose(bare.amplitude / mounted.amplitude, 5.72, atol=5e-3)
    high = FREQUENCY[FREQUENCY > 90.0]
    assert_allclose(peak_receptance(forced(), False, high), (7.888e-8, 118.370), rtol=1e-4)
    assert_allclose(peak_receptance(forced(**TABLE_2), True, high), (7.131e-8, 118.699), rtol=1e-4)


def test_den_hartog_numbers():
    design = den_hartog(forced())
    assert_allclose(design.c_T, 4297520.66, rtol=1e-9)
    assert_allclose(design.d_T, 4841.6, atol=0.05)
    assert_allclose(den_hartog_sqrt2(forced()).d_T, 6849.0, atol=3.0)


def test_den_hartog_balances_the_fixed_points_of_his_own_system():
    # 1-DOF primary without damping: a rim without mass on a rigid, undamped wheel
    p = forced(d_A=0.0, d_R=0.0, F_N=1e-9, m_R=1e-6, c_R=1e13)
    p = p._replace(Omega=1e-9)
    c_T, d_T = den_hartog(p)
    f = np.linspace(20.0, 100.0, 20001)
    amplitude = np.abs(response(p._replace(c_T=c_T, d_T=d_T), True, f).receptance)
    peaks = amplitude[1:-1][(amplitude[1:-1] > amplitude[:-2]) & (amplitude[1:-1] > amplitude[2:])]
    mu = p.m_T / p.m_A
    static = 1.0 / p.c_A + 1.0 / p.c_R
    assert len(peaks) == 2
    # equal to the accuracy of his mean of two damping values; height sqrt(1 + 2/mu)
    assert_allclose(peaks[0], peaks[1], rtol=5e-3)
    assert_allclose(peaks, np.sqrt(1 + 2 / mu) * static, rtol=5e-3)


def test_damping_of_table_2_minimises_the_spectral_abscissa_at_its_stiffness():
    design = minimal_abscissa_damping(forced(c_T=4.3e6))
    assert_allclose(design.d_T, 6848.0, atol=0.5)


def test_minimal_spectral_abscissa_is_a_minimum():
    p = forced()
    design = minimal_spectral_abscissa(p)
    best = float(stability.growth_rate(p._replace(c_T=design.c_T, d_T=design.d_T), True))
    rng = np.random.default_rng(5)
    c_T = design.c_T * np.exp(0.3 * rng.standard_normal(4000))
    d_T = design.d_T * np.exp(0.3 * rng.standard_normal(4000))
    others = stability.growth_rate(p._replace(c_T=c_T, d_T=d_T), True)
    assert best <= others.min() + 1e-9 * abs(best)


def test_h_infinity_optimum_of_the_reference():
    p = forced()
    design = h_infinity(p, 0.7, FREQUENCY)
    peak = peak_receptance(p._replace(c_T=design.c_T, d_T=design.d_T), True, FREQUENCY)
    bare = peak_receptance(p, False, FREQUENCY)
    assert_allclose(bare.amplitude / peak.amplitude, 11.07, atol=5e-3)
    given = peak_receptance(p._replace(c_T=3.263e6, d_T=3549.6), True, FREQUENCY)
    assert peak.amplitude <= given.amplitude
    assert_allclose(design.c_T, 3.263e6, rtol=1e-3)
    assert_allclose(design.d_T, 3549.6, rtol=5e-3)  # flat: equal peaks fix the stiffness
    assert float(stability.growth_rate(paper(c_T=design.c_T, d_T=design.d_T), True)) < 0.0


def test_h_infinity_gives_way_where_every_absorber_is_self_excited():
    p = forced()._replace(m_T=1e-3)
    assert h_infinity(p, 5.0, FREQUENCY) is None


def test_table_of_designs_marks_what_is_self_excited():
    cfg = {
        **sections(paper()),
        "absorber": {"m_T": 40.0, "c_T": 1e9, "d_T": 1.0},
        "forced_excitation": {"B": 0.4},
        "study": {"frequency": {"min": 1.0, "max": 300.0}},
        "numerics": {"frequency_points": 2000},
    }
    nothing = {name: np.empty(0) for name in ("branch", "d_T", "c_T", "c_A")}
    nothing["stabilises_all_c_A"] = np.empty(0, bool)
    out = absorber_tuning.compute(cfg, nothing)
    status = dict(zip(out["design"], out["status"], strict=True))
    assert status["paper"] == "self_excited"
    assert status["h_infinity"] == "converged"
    assert np.isnan(out["critical_c_T"]).all()
    assert_allclose(out["reduction"] * out["peak_receptance"], out["reference_peak_receptance"])
    response = frequency_response.compute({**cfg, "absorber": {}, "numerics": {"points": 50}}, out)
    assert response["design"][0] == "none"
    assert response["receptance_amplitude"].shape == (7, 50)
