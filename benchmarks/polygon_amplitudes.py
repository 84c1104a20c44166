"""Wheel orders in the nonlinear vehicle: beside the linear response, and up to saturation.

    python benchmarks/polygon_amplitudes.py [law] [step_tolerance] [orders]

The law: chart, smoothed or constant; orders such as 10,26,55. The paper's bogie in its curve, own
waves of the outer front wheel. First every order from 5 to 67 alone at 1 um, then seven at once,
against the linear response: rate and drift of each. Then the response over the amplitude until the
wheel no longer runs steadily: the table of docs/evolution.md. At last a turned wheel wears on, with
steps as configured and with half of them.
"""

import sys
import time
from pathlib import Path

import numpy as np

from tramdva.running.numba_cache import use_numba_cache

use_numba_cache()

from tramdva.bogie.names import WHEELS  # noqa: E402
from tramdva.bogie.published import paper_bogie  # noqa: E402
from tramdva.bogie.revolutions import Settings  # noqa: E402
from tramdva.bogie.rough_vehicle import rough_bogie  # noqa: E402
from tramdva.bogie.tram import absorber, changed, run_through  # noqa: E402
from tramdva.configuration.reading import load  # noqa: E402
from tramdva.contact.fastsim import patch_grid  # noqa: E402
from tramdva.evolution.tendency import Wearing, wear_sensitivity  # noqa: E402
from tramdva.route import wearing_on  # noqa: E402
from tramdva.route.growth import initial_amplitudes  # noqa: E402
from tramdva.route.nonlinear import WearingWheel, revolution  # noqa: E402
from tramdva.route.own_response import own_response, spins  # noqa: E402
from tramdva.route.parameters import InitialSpectrum  # noqa: E402
from tramdva.route.saturation import describing, saturation_amplitude  # noqa: E402
from tramdva.route.wearing_on import Bounds, wear_on  # noqa: E402
from tramdva.wear.chart import METHODS, wear_chart  # noqa: E402

CHART = wear_chart(load(Path(__file__).parents[1] / "config").lines["paper"].wear)
SETTINGS = Settings(512, 1, 40, 1e-3, 0.05)
AMPLITUDES = 1e-6 * np.array([1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0])
TOGETHER = np.array([5, 13, 26, 34, 43, 56, 67])


def wheels(method: str, cells: int) -> dict:
    """Outer front wheel and the linear response of orders 1 to 68, by absorber."""
    line = paper_bogie()
    line = line._replace(friction=(*line.friction[:2], 0.4))
    chart, grid = CHART._replace(method=METHODS[method]), patch_grid(cells, cells)
    bare = run_through(line)
    found = {}
    for name, run in (
        ("none", bare),
        ("Table 3", changed(line, absorber(line, 1.74e5, 300), bare)),
    ):
        bogie = rough_bogie(run.curve, run.equilibrium)
        wear = wear_sensitivity(bogie, run.curve.contacts.law, Wearing(chart, grid, WHEELS))
        spin = float(spins(run.curve, run.equilibrium.state)[0])
        orders = np.arange(1.0, 69.0)
        response = own_response(bogie, [wear], 0, spin).at(orders, orders * spin)[0]
        zones = np.ones(bogie.touching.shape[1])
        wheel = WearingWheel(run.curve.contacts, bogie, 0, spin, chart, grid, zones, SETTINGS)
        found[name] = wheel, orders, response
    return found


def beside_linear(wheel: WearingWheel, orders: np.ndarray, linear: np.ndarray, size: float) -> None:
    """Print the largest errors of rate and drift of single orders, and of several at once."""
    found = np.empty(orders.size, complex)
    for place in range(4, 67):
        wave = np.zeros(orders.size, complex)
        wave[place] = size
        found[place] = revolution(wheel, orders, wave).depth[place] / size
    shown = slice(4, 67)
    print(f"  alone at {1e6 * size:g} um:", _errors(found[shown], linear[shown], orders[shown]))
    wave = np.zeros(orders.size, complex)
    phase = np.random.default_rng(1).uniform(-np.pi, np.pi, TOGETHER.size)
    wave[TOGETHER - 1] = size / np.sqrt(TOGETHER.size) * np.exp(1j * phase)
    # What is proportional to the waves; combinations of two change no sign with them.
    both = [revolution(wheel, orders, sign * wave).depth for sign in (1.0, -1.0)]
    some = (0.5 * (both[0] - both[1]))[TOGETHER - 1] / wave[TOGETHER - 1]
    print("  seven at once, together that size:", _errors(some, linear[TOGETHER - 1], TOGETHER))


