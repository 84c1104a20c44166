"""Made-up files behind a design sheet."""

import numpy as np

from tramdva.evolution.growing_orders import growing_orders
from tramdva.report import design_sheet
from tramdva.report.sheet_verdicts import NOMINAL, ROBUST
from tramdva.robustness.spread import QUANTILES
from tramdva.robustness.spread import spread as spread_of
from tramdva.variables.registry import STAGES
from tramdva.variables.shared import CASE_STATUS

TRIED = ("I_T", "c_T", "d_T", "nominal_factor", "worst_factor")
KINDS = {"real": float, "flag": "U20", "truth": bool, "text": "U30"}


def tuning() -> dict[str, np.ndarray]:
    """Numbers of a robust tuning with 30 sampled cases."""
    ranges = list(design_sheet.RANGES)
    ends = [f"{name}_{end}" for name in ranges[:9] for end in ("min", "max")]
    varied = ["none", *ends, *["all"] * 30]
    cases = len(varied)
    lengths = {"case": cases, "range": 11, "wheel": 2, "friction": 2, "design": 4, "axis": 2,
               "end": 2, "map_c_T": 5, "map_d_T": 5, "rubber_end": 4, "peak": 2,
               "outcome": len(CASE_STATUS), "quantile": len(QUANTILES), "tried": 3}  # fmt: skip
    values = {
        name: np.zeros([lengths[d] for d in variable.dimensions], KINDS[variable.kind])
        for name, variable in STAGES["robust_tuning"].variables.items()
    }
    spread = np.linspace(0.02, 0.9, cases)
    missing = np.array([np.nan, 1.0, 1.0, 1.0])
    values |= {
        "varied": np.array(varied),
        "range": np.array(ranges),
        "wheel": np.array(["front_outer", "front_inner"]),
        "case_status": np.array(["converged"] * cases, dtype="U20"),
        "counted": np.ones(cases, bool),
        "status": np.array(["converged"] * 4, dtype="U20"),
        "I_T": 2.0 * missing,
        "c_T": np.array([np.nan, 1.74e5, 2.7e5, 2.6e5]),
        "d_T": np.array([np.nan, 300.0, 115.0, 394.0]),
        "tuned_frequency": 46.9 * missing,
        "damping_ratio": 0.25 * missing,
        "added_mass": 40.0 * missing,
        "added_weight": 392.4 * missing,
        "unsprung_mass": np.array(1000.0),
        "tolerance": np.array(
            [np.full((2, 2), np.nan)] * 3 + [np.array([[2.3e5, 3e5], [197.0, np.nan]])]
        ),
        "map_c_T": np.linspace(2e4, 5e5, 5),
        "map_d_T": np.linspace(20.0, 1500.0, 5),
        "map_worst_factor": np.add.outer(np.linspace(0.5, 2, 5), np.linspace(0.1, 1, 5)),
        "nominal_factor": np.array([np.nan, 0.29, 0.19, 0.27]),
        "worst_factor": np.array([np.nan, 1.1, 3.7, 0.71]),
        **{f"tried_{name}": np.full(3, np.nan) for name in TRIED},
        "self_excited_cases": np.array([np.nan, 1.0, 34.0, 0.0]),
        "factor": np.outer([1.0, 0.6, 0.7, 0.5], spread),
        "rubber_end": np.array(["stiffness_min", "stiffness_max", "damping_min", "damping_max"]),
        "rubber_factor": np.full((4, 4), 0.28),
        "peak": np.array(["second_bending", "resilient_wheel"]),
        "peak_frequency": np.full((cases, 2, 2), 55.3),
        "peak_factor": np.full((4, cases, 2, 2), 0.25) * spread[:, None, None],
        "growth_rate": np.tile(np.where(np.arange(cases) % 2, 1.0, -1.0)[:, None], (4, 1, 2)),
        "stroke_amplitude": np.outer([0.0, 1.0, 2.0, 1.0], 1e-3 * spread),
        "torque_amplitude": np.outer([0.0, 1.0, 2.0, 1.0], 100 * spread),
        "dissipated_power": np.outer([0.0, 1.0, 2.0, 1.0], 10 * spread),
        "carrier_amplitude": np.outer([3.0, 1.0, 1.0, 1.0], 1e-3 * spread),
        "load_frequency": np.full((4, cases), 55.0),
        "load_order": np.full((4, cases), 25.9),
    }
    values["growth_rate"][1:] = -5.0
    return values | spread_of(values, CASE_STATUS)


