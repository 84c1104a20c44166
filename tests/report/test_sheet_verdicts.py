"""First lines of the design sheet: every sentence is reached, and by its own state only."""

import re

import numpy as np
import pytest
from sheet_values import content, curving, maps, modes, tuning, without

from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.report import sheet_verdicts
from tramdva.report.sheet_verdicts import BOGIE, ORDERS, PAPER, ROBUST, TUNING


@pytest.fixture(scope="module")
def cfg(root) -> dict:
    return used_values(load(root / "config"), "paper", "design_sheet")


def bogie(growth, critical=np.nan, status="converged") -> dict[str, np.ndarray]:
    """Modes of one bogie whose growth rate over B is given."""
    return {
        "absorber": np.array(["none"]),
        "status": np.array([status]),
        "largest_growth_rate": np.array([growth]),
        "critical_friction_decrease": np.array([critical]),
        "operating_growth_rate": np.array([growth[1]]),
        "operating_frequency": np.array([54.7]),
    }


OF_BOGIE = {
    "no_equilibrium": bogie([np.nan] * 3, status="wheel_lifted"),
    "no_oscillation": bogie([np.nan] * 3),
    "always": bogie([2.0, 5.0, 9.0]),
    "at_some": bogie([2.0, -1.0, 9.0]),
    "from_onset": bogie([-2.0, 1.0, 3.0], 0.676),
    "never": bogie([-2.0, -1.5, -1.0]),
}


def orders(**changes) -> dict[str, np.ndarray]:
    """Maps whose second speed is the line's."""
    return maps() | {name: np.array(value) for name, value in changes.items()}


OF_ORDERS = {
    "no_equilibrium": orders(speed_status=[["converged", "not_converged"]] * 2),
    "self_excited": orders(speed_growth_rate=[[-1.0, 0.2]] * 2),
    "none_grows": maps(-1.0),
    "outside": orders(fastest_order=[26.0, 33.0], fastest_frequency=[55.0, 71.6]),
    "inside": maps(),
}


def tuned(**changes) -> dict[str, np.ndarray]:
    """A robust tuning without self-excitation of any absorber, with changes."""
    values = tuning() | {"self_excited_cases": np.array([np.nan, 0.0, 34.0, 0.0])}
    return values | {name: np.array(value) for name, value in changes.items()}


def louder(case: int) -> dict[str, np.ndarray]:
    """The robust optimum vibrates by itself where the bogie without absorbers does not."""
    values = tuned()
    assert values["growth_rate"][0, case, 1] < 0.0
    values["growth_rate"][ROBUST, case, 1] = 0.5
    return values


def noisy_everywhere() -> dict[str, np.ndarray]:
    values = without(tuning(), "nothing_grows")
    values["growth_rate"][0] = 3.0
    return values


def noisy_sometimes() -> dict[str, np.ndarray]:
    values = without(tuning(), "nothing_grows")
    values["growth_rate"][0, 3, 1] = 3.0
    return values


def some_excited() -> dict[str, np.ndarray]:
    values = tuned(self_excited_cases=[np.nan, 3.0, 34.0, 2.0])
    values["status"][ROBUST] = "self_excited"
    return values


OF_TUNING = {
    "no_equilibrium": [without(tuning(), "no_equilibrium")],
    "not_computed": [noisy_everywhere()],
    "nothing_grows": [without(tuning(), "nothing_grows")],
    "nothing_to_tune": [noisy_sometimes()],
    "self_excited": [without(tuning(), "self_excited")],
    "worse_than_nothing": [
        tuned(nominal_factor=[np.nan, 0.83, 0.9, 1.04], worst_factor=[np.nan, 1.4, 3.7, 2.5]),
        tuned(factor=tuning()["factor"] * 3.0),
        louder(2),
    ],
    "keep_the_line's": [tuned(worst_factor=[np.nan, 0.6, 3.7, 0.71])],
    "some_self_excited": [some_excited()],
    "recommended": [tuned()],
}


def words(template: str) -> str:
    """What the sentence of a state says whatever its numbers are."""
    return max(re.split(r"\{[^}]*\}", template), key=len)


def test_no_state_is_without_a_case() -> None:
    assert set(OF_BOGIE) == set(BOGIE)
    assert set(OF_ORDERS) == set(ORDERS)
    assert set(OF_TUNING) == set(TUNING)


@pytest.mark.parametrize("state", BOGIE)
def test_sentence_about_the_bogie(cfg, state: str) -> None:
    assert sheet_verdicts.state_of_bogie(OF_BOGIE[state], 0) == state
    said = sheet_verdicts.of_bogie(cfg, OF_BOGIE[state], 0)
    assert words(BOGIE[state]) in said
    assert "nan" not in said
    assert [other for other in BOGIE if words(BOGIE[other]) in said] == [state]