def _errors(found: np.ndarray, linear: np.ndarray, orders: np.ndarray) -> str:
    """Largest errors of rate, drift and response, and how many orders are within 2 %."""
    rate = np.abs(found.real / linear.real - 1.0)
    drift = np.abs(found.imag / linear.imag - 1.0)
    whole = np.abs(found / linear - 1.0)
    text = f"response {100 * whole.max():.2f} % (order {orders[whole.argmax()]:.0f})"
    for name, error in (("rate", rate), ("drift", drift)):
        text += f", {name} {100 * error.max():.2f} % (order {orders[error.argmax()]:.0f}"
        text += f", {np.sum(error > 0.02)} beyond 2 %)"
    return text


def over_amplitude(
    wheel: WearingWheel, orders: np.ndarray, linear: np.ndarray, chosen: np.ndarray
) -> None:
    """Print the response of chosen orders over their amplitude, over that of small waves."""
    table = describing(wheel, chosen, AMPLITUDES)
    small = linear[chosen.astype(int) - 1]
    saturation = saturation_amplitude(table, small)
    for row, order in enumerate(chosen):
        print(f"  order {order:.0f}, growth of small waves {-small[row].real:.2e}; a tenth is left "
              f"at {1e6 * saturation[row]:.1f} um")  # fmt: skip
        for column, size in enumerate(AMPLITUDES):
            value = table.response[row, column]
            left = value / small[row]
            print(
                f"    {1e6 * size:5.0f} um: response {100 * (abs(left) - 1):+6.1f} %, growth "
                f"{100 * value.real / small[row].real:6.1f} %, harmonics "
                f"{100 * table.harmonics[row, column]:5.1f} %, {table.status[row, column]}"
            )


def halved_steps(wheel: WearingWheel, orders: np.ndarray, linear: np.ndarray) -> None:
    """Print by how much half of the steps changes the levels of a wheel that wears on."""
    spectrum = InitialSpectrum(level_dB=17, slope_dB_per_octave=-6, seed=1)
    initial = initial_amplitudes(orders, spectrum)
    bounds = Bounds(1e4 / -linear.real.min(), 1.5e-4, 5e-3, 300)
    runs = []
    for share in (1.0, 0.5):
        wearing_on.LONGEST = 0.5 * share
        start = time.process_time()
        run = wear_on(wheel, orders, initial, linear, bounds._replace(tolerance=5e-3 * share**3))
        runs.append(run)
        print(
            f"  {len(run.steps)} steps, {run.evaluations} steady revolutions, {run.status} after "
            f"{-linear.real.min() * run.end:.2f} e-folds of the fastest order: "
            f"{time.process_time() - start:.0f} s",
            flush=True,
        )
    u = np.linspace(0.0, min(run.end for run in runs), 20)
    coarse, fine = (np.abs(run.at(u)) for run in runs)
    change = 20.0 * np.abs(np.log10(coarse / fine))
    for share in (0.1, 0.01):
        counted = fine >= share * fine.max(axis=1, keepdims=True)
        print(
            f"  half of the steps: {change[counted].max():.3f} dB, above {share:g} of the largest"
        )


def main() -> None:
    """Print everything."""
    method = sys.argv[1] if len(sys.argv) > 1 else "smoothed"
    tolerance = float(sys.argv[2]) if len(sys.argv) > 2 else SETTINGS.step_tolerance
    chosen = np.array((sys.argv[3] if len(sys.argv) > 3 else "10,26,34,55").split(","), float)
    for name, (wheel, orders, linear) in wheels(method, 40).items():
        wheel = wheel._replace(settings=SETTINGS._replace(step_tolerance=tolerance))
        print(f"absorbers: {name}; {method}", flush=True)
        start = time.process_time()
        for size in (1e-6,) if method != "chart" else (2e-7, 1e-6):
            beside_linear(wheel, orders, linear, size)
        print(f"  {time.process_time() - start:.0f} s", flush=True)
        start = time.process_time()
        over_amplitude(wheel, orders, linear, chosen)
        print(f"  {time.process_time() - start:.0f} s", flush=True)
        if name == "none":
            halved_steps(wheel, orders, linear)


if __name__ == "__main__":
    main()
