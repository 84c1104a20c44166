"""Orders, profiles and levels of wheels out of round; files of measurements."""

import numpy as np
import pytest

from tramdva.evolution import out_of_roundness as oor


def uniform(count: int) -> np.ndarray:
    return 2.0 * np.pi * np.arange(count) / count


def test_orders_of_a_profile_are_those_it_was_made_of():
    amplitudes = np.array([3e-6, 2e-6 * np.exp(1.1j), 5e-7j])
    angle = uniform(3600)
    profile = oor.radius_deviation([3, 17, 40], amplitudes, angle)
    found = oor.order_amplitudes(angle, profile, [3, 17, 40, 21])
    # Linear interpolation lowers order n of k points by sinc(n / k)^2.
    np.testing.assert_allclose(
        found[:3], amplitudes * np.sinc([3 / 3600, 17 / 3600, 40 / 3600]) ** 2
    )
    assert abs(found[3]) < 1e-12


def test_crest_is_positive_at_the_angle_of_its_phase():
    profile = oor.radius_deviation([4], [1e-5 * np.exp(-0.8j)], np.array([0.2, 0.2 + np.pi / 4]))
    np.testing.assert_allclose(profile, [1e-5, -1e-5])


def test_points_need_not_be_uniform():
    rng = np.random.default_rng(3)
    angle = np.sort(rng.uniform(0.0, 2.0 * np.pi, 4000))
    profile = oor.radius_deviation([0, 18], [2e-6, 1e-6j], angle)
    found = oor.order_amplitudes(angle, profile, [0, 18])
    np.testing.assert_allclose(found, [2e-6, 1e-6j], atol=2e-9)


@pytest.mark.parametrize(("amplitude", "decibel"), [(5, 11), (10, 17), (50, 31), (100, 37)])
def test_levels_in_decibel_as_operators_use_them(amplitude, decibel):
    assert round(float(oor.level(amplitude * 1e-6))) == decibel


def test_measured_file_is_read(tmp_path):
    path = tmp_path / "wheel.txt"
    angle = np.arange(0, 360, 2.0)
    deviation = 40.0 + 12.0 * np.cos(np.radians(20 * angle))
    rows = [f"{a:g}; {d:.6f}" for a, d in zip(angle, deviation, strict=True)]
    path.write_text("\n".join(["# degrees; um", *rows, f"360; {deviation[0]:.6f}"]))
    measured = oor.read_measurement(path)
    assert measured.angle.size == 180
    amplitude = oor.order_amplitudes(*measured, [20])[0] / np.sinc(20 / 180) ** 2
    np.testing.assert_allclose(amplitude, 12e-6, rtol=1e-6)
    assert abs(measured.deviation.mean()) < 1e-12


LINES = [f"{a} 1.0" for a in range(0, 360, 5)]


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        (LINES[:20], "20 points; at least 36"),
        ([*LINES, "355 1.0"], "angle 355 after 355 must be larger"),
        ([*LINES[:30], *LINES[40:]], "no point for 55 degrees after 145"),
        ([*LINES[:5], "nan 1", *LINES[6:]], "line 6: 'nan 1' must be finite"),
        (
            [*LINES[:5], "25 1 3", *LINES[6:]],
            "line 6: 3 columns; two are needed, angle in degrees",
        ),
        ([*LINES[:5], "25 $(date)", *LINES[6:]], "line 6: '25 $(date)' is not a pair of numbers"),
        ([f"{a} 350000" for a in range(0, 360, 5)], "deviation of 350000 um; at most 5000"),
        ([f"{a / 57.3} 1" for a in range(0, 360, 5)], "no point for 353"),
    ],
)
def test_wrong_files_are_refused_in_one_line(tmp_path, lines, words):
    path = tmp_path / "wheel.txt"
    path.write_text("\n".join(lines))
    with pytest.raises(oor.RoundnessError) as caught:
        oor.read_measurement(path)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_huge_binary_and_missing_files_are_refused(tmp_path, monkeypatch):
    path = tmp_path / "wheel.txt"
    with pytest.raises(oor.RoundnessError, match="there is no such file"):
        oor.read_measurement(path)
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(oor.RoundnessError, match="line 1: is not UTF-8 text"):
        oor.read_measurement(path)
    monkeypatch.setattr(oor, "LAYOUT", oor.LAYOUT._replace(largest=2))
    with pytest.raises(oor.RoundnessError, match="larger than 2 bytes"):
        oor.read_measurement(path)
