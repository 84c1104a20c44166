"""The explorer in a real browser: what it shows is what the result files hold."""

import io
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from browser import Watched, chromium, wait_for_value
from figure_scripts import script
from PIL import Image

from tramdva import results
from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.stages import bogie_designs, wheelset_designs
from tramdva.stages.axes import design_axis
from tramdva.variables.registry import STAGES

CONFIG = Path(__file__).resolve().parents[2] / "config"
HOSTILE = '</title><script>window.hacked = 1</script><img src=x onerror="hacked=2"> @data@ $$x^2$$'
WHEELS = ("front_outer", "front_inner")


@pytest.fixture(scope="module")
def wheelset():
    """The wheelset of the paper, coarsely; some designs vibrate by themselves."""
    cfg = used_values(load(CONFIG), "paper", "wheelset_designs")
    cfg["numerics"] = {
        "c_T_points": 9, "d_T_points": 6, "frequency_points": 150, "map_points": 9,
    }  # fmt: skip
    found = wheelset_designs.compute(cfg)
    unstable = found["instability"] != 0
    assert 0 < np.count_nonzero(unstable) < unstable.size
    for name in ("receptance_amplitude", "peak_receptance", "peak_frequency"):
        found[name][unstable] = np.nan  # as if they vibrated without steep friction too
    return found | {"forced_instability": found["instability"]} | wheelset_designs.comparison(found)


def made_up_bogie(wheels=WHEELS, c_T_points=7, stable_below=4e5):
    """Results of a bogie that nobody computed: a bump that moves with the absorber."""
    c_T = design_axis({"min": 3e4, "max": 6e5}, c_T_points, 1.74e5)
    d_T = design_axis({"min": 20.0, "max": 2000.0}, 5, 300.0)
    frequency, w = np.linspace(2.0, 150.0, 149), np.arange(1.0, len(wheels) + 1.0)[:, None]
    growth = np.tile(8.0 * np.log(c_T / stable_below), (d_T.size, 1))
    stable, middle = growth < 0.0, 55.0 * (c_T / 1.74e5)[:, None, None] ** 0.3
    none = 0.02 * w * (np.exp(-(((frequency - 55.0) / 3.0) ** 2)) - 0.4 * np.sin(frequency / 9.0))
    depth = (d_T / 300.0)[:, None, None, None] ** 0.1
    tendency = none - 0.012 * w * depth * np.exp(-(((frequency - middle) / 6.0) ** 2))
    tendency[:, -1:] = np.nan  # no steady wear with the stiffest
    near = (frequency >= 45.0) & (frequency <= 65.0)
    kind = np.where(stable, "stable", "self_excited")
    quiet = np.where(np.arange(c_T.size) == c_T.size - 1, "self_excited", "stable")
    values = {
        "d_T": d_T, "c_T": c_T, "m_T": 2.0, "own_d_T": 300.0, "own_c_T": 1.74e5,
        "wheel": np.array(wheels), "frequency": frequency, "order": frequency / 2.122,
        "growth_rate": growth, "leading_frequency": np.full(growth.shape, 54.7),
        "self_excitation": kind, "quiet_growth_rate": growth - 5.0,
        "quiet_self_excitation": np.tile(quiet, (d_T.size, 1)), "tendency": tendency,
        "none_growth_rate": 0.3, "none_leading_frequency": 54.7,
        "none_self_excitation": "self_excited", "none_quiet_growth_rate": -3.0,
        "none_quiet_self_excitation": "stable", "none_tendency": none, "status": "converged",
        "band_status": np.full(len(wheels), "found"),
        "band_factor": tendency[..., near].max(-1) / none[:, near].max(-1),
        "band_tendency": tendency[..., near].max(-1),
        "none_band_tendency": none[:, near].max(-1),
    }  # fmt: skip
    return values | bogie_designs.comparison(values)


def made_page(folder: Path, wheelset: dict, bogie: dict, label: str = HOSTILE) -> Path:
    cfg = used_values(load(CONFIG), "paper", "explorer") | {"label": label}
    paths = {}
    for name, values in (("wheelset_designs", wheelset), ("bogie_designs", bogie)):
        paths[name] = str(folder / f"{name}.nc")
        results.save(paths[name], STAGES[name], values, parameters={}, code="0" * 20)
    script("explorer").main(page=str(folder / "explorer.html"), code="", cfg=cfg, **paths)
    return folder / "explorer.html"


@pytest.fixture(scope="module")
def page(wheelset, tmp_path_factory) -> Path:
    return made_page(tmp_path_factory.mktemp("explorer"), wheelset, made_up_bogie())


