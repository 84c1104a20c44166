"""Pictures of docs/contact.md: `python docs/contact_pictures.py [folder]`.

Everything is computed here in a few seconds; reference points are those of CONTACT in
tests/reference/contact.
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from tramdva.contact import fastsim, geometry, hertz, kalker, polach, profiles, traction_field
from tramdva.contact.creep_force import friction_coefficient
from tramdva.contact.measured_profile import measured_profile, read_points
from tramdva.wear.chart import WearChart

ROOT = Path(__file__).resolve().parents[1]
REFERENCE = ROOT / "tests" / "reference" / "contact"
RED, BLUE, GREEN, PINK, AMBER, SKY = (
    "#D55E00",
    "#0072B2",
    "#009E73",
    "#CC79A7",
    "#E69F00",
    "#56B4E9",
)
LOAD, FRICTION, SPEED = 35e3, 0.35, 4.0
RADIUS = 0.3
KALKER = kalker.kalker_table(0.28)
MODULUS = hertz.effective_modulus(2.06e11, 0.27)


def s1002_pair():
    """S1002 on UIC60: profiles, tables, and the wheel's shift when the wheelset is central."""
    wheel = profiles.s1002_wheel()
    rail = profiles.uic60_rail(1 / 40, crown_half_width=10.5e-3, shoulder_half_width=25.985e-3)
    tables = geometry.contact_tables(
        wheel, rail, 0.46, shift_range=(-20e-3, -2.5e-3), roll_limit=0.005, yaw_limit=0.01
    )
    return wheel, rail, tables, -10.53e-3


def tram_pair():
    """The conformal tram pair; central where the tread contact begins to enter the root."""
    wheel, rail = profiles.tram_wheel(), profiles.grooved_rail(corner_start=7.5e-3)
    tables = geometry.contact_tables(
        wheel, rail, RADIUS, shift_range=(9e-3, 16e-3), roll_limit=0.005, yaw_limit=0.045,
        split_yaw=(0.0, 0.02, 0.04),
    )  # fmt: skip
    return wheel, rail, tables, 12.6e-3


def first_contact(tables, shift, yaw=0.0):
    """Contact of the zone that touches first, its height, and the gap of the others in m."""
    rows = np.zeros((geometry.WINDOW, 8))
    heights = [geometry.touch_height(t, shift, 0.0, yaw, rows) for t in tables]
    zone = int(np.argmin(heights))
    found = geometry.locate_contact(tables[zone], shift, heights[zone], 0.0, yaw, rows)
    return found, heights[zone], np.array(heights) - heights[zone]


def draw_pair(axes, pair, shifts):
    """Wheel over rail at touch, lines between matching contact points for many shifts."""
    wheel, rail, tables, centre = pair
    found, height, _ = first_contact(tables, centre)
    lift = 6e-3
    axes.fill_between(rail.position * 1e3, -rail.depth * 1e3, -25, color="0.85")
    axes.plot(rail.position * 1e3, -rail.depth * 1e3, color="black")
    o, d = wheel.position + centre, wheel.depth + height
    axes.plot(o * 1e3, -(d - lift) * 1e3, color=BLUE)
    for shift in shifts:
        found, _, _ = first_contact(tables, centre + shift)
        on_wheel = np.array([found[2] + centre, -(found[3] + height - lift)]) * 1e3
        on_rail = np.array([found[4], -found[5]]) * 1e3
        axes.plot(*np.column_stack([on_wheel, on_rail]), color=RED, lw=0.6)
    axes.set(xlim=(-52, 36), ylim=(-20, 13), aspect="equal")
    axes.set(xlabel="position outwards / mm", ylabel="height / mm")


def picture_profiles(folder):
    """Profiles with contact points."""
    figure, axes = plt.subplots(2, 1, figsize=(4.6, 4.6))
    draw_pair(axes[0], s1002_pair(), np.arange(-7, 7.01, 0.5) * 1e-3)
    axes[0].set_title("(a) S1002 on UIC60 1:40, shift −7 to 7 mm", fontsize=8)
    draw_pair(axes[1], tram_pair(), np.arange(-3, 2.01, 0.2) * 1e-3)
    axes[1].set_title("(b) tram wheel, root 15.2 mm, on a grooved rail, corner 13 mm", fontsize=8)
    figure.savefig(folder / "contact_profiles.png")


