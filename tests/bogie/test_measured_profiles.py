"""The bogie on measured profiles: sampled from the parametric pair it must run as on that pair."""

from pathlib import Path

import numpy as np
import pytest

from tramdva.bogie import modes
from tramdva.bogie import tram as bogie_line_module
from tramdva.bogie.curving import angle_of_attack, wheel_loads
from tramdva.configuration.uses import used_values
from tramdva.contact import geometry, patch
from tramdva.contact.measured_profile import measured_profile
from tramdva.contact.profiles import Profile, ProfileError
from tramdva.contact.tables import parametric_rail, parametric_wheel, stored_tables
from tramdva.stages import contact_geometry
from tramdva.stages.bogie_sections import bogie_line

# Per noise in m: tolerances of the angle of attack (rad), wheel loads (N), contact angle (rad) of
# loaded contacts, frequency (Hz) and growth rate (1/s) of the modes of the front axle.
# The patch of a yawed wheel follows the curvature of the profile itself: what noise does to that
# moves the second bending mode most.
TOLERANCES = {0.0: (1e-5, 1.0, 1e-4, 0.02, 0.01), 2e-6: (5e-5, 10.0, 2e-3, 1.2, 0.8)}
NAMES = ("second_bending_front", "third_bending_front", "resilient_wheel_front")


def write(path: Path, profile: Profile, noise: float, seed: int, offset: float = 0.0) -> Path:
    """Sample a profile every 0.25 mm along its arc, as a gauge does; rounding is no noise here."""
    random = np.random.default_rng(seed)
    steps = np.hypot(np.diff(profile.position), np.diff(profile.depth))
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    position = np.interp(np.arange(0.0, arc[-1], 0.25e-3), arc, profile.position)
    depth = profile.depth_at(position) + random.normal(0.0, noise, position.size) + offset
    np.savetxt(path, 1e3 * np.column_stack([position, depth]), "%.6f", ",", header="y, z in mm")
    return path


@pytest.fixture(scope="session")
def cfg(configuration) -> dict:
    """Values of the stage."""
    return used_values(configuration, "paper", "contact_geometry")


@pytest.fixture(scope="session")
def pair(configuration) -> dict[str, Profile]:
    """The paper's wheel and rail."""
    shape = configuration.lines["paper"].contact_geometry
    return {
        "wheel": parametric_wheel(shape.wheel),
        "rail": parametric_rail(shape.rail),
    }


@pytest.fixture(scope="session", params=TOLERANCES)
def measured(request, cfg, pair, tmp_path_factory):
    """Noise, and contact tables of profiles that were written to files and read again."""
    folder = tmp_path_factory.mktemp("measured")
    shape = dict(cfg["contact_geometry"])
    for seed, (kind, profile) in enumerate(pair.items()):
        path = write(folder / f"{kind}.csv", profile, request.param, seed)
        shape[kind] = shape[kind] | {"measured": path.name, "measured_noise": request.param}
    measured_cfg = {**cfg, "contact_geometry": shape}
    return request.param, contact_geometry.compute(measured_cfg, folder.joinpath)


def heights(variables, places) -> np.ndarray:
    """Height of the wheel at first touch in the zones of the tables."""
    tables = stored_tables(variables)
    rows = np.empty((geometry.WINDOW, 8))
    return np.array([[geometry.touch_height(t, *p, rows) for p in places] for t in tables])


def test_contact_tables_agree(tables, measured):
    noise, found = measured
    assert found["coefficients"].shape == tables["coefficients"].shape  # the same zones
    random = np.random.default_rng(4)
    low, high = (-2.5e-3, -0.01, 0.0), (7e-3, 0.01, 0.04)
    places = random.uniform(low, high, (300, 3))
    off = heights(found, places) - heights(tables, places)
    # Lowest zone: the one that touches. Noise of single points is smoothed.
    assert np.abs(off[heights(tables, places).argmin(axis=0), np.arange(300)]).max() < (
        2e-6 + 5.0 * noise
    )


