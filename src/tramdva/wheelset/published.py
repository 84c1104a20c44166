"""The wheelset of the paper as plain values, for examples and first steps in Python.

A run takes its values from the configuration, which says where each comes from.
"""

from tramdva.wheelset.model import WheelsetParameters, wheelset_parameters

SECTIONS = {
    "curve": {"r_C": 25.75, "gamma": -0.04, "outer_speed": 4.15},
    "creep_force": {
        "F_N": 35000,
        "mu_0": 0.35,
        "A": 0.36,
        "B": 0.7,
        "a": 0.0042,
        "b": 0.0042,
        "G": 82000000000.0,
        "c_22": 3.7,
        "k_A": 1,
        "k_S": 1,
    },
    "wheelset": {
        "m_A": 400,
        "m_R": 125,
        "c_A": 52000000.0,
        "d_A": 7250,
        "c_R": 49000000.0,
        "d_R": 9500,
        "L": 1.5,
    },
    "absorber": {"m_T": 40, "c_T": 4300000.0, "d_T": 6850},
}


def paper_wheelset(**changes: float) -> WheelsetParameters:
    """Wheelset of Table 1 with the absorber of Table 2, in SI units.

    Parameters
    ----------
    **changes : float
        Values that replace those of the tables, by symbol: ``paper_wheelset(c_A=8e7)``.

    Returns
    -------
    WheelsetParameters
    """
    return wheelset_parameters(SECTIONS, **changes)
