"""Weight of translating absorbers on a vehicle without them."""

import numpy as np
import pytest

from tramdva.bogie.absorber_weight import carrying
from tramdva.bogie.conditions import Conditions, as_configured, reached
from tramdva.bogie.curving import wheel_loads

MASS = 40.0


@pytest.fixture(scope="module")
def oblique(line):
    """Line whose absorbers translate, neither upright nor across."""
    own = line.bogie.absorber
    tilted = own.direction.model_copy(update={"x": 0.1, "y": 0.3, "z": 1.0})
    values = {"motion": "translation", "direction": tilted, "I_T": MASS, "c_T": 4e6, "d_T": 3000.0}
    absorber = own.model_copy(update=values)
    return line._replace(bogie=line.bogie.model_copy(update={"absorber": absorber}))


@pytest.fixture(scope="module")
def bare(oblique, running):
    return reached(as_configured(oblique, running), Conditions(speed=0.9, car_body_mass=1.1))


def test_contacts_are_those_of_the_vehicle_built_with_absorbers(oblique, bare):
    laden = carrying(bare)
    built = reached(bare, bare.conditions, oblique.bogie.absorber)
    assert laden.equilibrium.status == built.equilibrium.status == "converged"
    # Whatever the spring, a hanging mass is carried by its mounting: the same forces everywhere.
    np.testing.assert_allclose(
        laden.equilibrium.results, built.equilibrium.results, rtol=1e-6, atol=1e-8
    )


def test_wheels_carry_the_absorbers_as_well(bare):
    more = sum(wheel_loads(carrying(bare).equilibrium).values())
    more -= sum(wheel_loads(bare.equilibrium).values())
    # Cant and curve turn the weight a little out of the vertical of the track.
    assert more == pytest.approx(4 * MASS * 9.81, rel=5e-3)


def test_rotating_absorbers_have_no_weight(line, running):
    state = as_configured(line, running)
    assert carrying(state) is state