def picture_geometry(folder):
    """Contact angle and rolling radius over lateral shift, with CONTACT's points."""
    figure, axes = plt.subplots(2, 2, figsize=(6.85, 4.4), sharex="col")
    pairs = ((s1002_pair(), (-7e-3, 7e-3), 0.46), (tram_pair(), (-1.0e-3, 2.6e-3), RADIUS))
    for column, (pair, limits, radius) in enumerate(pairs):
        tables, centre = pair[2:]
        shift = np.linspace(*limits, 1401)
        for yaw, color, style in ((0.0, BLUE, "-"), (0.02, GREEN, "-."), (0.04, RED, "--")):
            if yaw and column == 0:
                continue
            found = [first_contact(tables, centre + s, yaw)[0] for s in shift]
            angle = np.degrees([f[1] for f in found])
            depth = np.array([f[3] for f in found])
            label = f"yaw {yaw * 1e3:.0f} mrad"
            axes[0, column].plot(shift * 1e3, angle, color=color, ls=style, label=label)
            rolling = (radius + depth) * 1e3
            axes[1, column].plot(shift * 1e3, rolling, color=color, ls=style, label=label)
    draw_manchester(axes[:, 0])
    axes[0, 0].set_ylabel("contact angle / °")
    axes[1, 0].set_ylabel("rolling radius / mm")
    axes[0, 0].set_title("(a) S1002 on UIC60", fontsize=8)
    axes[0, 1].set_title("(b) tram pair, root 15.2 mm on corner 13 mm", fontsize=8)
    for panel in axes[1]:
        panel.set_xlabel("lateral shift of the wheel outwards / mm")
    axes[0, 0].legend(loc="upper left")
    axes[0, 1].legend(loc="lower right")
    figure.savefig(folder / "contact_geometry.png")


def draw_manchester(axes):
    """CONTACT's angles and radii of case A-2.2 up to 6 mm (both wheels)."""
    rows = [
        line.replace("|", "").split()
        for line in (REFERENCE / "manchester_a22.txt").read_text().splitlines()
        if line[0].isdigit()
    ]
    table = np.array(rows, dtype=float)
    left, right = table[:21], table[21:]
    for part, sign in ((left, -1), (right, 1)):
        part = part[part[:, 2] <= 5.5]
        axes[0].plot(sign * part[:, 2], np.degrees(np.abs(part[:, 7])), "k+", ms=5)
        axes[1].plot(sign * part[:, 2], 460 + part[:, 11], "k+", ms=5)
    axes[0].plot([], [], "k+", label="CONTACT, Manchester A-2.2")


def cells(creepages, a, b, load, friction, n=40):
    """Traction field of one patch."""
    grid = fastsim.patch_grid(n, n)
    field = traction_field.empty_field(grid)
    flexibility = kalker.flexibilities(KALKER, a, b, 82e9)
    traction_field.traction_field(a, b, load, friction, *creepages, flexibility, grid, field)
    return field


