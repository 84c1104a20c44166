"""The stage `bogie_simulation`: one order, one absorber.

Apart from the other stages of the bogie, because there are many of these short jobs: it needs
neither the vehicle's matrices nor their assembly.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from tramdva.bogie import integration, wheel_forces
from tramdva.bogie.names import WHEELS
from tramdva.bogie.revolutions import Settings, WaveRun, hindrance, not_run, simulate_wave
from tramdva.bogie.stored import StoredBogie, stored_bogie
from tramdva.contact import patch
from tramdva.contact.tables import stored_tables
from tramdva.evolution import out_of_roundness
from tramdva.variables.bogie_simulation import VARIABLES

__all__ = ["VARIABLES", "compute"]

LEAST_AMPLITUDE = 1e-8  # m; of a measured order that is not there
HISTORIES = {
    "normal_force": patch.NORMAL_FORCE,
    "contact_angle": patch.CONTACT_ANGLE,
    "longitudinal_creepage": patch.LONGITUDINAL_CREEPAGE,
    "lateral_creepage": patch.LATERAL_CREEPAGE,
    "spin_creepage": patch.SPIN_CREEPAGE,
    "friction": patch.FRICTION,
    "semi_axis_longitudinal": patch.SEMI_AXIS_LONGITUDINAL,
    "semi_axis_lateral": patch.SEMI_AXIS_LATERAL,
    "forward_shift": patch.FORWARD_SHIFT,
    "wheel_lead": patch.WHEEL_LEAD,
}


def compute(
    cfg: Mapping[str, Any],
    order: int,
    contact_geometry: Mapping[str, np.ndarray],
    bogie_linearisation: Mapping[str, np.ndarray],
    file_of: Callable[[str], Any] = str,
) -> dict[str, np.ndarray]:
    """Simulate the bogie on wheels with waves of one order.

    Parameters
    ----------
    cfg : sections ``out_of_roundness`` and ``numerics``
    order : waves around the wheel
    contact_geometry, bogie_linearisation : variables of these files
    file_of : where a file lies that the configuration names: a measured radius deviation, of
        which the order's amplitude and phase count

    Returns
    -------
    Variables of ``bogie_simulation``.
    """
    stored = stored_bogie(bogie_linearisation)
    contacts = wheel_forces.Contacts(stored_tables(contact_geometry), stored.law, stored.places)
    roughness, numerics = cfg["out_of_roundness"], cfg["numerics"]
    amplitude = complex(roughness["amplitude"])
    if roughness["measured"]:
        measurement = out_of_roundness.read_measurement(file_of(roughness["measured"]))
        amplitude = complex(out_of_roundness.order_amplitudes(*measurement, [order])[0])
        amplitude = amplitude if abs(amplitude) > LEAST_AMPLITUDE else complex(LEAST_AMPLITUDE)
    settings = Settings(
        numerics["samples"], numerics["revolutions"], numerics["longest_transient"],
        numerics["tolerance"], numerics["step_tolerance"],
    )  # fmt: skip
    if why := hindrance(stored.bogie, str(bogie_linearisation["status"]) == "converged"):
        run = not_run(contacts, stored.wheel_radius, settings, why)
    else:
        run = simulate_wave(
            contacts, stored.bogie, stored.wheel_radius, order, amplitude, roughness["wheels"],
            settings,
        )  # fmt: skip
    return _variables(stored, bogie_linearisation, run, order, amplitude, roughness["wheels"])


def _variables(
    stored: StoredBogie, values, run: WaveRun, order: int, amplitude: complex, wheels
) -> dict[str, np.ndarray]:
    chosen = [WHEELS.index(name) for name in wheels]
    angle = run.time * stored.places.spin_rate
    deviation = out_of_roundness.radius_deviation([order], [amplitude], angle)
    columns = list(integration.RECORDED)
    histories = np.moveaxis(run.results[:, chosen], 0, 2)
    return {
        "absorber": values["absorber"],
        "order": np.float64(order),
        "frequency": np.float64(order * stored.places.spin_rate / (2.0 * np.pi)),
        "wheel": np.array(wheels),
        "zone": values["zone"],
        "speed": values["speed"],
        "wheel_radius": values["wheel_radius"],
        "kalker_table": stored.law.kalker_table,
        "shear_modulus": np.float64(stored.law.shear_modulus),
        "rolling_speed": stored.bogie.rolling_speed[chosen],
        "amplitude_real": np.float64(amplitude.real),
        "amplitude_imag": np.float64(amplitude.imag),
        "time": run.time,
        "wheel_angle": angle,
        "radius_deviation": np.tile(deviation, (len(chosen), 1)),
        **{name: histories[..., columns.index(column)] for name, column in HISTORIES.items()},
        "transient": np.float64(run.transient),
        "difference": np.float64(run.difference),
        "status": np.array(run.status),
    }
