from numba.core.dispatcher import Dispatcher
from wheelset_lines import paper

from tramdva import creep_force, warm_up, wheelset
from tramdva.bifurcation import collocation
from tramdva.self_excitation import solve_hopf_point
from tramdva.stability import growth_rate
from tramdva.sustained_vibration import limit_cycle_branch, orbit_extremes


def compiled() -> dict[str, int]:
    """Number of compiled versions of every kernel."""
    modules = (creep_force, wheelset, collocation)
    return {
        f"{module.__name__}.{name}": len(value.signatures)
        for module in modules
        for name, value in vars(module).items()
        if isinstance(value, Dispatcher)
    }


def test_after_the_warm_up_the_stages_compile_nothing():
    warm_up.compile_kernels()
    before = compiled()
    numerics = {"mesh_intervals": 10, "degree": 4, "tolerance": 1e-8, "max_orbits": 3}
    for mounted, c_A in ((False, 4.7e7), (True, 6.2e7)):
        values = paper(c_A=c_A, c_T=2e7, d_T=7500.0)
        growth_rate(values, mounted)
        start = solve_hopf_point(values, mounted, "c_A")
        branch = limit_cycle_branch(start, "c_A", (1e7, 4e8), numerics)
        orbit_extremes(branch.cycles[-1], values, mounted)
    assert compiled() == before
    assert sum(before.values()) > 10