def test_quiet_at_its_own_friction_is_not_vibrating_at_every_one(cfg) -> None:
    """Between two values of B that were computed it may be quiet."""
    values = bogie([2.0, 5.0, 9.0]) | {"operating_growth_rate": np.array([-4.4])}
    assert sheet_verdicts.state_of_bogie(values, 0) == "at_some"
    assert "does not vibrate by itself (growth" in sheet_verdicts.of_bogie(cfg, values, 0)


@pytest.mark.parametrize("state", ORDERS)
def test_sentence_about_the_orders(cfg, state: str) -> None:
    said = content(cfg, tuning(), maps=OF_ORDERS[state]).verdicts
    assert sheet_verdicts.state_of_orders(cfg, OF_ORDERS[state]) == state
    found = [other for other in ORDERS if any(words(ORDERS[other]) in line for line in said)]
    assert found == [state]
    assert (words(ORDERS[state]) in said[0]) == (state == "outside")
    assert not any("nan" in line for line in said)


@pytest.mark.parametrize(
    ("state", "case"), [(state, k) for state, cases in OF_TUNING.items() for k in range(len(cases))]
)
def test_sentence_about_the_absorber(cfg, state: str, case: int) -> None:
    values = OF_TUNING[state][case]
    assert sheet_verdicts.state_of_tuning(values) == state
    said = sheet_verdicts.recommendation(cfg, values)
    assert said.startswith(TUNING[state].partition("{")[0])
    assert "nan" not in said
    assert said.startswith("Recommended") == (
        state in ("recommended", "some_self_excited", "keep_the_line's")
    )


def test_what_is_worse_than_nothing_is_told_with_its_numbers(cfg) -> None:
    said = sheet_verdicts.recommendation(cfg, OF_TUNING["worse_than_nothing"][0])
    assert "this mass (2.00 kg m²) cannot do it" in said
    assert "leaves 104 %, in the worst case 250 % of the growth" in said
    assert "the line's leaves 83 %, in the worst case 140 %" in said


def tried(*enough: bool) -> dict[str, np.ndarray]:
    """A mass that cannot do it, and others that were tried: twice, four times and between."""
    values = OF_TUNING["worse_than_nothing"][0] | {
        "tried_I_T": np.array([4.0, 8.0, 5.66]),
        "tried_c_T": np.array([5e5, 1e6, 7e5]),
        "tried_d_T": np.array([500.0, 1000.0, 700.0]),
        "tried_nominal_factor": np.array([0.9, 0.5, 0.7]),
        "tried_worst_factor": np.array([1.1, 0.8, 0.9]),
    }
    return values | {"tried_is_enough": np.array(enough)}


@pytest.mark.parametrize(
    ("enough", "said"),
    [
        ((False, True, False), "8.00 kg m² could: c_T = 1.00·10⁶ N m/rad, d_T = 1000 N m s/rad"),
        ((False, True, True), "5.66 kg m² could: c_T = 7.00·10⁵ N m/rad, d_T = 700 N m s/rad"),
        ((False, False, False), "No mass up to 8.00 kg m² could: another place or direction"),
    ],
)
def test_the_mass_that_could_do_it_is_told(cfg, enough, said: str) -> None:
    assert said in sheet_verdicts.recommendation(cfg, tried(*enough))
    alone = sheet_verdicts.recommendation(cfg, OF_TUNING["self_excited"][0])
    assert "A larger mass, or another place or direction, may." in alone


def test_vibrating_where_nothing_helps_is_not_held_against_an_absorber() -> None:
    values = tuned()
    noisy = int(np.flatnonzero(values["growth_rate"][0, :, 1] > 0.0)[0])
    values["factor"][ROBUST, noisy] = 3.0  # over the line as configured
    assert sheet_verdicts.state_of_tuning(values) == "recommended"
    values["factor"][PAPER] = 3.0
    values["worst_factor"][PAPER] = 0.1
    assert sheet_verdicts.state_of_tuning(values) == "recommended"


def test_running_in_the_curve_is_told_or_why_not(cfg) -> None:
    rows = content(cfg, tuning()).running.rows
    assert rows[0][1:] == ["front outer", "front inner", "rear outer", "rear inner"]
    assert rows[1][1:] == ["41.5", "36.4", "40.1", "37.2"]
    assert rows[3][1:] == ["37.1", "37.1", "−31.0", "−31.0"]
    assert "0.676 (no absorber), – (line's absorber)" in content(cfg, tuning()).running.title
    lifted = content(cfg, tuning(), curving=curving("wheel_lifted"), modes=modes("wheel_lifted"))
    assert lifted.running.rows[1] == [
        "wheel load (kN), no absorber: none, wheel lifted",
        *["–"] * 4,
    ]
