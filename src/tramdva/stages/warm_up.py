"""Compile all kernels into Numba's cache, so that the first run does not have to."""

import numpy as np

from tramdva.bifurcation import hopf
from tramdva.bifurcation.continuation import StepControl, next_step
from tramdva.bifurcation.limit_cycle import LimitCycleCurve
from tramdva.bifurcation.system import DynamicalSystem
from tramdva.bogie import integration, wheel_forces
from tramdva.contact import geometry, kalker, patch, profiles
from tramdva.route.any_absorber import add_absorbers
from tramdva.wear.chart import CHART, WearChart
from tramdva.wear.gradient import worn_area_gradient
from tramdva.wear.passages import ContactHistory, passages, wear_orders
from tramdva.wheelset import model

# Only the types matter: the results are thrown away.
_COUNT = len(model.WheelsetParameters._fields)
_NUMBERS = model.WheelsetParameters(*np.linspace(1.0, 2.0, _COUNT).tolist())


def compile_kernels() -> None:
    """Call every compiled function once with each combination of types that the stages use."""
    with np.errstate(all="ignore"):
        _wheelset()
        _bifurcation()
        contacts = _contacts(2)
        _bogie(contacts)
        _wear(contacts.law)
    add_absorbers(
        np.ones((1, 1)), np.ones((1, 1, 4), complex), np.ones((1, 1, 4), complex), 1.0, 1.0, 1.0,
        np.zeros((1, 1)),
    )  # fmt: skip


def _wheelset() -> None:
    parameters = np.array(_NUMBERS)
    model.slip_derivatives(_NUMBERS, 1.0, 1.0)
    for n, mounted in ((4, False), (6, True)):
        for dtype in (float, complex):
            states = np.ones((1, n), dtype)
            model.accelerations(states, parameters)
            model.jacobian(states, parameters)
        model.linearised(_NUMBERS, mounted)
        model.dynamical_system(_NUMBERS, mounted)
        try:
            model.equilibrium(_NUMBERS, mounted)
        except ArithmeticError:
            continue


def _bifurcation() -> None:
    """Two Hopf points of x'' - (p + q) x' + x = 0 and an orbit near them: its mesh, a step."""
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    system = DynamicalSystem(
        rhs=lambda states, p: states @ turn.T + (p[0] + p[1]) * states,
        jacobian=lambda states, p: np.tile(turn + (p[0] + p[1]) * np.eye(2), (len(states), 1, 1)),
        dimension=2,
        parameter_names=("p", "q"),
    )
    point = hopf.solve_hopf_point(system, np.zeros(2), np.array([0.01, 0.0]), "p")
    window = {"p": (-1.0, 1.0), "q": (-1.0, 1.0)}
    steps = StepControl(0.1, 0.1, 0.1, max_points=2)
    hopf.hopf_curve(system, point, ("p", "q"), window, steps, direction=1, component=0)
    next_step(0.1, 1, 1.0, *steps.rule)
    curve = LimitCycleCurve(system, "p", max_iterations=1)
    orbit = curve.start(point, 2, 4)
    curve.prepare(orbit)
    curve.correct(curve.predict(orbit, 0.1))


def _contacts(zones: int) -> wheel_forces.Contacts:
    """Four wheels with a number of zones, on the coarsest tables and patches that there can be."""
    zone, *_ = geometry.contact_tables(
        profiles.tram_wheel(), profiles.grooved_rail(), 0.3, shift_range=(0.0, 1e-4),
        roll_limit=1e-3, yaw_limit=1e-3, yaw_nodes=2,
    )  # fmt: skip
    places = wheel_forces.WheelPlaces(
        np.ones(4), np.array([1, 1, 2, 2]), np.ones(4), 0.0, 0.0, 1.0, 1.0
    )
    law = patch.contact_law(0.3, 0.4, 0.1, cells_along=2, strips=2)
    return wheel_forces.Contacts(zones * (zone,), law, places)


def _wear(law: patch.ContactLaw) -> None:
    grid, numbers = law.grid, dict.fromkeys(WearChart._fields, 1.0)
    chart = WearChart(**numbers | {"method": CHART})
    moment = ContactHistory(*np.array([[5e-3, 5e-3, 4e4, 0.3, 0.0, 0.05, 1.0]]).T)
    worn_area_gradient(
        np.array(moment)[:, 0], law.kalker_table, law.shear_modulus, grid, 4.0, chart
    )
    found = passages(moment, law.kalker_table, law.shear_modulus, grid, 4.0, chart)
    wear_orders(found.area, np.zeros(1), 1)
    kalker.flexibilities(law.kalker_table, 5e-3, 5e-3, law.shear_modulus)


def _bogie(contacts: wheel_forces.Contacts) -> None:
    """One step of a vehicle with a single mode."""
    curvatures, local = np.zeros(3), np.zeros(44)
    wheel_forces.contact_forces(contacts, curvatures, local)
    wheel_forces.contact_jacobian(contacts, curvatures, local)
    wheel_forces.radius_sensitivity(contacts, curvatures, local)
    modal = integration.ModalContacts(
        np.zeros((2, 44)), np.zeros((24, 2)), local, np.zeros(24), np.zeros((24, 44))
    )
    passage = integration.Passage(np.zeros((4, 2)), np.zeros((2, 3)))
    zones = len(contacts.tables)
    round_wheels = integration.Excitation(
        np.zeros(1), np.zeros((2, 1, 4, zones)), np.zeros((2, 1, 44)), np.zeros((2, 1, 24)),
        np.zeros((0, 2)),
    )  # fmt: skip
    columns = np.array(integration.RECORDED)
    integration.run(
        modal, contacts, passage, round_wheels,
        integration.step_table(np.array([-1.0 + 1.0j]), 1e-3), 1e-3, 1.0, 0, 0.0, np.zeros(2),
        integration.workspace(contacts), np.empty((1, 44)),
        np.empty((1, 4, zones, columns.size)), columns, 1,
    )  # fmt: skip
