import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from wheelset_lines import paper, reference

from tramdva.wheelset import cycles, hopf, model

NUMERICS = {"mesh_intervals": 100, "degree": 4, "tolerance": 1e-10, "max_orbits": 400}


def branch_over_c_A(mounted, intervals=100):
    values = paper(c_A=4.7e7)
    if mounted:
        values = values._replace(c_A=6.2e7, c_T=2e7, d_T=7500.0)
    start = hopf.solve_hopf_point(values, mounted, "c_A")
    numerics = {**NUMERICS, "mesh_intervals": intervals}
    return start, cycles.limit_cycle_branch(start, "c_A", (1e7, 4e8), numerics)


@pytest.mark.parametrize(
    ("mounted", "table"),
    [(False, "limit_cycles_no_absorber"), (True, "limit_cycles_cT_2e7_dT_7500")],
)
def test_limit_cycles_of_the_reference(mounted, table):
    start, branch = branch_over_c_A(mounted)
    assert branch.ended == "hopf_point"
    assert branch.special == []
    assert all(cycle.stable for cycle in branch.cycles)
    ends = [start.values.c_A, branch.end.values.c_A]
    for row in reference(f"auto/{table}.csv"):
        # c_A is printed to 0.01 N/m; the amplitude is the root of the distance to the Hopf point
        distance = min(abs(float(row["c_A"]) - end) for end in ends)
        printed = max(1e-7, 0.5 * 0.005 / distance)
        cycle = cycles.cycle_at(branch, start.values, float(row["c_A"]))
        extremes = cycles.orbit_extremes(cycle, start.values, mounted)
        own = hopf.physical_values(start.values, mounted, cycle.parameters)
        y_R0 = model.equilibrium(own, mounted).y_R
        assert_allclose(cycle.period * 1e-3, float(row["period_s"]), rtol=1e-9)
        assert_allclose(extremes.y_R_max - y_R0, float(row["dev_max_m"]), rtol=printed)
        assert_allclose(extremes.y_R_min - y_R0, float(row["dev_min_m"]), rtol=printed)
        assert_allclose(extremes.slip_min, float(row["slip_min"]), rtol=1e-6)
        assert_allclose(extremes.a_R_max, float(row["aR_maxabs"]), rtol=2e-3)  # mesh values there
        leading = np.abs(cycle.multipliers[1:]).max()
        assert_allclose(leading, float(row["mult_lead_abs"]), atol=1e-7)


def test_acceleration_is_that_of_a_long_time_integration():
    # the reference's accelerations are maxima over its mesh; here an integrator runs along
    start, branch = branch_over_c_A(mounted=False)
    cycle = cycles.cycle_at(branch, start.values, 1.0e8)
    own = hopf.physical_values(start.values, False, cycle.parameters)
    units = model.scaling(own, False)
    state = units.to_states(cycle.nodal[0])
    period = cycle.period * units.time
    out = solve_ivp(
        lambda _, y: model.accelerations(y[None], np.array(own))[0],
        (0.0, 20 * period),
        state,
        method="DOP853",
        rtol=1e-11,
        atol=1e-13,
        dense_output=True,
    )
    assert_allclose(out.y[:, -1], state, atol=1e-9)  # a stable cycle: 20 periods later the same
    times = np.linspace(19 * period, 20 * period, 20001)
    states = out.sol(times).T
    extremes = cycles.orbit_extremes(cycle, start.values, False)
    a_R = model.accelerations(states, np.array(own))[:, 3]
    assert_allclose(extremes.a_R_max, np.abs(a_R).max(), rtol=1e-6)
    assert_allclose(extremes.y_R_max, states[:, 1].max(), atol=1e-11)
    assert_allclose(extremes.y_R_min, states[:, 1].min(), atol=1e-11)