def picture_patch(folder):
    """Traction and slip in two patches."""
    figure, axes = plt.subplots(2, 2, figsize=(6.85, 5.2))
    cases = (
        ("(a) $\\nu_x$ = 0.1 %, $\\nu_y$ = 0.1 %", (1e-3, 1e-3, 0.0), 4.0e-3, 4.0e-3),
        ("(b) $\\nu_y$ = −0.2 %, spin 2 1/m", (0.0, -2e-3, 2.0), 5.0e-3, 3.0e-3),
    )
    for row, (title, creepages, a, b) in enumerate(cases):
        field = cells(creepages, a, b, LOAD, FRICTION, 60)
        used = field.area[0] > 0
        order = np.argsort(field.position_y[0, used])
        x, y = (p[:, used][:, order] * 1e3 for p in (field.position_x, field.position_y))
        traction = [p[:, used][:, order] * 1e-6 for p in (field.traction_x, field.traction_y)]
        slip = np.hypot(field.slip_x, field.slip_y)[:, used][:, order] * SPEED
        sizes = (np.hypot(*traction), "traction / MPa"), (slip, "slip velocity / (m/s)")
        for panel, (size, label) in zip(axes[row], sizes, strict=True):
            top = np.percentile(size, 98)
            mesh = panel.contourf(x, y, np.minimum(size, top), levels=12, cmap="cividis")
            figure.colorbar(mesh, ax=panel, label=label, shrink=0.8 * b / a)
            panel.contour(x, y, slip, levels=[1e-6], colors="white", linewidths=1.0)
            panel.set(aspect="equal", xlabel="$x$ along rolling / mm", ylabel="$y$ / mm")
        every = (slice(None, None, 6), slice(None, None, 6))
        axes[row, 0].quiver(
            x[every], y[every], traction[0][every], traction[1][every], color=RED, width=0.005
        )
        axes[row, 0].set_title(title + ": traction", fontsize=8)
        axes[row, 1].set_title("slip; white: edge of adhesion", fontsize=8)
    figure.savefig(folder / "contact_patch.png")


def lateral_forces(creepage, a, friction, bound):
    """Lateral force in N over lateral creepage, friction given per point."""
    grid = fastsim.patch_grid(20, 20, bound)
    work = fastsim.workspace(grid)
    flexibility = kalker.flexibilities(KALKER, a, a, 82e9)
    return np.array(
        [
            -fastsim.fastsim_forces(a, a, LOAD, mu, 0.0, nu, 0.0, flexibility, grid, work)[1]
            for nu, mu in zip(creepage, friction, strict=True)
        ]
    )


def by_polach(creepage, a, friction):
    """Lateral force in N by Polach's formula."""
    coefficients = kalker.creep_coefficients(KALKER, 1.0)
    return np.array(
        [
            -polach.polach_forces(a, a, LOAD, mu, 0.0, nu, 0.0, coefficients, 82e9, 1.0, 1.0)[1]
            for nu, mu in zip(creepage, friction, strict=True)
        ]
    )


def picture_creep_curves(folder):
    """Constant and falling friction: FASTSIM, Polach, CONTACT."""
    figure, axes = plt.subplots(1, 2, figsize=(6.85, 2.9))
    rolling = pd.read_csv(REFERENCE / "hertzian_rolling.csv", comment="#")
    rolling = rolling[(rolling.method == "CONTACT") & (rolling.a_mm == 4)]
    pure = rolling[(rolling.cksi == 0) & (rolling.cphi_per_mm == 0)]
    nu = np.linspace(0.0, 0.008, 161)
    constant = np.full(nu.size, FRICTION)
    falling = pd.read_csv(REFERENCE / "falling_friction.csv", comment="#")
    falling = falling[falling.method == "CONTACT"]
    wide = np.geomspace(1e-4, 0.1, 241)
    mu = np.vectorize(friction_coefficient)(3.908 * wide, 0.35, 0.36, 0.7)
    for panel, creep, friction, a in ((axes[0], nu, constant, 4e-3), (axes[1], wide, mu, 4.1e-3)):
        for bound, color, style in (
            ("elliptic", PINK, "-"), ("balanced", BLUE, "-"), ("parabolic", GREEN, ":")
        ):  # fmt: skip
            force = lateral_forces(creep, a, friction, bound) * 1e-3
            width = 2.6 if bound == "elliptic" else 1.2
            style = "-" if bound == "elliptic" else style
            shade = "0.75" if bound == "elliptic" else color
            panel.plot(
                creep * 100, force, color=shade, ls=style, lw=width, label=f"FASTSIM, {bound}"
            )
        force = by_polach(creep, a, friction) * 1e-3
        panel.plot(creep * 100, force, color=RED, ls="--", label="Polach, $k_A = k_S = 1$")
        panel.set_xlabel("lateral creepage / %")
    inside = pure[pure.ceta < 0.008]
    axes[0].plot(inside.ceta * 100, -inside.Fy_N * 1e-3, "ko", ms=4, mfc="white", label="CONTACT")
    axes[1].plot(falling.ceta * 100, -falling.Fy_N * 1e-3, "ko", ms=4, mfc="white")
    axes[0].set(xlim=(0, 0.8), ylim=(0, 13), ylabel="lateral creep force / kN")
    axes[1].set(xscale="log", xlim=(0.02, 10), ylim=(0, 13))
    axes[0].legend(loc="lower right")
    axes[0].set_title("(a) constant friction 0.35", fontsize=8)
    axes[1].set_title("(b) friction falling with the slip velocity", fontsize=8)
    figure.savefig(folder / "contact_creep_curves.png")


