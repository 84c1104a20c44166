"""The exponential integrator against eigenvalues, another integrator and other steps."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tramdva.bogie import integration, modes, ride
from tramdva.bogie.curving import linearise
from tramdva.bogie.modal import modal_basis, modal_state, packed, vehicle_state
from tramdva.bogie.track import TrackLine
from tramdva.bogie.tram import absorber, changed, track_line

FREE = 1e9  # tolerance that leaves the step alone
INNER_FRONT = 11  # first local variable of the wheel


class Run:
    """The vehicle near an equilibrium in the curve."""

    def __init__(self, running):
        self.system = running.curve
        self.basis = modal_basis(running.curve, running.equilibrium)
        self.work = integration.workspace(running.curve.contacts)

    def start(self, amplitude: float, frequency: float = 55.0) -> np.ndarray:
        """Packed modal state with the oscillation nearest to a frequency (Hz)."""
        values = self.basis.eigenvalue
        distance = np.abs(values.imag / (2 * np.pi) - frequency) - 0.1 * values.real
        z = np.zeros(2 * values.size)
        z[np.argmin(distance)] = amplitude
        return z

    def __call__(self, z, duration, interval, excitation=None, tolerance=FREE):
        """Local variables (k, 40) and status; z is advanced."""
        count = round(duration / interval)
        local = np.empty((count, 44))
        zones = len(self.system.contacts.tables)
        results = np.empty((count, 4, zones, len(integration.RECORDED)))
        _, status, _, _ = integration.run(
            self.basis.contact, self.system.contacts,
            integration.steady(self.basis.eigenvalue.size, self.system.curvatures),
            excitation or ride.no_excitation(self.basis, self.system.contacts),
            integration.step_table(self.basis.eigenvalue, interval), interval, tolerance, 0, 0.0,
            z, self.work, local, results, np.array(integration.RECORDED), 1,
        )  # fmt: skip
        return local, status


def amplitude(local: np.ndarray) -> float:
    """Amplitude in m/s of the inner front rim's contact point."""
    velocity = local[:, INNER_FRONT + 5] + 0.3 * local[:, INNER_FRONT + 7]
    return float(np.sqrt(2.0) * np.std(velocity))


def test_modal_basis_reproduces_states_and_matrix(running):
    run = Run(running)
    state = running.equilibrium.state + 1e-5 * np.random.default_rng(1).normal(
        size=running.equilibrium.state.size
    )
    back = vehicle_state(run.basis, modal_state(run.basis, state))
    np.testing.assert_allclose(back, state, atol=1e-11)


def test_growth_rate_of_the_simulation_is_that_of_the_eigenvalue(running):
    expected = modes.critical_oscillation(running.curve, running.equilibrium.state, (30.0, 200.0))
    run = Run(running)
    z = run.start(2e-4, expected.frequency)
    window = round(20 / expected.frequency / 2.5e-4)
    local, status = run(z, 4.0, 2.5e-4)
    assert status == integration.COMPLETED
    first, last = local[:window], local[-window:]
    growth = np.log(amplitude(last) / amplitude(first)) / (4.0 - window * 2.5e-4)
    # 2 % of the rate, and the rounding of a window of whole periods (1e-3 in the amplitude)
    np.testing.assert_allclose(growth, expected.growth_rate, rtol=0.02, atol=1e-3)


def test_decay_with_absorbers_is_that_of_the_eigenvalue(line, running):
    damped = changed(line, absorber(line, 1.74e5, 20.0), running)
    expected = modes.critical_oscillation(damped.curve, damped.equilibrium.state, (45.0, 65.0))
    run = Run(damped)
    z = run.start(2e-4, expected.frequency)
    duration, window = 0.5, round(4 / expected.frequency / 2.5e-4)
    local, _ = run(z, duration, 2.5e-4)
    first, last = local[:window], local[-window:]
    growth = np.log(amplitude(last) / amplitude(first)) / (duration - window * 2.5e-4)
    np.testing.assert_allclose(growth, expected.growth_rate, rtol=0.02)


def test_free_motion_agrees_with_an_adaptive_runge_kutta_method(running):
    """A blow of the size of the limit cycle, over three periods."""
    run, system, k = Run(running), running.curve, running.curve.size
    start = vehicle_state(run.basis, run.start(0.02))
    inverse = np.linalg.inv(system.vehicle.mass)

    def rate(_, x):
        return np.concatenate([x[k : 2 * k], inverse @ system.forces(x)])

    duration = 0.05
    found = solve_ivp(rate, (0.0, duration), start, method="DOP853", rtol=1e-8, atol=1e-10)
    local, _ = run(modal_state(run.basis, start), duration, 5e-5)
    expected = system.local(found.y[:, -1])
    scale = np.abs(expected - system.local(running.equilibrium.state))[4:].max()
    np.testing.assert_allclose(local[-1], expected, atol=1e-3 * scale)


def test_scheme_is_of_fourth_order(running):
    """A vibration of the size of the limit cycle; smaller ones err by less than 1e-5 of it."""
    run = Run(running)
    steps = (2e-3, 1e-3, 5e-4, 2.5e-5)
    ends = [run(run.start(0.2), 0.04, interval)[0][-1] for interval in steps]
    errors = [np.linalg.norm(end - ends[-1]) for end in ends[:-1]]
    # The fast spin modes, 1e3 to 1e4 1/s, reduce the order of coarse steps, the knots of the
    # tables, whose forces are twice continuously differentiable, that of fine ones.
    assert 0.5 * np.log2(errors[0] / errors[2]) > 2.5