@pytest.fixture(scope="module")
def files(page):
    """Variables of both models as they stand in the files."""
    models = ("wheelset", "bogie")
    return {name: results.read(page.with_name(f"{name}_designs.nc")) for name in models}


@pytest.fixture(scope="module")
def browser():
    with chromium() as found:
        yield found


def opened(browser, page: Path, **size: int) -> Watched:
    watched = Watched(browser, **size)
    watched.tab.goto(page.as_uri())
    watched.tab.wait_for_selector("body[data-ready]", timeout=30_000)
    return watched


@pytest.fixture(scope="module")
def shared(browser, page) -> Watched:
    return opened(browser, page)


@pytest.fixture
def tab(shared):
    """The page with the line's own absorbers chosen."""
    for model in ("wheelset", "bogie"):
        shared.tab.click(f"#{model} .own")
    yield shared.tab
    assert shared.said == []


CURVE = """([model, plot]) =>
    Array.from(explorer[model].plots[plot].get_model_by_name("now").data.y)"""
PLACE = """([model, plot]) => {
    const data = explorer[model].plots[plot].get_model_by_name("place").data;
    return [data.x[0], data.y[0]];
}"""


def curves(tab) -> dict[str, np.ndarray]:
    """The curves of the chosen designs, by plot."""
    plots = [("wheelset", "wheelset_response"), *(("bogie", f"bogie_tendency_{w}") for w in (0, 1))]
    return {
        plot: np.array(tab.evaluate(CURVE, [model, plot]), dtype=float) for model, plot in plots
    }


def cells(tab, model: str) -> list[str]:
    return tab.locator(f"#{model} td.now").all_text_contents()


def stable_place(file: dict, kinds: str) -> tuple[int, int]:
    return tuple(int(k) for k in np.argwhere(file[kinds] == "stable")[0])


def test_page_loads_without_a_word_and_asks_for_nothing(shared, page):
    assert shared.said == []
    assert shared.asked == [page.as_uri()]
    assert shared.tab.locator("#fault").count() == 0
    text = page.read_text(encoding="utf-8")
    assert "http://" not in text.split("<body>")[0]
    assert "default-src 'none'" in text


def test_page_may_not_ask_even_if_it_wanted(tab, shared):
    refused = "fetch('https://example.org').then(() => 'answered', () => 'refused')"
    assert tab.evaluate(refused) == "refused"
    assert any("Content Security Policy" in words for words in shared.said)
    shared.said.clear()


def test_a_label_is_text_whatever_it_holds(tab):
    assert tab.locator(".line").text_content() == HOSTILE
    assert tab.evaluate("window.hacked") is None
    assert tab.title() == f"Absorber explorer: {HOSTILE}"
    assert tab.locator("img").count() == 0


def test_all_plots_are_drawn(tab):
    plots = tab.locator(".plot")
    assert plots.count() == 7
    for k in range(plots.count()):
        picture = np.asarray(Image.open(io.BytesIO(plots.nth(k).screenshot())).convert("RGB"))
        colours, counts = np.unique(picture.reshape(-1, 3), axis=0, return_counts=True)
        assert len(colours) > 30, plots.nth(k).get_attribute("id")
        assert counts.max() < 0.97 * counts.sum()


def test_curves_of_all_designs_are_those_of_the_files(tab, files):
    """To the rounding of the page: 0.05 % of a receptance, 0.3 % of the largest tendency."""
    for model, file in files.items():
        for i, j in np.ndindex(file["d_T"].size, file["c_T"].size):
            tab.evaluate("([model, i, j]) => explorer[model].select(i, j)", [model, i, j])
            shown = curves(tab)
            if model == "wheelset":
                expected = 1e6 * file["receptance_amplitude"][i, j]
                np.testing.assert_allclose(shown["wheelset_response"], expected, rtol=5.1e-4)
            else:
                size = np.abs(file["none_tendency"]).max(axis=1)[:, None]
                for w, expected in enumerate(file["tendency"][i, j] / size):
                    np.testing.assert_allclose(
                        shown[f"bogie_tendency_{w}"], expected, rtol=2.6e-3, atol=1.3e-4
                    )


