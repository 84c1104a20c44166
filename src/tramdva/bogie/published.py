"""The bogie of the paper as plain values, for examples and first steps in Python.

A run takes its values from the configuration, which says where each comes from.
"""

from tramdva.bogie.parameters import Bogie, Track
from tramdva.bogie.tram import BogieLine
from tramdva.contact.parameters import ContactGeometry
from tramdva.contact.tables import yaw_reach, zone_tables

FRICTION = (0.35, 0.36, 0.7)
TRACK = {
    "radius": 25,
    "speed": 4,
    "transition_length": 0,
    "cant": 0,
    "gravity": 9.81,
}
BOGIE = {
    "half_wheelbase": 0.869,
    "car_body": {
        "mass": 11000,
        "roll_inertia": 9000,
        "pitch_inertia": 20000,
        "yaw_inertia": 20000,
        "height": 1.35,
    },
    "car_support": {
        "roll_stiffness": 2000000.0,
        "roll_damping": 40000.0,
        "pitch_stiffness": 2000000.0,
        "pitch_damping": 40000.0,
        "yaw_stiffness": 2000000.0,
        "yaw_damping": 40000.0,
    },
    "frame": {
        "mass": 2330,
        "roll_inertia": 700,
        "pitch_inertia": 900,
        "yaw_inertia": 1500,
        "height": 0.4,
    },
    "secondary": {
        "stiffness": {"longitudinal": 1500000.0, "lateral": 300000.0, "vertical": 600000.0},
        "damping": {"longitudinal": 20000.0, "lateral": 15000.0, "vertical": 15000.0},
        "lateral_position": 0.55,
        "height": 0.55,
    },
    "primary": {
        "stiffness": {"longitudinal": 20000000.0, "lateral": 1990000.0, "vertical": 1200000.0},
        "damping": {"longitudinal": 17000.0, "lateral": 3500, "vertical": 2050},
        "lateral_position": 0.6,
        "height": 0.36,
        "pitch_stiffness": 500000.0,
        "pitch_damping": 500,
    },
    "axle": {
        "half_length": 0.659,
        "drop": 0.22,
        "middle_half_length": 0.29853,
        "middle": {"vertical_bending_stiffness": 317000.0, "mass_per_length": 450},
        "outer": {"vertical_bending_stiffness": 299000.0, "mass_per_length": 59},
        "lateral_bending_stiffness": 5000000.0,
        "torsional_stiffness": 1200000.0,
        "axial_stiffness": 1000000000.0,
        "polar_inertia_per_length": 0.6,
        "damping_ratio": 0.045459,
        "damping_reference_frequency": 60,
        "damping_exponent": 0.7,
    },
    "stub": {
        "mass": 90.3,
        "roll_inertia": 0.8,
        "pitch_inertia": 2.0,
        "yaw_inertia": 0.8,
        "lateral_position": 0.75,
        "height": 0.3,
    },
    "wheel": {
        "radius": 0.3,
        "half_distance": 0.75,
        "hub": {"mass": 45, "diametral_inertia": 1.3, "spin_inertia": 1.0},
        "rim": {"mass": 125, "diametral_inertia": 5.0, "spin_inertia": 9.5},
        "layer": {
            "radial_stiffness": 400000000.0,
            "axial_stiffness": 109000000.0,
            "radial_damping": 10500,
            "axial_damping": 10500,
            "tilting_stiffness": 50000000.0,
            "torsional_stiffness": 25000000.0,
            "tilting_damping": 440,
            "torsional_damping": 440,
        },
        "bearing_damping": 0.02,
    },
    "absorber": {
        "motion": "rotation",
        "direction": {"x": 1, "y": 0, "z": 0},
        "lateral_position": 0.50413,
        "height": 0.22,
        "I_T": 2,
        "c_T": 174000.0,
        "d_T": 300,
    },
}
CONTACT_GEOMETRY = {
    "wheel": {
        "measured": "",
        "measured_noise": 5e-06,
        "flange_root_radius": 0.0162,
        "flange_angle": 1.2217,
        "conicity": 0.025,
        "tread_inner": -0.02,
        "tread_outer": 0.045,
        "tape_circle_offset": 0,
    },
    "rail": {
        "measured": "",
        "measured_noise": 5e-06,
        "crown_radius": 0.3,
        "corner_radius": 0.013,
        "corner_start": 0.015,
        "field_half_width": 0.028,
        "lateral_position": -0.00261,
        "inclination": 0,
    },
    "material": {"youngs_modulus": 206000000000.0, "poisson_ratio": 0.27},
    "gap_scale": 8e-06,
    "creep_law": "half_space",
}


def paper_bogie(
    shift_step: float = 2.5e-5,
    yaw_nodes: int = 24,
    grid: tuple[int, int] = (12, 12),
    cutoff_frequency: float = 2000.0,
) -> BogieLine:
    """Bogie of Table 3 on wheels and rails of the paper's line, in its curve.

    Parameters
    ----------
    shift_step : float
        Step of the contact tables over the lateral shift in m.
    yaw_nodes : int
        Their nodes over the yaw angle.
    grid : (int, int)
        Cells along and strips of a contact patch.
    cutoff_frequency : float
        Elastic modes of the axle bridges up to here are kept, Hz.

    Returns
    -------
    BogieLine
        With the friction of self-excitation.
    """
    bogie, geometry = Bogie.model_validate(BOGIE), ContactGeometry.model_validate(CONTACT_GEOMETRY)
    track = Track.model_validate(TRACK)
    reach = yaw_reach(0.8 * track.radius, bogie.half_wheelbase, bogie.wheel.half_distance)
    return BogieLine(
        bogie,
        track,
        geometry,
        FRICTION,
        zone_tables(geometry, bogie.wheel.radius, shift_step, yaw_nodes, yaw_limit=reach),
        grid,
        cutoff_frequency,
        elements_per_section=4,
    )
