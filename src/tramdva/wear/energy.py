"""Wear by frictional work, with its regimes: T-gamma per area as twin-disc tests give it.

A cell of the patch does the work ``w = -q . s`` per rolled metre and area (traction times slip
over rolling speed; T-gamma / A where the whole patch counts as one cell). The mass worn per rolled
metre and area is

    K w        mild, up to the rate of the severe regime,
    W          severe: a plateau,
    W + K_c (w - w_c)   catastrophic, above w_c,

(Lewis and Dwyer-Joyce, Proc. IMechE J 218, 2004; Braghin, Lewis, Dwyer-Joyce, Bruni, Wear 261,
2006). The limit of the mild regime follows from the plateau, W / K, so that the law is continuous:
10.38 N/mm^2 where 10.4 is printed.
"""

from numba import njit


@njit(cache=True, nogil=True, error_model="numpy")
def energy_wear_rate(work, chart):
    """Depth worn per rolled length, dimensionless.

    Parameters
    ----------
    work : frictional work per rolled length and area, Pa; where the direction of sliding turns
        within a strip the mean traction of a cell can point along the slip: the small negative
        work counts as such, or the sum would not be that of the patch
    chart : WearChart
    """
    rate = chart.energy_mild * work
    if rate.real > chart.energy_severe:
        rate = chart.energy_severe + 0.0 * work
    if work.real > chart.energy_limit:
        rate = rate + chart.energy_catastrophic * (work - chart.energy_limit)
    return rate * (1.0 / chart.density)