def test_stability_map_has_the_signs_of_the_file(tab, files):
    file = files["wheelset"]
    for i, j in ((0, 0), (3, 4), (5, 8)):
        tab.evaluate("([i, j]) => explorer.wheelset.select(i, j)", [i, j])
        image = np.array(
            tab.evaluate("""() => Array.from(
                explorer.wheelset.plots.wheelset_stability.get_model_by_name("now").data.image[0])""")
        ).reshape(41, 41)
        growth = file["map_growth_rate"][i, j].T  # (c_A, c_R)
        expected = np.sign(growth) * np.sqrt(np.minimum(np.abs(growth) / 30.0, 1.0))
        np.testing.assert_allclose(image[::5, ::5], expected, rtol=6e-3, atol=2e-3)
        between = 0.5 * (growth[0, 0] + growth[0, 1])
        halfway = 0.5 * (image[0, 2] * abs(image[0, 2]) + image[0, 3] * abs(image[0, 3])) * 30.0
        assert halfway == pytest.approx(between, rel=0.02)


@pytest.mark.parametrize(("model", "other"), [("wheelset", "bogie"), ("bogie", "wheelset")])
@pytest.mark.parametrize("slider", ["c_T", "d_T"])
def test_a_slider_moved_by_keys_changes_its_model_only(tab, files, model, other, slider):
    before, table = curves(tab), {name: cells(tab, name) for name in files}

    tab.focus(f"#{model} .{slider}")
    tab.keyboard.press("ArrowLeft")

    after, file = curves(tab), files[model]
    for plot in after:
        moved = plot.startswith(model)
        assert np.array_equal(before[plot], after[plot]) != moved, plot
    assert cells(tab, other) == table[other]
    assert cells(tab, model) != table[model]
    own = np.argmin(np.abs(file[slider] - file[f"own_{slider}"])) - 1
    chosen = {name: float(file[f"own_{name}"]) for name in ("c_T", "d_T")}
    chosen[slider] = float(file[slider][own])
    omega = np.sqrt(chosen["c_T"] / file["m_T"])
    tuned = tab.locator(f"#{model} .tuned").text_content()
    assert tuned == f"tuned to {omega / 2 / np.pi:.1f} Hz"
    ratio = tab.locator(f"#{model} .ratio").text_content()
    assert ratio == f"damping ratio {chosen['d_T'] / (2 * file['m_T'] * omega):.3f}"
    assert tab.input_value(f"#{model} .{slider}") == str(own)


@pytest.mark.parametrize("model", ["wheelset", "bogie"])
def test_a_slider_moved_by_the_mouse_changes_the_curves(tab, model):
    before = curves(tab)
    slider = tab.locator(f"#{model} .c_T")
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    middle = box["y"] + box["height"] / 2
    tab.mouse.move(box["x"] + box["width"] / 2, middle)
    tab.mouse.down()
    tab.mouse.move(box["x"] + 2, middle, steps=5)
    tab.mouse.up()
    assert slider.input_value() == "0"
    after = curves(tab)
    changed = {plot for plot in after if not np.array_equal(before[plot], after[plot])}
    assert changed == {plot for plot in after if plot.startswith(model)}


def test_a_click_on_a_design_chooses_it(tab, files):
    tab.locator("#wheelset_plane").scroll_into_view_if_needed()
    frame = tab.evaluate("""() => {
        const view = Bokeh.index.get_by_id(explorer.wheelset.data.plots.wheelset_plane.root_id);
        const box = view.el.getBoundingClientRect(), inner = view.frame.bbox;
        return [box.x + inner.left, box.y + inner.top, inner.width, inner.height];
    }""")
    tab.mouse.click(frame[0] + 0.99 * frame[2], frame[1] + 0.99 * frame[3])
    file = files["wheelset"]
    wait_for_value(tab, "#wheelset .c_T", file["c_T"].size - 1)
    assert tab.input_value("#wheelset .d_T") == "0"
    place = tab.evaluate(PLACE, ["wheelset", "wheelset_plane"])
    np.testing.assert_allclose(place, [file["c_T"][-1] / 1e6, file["d_T"][0] / 1e3])


def test_buttons_choose_the_own_and_the_best_design(tab, files):
    tab.click("#wheelset .best")
    tab.click("#bogie .best")
    file = files["wheelset"]
    peak = np.where(file["instability"] == "stable", file["peak_receptance"], np.nan)
    assert cells(tab, "wheelset")[2] == f"{1e6 * np.nanmin(peak):.3f}"
    file = files["bogie"]
    left = np.where(file["self_excitation"][..., None] == "stable", file["band_factor"], np.nan)
    assert max(cells(tab, "bogie")[2:]) == f"{np.nanmin(left.max(axis=-1)):.2f}"
    tab.click("#bogie .own")
    shown = tab.locator("#bogie tbody tr").all()
    for row in shown:
        this, own, _ = row.locator("td").all_text_contents()
        assert this == own


