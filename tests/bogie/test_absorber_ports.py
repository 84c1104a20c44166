"""Four places stand for the bogie: its absorbers act as in the vehicle built with them."""

import numpy as np
import pytest
from wear_charts import chart_with

from tramdva.bogie import absorber_ports
from tramdva.bogie.absorber_ports import dynamic_stiffness, receptances
from tramdva.bogie.conditions import Conditions, as_configured, reached, under
from tramdva.bogie.curving import linearise, linearised
from tramdva.bogie.rough_vehicle import rough_bogie
from tramdva.bogie.rough_wheels import deviation_forces
from tramdva.bogie.tram import changed, systems
from tramdva.contact import fastsim
from tramdva.evolution.tendency import Wearing, wear_rows, wear_sensitivity

FRONT = ("front_outer", "front_inner")
FREQUENCY = np.array([8.0, 21.0, 50.0, 55.5, 73.0, 117.0])
TURN = 2.0 * np.pi * FREQUENCY
ABSORBERS = {
    "rotation": {"I_T": 2.0, "c_T": 1.74e5, "d_T": 300.0},
    "translation": {"motion": "translation", "I_T": 20.0, "c_T": 2e6, "d_T": 1500.0},
}


@pytest.fixture(scope="module")
def quiet(line, running):
    """The bogie without absorbers and without self-excitation."""
    return changed(line._replace(friction=(*line.friction[:2], 0.4)), None, running)


@pytest.fixture(scope="module", params=ABSORBERS)
def absorber(request, line):
    """An absorber that rotates, and one that moves obliquely."""
    own = line.bogie.absorber
    if request.param == "translation":
        tilted = own.direction.model_copy(update={"x": 0.1, "y": 0.3, "z": 1.0})
        own = own.model_copy(update={"direction": tilted})
    return own.model_copy(update=ABSORBERS[request.param])


@pytest.fixture(scope="module")
def bare(quiet, absorber):
    """Receptances and wear rows of the bogie without absorbers."""
    rough = rough_bogie(quiet.curve, quiet.equilibrium)
    sensitivity = wear_sensitivity(
        rough,
        quiet.curve.contacts.law,
        Wearing(chart_with(method="constant"), fastsim.patch_grid(12, 12), FRONT),
    )
    rows = wear_rows(rough, sensitivity, FREQUENCY, 4.0, 0.3, FRONT)
    found = receptances(quiet.curve, quiet.equilibrium, rough, absorber, TURN, rows.source)
    return found, rows, rough


@pytest.fixture(scope="module")
def modes(bare, absorber):
    """The four places in their eigenvectors."""
    found, rows, _ = bare
    reduced = absorber_ports.ports(found, absorber.I_T, rows.output([0, 1]), rows.direct[:, :2])
    return absorber_ports.port_modes(reduced)


def built(line, quiet, absorber):
    """The vehicle with absorbers at the contacts' Jacobian of that without."""
    quiet_line = line._replace(friction=(*line.friction[:2], 0.4))
    (system,) = systems(quiet_line, absorber, (1.0,))
    jacobian = linearise(quiet.curve, quiet.equilibrium.state).contact_jacobian
    return system, linearised(system, jacobian)


def attached(bare, inertia, c_T, d_T, output):
    """Quantities (f, k) with absorbers, from one system of equations of all their places."""
    turn, count = bare.angular_frequency, bare.place_by_wave.shape[1]
    stiffness = np.empty((turn.size, count), complex)
    stiffness[:, :4] = dynamic_stiffness(turn, inertia, c_T, d_T)[:, None]
    stiffness[:, 4:] = -(turn[:, None] ** 2) * inertia
    matrix = np.eye(count) + stiffness[:, :, None] * bare.place_by_force
    force = -np.linalg.solve(matrix, (stiffness * bare.place_by_wave)[..., None])
    local = bare.local_by_wave + (bare.local_by_force @ force)[..., 0]
    return (output @ local[..., None])[..., 0]


def test_wear_is_that_with_absorbers_attached_one_by_one(bare, modes, absorber):
    found, rows, _ = bare
    for c_T, d_T in ((absorber.c_T, absorber.d_T), (0.3 * absorber.c_T, 3.0 * absorber.d_T)):
        expected = attached(found, absorber.I_T, c_T, d_T, rows.output([0, 1]))
        expected = expected + rows.direct[:, :2]
        np.testing.assert_allclose(modes.response(absorber.I_T, c_T, d_T), expected, rtol=1e-9)


