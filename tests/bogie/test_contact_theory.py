"""How sure the growth rate is: variations of the contact's theory, and the band they span."""

import numpy as np
import pytest
from figure_scripts import script, texts

from tramdva.bogie import contact_theory, modes
from tramdva.bogie.contact_theory import COMPARISON, DISCRETISATION, NOMINAL, THEORY, Growth
from tramdva.bogie.tram import run_through
from tramdva.contact import patch

LIMITS = (30.0, 200.0)
DECREASE = np.linspace(0.0, 1.0, 6)


@pytest.fixture(scope="module")
def variations(line):
    """Variations of the paper's line; tables of other gaps are its own here."""
    return contact_theory.variations(line, lambda gap, step: line.tables)


def variation(variations, name):
    """Variation of this name."""
    return next(one for one in variations if one.name == name)


def test_the_line_as_configured_is_its_own_critical_oscillation(variations, running):
    found = contact_theory.growth(variations[0], running, LIMITS, DECREASE)
    known = modes.critical_oscillation(running.curve, running.equilibrium.state, LIMITS)
    assert found.status == "converged"
    assert found.rate == pytest.approx(known.growth_rate, abs=1e-4)
    assert found.frequency == pytest.approx(known.frequency, rel=1e-5)
    assert 0.0 < found.critical < running.curve.contacts.law.friction[2]  # it grows at its B


def test_another_creep_law_is_that_of_a_line_configured_so(variations, line, running):
    """The way through the configuration shares no step with a law exchanged in the vehicle."""
    changed = variation(variations, "creep law: fastsim")
    found = contact_theory.growth(changed, running, LIMITS, DECREASE)
    geometry = line.contact_geometry.model_copy(update={"creep_law": "fastsim"})
    run = run_through(line._replace(contact_geometry=geometry))
    known = modes.critical_oscillation(run.curve, run.equilibrium.state, LIMITS)
    assert found.rate == pytest.approx(known.growth_rate, abs=1e-3)


def test_curvature_is_changed_by_the_share_and_nothing_else(variations, running):
    place = (1.0, 0.0, 0.0)
    curves = {}
    for name in ("as configured", "curvature +20%"):
        tables = variation(variations, name).line.tables
        contacts = running.curve.contacts._replace(tables=tables)
        rows, work, result = patch.contact_workspace(contacts.law)
        patch.wheel_contact(
            tables[0], contacts.law, place[0], (0.0, -1e-4), (0.0, 0.0), (0.0, 0.0, 0.0),
            (0.0, 4.0 / 0.3, 0.0), 4.0, 0.0, 0.0, 0.0, rows, work, result,
        )  # fmt: skip
        curves[name] = result.copy()
    before, after = curves.values()
    np.testing.assert_allclose(
        after[patch.CURVATURE_LATERAL], 1.2 * before[patch.CURVATURE_LATERAL], rtol=1e-12
    )
    for column in (patch.PENETRATION, patch.CONTACT_ANGLE, patch.WHEEL_POSITION):
        assert after[column] == before[column]


def one(group, kind=THEORY):
    """Variation of which only group and kind count."""
    return contact_theory.Variation(group, group, kind, None, None)


def test_independent_causes_add_by_their_squares_and_comparisons_do_not_count():
    found = [
        one(NOMINAL, NOMINAL), one("a"), one("a"), one("b"), one("c", DISCRETISATION),
        one("d", COMPARISON), one("e"),
    ]  # fmt: skip
    rates = (1.0, 1.0 + 3.0, 1.0 + 2.0, 1.0 + 4.0, 1.0 - 2.0, -50.0, np.nan)
    critical = (0.5, 0.4, 0.45, 0.3, 0.7, 9.0, np.nan)
    results = [
        Growth(rate, 55.0, B, "converged" if np.isfinite(rate) else "wheel_lifted")
        for rate, B in zip(rates, critical, strict=True)
    ]
    band = contact_theory.band(found, results)
    assert band == pytest.approx((1.0 - 2.0, 1.0 + 5.0, 0.3, 0.7))
    # One theory without an onset leaves the upper end open.
    results[3] = results[3]._replace(critical=np.nan)
    open_band = contact_theory.band(found, results)
    assert open_band.critical_low == 0.4
    assert np.isnan(open_band.critical_high)


def test_without_an_equilibrium_there_is_no_band_but_a_reason():
    lost = Growth(np.nan, np.nan, np.nan, "outside_profile")
    band = contact_theory.band([one(NOMINAL, NOMINAL), one("a")], [lost, lost])
    assert np.isnan(band).all()
    values = {
        "variation": np.array(["as configured", "gap scale x 2"]),
        "kind": np.array([NOMINAL, THEORY]),
        "growth_rate": np.full(2, np.nan),
        "critical_friction_decrease": np.full(2, np.nan),
        "status": np.array(["outside_profile"] * 2),
        "largest_friction_decrease": np.array(3.0),
        **{name: np.array(value) for name, value in band._asdict().items()},
    }
    drawn = texts(script("growth_band_chart").draw(values, 0.7))
    assert drawn.count("a wheel leaves its profile or table") == 2
    assert "none up to" not in drawn