def test_an_attracted_orbit_settles_on_the_cycle():
    # from beside the unstable equilibrium, by an integrator that knows nothing of the cycle
    start, branch = branch_over_c_A(mounted=False)
    cycle = cycles.cycle_at(branch, start.values, 1.0e8)
    own = hopf.physical_values(start.values, False, cycle.parameters)
    state = model.equilibrium_state(own, False) + np.array([0, 1e-4, 0, 0])
    out = solve_ivp(
        lambda _, y: model.accelerations(y[None], np.array(own))[0],
        (0.0, 3.0),
        state,
        method="DOP853",
        rtol=1e-10,
        atol=1e-12,
        dense_output=True,
    )
    late = out.sol(np.linspace(2.9, 3.0, 20001))[1]
    extremes = cycles.orbit_extremes(cycle, start.values, False)
    assert_allclose([late.min(), late.max()], [extremes.y_R_min, extremes.y_R_max], atol=2e-10)


def test_amplitudes_converge_with_the_mesh():
    rows = [row for row in reference("auto/mesh_convergence.csv") if row["set"] == "P1"]
    exact = {float(row["c_A"]): float(row["dev_max"]) for row in rows if row["NTST"] == "200"}
    errors = {}
    for intervals in (20, 40, 100):
        start, branch = branch_over_c_A(mounted=False, intervals=intervals)
        worst = 0.0
        for c_A, deviation in exact.items():
            cycle = cycles.cycle_at(branch, start.values, c_A)
            extremes = cycles.orbit_extremes(cycle, start.values, False)
            own = hopf.physical_values(start.values, False, cycle.parameters)
            y_R0 = model.equilibrium(own, False).y_R
            worst = max(worst, abs((extremes.y_R_max - y_R0) / deviation - 1.0))
        errors[intervals] = worst
    assert errors[20] < 5e-7
    assert errors[40] < 2e-8
    assert errors[100] < 1e-9


def test_subcritical_hopf_points_and_their_fold():
    # a = b = 6.5 mm: Hopf point 46.710273e6, fold of cycles 46.709258e6 N/m
    values = paper(c_A=4.67e7, C_22=paper().C_22 * (6.5 / 4.2) ** 2)
    start = hopf.solve_hopf_point(values, False, "c_A")
    assert_allclose(start.values.c_A, 46.710273e6, rtol=2e-8)  # digits given by the source
    assert start.first_lyapunov_coefficient > 0.0
    branch = cycles.limit_cycle_branch(start, "c_A", (1e7, 4e8), NUMERICS)
    folds = [c_A for kind, c_A in branch.special if kind == "fold"]
    assert_allclose(folds[0], 46.709258e6, rtol=2e-8)
    assert not branch.cycles[0].stable
    assert any(cycle.stable for cycle in branch.cycles)
    assert branch.ended == "hopf_point"


def test_amplitudes_over_the_absorber_stiffness():
    rows = reference("auto/cycle_amplitude_dT_7500.csv")
    values = paper(c_A=float(rows[0]["c_A"]), c_T=1.7126e7, d_T=7500.0)
    start = hopf.solve_hopf_point(values, True, "c_T")
    assert_allclose(start.values.c_T, 17125790.14, rtol=1e-8)
    numerics = {**NUMERICS, "mesh_intervals": 60}
    branch = cycles.limit_cycle_branch(start, "c_T", (1e6, 2.2e8), numerics)
    for row in rows[::3]:
        cycle = cycles.cycle_at(branch, start.values, float(row["c_T"]))
        extremes = cycles.orbit_extremes(cycle, start.values, True)
        distance = max(abs(extremes.y_R_max - 1.5), abs(extremes.y_R_min - 1.5))
        assert_allclose(distance, float(row["max_abs_yR_minus_L_m"]), rtol=1e-7)
        assert_allclose(cycle.period * 1e-3, float(row["period_s"]), rtol=1e-9)


def test_numbers_of_figure_6_at_d_T_7500():
    values = paper(c_A=84530519.74, c_T=1.7126e7, d_T=7500.0)
    start = hopf.solve_hopf_point(values, True, "c_T")
    onset = start.values.c_T
    branch = cycles.limit_cycle_branch(start, "c_T", (1e6, 2.2e8), NUMERICS)
    for c_T, millimetres in ((1.0005 * onset, 0.419), (1.05 * onset, 0.641), (2e8, 0.743)):
        cycle = cycles.cycle_at(branch, start.values, c_T)
        extremes = cycles.orbit_extremes(cycle, start.values, True)
        assert_allclose(1.5 - extremes.y_R_min, millimetres * 1e-3, atol=6e-7)