def test_stroke_and_power_are_those_of_the_vehicle_built_with_absorbers(
    line, quiet, bare, modes, absorber
):
    system, linear = built(line, quiet, absorber)
    _, rows, rough = bare
    forces = deviation_forces(rough, TURN, rows.source) @ system.vehicle.force_input.T
    k, names = system.size, system.vehicle.names
    state = np.array([
        np.linalg.solve(1j * w * np.eye(len(linear.matrix)) - linear.matrix, linear.input @ f)
        for w, f in zip(TURN, forces, strict=True)
    ])  # fmt: skip
    own = [i for i, name in enumerate(names) if name.endswith("_absorber motion")]
    unit = system.vehicle.strain["absorber", "front"] / absorber.c_T
    unit = unit + system.vehicle.strain["absorber", "rear"] / absorber.c_T
    # A row of the springs' matrix that belongs to an absorber is its relative motion.
    expected = state[:, :k] @ unit[own][:, :k].T
    stroke = modes.stroke(absorber.I_T, absorber.c_T, absorber.d_T)
    np.testing.assert_allclose(stroke, expected, rtol=1e-8)

    torque = (absorber.c_T + 1j * TURN[:, None] * absorber.d_T) * stroke
    mean = 0.5 * (torque * np.conj(1j * TURN[:, None] * stroke)).real
    power = 0.5 * absorber.d_T * (TURN[:, None] * np.abs(stroke)) ** 2
    np.testing.assert_allclose(mean, power, rtol=1e-10)
    # What the damper takes is what the axle gives: -Z acts on its motion.
    carrier = modes.carrier(absorber.I_T, absorber.c_T, absorber.d_T)
    stiffness = dynamic_stiffness(TURN, absorber.I_T, absorber.c_T, absorber.d_T)[:, None]
    given = 0.5 * (stiffness * carrier * np.conj(1j * TURN[:, None] * carrier)).real
    np.testing.assert_allclose(given, power, rtol=1e-8)


def test_eigenvalues_are_those_of_the_vehicle_built_with_absorbers(line, quiet, absorber):
    motion = absorber_ports.motion(
        quiet.curve, linearise(quiet.curve, quiet.equilibrium.state), absorber
    )
    found = absorber_ports.with_absorbers(motion, absorber.I_T, absorber.c_T, absorber.d_T)
    expected = np.linalg.eigvals(built(line, quiet, absorber)[1].matrix)

    def upper(values):
        values = values[(values.imag > 10.0) & (values.imag < 1500.0)]
        return values[np.lexsort((values.real, values.imag.round(6)))]

    assert found.size == expected.size
    np.testing.assert_allclose(upper(found), upper(expected), rtol=1e-8)


def test_low_modes_are_enough_for_the_sign_of_a_growth_rate(line, quiet, absorber):
    motion = absorber_ports.motion(
        quiet.curve, linearise(quiet.curve, quiet.equilibrium.state), absorber
    )
    for c_T, d_T in ((absorber.c_T, absorber.d_T), (2 * absorber.c_T, 0.3 * absorber.d_T)):
        exact, rough = (
            absorber_ports.growth_rate(
                absorber_ports.with_absorbers(part, absorber.I_T, c_T, d_T), (30.0, 200.0)
            )
            for part in (motion, motion.below(250.0))
        )
        assert abs(exact - rough) < 0.2


def test_growth_rate_outside_all_modes_is_minus_infinity():
    assert absorber_ports.growth_rate(np.array([-1.0 + 10.0j]), (30.0, 200.0)) == -np.inf


def test_conditions_change_what_they_name_alone(line):
    shares = Conditions(0.9, 1.1, 1.2, 0.8, 1.3, 0.85, 1.25, 1.15, 0.75)
    other, own = under(line, shares), line
    assert other.friction == pytest.approx((0.9 * 0.35, 0.36, 1.1 * 0.7))
    assert other.track.radius == pytest.approx(1.2 * own.track.radius)
    assert other.track.speed == pytest.approx(0.8 * own.track.speed)
    expected = own.bogie.model_dump()
    for name in ("mass", "roll_inertia", "pitch_inertia", "yaw_inertia"):
        expected["car_body"][name] *= 1.3
    for name in expected["wheel"]["layer"]:
        expected["wheel"]["layer"][name] *= 0.85 if name.endswith("stiffness") else 1.25
    for axis in ("longitudinal", "lateral", "vertical"):
        expected["primary"]["stiffness"][axis] *= 1.15
        expected["primary"]["damping"][axis] *= 0.75
    expected["primary"]["pitch_stiffness"] *= 1.15
    expected["primary"]["pitch_damping"] *= 0.75
    assert other.bogie.model_dump() == expected
    assert under(line, Conditions()) == line


def test_equilibrium_under_conditions_does_not_depend_on_the_way(line, running):
    start = as_configured(line, running)
    target = Conditions(radius=1.3, speed=0.8, car_body_mass=1.1)
    direct = reached(start, target)
    around = reached(reached(start, Conditions(radius=1.1, friction=0.9)), target)
    assert direct.equilibrium.status == around.equilibrium.status == "converged"
    np.testing.assert_allclose(
        direct.equilibrium.results, around.equilibrium.results, rtol=1e-6, atol=1e-8
    )
    places = direct.system.contacts.places
    assert places.speed == pytest.approx(0.8 * line.track.speed)