def test_numbers_beside_the_sliders_are_those_of_the_file(tab, files):
    file = files["wheelset"]
    i, j = stable_place(file, "instability")
    tab.evaluate("([i, j]) => explorer.wheelset.select(i, j)", [i, j])
    peak = file["peak_receptance"][i, j]
    none = file["none_peak_receptance"]
    assert cells(tab, "wheelset") == [
        f"{file['growth_rate'][i, j]:+.2f}",
        f"{file['leading_frequency'][i, j]:.1f}",
        f"{1e6 * peak:.3f}",
        f"{file['peak_frequency'][i, j]:.1f}",
        f"{none / peak:.2f}",
    ]
    verdict = tab.locator("#wheelset .verdict")
    assert verdict.text_content() == "Stable: does not vibrate by itself at B = 0.7 s/m"
    assert "good" in verdict.get_attribute("class")


@pytest.mark.parametrize(
    ("model", "steady", "dashes"),
    [("wheelset", "forced_instability", [2, 3, 4]), ("bogie", "quiet_self_excitation", [2, 3])],
)
def test_what_vibrates_by_itself_is_called_so_and_has_no_numbers(tab, files, model, steady, dashes):
    i, j = np.argwhere(files[model][steady] != "stable")[0]
    tab.evaluate("([model, i, j]) => explorer[model].select(i, j)", [model, int(i), int(j)])
    verdict = tab.locator(f"#{model} .verdict")
    assert verdict.text_content() == "Unstable: vibrates by itself at B = 0.7 s/m"
    assert "bad" in verdict.get_attribute("class")
    assert tab.locator(f"#{model} .note").text_content().startswith("No steady")
    shown = cells(tab, model)
    assert [k for k, cell in enumerate(shown) if cell == "–"] == dashes
    for plot, curve in curves(tab).items():
        assert np.isnan(curve).all() == plot.startswith(model)


def test_narrow_page_needs_no_scrolling_sideways(browser, page):
    watched = opened(browser, page, width=390, height=800)
    wide = watched.tab.evaluate("document.scrollingElement.scrollWidth")
    assert wide <= 390
    for plot in watched.tab.locator(".plot").all():
        assert plot.bounding_box()["width"] > 300
    assert watched.said == []


def test_nothing_stable_leaves_no_best_design(browser, wheelset, tmp_path):
    """Four wheels, a bogie that always vibrates, and a wheelset without an equilibrium."""
    wheels = (*WHEELS, "rear_outer", "rear_inner")
    bogie = made_up_bogie(wheels, stable_below=1e3)
    nowhere = dict(wheelset)
    for name, values in wheelset.items():
        if name.endswith("instability"):
            nowhere[name] = np.full(np.shape(values), "no_equilibrium")
        elif name.startswith(("growth", "leading", "receptance", "peak", "map_", "none_")):
            nowhere[name] = np.full(np.shape(values), np.nan)
    nowhere |= wheelset_designs.comparison(nowhere)
    watched = opened(browser, made_page(tmp_path, nowhere, bogie, "A line"))
    tab = watched.tab
    assert tab.locator(".plot").count() == 9
    for model in ("wheelset", "bogie"):
        assert tab.locator(f"#{model} .best").is_disabled()
    verdict = tab.locator("#wheelset .verdict").text_content()
    assert verdict == "There is no steady rolling in this curve"
    assert set(cells(tab, "wheelset")) == {"–"}
    assert watched.said == []


def test_the_same_results_give_the_same_page(page):
    """In processes of their own, as jobs are."""
    again = """
import sys
from pathlib import Path
from figure_scripts import script
from test_explorer import CONFIG, HOSTILE
from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
folder = Path(sys.argv[1])
cfg = used_values(load(CONFIG), "paper", "explorer") | {"label": HOSTILE}
names = ("wheelset_designs", "bogie_designs")
paths = {name: str(folder / f"{name}.nc") for name in names}
script("explorer").main(page=str(folder / sys.argv[2]), code="", cfg=cfg, **paths)
"""
    here = Path(__file__).parent
    for name in ("first.html", "second.html"):
        subprocess.run(
            [sys.executable, "-c", again, str(page.parent), name],
            cwd=here, env=os.environ | {"PYTHONPATH": str(here.parent / "tools")}, check=True,
        )  # fmt: skip
    first, second = (page.with_name(f"{name}.html") for name in ("first", "second"))
    assert first.read_bytes() == second.read_bytes()
    assert 4e5 < page.stat().st_size < 1.5e6
