"""The stage `basic_model`: the wheelset of figures 2 to 7 as the line's bogie says."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bogie.critical_mode import Band, band_about, critical_mode, peak_bands
from tramdva.bogie.curving import angle_of_attack, linearise
from tramdva.bogie.modes import modes
from tramdva.bogie.names import WHEELS
from tramdva.bogie.reduction import Reduction, absorber_mass, chain_of, reduced, without_own_creep
from tramdva.bogie.tram import BogieLine, Running, run_through
from tramdva.bogie.vehicle import absorber_carriers
from tramdva.contact import kalker, patch
from tramdva.stages.bogie_sections import bogie_line, frequency_limits
from tramdva.variables.basic_model import QUANTITIES, VARIABLES
from tramdva.variables.shared import CURVING_WORDS

__all__ = ["VARIABLES", "compute"]

WHEEL = "front_inner"
SECTION_OF = {
    **dict.fromkeys(("r_C", "gamma", "outer_speed"), "curve"),
    **dict.fromkeys(("F_N", "a", "b", "c_22"), "creep_force"),
    **dict.fromkeys(("m_A", "m_R", "c_A", "d_A", "c_R", "d_R"), "wheelset"),
    **dict.fromkeys(("m_T", "c_T", "d_T"), "absorber"),
}
# rad; with less the inner wheel does not slide steadily outwards, which the basic model is about.
LEAST_ATTACK = 1e-3
REASONS = CURVING_WORDS | {
    "no_attack": "the front axle has no angle of attack of 1 mrad: its inner wheel does not slide",
    "no_mode": "the bogie has no second bending or no resilient wheel mode at the inner wheel",
    "no_chain": "no two masses on two springs have the modes of the bogie",
}


def compute(
    cfg: Mapping[str, Any], contact_geometry: Mapping[str, np.ndarray]
) -> dict[str, np.ndarray]:
    """Values of the basic model: those of the line's file, the others from its bogie.

    Parameters
    ----------
    cfg : sections of the bogie and of the basic model, None where the file gives nothing; and
        ``tendency_axis``, ends of the frequencies of figure 10
    contact_geometry : variables of this file

    Returns
    -------
    Variables of ``basic_model.nc``.
    """
    line = bogie_line(cfg, contact_geometry)
    run = run_through(line)
    found = dict.fromkeys(QUANTITIES, np.nan)
    seen, status = None, run.equilibrium.status
    if status == "converged":
        found |= _in_the_curve(line, run)
        # The mode of a stiff resilient wheel may lie above the vibrations that polygonise wheels.
        seen = _seen(line, run, (frequency_limits(cfg)[0], line.cutoff_frequency))
        status = _reduce(line, run, seen, found)
    own = {name: cfg[section][name] for name, section in SECTION_OF.items()}
    used = {name: found[name] if value is None else value for name, value in own.items()}
    modes = [] if seen is None else [mode for mode in (seen.bending, seen.wheel) if mode]
    words = [] if seen is None else ["second_bending"] * bool(seen.bending)
    words += ["resilient_wheel"] if seen is not None and seen.wheel else []
    incomplete = any(np.isnan(value) for value in used.values())
    return {
        **{name: np.float64(used[name]) for name in QUANTITIES},
        **{f"reduced_{name}": np.float64(found[name]) for name in QUANTITIES},
        "quantity": np.array(list(QUANTITIES)),
        "given": np.array([own[name] is not None for name in QUANTITIES]),
        "mode": np.array(words),
        "mode_frequency": np.array([mode.frequency for mode in modes]),
        "mode_growth_rate": np.array([mode.pole.real for mode in modes]),
        "mode_mass": np.array([mode.mass for mode in modes]),
        **_bands(cfg, run),
        "status": np.array(status),
        "reason": np.array(REASONS.get(status, "") if incomplete else ""),
    }


def _bands(cfg: Mapping[str, Any], run: Running) -> dict[str, np.ndarray]:
    """Critical mode, the band about it, and the bands of the peaks of figure 10."""
    none, peaks, reason = np.float64(np.nan), [], REASONS.get(run.equilibrium.status, "")
    mode, band = None, Band("", np.nan, np.nan)
    limits = frequency_limits(cfg)
    axis = cfg["tendency_axis"]["min"], cfg["tendency_axis"]["max"]
    if not reason:
        every = min(limits[0], axis[0]), max(limits[1], axis[1])
        found = modes(run.curve, run.equilibrium.state, every)
        mode = critical_mode(run.curve, found, limits)
        reason = "" if mode else "the bogie has no mode in the range of study.bogie_modes.frequency"
    if mode is not None:
        band, peaks = band_about(mode, axis), peak_bands(run.curve, found, mode, axis)
        if not band.high > band.low:
            band = Band("", np.nan, np.nan)
            reason = (
                f"the critical mode, {mode.frequency:.0f} Hz, lies outside the frequencies of "
                "study.evolution_tendency: give study.tendency_maps.design_band"
            )
    return {
        "critical_mode": np.array(mode.name if mode else ""),
        **{
            f"critical_{name}": np.float64(getattr(mode, name) if mode else none)
            for name in ("frequency", "growth_rate", "likeness")
        },
        "band_min": np.float64(band.low),
        "band_max": np.float64(band.high),
        "peak": np.array([peak.name for peak in peaks], dtype="U40"),
        "peak_min": np.array([peak.low for peak in peaks]),
        "peak_max": np.array([peak.high for peak in peaks]),
        "band_reason": np.array(reason),
    }


def _in_the_curve(line: BogieLine, run: Running) -> dict[str, float]:
    """Curve and contact of the front inner wheel; of several contacts the one of most load."""
    contacts = run.equilibrium.results[WHEELS.index(WHEEL)]
    most = contacts[np.argmax(contacts[:, patch.NORMAL_FORCE])]
    a, b = most[patch.SEMI_AXIS_LONGITUDINAL], most[patch.SEMI_AXIS_LATERAL]
    outer = line.track.radius + line.bogie.wheel.half_distance
    _, c_22, _ = kalker.creep_coefficients(run.curve.contacts.law.kalker_table, a / b)
    return {
        "r_C": outer,
        "gamma": -float(angle_of_attack(run.curve, run.equilibrium)[0]),
        "outer_speed": line.track.speed * outer / line.track.radius,
        "F_N": float(most[patch.NORMAL_FORCE]),
        "a": float(a),
        "b": float(b),
        "c_22": float(c_22),
    }


def _seen(line: BogieLine, run: Running, limits: tuple[float, float]) -> Reduction:
    state = run.equilibrium.state
    jacobian = linearise(run.curve, state).contact_jacobian
    linear = without_own_creep(run.curve, state, jacobian, WHEEL)
    along, _ = absorber_carriers(run.curve.vehicle, line.bogie.absorber)
    return reduced(run.curve, linear, WHEEL, line.bogie.wheel.radius, along, limits)


def _reduce(line: BogieLine, run: Running, seen: Reduction, found: dict[str, float]) -> str:
    """Add the two masses and the absorber to what was found; return the status."""
    if found["gamma"] > -LEAST_ATTACK:
        return "no_attack"
    if seen.bending is None or seen.wheel is None:
        return "no_mode"
    chain = chain_of(*sorted((seen.bending, seen.wheel), key=lambda mode: mode.frequency))
    if chain is None:
        return "no_chain"
    found |= chain._asdict()
    own = line.bogie.absorber
    m_T = absorber_mass(own.I_T, seen, chain.share_of_axle(seen.bending.pole))
    found |= {"m_T": m_T, "c_T": own.c_T * m_T / own.I_T, "d_T": own.d_T * m_T / own.I_T}
    return "derived"
