"""A picture tells what it is of; what is missing, stale or coarse is told."""

from dataclasses import replace
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from tramdva.configuration.reading import Configuration, load
from tramdva.record import origin, run_record, status
from tramdva.record.origin import Origins, of_picture
from tramdva.report import figures, stamp
from tramdva.report.stamp import Stamp

ROOT = Path(__file__).resolve().parents[2]
TABLES = origin.tables_of(ROOT / "Snakefile")


def with_text(folder: Path, name: str, old: str, new: str) -> Configuration:
    path = folder / name
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))
    return load(folder)


def origins(configuration: Configuration) -> dict[str, str]:
    found = Origins(configuration, TABLES, ROOT)
    return {name: found.of("paper", name) for name in TABLES["FIGURES"]}


def changed(before: dict[str, str], after: dict[str, str]) -> set[str]:
    return {name for name in before if before[name] != after[name]}


def test_origin_follows_all_values_behind_a_figure(config_folder: Path) -> None:
    before = origins(load(config_folder))
    worn = origins(
        with_text(config_folder, "lines/paper.yaml", "hardness: 2.7e+9", "hardness: 2e+9")
    )
    assert {"fig10_evolution_tendency", "design_sheet", "explorer"} <= changed(before, worn)
    assert not {"fig02_stability_map", "fig09_curve_entry"} & changed(before, worn)
    label = origins(with_text(config_folder, "lines/paper.yaml", "label: Tram", "label: A tram"))
    assert "fig02_stability_map" in changed(worn, label)
    same = origins(with_text(config_folder, "lines/paper.yaml", "# Table 3", "# table 3"))
    assert changed(label, same) == set()


def test_resolution_is_that_of_the_numerics_behind_a_figure(root: Path) -> None:
    full = Origins(load(root / "config"), TABLES, root)
    coarse = Origins(load(root / "config", [root / "config/quick.yaml"]), TABLES, root)
    finer = load(root / "config", (), {"numerics": {"stability_map": {"points": 61}}})
    one = Origins(finer, TABLES, root)
    for figure in TABLES["FIGURES"]:
        assert full.resolution("paper", figure) == "full"
        expected = "full" if figure == "fig08_bogie" else "coarse"  # drawn from the configuration
        assert coarse.resolution("paper", figure) == expected
    assert one.resolution("paper", "fig02_stability_map") == "coarse"
    assert one.resolution("paper", "fig09_curve_entry") == "full"


def draw(path: Path, resolution: str = "full", made: str = "0123456789ab") -> Figure:
    path.parent.mkdir(parents=True, exist_ok=True)
    with figures.style(ROOT / "paper_figures/tramdva.mplstyle"):
        figure = figures.canvas(figures.SINGLE_COLUMN, 60)
        figure.subplots().plot([0, 1])
        with stamp.shown(Stamp("paper", resolution, made)):
            figures.save(figure, path.with_suffix(".pdf"), path, "title")
    return figure


@pytest.mark.parametrize("resolution", ["full", "coarse"])
def test_pictures_bear_their_stamp(tmp_path: Path, resolution: str) -> None:
    figure = draw(tmp_path / "x.png", resolution)
    (words,) = [text.get_text() for text in figure.texts]

    assert words.endswith(f"paper · tramdva {stamp.version('tramdva')} · 0123456789ab")
    assert words.startswith("COARSE NUMERICS") == (resolution == "coarse")
    assert of_picture(tmp_path / "x.png") == "0123456789ab"
    assert of_picture(tmp_path / "x.png", origin.WORDS) == words
    assert figures.MARK == origin.MARK
    figure.draw_without_rendering()
    (axes,) = figure.axes
    low = axes.get_tightbbox().y0
    assert figure.texts[0].get_window_extent().y1 < low  # below everything else


def test_a_script_by_hand_has_no_stamp(tmp_path: Path) -> None:
    figures.save(figures.canvas(50, 50), tmp_path / "x.pdf", tmp_path / "x.png", "title")
    assert of_picture(tmp_path / "x.png") == ""


def test_pictures_of_other_code_are_told(tmp_path: Path) -> None:
    configuration = load(ROOT / "config", (), {"lines": ["paper"]})
    own = Origins(configuration, TABLES, ROOT)
    for name in ("fig02_stability_map", "fig08_bogie"):
        draw(tmp_path / f"paper/{name}.png", made=own.of("paper", name))
    assert origin.outdated(configuration, tmp_path, ROOT) == []
    other = configuration.lines["paper"].model_copy(update={"label": "Another"})
    relabelled = replace(configuration, lines={"paper": other})
    old = origin.outdated(relabelled, tmp_path, ROOT)
    assert [Path(path).stem for path in old] == ["fig02_stability_map", "fig08_bogie"]


def test_state_of_a_run_is_told_in_lines() -> None:
    found = [
        status.Found("results/a/wear.nc", "a", "current", "", False),
        status.Found("paper_figures/a/x.png", "a", "current", "", True),
        status.Found("results/a/old.nc", "a", "stale", "is out of date (params changed)", False),
        *(
            status.Found(f"results/b/{k}.nc", "b", "missing", "is missing", False)
            for k in range(12)
        ),
    ]
    lines = list(status.told(found, ["paper_figures/paper/fig02.png"]))

    assert lines[:2] == ["a: 2 current, 1 stale (pictures of coarse numerics)", "b: 12 missing"]
    assert "  results/a/old.nc: is out of date (params changed)" in lines
    assert "  and 2 more missing" in lines
    assert lines[-1].startswith("1 pictures of the repository are not of its code")


def test_no_report_beside_other_values(monkeypatch) -> None:
    stale = status.Found("paper_figures/a/x.png", "a", "stale", "is out of date", False)
    monkeypatch.setattr(status, "look", lambda arguments: [stale])
    with pytest.raises(SystemExit, match=r"no report: paper_figures/a/x\.png: is out of date"):
        status.report("report.html", [])


def test_configuration_that_is_wrong_is_told(monkeypatch) -> None:
    def refuse(arguments):
        raise run_record.IncompleteRunError("config/config.yaml: is empty")

    monkeypatch.setattr(status, "look", refuse)
    with pytest.raises(SystemExit, match=r"tramdva: config/config\.yaml: is empty"):
        status.main([])


@pytest.mark.parametrize(
    ("arguments", "folder"),
    [([], "."), (["-d", "x"], "x"), (["-n", "--directory=y"], "y"), (["--directory", "z"], "z")],
)
def test_working_directory_of_arguments(arguments, folder) -> None:
    assert status.directory(arguments) == folder