def test_limit_cycle_does_not_depend_on_the_step(running):
    run = Run(running)
    amplitudes = []
    for interval in (1e-3, 5e-4):
        z = run.start(0.15)
        local, status = run(z, 14.0, interval)
        assert status == integration.COMPLETED
        amplitudes.append(amplitude(local[-round(0.2 / interval) :]))
    assert 0.04 < amplitudes[0] < 0.06  # figure 9 ends at 0.048 m/s
    np.testing.assert_allclose(amplitudes[0], amplitudes[1], rtol=0.01)


def one_wave(contacts, turn, crest=0.0):
    """A wave of an angular frequency on the wheels, whose linear response is not told."""
    deviation = np.zeros((2, 1, 4, len(contacts.tables)))
    deviation[0, 0] = crest
    return {
        "angular_frequency": np.array([turn]),
        "deviation": deviation,
        "local": np.zeros((2, 1, 44)),
        "contact_force": np.zeros((2, 1, 24)),
    }


@pytest.mark.parametrize("frequency", [20.0, 70.0, 120.0])
def test_frequency_response_agrees_with_a_simulation(line, running, frequency):
    """A small lateral force on the inner front rim; with absorbers, so that transients decay."""
    damped = changed(line, absorber(line, 1.74e5, 300.0), running)
    run, turn = Run(damped), 2.0 * np.pi * frequency
    force = np.zeros(len(damped.curve.vehicle.names))
    force[damped.curve.vehicle.names.index("front_inner_rim y")] = 20.0
    linear = linearise(damped.curve, damped.equilibrium.state)
    matrix = 1j * turn * np.eye(len(linear.matrix)) - linear.matrix
    expected = linear.output @ np.linalg.solve(matrix, linear.input @ force)
    excitation = ride.no_excitation(run.basis, damped.curve.contacts)._replace(
        **one_wave(damped.curve.contacts, turn),
        force=packed(run.basis.load @ force)[None],
    )
    m = run.basis.eigenvalue.size
    # Start on the steady response, so that only the difference is a transient.
    steady = (run.basis.load @ force) / 2.0
    values = run.basis.eigenvalue
    z = steady / (1j * turn - values) + steady / (-1j * turn - values)
    z = np.concatenate([z.real, z.imag]) if z.size == m else z
    period, interval = 1.0 / frequency, 1.0 / frequency / 200
    local, _ = run(z, 40 * period, interval, excitation)
    time = (np.arange(200) + 1 + 39 * 200) * interval
    tail = local[-200:, INNER_FRONT + 5]
    found = 2.0 * np.mean(tail * np.exp(-1j * turn * time))
    np.testing.assert_allclose(abs(found), abs(expected[INNER_FRONT + 5]), rtol=5e-3)


def route(line, run, transition=0.0, cant=0.0) -> ride.Route:
    start = track_line(line, 0.5 * line.track.speed)
    return ride.Route(
        TrackLine(start.start, transition, start.curvature, cant),
        line.track.speed,
        line.bogie.half_wheelbase,
        9.81,
        (run.straight, run.curve),
        (run.straight_equilibrium, run.equilibrium),
    )


@pytest.mark.parametrize("transition", [0.0, 3.0])
def test_ride_with_absorbers_ends_in_the_curving_equilibrium(line, running, transition):
    damped = changed(line, absorber(line, 1.74e5, 300.0), running)
    found = ride.ride(route(line, damped, transition), 5.0, 1e-3, 1, 1e-2)
    assert found.status == "completed"
    end = damped.curve.local(damped.equilibrium.state).reshape(4, 11)
    last = found.local[-1].reshape(4, 11)
    np.testing.assert_allclose(last[:, :2], end[:, :2], atol=2e-5)  # m; car body decays slowly
    assert np.abs(ride.contact_point_velocity(0.3, found.local[-50:])).max() < 1e-3


def test_a_transition_curve_softens_the_entry(line, running):
    damped = changed(line, absorber(line, 1.74e5, 300.0), running)
    blows = [
        np.abs(
            ride.contact_point_velocity(
                0.3, ride.ride(route(line, damped, length), 2.0, 1e-3, 1, 1e-2).local
            )[1]
        ).max()
        for length in (0.0, 4.0)
    ]
    assert blows[1] < 0.6 * blows[0]


def test_radius_deviation_moves_the_wheel_up(line, running):
    """A crest of 10 um at a very low frequency lifts the rim by 10 um."""
    damped = changed(line, absorber(line, 1.74e5, 300.0), running)
    run = Run(damped)
    crest = np.zeros((4, len(damped.curve.contacts.tables)))
    crest[1] = 1e-5
    excitation = ride.no_excitation(run.basis, damped.curve.contacts)._replace(
        **one_wave(damped.curve.contacts, 0.0, crest)
    )
    z = np.zeros(2 * run.basis.eigenvalue.size)
    local, _ = run(z, 4.0, 1e-3, excitation)
    rest = damped.curve.local(damped.equilibrium.state)
    lift = local[-1, INNER_FRONT + 1] - rest[INNER_FRONT + 1]
    np.testing.assert_allclose(lift, 1e-5, rtol=0.05)  # the load changes a little