def without(values: dict, status: str) -> dict:
    """The same line where a search found no design."""
    for name in ("c_T", "d_T", "nominal_factor", "worst_factor", "tuned_frequency"):
        values[name][[NOMINAL, ROBUST]] = np.nan
    values["status"][[NOMINAL, ROBUST]] = status
    for name in ("factor", "peak_factor", "stroke_amplitude", "torque_amplitude", "growth_rate"):
        values[name][[NOMINAL, ROBUST]] = np.nan
    if status != "self_excited":
        for name in ("factor", "peak_factor", "map_worst_factor", "peak_frequency"):
            values[name][:] = np.nan
    if status == "nothing_grows":
        values["growth_rate"][0] = -1.0
    if status == "no_equilibrium":
        values["case_status"][:] = "not_converged"
        values["growth_rate"][:] = np.nan
    return values | spread_of(values, CASE_STATUS)


def modes(status: str = "converged", growth: float = 0.3) -> dict[str, np.ndarray]:
    return {
        "absorber": np.array(["none", "paper", "tuned"]),
        "status": np.array([status] * 3),
        "operating_growth_rate": np.array([growth, -17.0, -18.0]),
        "operating_frequency": np.array([54.7, 34.9, 35.0]),
        "critical_friction_decrease": np.array([0.676 if growth > 0 else np.nan, np.nan, np.nan]),
        "largest_growth_rate": np.array(
            [[-9.0, 19.0 if growth > 0 else -1.0], [-20.0, -10.0], [-20.0, -10.0]]
        ),
    }


def curving(status: str = "converged") -> dict[str, np.ndarray]:
    return {
        "absorber": np.array(["none", "paper", "tuned"]),
        "status": np.array([status] * 3),
        "wheel": np.array(["front_outer", "front_inner", "rear_outer", "rear_inner"]),
        "axle": np.array(["front", "rear"]),
        "wheel_load": np.tile([41494.0, 36376.0, 40137.0, 37166.0], (3, 1)),
        "angle_of_attack": np.tile([0.0371, -0.031], (3, 1)),
    }


def maps(sign: float = 1.0) -> dict[str, np.ndarray]:
    frequency, speed = np.linspace(2.0, 150.0, 297), np.array([3.0, 4.0])
    bump = 1e-3 * np.exp(-(((frequency - 55.0) / 4.0) ** 2)) - 1e-4
    values = {
        "absorber": np.array(["none", "paper"]),
        "frequency": frequency,
        "speed": speed,
        "speed_status": np.array([["converged", "converged"], ["converged", "wheel_lifted"]]),
        "speed_growth_rate": np.array([[-1.0, -1.0], [-9.0, np.nan]]),
        "speed_tendency": np.tile(bump if sign > 0 else -np.abs(bump), (2, 2, 2, 1)),
    }
    return values | growing_orders(values, wheel_radius=0.3)


def growth(status: str = "reached") -> dict[str, np.ndarray]:
    """Kilometres without and with absorbers under two laws."""
    km = np.array([[4200.0, 4400.0], [5400.0, 5300.0]])
    known = status == "reached"
    return {
        "wear_law": np.array(["smoothed", "constant"]),
        "shown_wear_law": np.array("smoothed"),
        "absorber": np.array(["none", "paper"]),
        "turning_distance": km if known else np.full((2, 2), np.nan),
        "turning_status": np.full((2, 2), status, dtype="U20"),
        "hindrance": np.array(["" if known else "self_excited: 25 m left", ""]),
        "first_wheel": np.zeros((2, 2)),
        "fastest_order": np.full((2, 2, 4), 57.0),
        "fastest_section": np.full((2, 2, 4), "station square", dtype="U20"),
        "limit": np.array(3e-4),
        "distance": np.array([0.0, 1e5]),
        "longest_absorber": np.array(["paper", "none"] if known else ["", ""], dtype="U20"),
        "laws_agree": np.array(False),
        "wheel_life": 20.0 * km,
    }


def remedies() -> dict[str, np.ndarray]:
    """A measure that helps and one that does not."""
    return {
        "bare_status": np.array("computed"),
        "bare_wheel_life": np.array(8e4),
        "remedy": np.array(["lubricated", "harder_wheels"]),
        "remedy_section": np.array(["old town", ""]),
        "remedy_wheel_life": np.array([1.2e5, 5.6e4]),
    }


def content(cfg, values, critical: float = 0.68, **others) -> design_sheet.Sheet:
    return design_sheet.sheet(
        cfg,
        values,
        {"baseline_critical_B": np.array(critical)},
        others.get("modes", modes()),
        others.get("maps", maps()),
        others.get("curving", curving()),
        others.get("growth", growth()),
        others.get("remedies", remedies()),
    )