def picture_wear(folder):
    """The chart with the working points (cells) of an inner and an outer wheel."""
    chart = WearChart()
    figure, panel = plt.subplots(figsize=(4.4, 3.3))
    limit = chart.pressure_share * chart.hardness * 1e-9
    regions = (
        ("mild", 0.06, 1.3), ("severe", 0.45, 0.25), ("mild, fast", 0.85, 0.25),
        ("seizure", 0.85, 2.45),
    )  # fmt: skip
    panel.axvspan(0.2, 0.7, ymax=limit / 3.0, color="0.92")
    panel.axhspan(limit, 3.0, color="0.82")
    for name, v, p in regions:
        panel.text(v, p, name, ha="center", va="center", fontsize=8, style="italic")
    cases = (
        ("inner tread, 35 kN", (0.0, 0.04, 0.08), (0.3, 0.3), LOAD, BLUE, "o", 1.3),
        ("outer flange root 39°, 43 kN", (-0.003, 0.0515, 2.1), (0.39, 0.09), 43e3, RED, "^", 39.0),
    )
    table = hertz.hertz_table()
    for label, creepages, radii, load, color, marker, angle in cases:
        along = np.cos(np.radians(angle)) / RADIUS
        penetration = hertz.penetration_of_force(table, along, 1 / radii[1], MODULUS, load)
        _, a, b = hertz.hertz_ellipse(table, along, 1 / radii[1], MODULUS, penetration)
        slip = SPEED * np.hypot(*creepages[:2])
        mu = friction_coefficient(slip, 0.35, 0.36, 0.7)
        field = cells(creepages, a, b, load, mu, 16)
        velocity = np.hypot(field.slip_x, field.slip_y) * SPEED
        shown = (field.area > 0) & (velocity > 0.01)
        panel.plot(
            velocity[shown], field.pressure[shown] * 1e-9, marker, color=color, ms=2.6, alpha=0.6,
            mew=0, label=f"{label}",
        )  # fmt: skip
    panel.set(xlim=(0, 1), ylim=(0, 3), xlabel="slip velocity / (m/s)", ylabel="pressure / GPa")
    panel.legend(loc="upper left", markerscale=1.8)
    figure.savefig(folder / "contact_wear_chart.png")


def picture_measured(folder):
    """What the reader makes of a measured file: points, spline, distance."""
    wheel = profiles.s1002_wheel()
    path = folder / "example.txt"
    y = np.arange(-45.0, 50.0, 0.5)
    z = wheel.depth_at(y * 1e-3) * 1e3 + np.random.default_rng(1).normal(0, 0.01, y.size)
    path.write_text("\n".join(f"{a:.4f} {b:.4f}" for a, b in zip(y, z, strict=True)))
    draw_measured(path, "wheel", 0.0095e-3, folder / "contact_measured_profile.png")
    path.unlink()


def draw_measured(path, kind, noise, picture):
    """Picture of one measured file beside its smoothed profile."""
    points = read_points(path)
    profile = measured_profile(path, kind, noise)
    figure, axes = plt.subplots(2, 1, figsize=(4.6, 3.6), height_ratios=(2, 1), sharex=True)
    axes[0].plot(points[:, 0], -points[:, 1], "o", ms=1.8, color=AMBER, label="points of the file")
    axes[0].plot(profile.position * 1e3, -profile.depth * 1e3, color="black", label="spline")
    inside = (points[:, 0] > profile.position[0] * 1e3) & (
        points[:, 0] < profile.position[-1] * 1e3
    )
    y = points[inside, 0]
    off = (points[inside, 1] - profile.depth_at(y * 1e-3) * 1e3) * 1e3
    off -= np.median(off)  # the file's z is zero somewhere else
    off /= np.hypot(1.0, profile.slope_at(y * 1e-3))
    axes[1].plot(y, off, "o", ms=1.8, color=AMBER)
    axes[1].axhline(0.0, color="black", lw=0.8)
    axes[0].set(ylabel="height / mm")
    axes[0].legend()
    axes[1].set(xlabel="position outwards / mm", ylabel="distance / µm")
    figure.savefig(picture)


