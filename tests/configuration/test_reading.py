"""Wrong configurations: all problems at once, a line each, with what is allowed."""

import math
from pathlib import Path

import pytest

from tramdva.configuration.reading import ConfigurationError, load, load_or_exit
from tramdva.configuration.uses import USES, used_values

LABEL = "label: Line x\n"
C_A = "must be between 1e6 and 1e10 N/m (effective stiffness of axle and primary suspension)"
NAME = "must be a name of lower-case letters, digits, - and _, at most 41 of them"


def problems(folder: Path, *files: Path, **overrides) -> list[str]:
    with pytest.raises(ConfigurationError) as caught:
        load(folder, files, overrides)
    return str(caught.value).splitlines()


def write_line(folder: Path, text: str | bytes, name: str = "x") -> None:
    raw = text if isinstance(text, bytes) else text.encode()
    (folder / "lines" / f"{name}.yaml").write_bytes(raw)


def replace_in(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


# What a line says beside its label, and what is said about it.
WRONG_LINES = {
    "wrong unit": ("wheelset: {c_A: 5.2e4}", f"wheelset.c_A = 52000.0: {C_A}"),
    "wrong unit, upwards": ("wheelset: {c_A: 5.2e13}", f"wheelset.c_A = 52000000000000.0: {C_A}"),
    "negative": ("wheelset: {c_A: -5.2e7}", f"wheelset.c_A = -52000000.0: {C_A}"),
    "zero": ("wheelset: {c_A: 0}", f"wheelset.c_A = 0: {C_A}"),
    "not a number": ("wheelset: {c_A: .nan}", f"wheelset.c_A = nan: {C_A}"),
    "infinite": ("wheelset: {c_A: .inf}", f"wheelset.c_A = inf: {C_A}"),
    "minus infinity": ("wheelset: {c_A: -.inf}", f"wheelset.c_A = -inf: {C_A}"),
    "overflow": ("wheelset: {c_A: 1e999}", f"wheelset.c_A = inf: {C_A}"),
    "huge": (f"wheelset: {{c_A: 1{'0' * 400}}}", f"wheelset.c_A = a huge number: {C_A}"),
    "text": ("wheelset: {c_A: stiff}", f'wheelset.c_A = "stiff": {C_A}'),
    "number with unit": ("wheelset: {c_A: 5.2e7 N/m}", f'wheelset.c_A = "5.2e7 N/m": {C_A}'),
    "decimal comma": ('wheelset: {c_A: "5,2e7"}', f'wheelset.c_A = "5,2e7": {C_A}'),
    "truth": ("wheelset: {c_A: yes}", f"wheelset.c_A = true: {C_A}"),
    "nothing": ("wheelset: {c_A: }", f"wheelset.c_A = null: {C_A}"),
    "huge, thousands of digits": (
        f"wheelset: {{c_A: {'1' * 5000}}}",
        f"wheelset.c_A = inf: {C_A}",
    ),
    "expression": ("wheelset: {c_A: 2*3e7}", f'wheelset.c_A = "2*3e7": {C_A}'),
    "Python": ("wheelset: {c_A: int(6e7)}", f'wheelset.c_A = "int(6e7)": {C_A}'),
    "template": ("wheelset: {c_A: '?6*10**7'}", f'wheelset.c_A = "?6*10**7": {C_A}'),
    "hours and minutes": ("wheelset: {c_A: 1:30}", f'wheelset.c_A = "1:30": {C_A}'),
    "hexadecimal": ("wheelset: {c_A: 0x2faf080}", f'wheelset.c_A = "0x2faf080": {C_A}'),
    "date": ("wheelset: {c_A: 2024-13-45}", f'wheelset.c_A = "2024-13-45": {C_A}'),
    "command": ("wheelset: {c_A: $(reboot)}", f'wheelset.c_A = "$(reboot)": {C_A}'),
    "escape sequence as value": (
        'wheelset: {c_A: "\\e[2J"}',
        f'wheelset.c_A = "\\u001b[2J": {C_A}',
    ),
    "escape sequence as key": (
        'wheelset: {"\\x9b2J\\u202E": 1}',
        "wheelset.\\x9b2J\\u202e: unknown key; known here: m_A, m_R, c_A, d_A, c_R, d_R, L",
    ),
    "list": ("wheelset: {c_A: [5.2e7]}", f"wheelset.c_A = [52000000.0]: {C_A}"),
    "map": ("wheelset: {c_A: {value: 5}}", f'wheelset.c_A = {{"value": 5}}: {C_A}'),
    "word that is none of those allowed": (
        "contact_geometry: {creep_law: kalker}",
        'contact_geometry.creep_law = "kalker": must be creep forces by half_space (table of the '
        "elastic half-space) or fastsim",
    ),
    "sign of the angle": (
        "curve: {gamma: 0.04}",
        "curve.gamma = 0.04: must be between -0.2 and -0.001 rad (angle of attack, negative)",
    ),
    "angle in degrees": (
        "curve: {gamma: -2.3}",
        "curve.gamma = -2.3: must be between -0.2 and -0.001 rad (angle of attack, negative)",
    ),
    "radius in mm": (
        "curve: {r_C: 25750}",
        "curve.r_C = 25750: must be between 10 and 2000 m (curve radius at the outer wheel)",
    ),
    "speed in km/h": (
        "curve: {outer_speed: 14.94}",
        "curve: outer_speed^2/r_C = 8.67 m/s^2 must be at most 4 m/s^2 "
        "(outer_speed is in m/s, not km/h)",
    ),
    "force in kN": (
        "creep_force: {F_N: 35}",
        "creep_force.F_N = 35: must be between 1000 and 3e5 N (normal force at the inner wheel)",
    ),
    "semi-axis in mm": (
        "creep_force: {a: 4.2}",
        "creep_force.a = 4.2: must be between 0.0003 and 0.03 m "
        "(semi-axis of the contact patch along the rail)",
    ),
    "modulus in MPa": (
        "creep_force: {G: 82000}",
        "creep_force.G = 82000: must be between 1e10 and 3e11 N/m^2 "
        "(shear modulus of wheel and rail)",
    ),
    "friction above one": (
        "creep_force: {A: 1.2}",
        "creep_force.A = 1.2: must be between 0 and 1 "
        "(ratio of friction coefficients, mu_inf/mu_0)",
    ),
    "mass in t": (
        "wheelset: {m_A: 0.4}",
        "wheelset.m_A = 0.4: must be between 20 and 10000 kg (reduced mass of axle and wheel hub)",
    ),
    "damping in kN s/m": (
        "absorber: {d_T: 6.85}",
        "absorber.d_T = 6.85: must be between 10 and 1e6 N s/m (damping of the absorber)",
    ),
    "absorber heavier than the axle": (
        "absorber: {m_T: 500}",
        "absorber.m_T/wheelset.m_A = 1.25 must be at most 1 (mass ratio mu)",
    ),
    "letter of the wrong case": (
        "wheelset: {c_a: 5.2e7}",
        "wheelset.c_a: unknown key; did you mean wheelset.c_A?",
    ),
    "key of no section": (
        "c_A: 5.2e7",
        "c_A: unknown key; did you mean wheelset.c_A or study.stability_map.c_A or "
        "study.limit_cycles.c_A?",
    ),
    "key of another section": (
        "wheelset: {F_N: 3e4}",
        "wheelset.F_N: unknown key; did you mean creep_force.F_N?",
    ),
    "misspelled section": (
        "wheelsett: {c_A: 5.2e7}",
        "wheelsett: unknown key; did you mean wheelset?",
    ),
    "key like no other": (
        "curve: {cant_deficiency: 0.1}",
        "curve.cant_deficiency: unknown key; known here: r_C, gamma, outer_speed",
    ),
    "numerics in a line": (
        "numerics: {stability_map: {points: 11}}",
        "numerics: unknown key; it belongs in config/config.yaml",
    ),
    "section that is no map": (
        "absorber: 40",
        "absorber = 40: must be a map of keys (The dynamic vibration absorber at the hub)",
    ),
    "empty section": (
        "absorber:",
        "absorber = null: must be a map of keys (The dynamic vibration absorber at the hub)",
    ),
    "no variants": (
        "absorber_variants: []",
        "absorber_variants: must not be empty (absorbers of the stability maps)",
    ),
    "variants that are no list": (
        "absorber_variants: {name: case_1}",
        'absorber_variants = {"name": "case_1"}: must be a list (absorbers of the stability maps)',
    ),
    "variant named none": (
        "absorber_variants: [{name: none, label: a, c_T: 4e7, d_T: 7500}]",
        "absorber_variants: 'none' is the wheelset without absorber: choose another name",
    ),
    "variants of one name": (
        "absorber_variants:\n"
        "  - {name: soft, label: a, c_T: 1e7, d_T: 7500}\n"
        "  - {name: soft, label: b, c_T: 2e7, d_T: 7500}",
        "absorber_variants: soft is given twice",
    ),
    "variant with a path as name": (
        "absorber_variants: [{name: ../soft, label: a, c_T: 4e7, d_T: 7500}]",
        'absorber_variants[0].name = "../soft": must be a name of lower-case letters, digits '
        "and _, the first a letter",
    ),
    "incomplete variant": (
        "absorber_variants: [{name: soft, label: a, c_T: 4e7}]",
        "absorber_variants[0].d_T: missing: must be between 10 and 1e6 N s/m "
        "(damping of the absorber)",
    ),
    "range the wrong way round": (
        "study: {frequency_response: {frequency: {min: 300, max: 30}}}",
        "study.frequency_response.frequency: min must be less than max",
    ),
    "range that meets the paper's": (
        "study: {hopf_curves: {c_A: {min: 1e9}}}",
        "study.hopf_curves.c_A: min must be less than max",
    ),
    "empty list of damping": (
        "study: {hopf_curves: {d_T: []}}",
        "study.hopf_curves.d_T: must not be empty (damping values of the curves)",
    ),
    "damping given twice": (
        "study: {hopf_curves: {d_T: [2500, 7500, 2500.0]}}",
        "study.hopf_curves.d_T: 2500.0 is given twice",
    ),
    "one damping of several": (
        "study: {hopf_curves: {d_T: [2500, 7.5]}}",
        "study.hopf_curves.d_T[1] = 7.5: must be between 10 and 1e6 N s/m "
        "(damping of the absorber, one curve each)",
    ),
    "endless list": (
        f"study: {{hopf_curves: {{d_T: {list(range(100, 200))}}}}}",
        "study.hopf_curves.d_T: must have at most 50 entries",
    ),
}

# A whole file of a line, and what is said about it.
WRONG_FILES = {
    "empty": ("", "is empty: it must hold what differs, at least its label"),
    "only comments": ("# to do\n", "is empty: it must hold what differs, at least its label"),
    "list": ("- wheelset\n", "must be a map of keys (key: value), not a list"),
    "single value": ("wheelset\n", "must be a map of keys (key: value), not a single value"),
    "no label": (
        "wheelset: {c_A: 6e7}\n",
        "label: missing: must be a name for the figures, at most 80 letters",
    ),
    "bracket left open": (
        "label: x\nwheelset: {c_A: 6e7\n",
        "line 3: expected ',' or '}', but got '<stream end>'",
    ),
    "wrong indent": (
        "wheelset:\n  c_A: 6e7\n c_R: 6e7\n",
        "line 3: expected <block end>, but found '<block mapping start>'",
    ),
    "tab": ("wheelset:\n\tc_A: 6e7\n", "line 2: indent with spaces, not tabs"),
    "key twice": (LABEL + "curve:\n  r_C: 30\n  r_C: 40\n", "line 4: the key r_C is given twice"),
    "section twice": (
        LABEL + "curve: {r_C: 30}\ncurve: {gamma: -0.03}\n",
        "line 3: the key curve is given twice",
    ),
    "key that is no text": (LABEL + "1: 2\n", "line 2: the key '1' must be a text"),
    "python tag": (
        "label: !!python/object/apply:os.system [touch pwned]\n",
        "line 1: tags (!...) are not supported",
    ),
    "alias": ("label: &a x\ncurve: *a\n", "line 2: aliases are not supported"),
    "two documents": ("label: x\n---\nlabel: y\n", "line 2: must hold one document only"),
    "not UTF-8": (b"label: Stra\xdfe\n", "line 1: is not UTF-8 text"),
    "too large": (b"#" * 100_001, "is larger than 100000 bytes"),
    "deep list": (f"label: {'[' * 3000}{']' * 3000}\n", "line 1: is nested too deeply"),
    "deep map": ("\n".join(f"{' ' * i}a:" for i in range(300)), "line 31: is nested too deeply"),
    "merge": ("label: x\ncurve: {<<: {r_C: 30}}\n", "line 2: tags (!...) are not supported"),
    "billion laughs": (
        "label: &a [x, x]\ncurve: &b [*a, *a]\ntrack: [*b, *b]\n",
        "line 2: aliases are not supported",
    ),
    "template": (
        "label: x\n__use_yte__: true\n",
        "line 2: the key __use_yte__ is not allowed",
    ),
    "unprintable": ("label: a\x00b\n", "special characters are not allowed"),
}

# A change in config.yaml, and what is said about it.
WRONG_RUNS = {
    "path": ("lines: [../x]", f'lines[0] = "../x": {NAME}'),
    "absolute path": ("lines: [/etc/passwd]", f'lines[0] = "/etc/passwd": {NAME}'),
    "folder": ("lines: [paper/x]", f'lines[0] = "paper/x": {NAME}'),
    "capitals": ("lines: [Paper]", f'lines[0] = "Paper": {NAME}'),
    "empty name": ('lines: [""]', f'lines[0] = "": {NAME}'),
    "hidden file": ("lines: [.x]", f'lines[0] = ".x": {NAME}'),
    "long name": (f"lines: [{'a' * 42}]", f'lines[0] = "{"a" * 42}": {NAME}'),
    "parent": ("lines: [..]", f'lines[0] = "..": {NAME}'),
    "wildcard": ('lines: ["{line}"]', f'lines[0] = "{{line}}": {NAME}'),
    "pattern": ('lines: ["paper|x"]', f'lines[0] = "paper|x": {NAME}'),
    "any name": ('lines: ["*"]', f'lines[0] = "*": {NAME}'),
    "option": ("lines: [-n]", f'lines[0] = "-n": {NAME}'),
    "command": ('lines: ["$(touch x)"]', f'lines[0] = "$(touch x)": {NAME}'),
    "backticks": ('lines: ["`touch x`"]', f'lines[0] = "`touch x`": {NAME}'),
    "quote": ('lines: ["x\'y"]', f'lines[0] = "x\'y": {NAME}'),
    "backslash": ("lines: ['x\\y']", f'lines[0] = "x\\\\y": {NAME}'),
    "control character": ('lines: ["x\\x07"]', f'lines[0] = "x\\u0007": {NAME}'),
    "nothing": ("lines: [~]", f"lines[0] = null: {NAME}"),
    "letters like others": ("lines: [рарег]", f'lines[0] = "рарег": {NAME}'),
    "300 letters": (f"lines: [{'a' * 300}]", f'lines[0] = "{"a" * 56}...: {NAME}'),
    "device": (
        "lines: [nul]",
        'lines[0] = "nul": is the name of a device on Windows: choose another name',
    ),
    "line break": ('lines: ["paper\\n"]', f'lines[0] = "paper\\n": {NAME}'),
    "number": ("lines: [1]", f"lines[0] = 1: {NAME}"),
    "unknown line": (
        "lines: [papr]",
        "lines[0] = papr: there is no config/lines/papr.yaml; did you mean paper?",
    ),
    "quite unknown line": (
        "lines: [paper, zzz]",
        "lines[1] = zzz: there is no config/lines/zzz.yaml; there are: paper, worn-40m",
    ),
    "line twice": ("lines: [paper, paper]", "lines: paper is given twice"),
    "no lines": (
        "lines: []",
        "lines: must not be empty (names of files in config/lines, without .yaml)",
    ),
    "lines that are no list": (
        "lines: paper",
        'lines = "paper": must be a list (names of files in config/lines, without .yaml)',
    ),
    "misspelled lines": ("line: [paper]", "line: unknown key; did you mean lines?"),
    "physics in the run": (
        "lines: [paper]\nwheelset: {c_A: 6e7}",
        "wheelset: unknown key; it belongs in config/lines/<line>.yaml",
    ),
}


@pytest.mark.refuses
@pytest.mark.parametrize("case", WRONG_LINES)
def test_wrong_line(config_folder: Path, case: str) -> None:
    text, problem = WRONG_LINES[case]
    write_line(config_folder, f"{LABEL}{text}\n")

    assert problems(config_folder, lines=["x"]) == [f"config/lines/x.yaml: {problem}"]


@pytest.mark.refuses
@pytest.mark.parametrize("case", WRONG_FILES)
def test_wrong_file(config_folder: Path, case: str) -> None:
    text, problem = WRONG_FILES[case]
    write_line(config_folder, text)

    assert problems(config_folder, lines=["x"]) == [f"config/lines/x.yaml: {problem}"]


LABELS = {
    "line break": '"a\\nb"',
    "escape sequence": '"\\e[2J"',
    "reversed": '"\\u202Ea"',
    "carriage return": '"a\\rb"',
}


@pytest.mark.refuses
@pytest.mark.parametrize("case", LABELS)
def test_label_is_one_printable_line(config_folder: Path, case: str) -> None:
    write_line(config_folder, f"label: {LABELS[case]}\n")

    (problem,) = problems(config_folder, lines=["x"])

    assert problem.startswith("config/lines/x.yaml: label = ")
    assert problem.endswith(": must be one line of printable letters")
    assert problem.isprintable()


@pytest.mark.parametrize("written", ["0700", "1_000", "+7e2"])
def test_numbers_are_decimal(config_folder: Path, written: str) -> None:
    write_line(config_folder, f"{LABEL}wheelset: {{d_A: {written}}}\n")
    loaded = load(config_folder, overrides={"lines": ["x"]})

    assert loaded.lines["x"].wheelset.d_A == {"1_000": 1000.0}.get(written, 700.0)


@pytest.mark.refuses
@pytest.mark.parametrize("case", WRONG_RUNS)
def test_wrong_run(config_folder: Path, case: str) -> None:
    text, problem = WRONG_RUNS[case]
    replace_in(config_folder / "config.yaml", "lines: [paper, worn-40m]", text)

    assert f"config/config.yaml: {problem}" in problems(config_folder)


def test_wrong_numerics(config_folder: Path) -> None:
    replace_in(config_folder / "config.yaml", "points: 201", "points: 201.5")
    replace_in(config_folder / "config.yaml", "max_iterations: 20", "max_iteration: 20")

    assert problems(config_folder) == [
        "config/config.yaml: numerics.stability_map.points = 201.5: must be a whole number "
        "between 5 and 5001 (grid points per axis)",
        "config/config.yaml: numerics.hopf_points.max_iterations: missing: must be a whole "
        "number between 3 and 1000 (largest number of Newton steps)",
        "config/config.yaml: numerics.hopf_points.max_iteration: unknown key; did you mean "
        "numerics.hopf_points.max_iterations?",
    ]


def test_all_problems_of_all_files_at_once(config_folder: Path) -> None:
    replace_in(config_folder / "config.yaml", "points: 201", "points: many")
    replace_in(config_folder / "lines/paper.yaml", "r_C: 25.75", "r_C: 2.575")
    write_line(config_folder, LABEL + "wheelset: {c_A: 1}\n")
    write_line(config_folder, "- y\n", "y")

    assert problems(config_folder, lines=["x", "paper", "y", "z"]) == [
        'config/config.yaml: numerics.stability_map.points = "many": must be a whole number '
        "between 5 and 5001 (grid points per axis)",
        "config/lines/paper.yaml: curve.r_C = 2.575: must be between 10 and 2000 m "
        "(curve radius at the outer wheel)",
        f"config/lines/x.yaml: wheelset.c_A = 1: {C_A}",
        "config/lines/y.yaml: must be a map of keys (key: value), not a list",
        "--config: lines[3] = z: there is no config/lines/z.yaml; there are: paper, worn-40m, x, y",
    ]


def test_missing_files(config_folder: Path) -> None:
    (config_folder / "lines/paper.yaml").unlink()
    (config_folder / "config.yaml").unlink()

    assert problems(config_folder) == [
        "config/config.yaml: cannot be read: no such file or directory",
        "config/lines/paper.yaml: cannot be read: no such file or directory",
    ]


def test_missing_key_of_the_paper(config_folder: Path) -> None:
    replace_in(config_folder / "lines/paper.yaml", "  c_A: 5.2e+7 # Table 1\n", "")

    assert problems(config_folder) == [f"config/lines/paper.yaml: wheelset.c_A: missing: {C_A}"]


def test_further_file_is_named(config_folder: Path, tmp_path: Path) -> None:
    finer = tmp_path / "finer.yaml"
    finer.write_text("numerics: {stability_map: {points: 1e9}}\n")

    assert problems(config_folder, finer) == [
        "finer.yaml: numerics.stability_map.points = 1000000000.0: must be a whole number "
        "between 5 and 5001 (grid points per axis)"
    ]


def test_program_ends_with_the_problems_alone(config_folder: Path) -> None:
    with pytest.raises(SystemExit) as ended:
        load_or_exit(config_folder, overrides={"lines": ["zzz"]})

    assert ended.value.code == (
        "--config: lines[0] = zzz: there is no config/lines/zzz.yaml; there are: paper, worn-40m"
    )


def test_uppermost_value_counts(config_folder: Path, root: Path) -> None:
    loaded = load(
        config_folder,
        [root / "config/quick.yaml"],
        {"numerics": {"limit_cycles": {"degree": "5"}}},
    )

    assert loaded.run.numerics.stability_map.points == 41
    assert loaded.run.numerics.limit_cycles.degree == 5
    assert loaded.run.numerics.limit_cycles.max_orbits == 400


def test_line_merges_maps_and_replaces_lists(config_folder: Path) -> None:
    write_line(config_folder, LABEL + "wheelset: {c_A: 6e7}\nstudy: {hopf_curves: {d_T: [900]}}\n")

    x = load(config_folder, overrides={"lines": ["x"]}).lines["x"]

    assert x.label == "Line x"
    assert x.wheelset.c_A == 6.0e7
    assert x.wheelset.c_R == 4.9e7
    assert x.study.hopf_curves.d_T == (900.0,)
    assert x.study.hopf_curves.c_A.max == 2.5e8


@pytest.mark.parametrize("written", ["60000000", "6e7", "6.0e+7", "6E7", '"6e7"', "0.6e8", "+6e7"])
def test_notation_of_a_number_does_not_matter(config_folder: Path, written: str) -> None:
    write_line(config_folder, f"{LABEL}wheelset: {{c_A: {written}}}\n")
    loaded = load(config_folder, overrides={"lines": ["x"]})

    value = used_values(loaded, "x", "stability_map")["wheelset"]["c_A"]

    assert repr(value) == "60000000.0"


def test_stage_has_its_own_entries_only(config_folder: Path) -> None:
    loaded = load(config_folder)

    values = used_values(loaded, "paper", "absorber_tuning")

    assert set(values) == {
        "curve", "creep_force", "wheelset", "absorber", "forced_excitation", "study", "numerics",
    }  # fmt: skip
    assert values["forced_excitation"] == {"B": 0.4}
    assert values["study"] == {"frequency": {"min": 1.0, "max": 300.0}}
    assert values["numerics"] == {"frequency_points": 2000}


def test_stage_gets_variants_without_labels(config_folder: Path) -> None:
    values = used_values(load(config_folder), "paper", "stability_map")

    assert values["absorber"] == {"m_T": 40.0}
    assert values["absorber_variants"][0] == {"name": "case_1", "c_T": 4.0e7, "d_T": 7500.0}
    assert values["numerics"] == {"points": 201}


def _plain(value: object) -> bool:
    if isinstance(value, dict):
        return all(type(key) is str and _plain(item) for key, item in value.items())
    if isinstance(value, list):
        return all(_plain(item) for item in value)
    return type(value) in (str, int) or (type(value) is float and math.isfinite(value))


@pytest.mark.parametrize("name", USES)
def test_stage_gives_plain_values(config_folder: Path, name: str) -> None:
    assert _plain(used_values(load(config_folder), "paper", name))


def test_order_of_keys_does_not_matter(config_folder: Path) -> None:
    write_line(config_folder, LABEL + "curve: {gamma: -0.03, r_C: 26}\n", "x")
    write_line(config_folder, "curve: {r_C: 26, gamma: -0.03}\n" + LABEL, "y")
    loaded = load(config_folder, overrides={"lines": ["x", "y"]})

    x, y = (used_values(loaded, line, "stability_map") for line in ("x", "y"))

    assert repr(x) == repr(y)
