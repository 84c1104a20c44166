"""Which values of the configuration each stage and each figure uses."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from operator import getitem
from typing import Any

from tramdva.bogie.parameters import BareBogie, BogieAbsorber
from tramdva.configuration import measured_files
from tramdva.configuration.following import BASIC_MODEL
from tramdva.configuration.plan import plan
from tramdva.configuration.reading import Configuration
from tramdva.contact.parameters import ContactProfiles

_FORCE = ("curve", "creep_force")
_WHEELSET = ("wheelset",)
_WHEELSET_OF_ANY_C_A = tuple(
    f"wheelset.{name}" for name in ("m_A", "m_R", "d_A", "c_R", "d_R", "L")
)
_VARIANTS = (
    "absorber.m_T",
    "absorber_variants.name",
    "absorber_variants.c_T",
    "absorber_variants.d_T",
)
_BOGIE = (
    "track",
    "bogie",
    "contact_geometry",
    "creep_force.mu_0",
    "creep_force.A",
    "creep_force.B",
    "numerics.bogie",
)
# Without self-excitation, for wheels out of round.
_ROUGH_BOGIE = (
    "track",
    *(f"bogie.{name}" for name in BareBogie.model_fields),
    "contact_geometry",
    "creep_force.mu_0",
    "creep_force.A",
    "forced_excitation.B",
    "numerics.bogie",
)
_ABSORBER_TO_TUNE = tuple(
    f"bogie.absorber.{name}" for name in BogieAbsorber.model_fields if name not in ("c_T", "d_T")
)
_FIGURE = ("label",)
_FIGURE_WITH_ABSORBER = (*_FIGURE, "absorber.c_T", "absorber.d_T")
_FIGURE_OF_VARIANTS = ("label", "absorber_variants.name", "absorber_variants.label")

# What each stage and each figure uses. `study.<x>` and `numerics.<x>` come without the <x>.
USES: dict[str, tuple[str, ...]] = {
    "stability_map": (
        *_FORCE,
        *_WHEELSET,
        *_VARIANTS,
        "study.stability_map",
        "numerics.stability_map",
    ),
    "hopf_points": (*_FORCE, *_WHEELSET_OF_ANY_C_A, *_VARIANTS, "numerics.hopf_points"),
    "limit_cycles": (
        *_FORCE,
        *_WHEELSET_OF_ANY_C_A,
        *_VARIANTS,
        "study.limit_cycles",
        "numerics.limit_cycles",
    ),
    "hopf_curves": (
        *_FORCE,
        *_WHEELSET_OF_ANY_C_A,
        "absorber.m_T",
        "study.hopf_curves",
        "numerics.hopf_curves",
    ),
    "critical_hopf_curve": (
        *_FORCE,
        *_WHEELSET_OF_ANY_C_A,
        "absorber.m_T",
        "study.critical_hopf_curve",
        "numerics.critical_hopf_curve",
    ),
    "cycle_amplitudes": (
        *_FORCE,
        *_WHEELSET,
        "absorber.m_T",
        "study.cycle_amplitudes",
        "numerics.cycle_amplitudes",
    ),
    "absorber_tuning": (
        *_FORCE,
        *_WHEELSET,
        "absorber",
        "forced_excitation.B",
        "study.frequency_response.frequency",
        "numerics.absorber_tuning",
    ),
    "frequency_response": (
        *_FORCE,
        *_WHEELSET,
        "forced_excitation.B",
        "study.frequency_response",
        "numerics.frequency_response",
    ),
    "contact_geometry": (
        *(f"contact_geometry.{name}" for name in ContactProfiles.model_fields),
        "bogie.wheel.radius",
        "bogie.wheel.half_distance",
        "bogie.half_wheelbase",
        "track.radius",
        "study.tendency_maps.radius.min",
        "study.design_sheet.conditions.radius.min",
        "measured.wheel",
        "measured.rail",
        "numerics.contact_geometry",
    ),
    "basic_model": (
        *_BOGIE,
        *(path for path in BASIC_MODEL if path not in _BOGIE),
        "study.bogie_modes.frequency",
        "tendency_axis",
    ),
    "preflight": (
        *_BOGIE,
        "forced_excitation.B",
        "study.bogie_modes.frequency",
        "measured.wheel",
        "plan",
    ),
    "curving_equilibrium": (*_BOGIE, "study.bogie_modes.frequency"),
    "bogie_modes": (*_BOGIE, "study.bogie_modes", "numerics.bogie_modes"),
    "growth_band": (
        *_BOGIE,
        "measured.wheel",
        "measured.rail",
        "study.bogie_modes",
        "numerics.bogie_modes",
        "numerics.contact_geometry",
    ),
    "curve_entry": (*_BOGIE, "study.curve_entry", "numerics.curve_entry"),
    "bogie_linearisation_none": _ROUGH_BOGIE,
    "bogie_linearisation_paper": (*_ROUGH_BOGIE, "bogie.absorber"),
    "bogie_linearisation_tuned": (*_ROUGH_BOGIE, *_ABSORBER_TO_TUNE),
    "bogie_simulation": (
        "out_of_roundness",
        "measured.out_of_roundness",
        "numerics.bogie_simulation",
    ),
    "wear": ("wear", "numerics.wear"),
    "evolution_tendency": (
        "wear",
        "out_of_roundness.wheels",
        "study.evolution_tendency",
        "study.tendency_maps.design_band",
        "numerics.wear",
        "numerics.evolution_tendency",
    ),
    "tendency_maps": (
        *_ROUGH_BOGIE,
        "bogie.absorber",
        "wear",
        "out_of_roundness.wheels",
        "study.evolution_tendency",
        "study.tendency_maps",
        "numerics.wear",
        "numerics.tendency_maps",
    ),
    "wheelset_designs": (
        *_FORCE,
        *_WHEELSET,
        "absorber",
        "forced_excitation.B",
        "study.stability_map.c_A",
        "study.stability_map.c_R",
        "study.frequency_response.frequency",
        "study.wheelset_designs",
        "numerics.wheelset_designs",
    ),
    "bogie_designs": (
        *_BOGIE,
        "forced_excitation.B",
        "wear",
        "out_of_roundness.wheels",
        "study.evolution_tendency.frequency",
        "study.tendency_maps.design_band",
        "study.bogie_designs",
        "numerics.wear",
        "numerics.bogie_designs",
    ),
    "robustness_sample": (
        *_ROUGH_BOGIE,
        *_ABSORBER_TO_TUNE,
        "creep_force.B",
        "wear",
        "out_of_roundness.wheels",
        "study.bogie_modes.frequency",
        "study.evolution_tendency.peaks",
        "study.tendency_maps.design_band",
        "study.design_sheet.conditions",
        "study.design_sheet.rubber",
        "numerics.wear",
        "numerics.robustness_sample",
    ),
    "robust_tuning": (
        "track.gravity",
        "bogie.absorber",
        "bogie.wheel.radius",
        "study.bogie_modes.frequency",
        "study.evolution_tendency.peaks",
        "study.tendency_maps.design_band",
        "study.tendency_maps.c_T",
        "study.tendency_maps.d_T",
        "study.design_sheet",
        "numerics.robust_tuning",
    ),
    "route_response": (
        *_ROUGH_BOGIE,
        "bogie.absorber",
        "wear",
        "route.file",
        "route.way",
        "route.ends",
        "route.sections",
        "route.measured_wear",
        "measured.route",
        "numerics.wear",
        "numerics.route_response",
    ),
    "route_tuning": (
        *_ROUGH_BOGIE,
        "bogie.absorber",
        "creep_force.B",
        "wear",
        "route",
        "measured.route",
        "numerics.wear",
        "numerics.route_response",
        "numerics.route_tuning",
    ),
    "route_remedies": (
        *_ROUGH_BOGIE,
        "bogie.absorber",
        "wear",
        "route",
        "out_of_roundness.wheels",
        "study.tendency_maps.design_band",
        "measured.route",
        "numerics.wear",
        "numerics.route_response",
    ),
    "polygon_growth": (
        "route",
        "measured.route",
        "numerics.polygon_growth",
    ),
    "polygon_simulation": (
        *_ROUGH_BOGIE,
        "bogie.absorber",
        "creep_force.B",
        "wear",
        "route.file",
        "route.way",
        "route.ends",
        "route.sections",
        "route.wear_law",
        "route.initial",
        "route.turning.peak_to_peak_mm",
        "route.horizon_km",
        "measured.route",
        "numerics.wear",
        "numerics.polygon_simulation",
    ),
    "preflight_chart": _FIGURE,
    "preflight_page": _FIGURE,
    "fig02_stability_map": (*_FIGURE_OF_VARIANTS, *_FIGURE_WITH_ABSORBER),
    "fig03_bifurcation_diagram": _FIGURE_OF_VARIANTS,
    "fig04_hopf_curves": _FIGURE,
    "fig05_critical_hopf_curve": _FIGURE_WITH_ABSORBER,
    "fig06_cycle_amplitudes": _FIGURE,
    "fig07_frequency_response": _FIGURE,
    "fig08_bogie": (*_FIGURE, "bogie"),
    "fig09_curve_entry": (*_FIGURE, "study.curve_entry.entry"),
    "bogie_mode_shapes": (*_FIGURE, "bogie.wheel.radius"),
    "bogie_stability": (*_FIGURE, "creep_force.B", "bogie.absorber.motion"),
    "growth_band_chart": (*_FIGURE, "creep_force.B"),
    "campbell_chart": (*_FIGURE, "track.speed", "bogie.wheel.radius"),
    "fig10_evolution_tendency": _FIGURE,
    "worn_wheels": _FIGURE,
    "order_speed_chart": (*_FIGURE, "bogie.wheel.radius"),
    "tendency_design_chart": (
        *_FIGURE,
        "study.tendency_maps.design_band",
        "bogie.absorber.motion",
    ),
    "route_chart": _FIGURE,
    "polygon_growth_chart": _FIGURE,
    "kilometres_chart": _FIGURE,
    "remedies_chart": _FIGURE,
    "turned_wheels": _FIGURE,
    "table2_absorber_designs": (),
    "table_absorber_effect": (),
    "explorer": (
        *_FIGURE,
        "creep_force.B",
        "forced_excitation.B",
        "bogie.absorber.motion",
        "study.tendency_maps.design_band",
    ),
    "design_sheet": (
        *_FIGURE,
        "creep_force.mu_0",
        "creep_force.B",
        "forced_excitation.B",
        "track.radius",
        "track.speed",
        "bogie.absorber",
        "bogie.car_body.mass",
        "study.bogie_modes.B_max",
        "study.bogie_modes.frequency",
        "study.tendency_maps.design_band",
        "study.design_sheet",
    ),
}


def used_values(config: Configuration, line: str, name: str) -> dict[str, Any]:
    """Return exactly the values that a stage or figure of a line uses.

    Parameters
    ----------
    config : Configuration
        The whole configuration.
    line : str
        Name of the line.
    name : str
        Name of the stage or figure, a key of `STAGES`.

    Returns
    -------
    dict
        Plain nested maps, lists, numbers and texts in SI units; the entries of `study` and
        `numerics` are those of this stage; `plan` is what a run computes; `measured` holds the
        hashes of measured files; `tendency_axis` are the ends of that axis of frequencies. What
        the stage `basic_model` derives from the bogie is None.
    """
    everything = config.lines[line].model_dump(mode="json")
    # What a section of the route does not say is left out: None stands for what is derived.
    everything["route"] = config.lines[line].route.model_dump(mode="json", exclude_none=True)
    measured = config.measured[line]
    everything["measured"] = {
        what: measured[what].sha256 if what in measured else "" for what in measured_files.KEYS
    }
    everything["numerics"] = config.run.numerics.model_dump(mode="json")
    everything["plan"] = plan(config.run, config.lines[line])
    axis = config.lines[line].study.evolution_tendency.frequency
    everything["tendency_axis"] = axis.model_dump(mode="json")
    for path in config.derived[line]:
        *sections, key = path.split(".")
        reduce(getitem, sections, everything)[key] = None
    values = _select(everything, [tuple(path.split(".")) for path in USES[name]])
    for section in ("study", "numerics"):
        if section in values:
            values[section] = {k: v for part in values[section].values() for k, v in part.items()}
    return values


def is_left(config: Configuration, line: str, name: str) -> bool:
    """Whether a stage or figure uses a value that its line leaves to the bogie.

    It then reads the file of the stage `basic_model`, which completes its values.
    """
    return any(
        path == used or path.startswith(f"{used}.")
        for path in config.derived[line]
        for used in USES.get(name, ())
    )


# The stage that computes what lines leave to the bogie; rules that read its file in any case.
DERIVING, READ_IN_ANY_CASE = "basic_model", ("preflight",)


def stages_read(
    config: Configuration, line: str, name: str, reads: Sequence[str], absorber: str | None = None
) -> list[str]:
    """Return those of the stages that a rule may read which it reads for a line.

    Parameters
    ----------
    config : Configuration
        The whole configuration.
    line : str
        Name of the line.
    name : str
        Name of the stage or figure.
    reads : sequence of str
        Stages that it may read, as the Snakefile says.
    absorber : str, optional
        With which the job is; None for all jobs of the rule together.
    """
    absorbers = config.lines[line].study.evolution_tendency.absorbers

    def is_read(stage: str) -> bool:
        if stage == DERIVING and name not in READ_IN_ANY_CASE:
            return is_left(config, line, name)
        if name == "bogie_linearisation" and stage == "curving_equilibrium":
            return "tuned" in (absorbers if absorber is None else (absorber,))
        return True

    return [stage for stage in reads if is_read(stage)]


def _select(tree: Any, paths: Sequence[tuple[str, ...]]) -> Any:
    if () in paths:
        return tree
    if isinstance(tree, list):
        return [_select(item, paths) for item in tree]
    heads = {path[0] for path in paths}
    return {
        key: _select(value, [path[1:] for path in paths if path[0] == key])
        for key, value in tree.items()
        if key in heads
    }
