"""The wheelset in compiled AUTO-07p: limit cycles and the Hopf curve of `continuation.py`.

AUTO-07p is free software (github.com/auto-07p/auto-07p). Once::

    git clone https://github.com/auto-07p/auto-07p && cd auto-07p && ./configure && make

needs gfortran and make; AUTO_DIR then names that folder. The equations are compiled with -O2 and
linked with the objects in its `lib`; AUTO itself is as its makefile compiles it.
"""

import os
import resource
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from tramdva.wheelset import model

RUNS = 5

# Units mm, ms, kg, kN; the rolling speed is that of one equilibrium, so that AUTO solves none.
EQUATIONS = """
subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
  double precision :: ca, ct, w, decay, mu, e, q, h, wheel, damper, e1, h1, slope
  ca = par(1)
  ct = par(2)
  w = u(6) + {v}
  decay = {mu_0}*{falling}*exp(-{B}*w)
  mu = decay + {mu_0}*{A}
  e = {slope}*w/mu
  q = 1d0/(1d0 + e*e)
  h = e*q + atan(e)
  wheel = {c_R}*(u(3) - u(1)) + {d_R}*(u(6) - u(4))
  damper = ct*(u(2) - u(1)) + {d_T}*(u(5) - u(4))
  f(1:3) = u(4:6)
  f(4) = (-ca*u(1) - {d_A}*u(4) + wheel + damper)/{m_A} - {c0} + {c1}*u(1)
  f(5) = -damper/{m_T} - {c0} + {c1}*u(2)
  f(6) = (-wheel - {force}*mu*h)/{m_R} - {c0} + {c1}*u(3)
  if (ijac == 0) return
  dfdu = 0d0
  dfdu(1, 4) = 1d0
  dfdu(2, 5) = 1d0
  dfdu(3, 6) = 1d0
  dfdu(4, :) = (/ (-ca - {c_R} - ct)/{m_A} + {c1}, ct/{m_A}, {c_R}/{m_A}, &
                  (-{d_A} - {d_R} - {d_T})/{m_A}, {d_T}/{m_A}, {d_R}/{m_A} /)
  dfdu(5, 1) = ct/{m_T}
  dfdu(5, 2) = -ct/{m_T} + {c1}
  dfdu(5, 4) = {d_T}/{m_T}
  dfdu(5, 5) = -{d_T}/{m_T}
  e1 = {slope}/mu*(1d0 + {B}*w*decay/mu)
  h1 = (1d0 - e*e)*q*q + q
  slope = {force}*(mu*h1*e1 - {B}*decay*h)
  dfdu(6, 1) = {c_R}/{m_R}
  dfdu(6, 3) = -{c_R}/{m_R} + {c1}
  dfdu(6, 4) = {d_R}/{m_R}
  dfdu(6, 6) = (-{d_R} - slope)/{m_R}
  if (ijac == 1) return
  dfdp(:, 1:2) = 0d0
  dfdp(4, 1) = -u(1)/{m_A}
  dfdp(4, 2) = (u(2) - u(1))/{m_A}
  dfdp(5, 2) = -(u(2) - u(1))/{m_T}
end subroutine func

subroutine stpnt(ndim, u, par, t)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(inout) :: u(ndim), par(*)
  double precision, intent(in) :: t
  par(1:2) = (/ {c_A}, {c_T} /)
  u = (/ {y_A}, {y_T}, {y_R}, 0d0, 0d0, 0d0 /)
end subroutine stpnt
""" + "\n".join(
    f"subroutine {name}\nend subroutine {name}" for name in ("bcnd", "icnd", "fopt", "pvls")
)

