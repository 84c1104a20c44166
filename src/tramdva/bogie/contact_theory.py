"""How much the growth of an oscillation depends on what the theory of contact leaves open.

Creep law, shape of the traction bound, curvature of a patch in which it is not constant, averaging
over the gap, and the discretisation of patch, tables and axle: each is changed alone, the vehicle
follows into its new equilibrium, and growth rate and critical friction decrease are found anew.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from tramdva.bogie.curving import Equilibrium, System, near
from tramdva.bogie.modes import at_friction, critical_friction_decrease, critical_of
from tramdva.bogie.tram import BogieLine, Running, contacts_of, systems, transferred
from tramdva.contact import fastsim, patch
from tramdva.contact.geometry import ContactTable

# Within a patch in a root the relative curvature differs from that at its centre by up to this
# share; measured profiles leave about as much open.
CURVATURE_SHARE = 0.2
LOG_CURVATURE = 5  # column of the tables
NOMINAL, THEORY, DISCRETISATION = "as configured", "theory", "discretisation"
COMPARISON = "comparison"  # stands beside the band: not a theory of what happens here


class Variation(NamedTuple):
    """One change against the line as configured.

    name : words for figures; group : those of one group exclude each other
    kind : NOMINAL, THEORY, DISCRETISATION or COMPARISON
    line : with the change; changed : what else is changed in the vehicle made of it
    """

    name: str
    group: str
    kind: str
    line: BogieLine
    changed: Callable[[System], System]


class Growth(NamedTuple):
    """Growth rate (1/s) and frequency (Hz) at the line's friction, critical B (s/m), status.

    `critical` is NaN where the growth rate keeps its sign; numbers are NaN without an equilibrium.
    """

    rate: float
    frequency: float
    critical: float
    status: str


def variations(
    line: BogieLine, tables: Callable[[float, float], tuple[ContactTable, ...]]
) -> list[Variation]:
    """All variations of a line, the line as configured first.

    Parameters
    ----------
    line : BogieLine
    tables : contact tables for shares of the line's `gap_scale` and of the tables' step
    """
    nominal = Variation(NOMINAL, NOMINAL, NOMINAL, line, _same)
    return [nominal, *_of_theory(line, tables), *_of_discretisation(line, tables)]


def _of_theory(line: BogieLine, tables) -> list[Variation]:
    own = contacts_of(line).law.method
    # Polach's formula is made for traction at large creepages, without the spin of a flange.
    found = [
        Variation(
            f"creep law: {word}",
            "creep law",
            COMPARISON if method == patch.POLACH else THEORY,
            line,
            _with_law(method=method),
        )
        for word, method in patch.METHODS.items()
        if method != own
    ]
    if own == patch.FASTSIM:
        found += [
            Variation(
                f"traction bound: {bound}",
                "traction bound",
                THEORY,
                line,
                _with_law(grid=fastsim.patch_grid(*line.grid, bound)),
            )
            for bound in fastsim.BOUNDS
            if bound != "balanced"
        ]
    for sign in (-1, 1):
        bent = line._replace(tables=tuple(_bent(table, sign) for table in line.tables))
        name = f"curvature {sign * CURVATURE_SHARE:+.0%}"
        found.append(Variation(name, "curvature", THEORY, bent, _same))
    for share in (0.5, 2.0):
        other = line._replace(tables=tables(share, 1.0))
        found.append(Variation(f"gap scale x {share:g}", "gap scale", THEORY, other, _same))
    return found


def _of_discretisation(line: BogieLine, tables) -> list[Variation]:
    finer = {
        "step of the contact tables / 2": {"tables": tables(1.0, 0.5)},
        "cutoff of elastic modes x 2": {"cutoff_frequency": 2.0 * line.cutoff_frequency},
        "beam elements x 2": {"elements_per_section": 2 * line.elements_per_section},
    }
    if contacts_of(line).law.method == patch.FASTSIM:
        finer["cells of the patch x 2"] = {"grid": tuple(2 * cells for cells in line.grid)}
    return [
        Variation(name, name, DISCRETISATION, line._replace(**change), _same)
        for name, change in finer.items()
    ]


def _same(system: System) -> System:
    return system


def _with_law(**values) -> Callable[[System], System]:
    """Change of the contact law's fields."""

    def change(system: System) -> System:
        contacts = system.contacts
        return system._replace(contacts=contacts._replace(law=contacts.law._replace(**values)))

    return change


def _bent(table: ContactTable, sign: int) -> ContactTable:
    """Table whose lateral relative curvature is larger or smaller by `CURVATURE_SHARE`.

    Its logarithm is splined, and B-splines add up to one.
    """
    coefficients = table.coefficients.copy()
    coefficients[..., LOG_CURVATURE] += np.log1p(sign * CURVATURE_SHARE)
    return table._replace(coefficients=coefficients)


def growth(
    variation: Variation, known: Running, limits: tuple[float, float], decrease: np.ndarray
) -> Growth:
    """Growth of the least stable oscillation of a variation.

    Parameters
    ----------
    variation : Variation
    known : equilibria of the line as configured
    limits : Hz, of the oscillations that count
    decrease : (k,) s/m, where the onset of self-excitation is looked for
    """
    (system,) = systems(variation.line, None, (1.0,))
    system = variation.changed(system)
    found: Equilibrium = near(system, transferred(known.curve, known.equilibrium, system))
    if found.status != "converged":
        return Growth(np.nan, np.nan, np.nan, found.status)
    B = system.contacts.law.friction[2]
    here = critical_of(at_friction(system, found.state, B), limits)
    rates = np.array(
        [critical_of(at_friction(system, found.state, b), limits).growth_rate for b in decrease]
    )
    onset = critical_friction_decrease(system, found.state, limits, decrease, rates)
    return Growth(here.growth_rate, here.frequency, onset, found.status)


class Band(NamedTuple):
    """Lower and upper ends of growth rate (1/s) and critical friction decrease (s/m).

    Critical values are NaN where no variation has an onset, `critical_high` where not all have one.
    """

    growth_low: float
    growth_high: float
    critical_low: float
    critical_high: float


def band(found: Sequence[Variation], results: Sequence[Growth]) -> Band:
    """Band about the line as configured, the first one, that variations span.

    Notes
    -----
    Of each group the largest deviation up and down counts; groups have nothing to do with each
    other and are added by their squares. The critical friction decrease is that of the outermost
    single variations, because it does not follow the growth rate in proportion. Comparisons, and
    variations without an equilibrium, do not count.
    """
    nominal = results[0].rate
    if not np.isfinite(nominal):
        return Band(*(np.nan,) * 4)
    counted = [
        (variation.group, result)
        for variation, result in zip(found, results, strict=True)
        if variation.kind != COMPARISON and np.isfinite(result.rate)
    ]
    up, down = {}, {}
    for group, result in counted:
        up[group] = max(up.get(group, 0.0), result.rate - nominal)
        down[group] = max(down.get(group, 0.0), nominal - result.rate)
    critical = np.array([result.critical for _, result in counted])
    some, all_ = np.isfinite(critical).any(), np.isfinite(critical).all()
    return Band(
        nominal - float(np.linalg.norm(list(down.values()))),
        nominal + float(np.linalg.norm(list(up.values()))),
        float(np.nanmin(critical)) if some else np.nan,
        float(critical.max()) if all_ else np.nan,
    )
