"""The least stable oscillation with absorbers beside all eigenvalues of the vehicle with them."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tramdva.bogie import absorber_growth
from tramdva.bogie.absorber_growth import least_stable, seen_by_absorbers
from tramdva.bogie.absorbers import family_of
from tramdva.bogie.curving import oscillations
from tramdva.bogie.parameters import BogieAbsorber
from tramdva.bogie.tram import changed

LIMITS = (30.0, 200.0)
# A rotating absorber's N m/rad and N m s/rad, a translating one's N/m and N s/m.
RANGES = {"rotation": ((3e4, 6e5), (20.0, 2000.0)), "translation": ((3e5, 2e7), (100.0, 5e4))}


@pytest.fixture(scope="module", params=["rotation", "translation"])
def family(request, line, running):
    """Absorbers of one kind, and how the bogie without any is seen by them."""
    design = line.bogie.absorber
    if request.param == "translation":
        design = BogieAbsorber.model_validate(
            design.model_dump()
            | {"motion": "translation", "I_T": 40.0, "c_T": 4e6, "d_T": 5e3}
            | {"direction": {"x": 0.0, "y": 0.0, "z": 1.0}}
        )
    members = family_of(design, changed(line, design, running))
    return request.param, members, seen_by_absorbers(members, running, LIMITS)


def test_it_is_the_least_stable_of_all_eigenvalues(family) -> None:
    kind, members, bare = family
    for c_T in np.geomspace(*RANGES[kind][0], 5):
        for d_T in np.geomspace(*RANGES[kind][1], 5):
            matrix = members.member(c_T, d_T)[1].matrix
            exact = oscillations(np.linalg.eigvals(matrix), LIMITS)
            exact = exact[np.argmax(exact.real)]
            found = least_stable(bare, members.design.I_T, c_T, d_T)
            assert_allclose([found.real, found.imag], [exact.real, exact.imag], atol=1e-6)


def test_few_modes_miss_none_that_could_be_the_least_stable(family) -> None:
    """Of the modes near the top none is further off than what is allowed for."""
    kind, members, bare = family
    allowed = absorber_growth.CANDIDATES - absorber_growth.LARGEST_SHIFT
    for c_T in np.geomspace(*RANGES[kind][0], 4):
        for d_T in np.geomspace(*RANGES[kind][1], 4):
            exact = oscillations(np.linalg.eigvals(members.member(c_T, d_T)[1].matrix), LIMITS)
            exact = exact[exact.real > exact.real.max() - 2.0 * allowed]
            few = absorber_growth._few(bare, members.design.I_T, c_T, d_T)
            assert np.abs(few - exact[:, None]).min(axis=1).max() < allowed


@pytest.mark.parametrize("doubt", ["undamped", "no_flexibility", "no_convergence"])
def test_in_doubt_all_eigenvalues_are_found(family, monkeypatch, doubt: str) -> None:
    kind, members, bare = family
    c_T, d_T = RANGES[kind][0][0], 0.0 if doubt == "undamped" else RANGES[kind][1][0]
    exact = oscillations(np.linalg.eigvals(members.member(c_T, d_T)[1].matrix), LIMITS)
    if doubt == "no_flexibility":
        bare = bare._replace(rest=np.full_like(bare.rest, np.nan))
    if doubt == "no_convergence":
        monkeypatch.setattr(absorber_growth, "NEWTON_STEPS", 0)
    found = least_stable(bare, members.design.I_T, c_T, d_T)
    assert_allclose(found.real, exact.real.max(), atol=1e-6)


def test_limits_without_an_oscillation(family) -> None:
    kind, members, bare = family
    nowhere = bare._replace(limits=(199.0, 199.001))
    c_T, d_T = (ends[0] for ends in RANGES[kind])
    assert least_stable(nowhere, members.design.I_T, c_T, d_T) is None