CONSTANTS = """NDIM=6, IPS={ips}, IRS={irs}, ILP=0
ICP={icp}
NTST=50, NCOL=4, IAD=3, ISP=2, ISW={isw}, IPLT=0, NBC=0, NINT=0
NMX={nmx}, NPR=0, MXBF=0, IID=0, ITMX=9, ITNW=7, NWTN=3, JAC={jac}
EPSL=1e-8, EPSU=1e-8, EPSS=1e-6
DS={ds}, DSMIN=1e-4, DSMAX={dsmax}, IADS=1
NPAR=2, THL={thl}, THU={{}}
UZSTOP={{1: [10.0, 250.0], 2: [0.1, 150.0]}}
"""
EQUILIBRIA = {"ips": 1, "icp": "[1]", "isw": 1, "ds": 0.5, "dsmax": 5.0, "nmx": 100, "thl": "{}"}
# The arclength leaves out the period of a limit cycle, as AUTO's manual advises, and counts that of
# a Hopf point: with the same largest step the points are then about as many as ours.
TASKS = {
    "limit cycles": {
        "ips": 2, "icp": "[1, 11]", "isw": 1, "ds": 0.02, "dsmax": 1.0, "nmx": 110,
        "thl": "{11: 0.0}",
    },
    "Hopf curve": {
        "ips": 1, "icp": "[1, 2]", "isw": 2, "ds": 0.5, "dsmax": 0.6, "nmx": 2000, "thl": "{}",
    },
}  # fmt: skip


def equations(p: model.WheelsetParameters) -> str:
    """The wheelset as AUTO's Fortran."""
    state = model.equilibrium(p, with_absorber=True)
    numbers = {
        "c0": 1e-3 * p.Omega**2 * (p.r_C * np.cos(p.gamma) - p.L),
        "c1": 1e-6 * p.Omega**2,
        "v": -p.gamma * state.V_0,
        "mu_0": p.mu_0,
        "falling": 1.0 - p.A,
        "A": p.A,
        "B": p.B,
        "slope": 0.25 * np.pi * p.C_22 / (state.V_0 * p.F_N),
        "force": 2e-3 * p.F_N / np.pi,
        **{name: getattr(p, name) for name in ("m_A", "m_T", "m_R")},
        **{name: 1e-6 * getattr(p, name) for name in ("c_A", "c_T", "c_R")},
        **{name: 1e-3 * getattr(p, name) for name in ("d_A", "d_T", "d_R")},
        **{name: 1e3 * (getattr(state, name) - p.L) for name in ("y_A", "y_T", "y_R")},
    }
    fortran = {name: f"({value:.17e})".replace("e", "d") for name, value in numbers.items()}
    return EQUATIONS.format(**fortran)


def tasks(values: model.WheelsetParameters, jacobian: bool) -> dict[str, tuple[float, int]]:
    """CPU seconds and points of both tasks, best of several runs; empty without AUTO_DIR.

    With `jacobian` AUTO is given the derivatives of f (JAC = 1), else it takes differences.
    """
    auto = os.environ.get("AUTO_DIR")
    if not auto:
        return {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "w.f90").write_text(equations(values._replace(c_A=6e7)), encoding="utf-8")
        objects = sorted(Path(auto, "lib").glob("*.o"))
        compiled = ["-O2", "-ffree-line-length-none", "-c", "w.f90"]
        for command in (compiled, ["-fopenmp", "w.o", *objects, "-o", "w"]):
            subprocess.run(["gfortran", *command], cwd=folder, check=True)
        (folder / "fort.3").touch()
        jac = int(jacobian)
        _run(folder, CONSTANTS.format(irs=0, jac=jac, **EQUILIBRIA))
        hopf = next(row for row in _table(folder) if row[2] == "3")
        (folder / "fort.8").rename(folder / "fort.3")
        return {
            task: _best(folder, CONSTANTS.format(irs=hopf[3], jac=jac, **numbers))
            for task, numbers in TASKS.items()
        }


def _best(folder: Path, constants: str) -> tuple[float, int]:
    seconds = min(_run(folder, constants) for _ in range(RUNS))
    return seconds, len(_table(folder))


def _run(folder: Path, constants: str) -> float:
    """CPU seconds of one run."""
    (folder / "fort.2").write_text(constants, encoding="utf-8")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(
        [folder / "w"],
        cwd=folder,
        env=os.environ | {"OMP_NUM_THREADS": "1"},
        stdout=subprocess.DEVNULL,
        check=True,
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _table(folder: Path) -> list[list[str]]:
    """Rows of AUTO's table: branch, point, type, label, parameters, ..."""
    lines = (folder / "fort.7").read_text(encoding="utf-8").splitlines()
    return [row for line in lines if (row := line.split())[0] != "0"]