def picture_yawed_wheel(folder: Path) -> None:
    """Wheel from above and along its axle's plane: axis, normal, and the two parts of the lead."""
    yaw, delta, s, radius = 0.3, 0.75, -0.09, 0.3  # drawn much larger than in a curve
    lead, centre = radius * np.tan(delta) * np.sin(yaw), -s * np.sin(yaw)
    figure, axes = plt.subplots(1, 2, figsize=(7.2, 3.2))
    above, behind = axes
    along = np.array([-0.2, 0.12])
    above.plot(along, -along * np.tan(yaw), color="black", lw=1.0)
    above.text(0.05, -0.035, "axis", rotation=-np.degrees(yaw))
    above.axvline(s, color=GREEN, lw=1.0, ls="--")
    above.text(s + 0.004, -0.03, "rail", color=GREEN)
    above.annotate("", (s, centre), (s, 0.0), arrowprops={"arrowstyle": "->", "color": BLUE})
    above.annotate(
        "", (s, centre + lead), (s, centre), arrowprops={"arrowstyle": "->", "color": RED}
    )
    above.plot([0.0, s, s], [0.0, centre, centre + lead], "o", ms=4, color="black")
    above.text(0.005, 0.006, "wheel's centre")
    above.text(s - 0.006, 0.3 * centre, r"$-s\,\sin\gamma$", color=BLUE, ha="right")
    above.text(
        s - 0.006, centre + 0.5 * lead, r"$r\,\tan\delta\,\sin\gamma$", color=RED, ha="right"
    )
    above.text(s + 0.006, centre + lead, "contact")
    above.plot([0.0, s], [0.0, 0.0], color="black", lw=0.5, ls=":")
    above.text(0.5 * s, -0.016, "$s$", ha="center")
    above.set(xlabel="outwards", ylabel="along the rail", title="from above", aspect="equal")
    behind.plot([-0.42, 0.12], [0.0, 0.0], color="black", lw=1.0)
    behind.plot([s, s - radius * np.tan(delta)], [-radius, 0.0], color=GREEN, lw=1.0, ls="--")
    behind.text(s - 0.12, -0.17, "normal", color=GREEN, ha="right")
    behind.plot([s, s], [0.0, -radius], color=BLUE, lw=1.0)
    behind.text(s + 0.006, -0.15, "$r$", color=BLUE)
    tangent = np.array([-0.06, 0.06])
    behind.plot(s + tangent, -radius - tangent * np.tan(-delta), color="black", lw=2.0)
    behind.text(s + 0.02, -radius - 0.03, r"contact plane, $\delta$")
    behind.plot([0.0, s], [0.0, -radius], "o", ms=4, color="black")
    behind.text(0.005, 0.012, "wheel's centre")
    behind.set(xlabel="outwards", ylabel="up", title="from behind", aspect="equal")
    above.set(ylim=(-0.05, 0.14))
    behind.set(ylim=(-0.38, 0.06))
    for axis in axes:
        axis.set(xticks=[], yticks=[])
    figure.savefig(folder / "yawed_wheel.png")
    plt.close(figure)


def main(folder: Path) -> None:
    """Write all pictures into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    with plt.style.context(ROOT / "paper_figures" / "tramdva.mplstyle"):
        plt.rcParams["savefig.dpi"] = 180
        picture_yawed_wheel(folder)
        picture_profiles(folder)
        picture_geometry(folder)
        picture_patch(folder)
        picture_creep_curves(folder)
        picture_wear(folder)
        picture_measured(folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "figures")
