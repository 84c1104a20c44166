"""Reference results of CONTACT and a plain FASTSIM, the second way to the same numbers."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tramdva.contact import fastsim, geometry, kalker, profiles, traction_field

FOLDER = Path(__file__).resolve().parents[1] / "reference" / "contact"
SHEAR_MODULUS, POISSON, FRICTION, LOAD, SPEED = 82e9, 0.28, 0.35, 35e3, 4.0


def plain_fastsim(a, b, limit, creepages, flexibility, cells, bound="parabolic"):
    """FASTSIM as published: a square grid of cells, midpoints, one cell after the other.

    Returns Fx, Fy, Mz and the power over speed, all of the cells with their centre in the patch.
    """
    nu_x, nu_y, phi = creepages
    dx, dy = 2 * a / cells, 2 * b / cells
    total = np.zeros(4)
    for j in range(cells):
        y = -b + (j + 0.5) * dy
        q = np.zeros(2)
        for i in range(cells):
            x = a - (i + 0.5) * dx
            inside = 1 - (x / a) ** 2 - (y / b) ** 2
            if inside <= 0:
                q[:] = 0
                continue
            shape = 2.0 * inside if bound == "parabolic" else 1.5 * np.sqrt(inside)
            capacity = limit / (np.pi * a * b) * shape
            rate = np.array(
                [
                    nu_x / flexibility[0] - phi * y / flexibility[2],
                    nu_y / flexibility[1] + phi * x / flexibility[2],
                ]
            )
            trial = q - dx * rate
            q = trial * min(1.0, capacity / max(np.hypot(*trial), 1e-300))
            slip = (q - trial) / dx * flexibility[:2]
            total += dx * dy * np.array([*q, x * q[1] - y * q[0], -q @ slip])
    return total


@pytest.fixture(scope="session", name="plain_fastsim")
def _plain_fastsim():
    return plain_fastsim


@pytest.fixture(scope="session")
def hertzian_rolling() -> pd.DataFrame:
    """CONTACT's cases in SI: a, b, nu_x, nu_y, phi, Fx, Fy, Mz, power and method, n."""
    table = pd.read_csv(FOLDER / "hertzian_rolling.csv", comment="#")
    return pd.DataFrame(
        {
            "method": table.method,
            "n": table.n,
            "a": table.a_mm * 1e-3,
            "b": table.b_mm * 1e-3,
            "nu_x": table.cksi,
            "nu_y": table.ceta,
            "phi": table.cphi_per_mm * 1e3,
            "Fx": table.Fx_N,
            "Fy": table.Fy_N,
            "Mz": table.Mz_Nmm * 1e-3,
            "power": -table.fric_power_W,
        }
    )


@pytest.fixture(scope="session")
def contact_cases(hertzian_rolling) -> pd.DataFrame:
    """Half-space results only."""
    return hertzian_rolling[hertzian_rolling.method == "CONTACT"].reset_index(drop=True)


@pytest.fixture(scope="session")
def falling_friction() -> pd.DataFrame:
    """CONTACT's lateral creep curve with falling friction."""
    table = pd.read_csv(FOLDER / "falling_friction.csv", comment="#")
    return table[table.method == "CONTACT"].reset_index(drop=True)


def read_wheelset_table(name: str, sides: dict) -> pd.DataFrame:
    """Rows of a table of CONTACT's wheelset cases; `sides` maps a comment or letter to a side."""
    rows, side = [], None
    for line in (FOLDER / name).read_text().splitlines():
        if line.startswith("#"):
            side = sides.get(line.strip("# ").strip(), side)
        elif line[0].isdigit() or line[0] in "LR":
            fields = [field for field in line.split() if field != "|"]
            rows.append([side, *fields])
    return pd.DataFrame(rows)


@pytest.fixture(scope="session")
def manchester() -> pd.DataFrame:
    """Case A-2.2 of the Manchester benchmark, mm and N as printed."""
    table = read_wheelset_table("manchester_a22.txt", {"left wheel": "L", "right wheel": "R"})
    table.columns = [
        "side",
        "case",
        "pid",
        "y",
        "yaw",
        "z",
        "y_track",
        "z_track",
        "angle",
        "y_rail",
        "z_rail",
        "y_wheel",
        "z_wheel",
        "nu_x",
        "nu_y",
        "phi",
        "FN",
        "FX",
        "FS",
        "pmax",
    ]
    numbers = table.columns[3:]
    table[numbers] = table[numbers].astype(float)
    return table


@pytest.fixture(scope="session")
def tram_cases() -> pd.DataFrame:
    """S1002 on UIC60 under tram conditions, mm, degrees and N as printed."""
    table = read_wheelset_table("tram_s1002_uic60.txt", {}).drop(columns=0)
    table.columns = [
        "side",
        "y",
        "patch",
        "z",
        "y_track",
        "z_track",
        "angle",
        "y_wheel",
        "nu_x",
        "nu_y",
        "phi",
        "FN",
        "FX",
        "FS",
        "pmax",
    ]
    numbers = table.columns[1:]
    table[numbers] = table[numbers].astype(float)
    return table


@pytest.fixture(scope="session")
def flexibility():
    """Function (a, b) -> (L1, L2, L3) of steel."""
    table = kalker.kalker_table(POISSON)
    return lambda a, b: kalker.flexibilities(table, a, b, SHEAR_MODULUS)


@pytest.fixture(scope="session")
def forces(flexibility):
    """Function (a, b, N, mu, creepages, cells, strips, bound) -> Fx, Fy, Mz."""

    def run(a, b, load, friction, creepages, cells=20, strips=20, bound="balanced"):
        grid = fastsim.patch_grid(cells, strips, bound)
        work = fastsim.workspace(grid)
        return np.array(
            fastsim.fastsim_forces(a, b, load, friction, *creepages, flexibility(a, b), grid, work)
        )

    return run


@pytest.fixture(scope="session")
def field(flexibility):
    """Function as `forces` -> (TractionField, Fx, Fy, Mz, slip factor)."""

    def run(a, b, load, friction, creepages, cells=40, strips=40, bound="balanced"):
        grid = fastsim.patch_grid(cells, strips, bound)
        result = traction_field.empty_field(grid)
        numbers = traction_field.traction_field(
            a, b, load, friction, *creepages, flexibility(a, b), grid, result
        )
        return result, *numbers

    return run


@pytest.fixture(scope="session")
def benchmark_rail():
    """UIC60 with the arcs of the Manchester benchmark's profile."""
    return profiles.uic60_rail(1 / 40, crown_half_width=10.5e-3, shoulder_half_width=25.985e-3)


@pytest.fixture(scope="session")
def manchester_tables(benchmark_rail):
    """Zones of S1002 (R = 460 mm, 10 kN) on UIC60; yaw of 14 mrad separates root and flank."""
    return geometry.contact_tables(
        profiles.s1002_wheel(),
        benchmark_rail,
        0.46,
        shift_range=(-26e-3, 6e-3),
        roll_limit=0.02,
        yaw_limit=0.03,
        gap_scale=4e-6,
        split_yaw=(0.0, 0.0144),
    )


@pytest.fixture(scope="session")
def tram_tables():
    """The conformal tram pair: wheel root 15.2 mm on a rail corner of 13 mm, R = 300 mm."""
    return geometry.contact_tables(profiles.tram_wheel(), profiles.grooved_rail(), 0.3)
