"""Time of limit cycles and Hopf points, as ratios to AUTO in the same run.

    OMP_NUM_THREADS=1 AUTO_DIR=/path/to/auto-07p python benchmarks/continuation.py

The system is the wheelset with the absorber c_T = 2e7 N/m, d_T = 7500 N s/m (six states): the
branch of limit cycles between its two Hopf points with 50 mesh intervals of degree 4 and Floquet
multipliers, and the Hopf curve in (c_A, c_T) with first Lyapunov coefficients. Times are CPU
seconds in a warm process, the best of several runs; only ratios of one run mean anything.

Beside it stand, where they are installed: AUTO-07p, compiled, with derivatives by differences and
with those of the equations (`auto_07p.py` says how to get it); and the AUTO inside XPPAUT, whose
right-hand side is interpreted (`pip install xpplab`). Both take steps of the same largest length,
and both keep the rolling speed of one equilibrium, where ours solves that equilibrium.
"""

import resource
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import auto_07p
import numpy as np
import yaml

from tramdva.bifurcation import hopf
from tramdva.bifurcation.continuation import StepControl
from tramdva.bifurcation.limit_cycle import LimitCycleCurve, follow
from tramdva.wheelset import model
from tramdva.wheelset.hopf import rim_velocity, solve_hopf_point

ROOT = Path(__file__).resolve().parents[1]
RUNS = 5


def line() -> model.WheelsetParameters:
    """The paper's line with its third absorber variant."""
    text = (ROOT / "config/lines/paper.yaml").read_text(encoding="utf-8")
    return model.wheelset_parameters(yaml.safe_load(text), c_A=6.2e7, c_T=2e7, d_T=7500.0)


def best_time(function: Callable[[], Any]) -> tuple[float, Any]:
    """Smallest CPU time of several runs and the last result; the first run compiles."""
    function()
    times = []
    for _ in range(RUNS):
        start = time.process_time()
        result = function()
        times.append(time.process_time() - start)
    return min(times), result


def ours(values: model.WheelsetParameters) -> dict[str, tuple[float, int]]:
    """Time and number of points of both tasks."""
    system = model.dynamical_system(values, with_absorber=True)
    start = solve_hopf_point(values, True, "c_A").scaled
    curve = LimitCycleCurve(system, "c_A", parameter_scale=100.0)
    steps = StepControl(0.01, 1e-5, 0.0125, 400, comfortable_iterations=5)

    def cycles() -> int:
        return len(follow(curve, curve.start(start, 50, 4), steps, (10.0, 400.0)).points)

    def hopf_points() -> int:
        walk = hopf.hopf_curve(
            system,
            start,
            ("c_A", "c_T"),
            {"c_A": (10.0, 250.0), "c_T": (0.1, 150.0)},
            StepControl(0.5, 1e-4, 0.6, 2000),
            direction=-1,
            component=rim_velocity(True),
        )
        return len(walk.points)

    return {"limit cycles": best_time(cycles), "Hopf curve": best_time(hopf_points)}


ODE = """par ca={c_A}, ct=20
ya'=va
yt'=vt
yr'=vr
va'=(-ca*ya-7.25*va+49*(yr-ya)+9.5*(vr-va)+ct*(yt-ya)+7.5*(vt-va))/400-{c0}+{c1}*ya
vt'=(-ct*(yt-ya)-7.5*(vt-va))/40-{c0}+{c1}*yt
vr'=(-49*(yr-ya)-9.5*(vr-va)-f)/125-{c0}+{c1}*yr
w=vr+{v}
mu={mu_0}*({falling}*exp(-{B}*w)+{A})
eps={slope}*w/mu
f={force}*mu*(eps/(1+eps*eps)+atan(eps))
init ya={y_A}, yt={y_T}, yr={y_R}
@ total=100,dt=.01
done
"""


def ode_file(p: model.WheelsetParameters) -> str:
    """The wheelset in mm, ms, kg for XPPAUT, with V_0 of one equilibrium."""
    state = model.equilibrium(p, with_absorber=True)
    numbers = {
        "c_A": p.c_A * 1e-6,
        "c0": 1e-3 * p.Omega**2 * (p.r_C * np.cos(p.gamma) - p.L),
        "c1": 1e-6 * p.Omega**2,
        "v": -p.gamma * state.V_0,
        "mu_0": p.mu_0,
        "falling": 1.0 - p.A,
        "A": p.A,
        "B": p.B,
        "slope": 0.25 * np.pi * p.C_22 / (state.V_0 * p.F_N),
        "force": 2e-3 * p.F_N / np.pi,
        "y_A": 1e3 * (state.y_A - p.L),
        "y_T": 1e3 * (state.y_T - p.L),
        "y_R": 1e3 * (state.y_R - p.L),
    }
    return ODE.format(**{name: f"{float(value):.15g}" for name, value in numbers.items()})


def auto_of_xppaut(values: model.WheelsetParameters) -> dict[str, tuple[float, int]]:
    """Both tasks by the AUTO inside XPPAUT; empty where xpplab is not installed."""
    try:
        import xpplab
    except ImportError:
        return {}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "wheelset.ode"
        path.write_text(ode_file(values._replace(c_A=6e7)), encoding="utf-8")
        return _auto_tasks(xpplab.Model(str(path)).auto)


def _auto_tasks(auto: Any) -> dict[str, tuple[float, int]]:
    window = {"parmin": 50, "parmax": 200, "dsmin": 1e-4}
    start = auto.equilibria("ca", ds=0.5, dsmax=5, nmax=400, **window).first("HB")
    accuracy = {"epsl": 1e-8, "epsu": 1e-8, "epss": 1e-6}
    begun = time.process_time()
    cycles = auto.continue_from(
        start, "periodic", ntst=50, ds=0.02, dsmax=1.0, nmax=132, **accuracy
    )
    between = time.process_time()
    points = auto.continue_from(
        start, "two-parameter", second="ct", ds=-0.5, dsmax=0.6, nmax=412, parmin=10, parmax=250
    )
    ended = time.process_time()
    return {
        "limit cycles": (between - begun, len(cycles)),
        "Hopf curve": (ended - between, len(points)),
    }


def main() -> None:
    """Print for each task its time, and per point and for the whole the ratios to each AUTO."""
    values = line()
    here = ours(values)
    partners = {
        "AUTO-07p, differences": auto_07p.tasks(values, jacobian=False),
        "AUTO-07p, derivatives given": auto_07p.tasks(values, jacobian=True),
        "AUTO of XPPAUT": auto_of_xppaut(values),
    }
    for task, (seconds, points) in here.items():
        each = seconds / points
        print(f"{task}: {seconds:.3f} s CPU for {points} points, {1e3 * each:.3f} ms each")
        for name, there in partners.items():
            if task in there:
                other, count = there[task]
                print(
                    f"  over {name} ({count} points): {each / (other / count):.2f} per point, "
                    f"{seconds / other:.2f} in all"
                )
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"largest memory of the process: {peak:.0f} MB")


if __name__ == "__main__":
    main()
