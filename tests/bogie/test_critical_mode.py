"""The mode that absorbers are for, and bands about modes."""

import numpy as np
import pytest

from tramdva.bogie.critical_mode import BAND, critical_mode, peak_bands
from tramdva.bogie.curving import with_friction_decrease
from tramdva.bogie.modes import modes

LIMITS, AXIS = (30.0, 200.0), (2.0, 150.0)


@pytest.fixture(scope="module")
def found(running):
    return modes(running.curve, running.equilibrium.state, (2.0, 200.0))


def test_critical_mode_of_the_paper_s_bogie_is_its_second_bending(running, found) -> None:
    mode = critical_mode(running.curve, found, LIMITS)
    assert mode.name == "second_bending_front"
    assert mode.frequency == pytest.approx(55.0, abs=2.0)
    assert mode.growth_rate == found.eigenvalue.real[found.frequency > 30.0].max() > 0.0
    assert mode.likeness > 0.9


def test_without_self_excitation_it_is_still_the_second_bending(running) -> None:
    """At a small B all dies out, also a mode of less damping than second bending."""
    quiet = with_friction_decrease(running.curve, 0.1)
    found = modes(quiet, running.equilibrium.state, (2.0, 200.0))
    other = next(k for k, name in enumerate(found.name) if name.startswith("resilient_wheel"))
    value = found.eigenvalue.copy()
    value[other] = -1e-3 + 1j * value[other].imag
    assert (value.real[found.frequency > LIMITS[0]] < 0.0).all()
    mode = critical_mode(quiet, found._replace(eigenvalue=value), LIMITS)
    assert mode.name.startswith("second_bending")
    assert mode.growth_rate < -1e-3


def test_another_mode_that_grows_is_the_critical_one(running, found) -> None:
    """Its growth rate alone decides, not its name."""
    other = next(k for k, name in enumerate(found.name) if name.startswith("resilient_wheel"))
    value = found.eigenvalue.copy()
    value[other] += 50.0 - value[other].real
    mode = critical_mode(running.curve, found._replace(eigenvalue=value), LIMITS)
    assert mode.name == found.name[other]
    assert mode.growth_rate == pytest.approx(50.0)
    assert np.isnan(mode.likeness)


def test_bands_of_peaks_hold_their_modes_and_do_not_overlap(running, found) -> None:
    mode = critical_mode(running.curve, found, LIMITS)
    bands = peak_bands(running.curve, found, mode, AXIS)
    names = [band.name for band in bands]
    assert names == ["first_bending", "second_bending", "third_bending", "resilient_wheel"]
    ends = np.array([[band.low, band.high] for band in bands])
    assert (ends[1:, 0] >= ends[:-1, 1]).all()
    assert (ends[:, 0] >= AXIS[0]).all()
    assert (ends[:, 1] <= AXIS[1]).all()
    second = bands[names.index("second_bending")]
    assert second.low == pytest.approx(BAND[0] * mode.frequency, abs=0.1)
    assert second.low < mode.frequency < second.high


def test_without_modes_there_is_none(running, found) -> None:
    assert critical_mode(running.curve, found, (0.1, 0.2)) is None