def test_bogie_curves_and_vibrates_alike(configuration, running_, measured):
    noise, found = measured
    attack, load, angle, frequency, growth = TOLERANCES[noise]
    line = bogie_line(used_values(configuration, "paper", "curving_equilibrium"), found)
    other = bogie_line_module.run_through(line)
    assert other.equilibrium.status == "converged"
    np.testing.assert_allclose(
        angle_of_attack(other.curve, other.equilibrium),
        angle_of_attack(running_.curve, running_.equilibrium),
        atol=attack, rtol=0.0,
    )  # fmt: skip
    np.testing.assert_allclose(
        list(wheel_loads(other.equilibrium).values()),
        list(wheel_loads(running_.equilibrium).values()),
        atol=load, rtol=0.0,
    )  # fmt: skip
    loaded = running_.equilibrium.results[..., patch.STATUS] == patch.CONTACT
    np.testing.assert_allclose(
        other.equilibrium.results[..., patch.CONTACT_ANGLE][loaded],
        running_.equilibrium.results[..., patch.CONTACT_ANGLE][loaded],
        atol=angle, rtol=0.0,
    )  # fmt: skip
    for name, values in named_modes(other).items():
        np.testing.assert_allclose(values[0], named_modes(running_)[name][0], atol=frequency)
        np.testing.assert_allclose(values[1], named_modes(running_)[name][1], atol=growth)


def named_modes(run) -> dict[str, tuple[float, float]]:
    """Frequency and growth rate of the modes of `NAMES`."""
    found = modes.modes(run.curve, run.equilibrium.state, (30.0, 140.0))
    places = {name: found.name.index(name) for name in NAMES}
    return {k: (found.frequency[i], found.eigenvalue[i].real) for k, i in places.items()}


@pytest.fixture(scope="session")
def running_(running):
    """Equilibria on the parametric pair."""
    return running


def test_where_the_file_has_its_zero_of_z_does_not_matter(pair, tmp_path):
    for kind, profile in pair.items():
        near, far = (
            measured_profile(write(tmp_path / "p.csv", profile, 0.0, 0, offset), kind, 0.0)
            for offset in (0.0, 0.028)
        )
        np.testing.assert_allclose(far.depth, near.depth, atol=2e-7)  # digits of the file
        origin = near.depth.min() if kind == "rail" else near.depth_at(0.0)
        np.testing.assert_allclose(origin, 0.0, atol=1e-9)


def test_groove_and_keeper_of_a_rail_are_left_out(pair, tmp_path):
    head = write(tmp_path / "head.csv", pair["rail"], 0.0, 0)
    points = np.loadtxt(head, delimiter=",")
    wall = points[0] + np.column_stack([np.arange(-1.0, 0.0, 0.1), np.arange(20.0, 0.0, -2.0)])
    across = np.arange(-60.0, wall[0, 0] - 0.1, 0.5)
    keeper = np.column_stack([across, np.full_like(across, 30.0)])
    np.savetxt(tmp_path / "whole.csv", np.vstack([keeper, wall, points]), "%.6f", ",")
    found = measured_profile(tmp_path / "whole.csv", "rail", 0.0)
    assert found.position[0] > points[0, 0] * 1e-3 - 0.5e-3
    inner = pair["rail"].position[200:-50]
    np.testing.assert_allclose(found.depth_at(inner), pair["rail"].depth_at(inner), atol=1e-6)


def test_wall_beside_the_origin_is_refused(tmp_path):
    y = np.linspace(-30.0, 30.0, 301)
    z = 5e-4 * y**2 + 0.05 * np.clip(-20.0 - y, 0.0, None) ** 2 + 20.0 * (y > 3.0)
    path = tmp_path / "wall.csv"
    np.savetxt(path, np.column_stack([y, z]), "%.6f", ",")
    with pytest.raises(ProfileError, match="upright or turns back within 8 mm"):
        measured_profile(path, "rail", 0.0)
