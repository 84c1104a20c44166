"""The paper's table of contents: one rule per stage, one per figure, in the paper's order."""

from functools import partial
from pathlib import Path

from tramdva import inventory, job, measured_files, supervision
from tramdva.config import load_or_exit, stage
from tramdva.provenance import code_hash, compile_kernels_once, use_numba_cache

ROOT = Path(workflow.current_basedir)
SCRIPTS = ROOT / "workflow/scripts"
FIGURES = ROOT / "paper_figures"
STYLE = FIGURES / "tramdva.mplstyle"
OWN_CONFIG = Path("config/config.yaml").is_file()

settings = workflow.config_settings
configuration = load_or_exit(
    Path("config") if OWN_CONFIG else ROOT / "config",
    settings.configfiles,
    settings.config,
)
LINES = configuration.run.lines
ORDERS = configuration.run.numerics.evolution_tendency.orders.listed()
ABSORBERS = {
    name: line.study.evolution_tendency.absorbers
    for name, line in configuration.lines.items()
}
PARTS = range(configuration.run.numerics.robustness_sample.parts)
values = partial(stage, configuration)
use_numba_cache()
if workflow.is_main_process:
    measured_files.check_or_exit(configuration.measured)
if supervision.enter_folder(as_job=not workflow.is_main_process):
    inventory.take_back_dates("results", "paper_figures", "logs")
    inventory.set_aside_unusable(configuration, SCRIPTS)


report: "workflow/report/workflow.rst"


wildcard_constraints:
    line="|".join(LINES),
    absorber="none|paper|tuned",
    order="[0-9]+",
    part="[0-9]+",


onstart:
    supervision.begin_run("results", "paper_figures", "logs")
    compile_kernels_once()
    print(
        f"tramdva: {', '.join(LINES)}; numbers in results/, figures in paper_figures/"
    )


onsuccess:
    print(job.summary(LINES))


onerror:
    print(
        "tramdva: not all results are complete; logs/<line>/<stage>.log says why."
    )
    print(
        "A job that died of SIGKILL was killed from outside, mostly for want of memory."
    )


STAGES = [
    "stability_map",
    "hopf_points",
    "limit_cycles",
    "hopf_curves",
    "critical_hopf_curve",
    "cycle_amplitudes",
    "absorber_tuning",
    "frequency_response",
    "contact_geometry",
    "curving_equilibrium",
    "bogie_modes",
    "curve_entry",
    "evolution_tendency",
    "tendency_maps",
    "wheelset_designs",
    "bogie_designs",
    "robust_tuning",
]
PER_ABSORBER = "results/{line}/bogie_linearisation/{absorber}.nc"
PER_ORDER = [
    "results/{line}/bogie_simulation/{absorber}/order_{order}.nc",
    "results/{line}/wear/{absorber}/order_{order}.nc",
]
PER_PART = "results/{line}/robustness_sample/part_{part}.nc"
PICTURES = [
    "fig02_stability_map",
    "fig03_bifurcation_diagram",
    "fig04_hopf_curves",
    "fig05_critical_hopf_curve",
    "fig06_cycle_amplitudes",
    "fig07_frequency_response",
    "fig08_bogie",
    "fig09_curve_entry",
    "bogie_mode_shapes",
    "bogie_stability",
    "campbell_chart",
    "fig10_evolution_tendency",
    "worn_wheels",
    "order_speed_chart",
    "tendency_design_chart",
]
TABLES = ["table2_absorber_designs", "table_absorber_effect"]
EXPLORER = [FIGURES / f"explorer.{kind}" for kind in ("html", "css", "js")]
SHEET = ["pdf", "html"]


rule all:
    input:
        expand("results/{line}/{stage}.nc", line=LINES, stage=STAGES),
        [expand(PER_ABSORBER, line=x, absorber=ABSORBERS[x]) for x in LINES],
        [expand(PER_ORDER, line=x, absorber=ABSORBERS[x], order=ORDERS) for x in LINES],
        expand(PER_PART, line=LINES, part=PARTS),
        expand("paper_figures/{line}/{figure}.pdf", line=LINES, figure=PICTURES),
        expand("paper_figures/{line}/{figure}.png", line=LINES, figure=PICTURES),
        expand("paper_figures/{line}/{table}.csv", line=LINES, table=TABLES),
        expand("paper_figures/{line}/{table}.html", line=LINES, table=TABLES),
        expand("paper_figures/{line}/explorer.html", line=LINES),
        expand("paper_figures/{line}/design_sheet.{kind}", line=LINES, kind=SHEET),
    message:
        "all numbers, figures and tables"


rule stability_map:
    output:
        "results/{line}/stability_map.nc",
    log:
        "logs/{line}/stability_map.log",
    benchmark:
        "logs/{line}/stability_map.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "stability_map"),
        code=code_hash(SCRIPTS / "stability_map.py"),
    message:
        "{wildcards.line}: stability maps (figure 2)"
    script:
        "workflow/scripts/stability_map.py"


rule hopf_points:
    input:
        stability_map=rules.stability_map.output[0],
    output:
        "results/{line}/hopf_points.nc",
    log:
        "logs/{line}/hopf_points.log",
    benchmark:
        "logs/{line}/hopf_points.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "hopf_points"),
        code=code_hash(SCRIPTS / "hopf_points.py"),
    message:
        "{wildcards.line}: Hopf points (figure 3)"
    script:
        "workflow/scripts/hopf_points.py"


rule limit_cycles:
    input:
        hopf_points=rules.hopf_points.output[0],
    output:
        "results/{line}/limit_cycles.nc",
    log:
        "logs/{line}/limit_cycles.log",
    benchmark:
        "logs/{line}/limit_cycles.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "limit_cycles"),
        code=code_hash(SCRIPTS / "limit_cycles.py"),
    message:
        "{wildcards.line}: limit cycles (figure 3)"
    script:
        "workflow/scripts/limit_cycles.py"


rule hopf_curves:
    output:
        "results/{line}/hopf_curves.nc",
    log:
        "logs/{line}/hopf_curves.log",
    benchmark:
        "logs/{line}/hopf_curves.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "hopf_curves"),
        code=code_hash(SCRIPTS / "hopf_curves.py"),
    message:
        "{wildcards.line}: Hopf curves (figure 4)"
    script:
        "workflow/scripts/hopf_curves.py"


rule critical_hopf_curve:
    input:
        hopf_curves=rules.hopf_curves.output[0],
    output:
        "results/{line}/critical_hopf_curve.nc",
    log:
        "logs/{line}/critical_hopf_curve.log",
    benchmark:
        "logs/{line}/critical_hopf_curve.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "critical_hopf_curve"),
        code=code_hash(SCRIPTS / "critical_hopf_curve.py"),
    message:
        "{wildcards.line}: critical Hopf curve (figure 5)"
    script:
        "workflow/scripts/critical_hopf_curve.py"


rule cycle_amplitudes:
    input:
        critical_hopf_curve=rules.critical_hopf_curve.output[0],
    output:
        "results/{line}/cycle_amplitudes.nc",
    log:
        "logs/{line}/cycle_amplitudes.log",
    benchmark:
        "logs/{line}/cycle_amplitudes.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "cycle_amplitudes"),
        code=code_hash(SCRIPTS / "cycle_amplitudes.py"),
    message:
        "{wildcards.line}: cycle amplitudes (figure 6)"
    script:
        "workflow/scripts/cycle_amplitudes.py"


rule absorber_tuning:
    input:
        critical_hopf_curve=rules.critical_hopf_curve.output[0],
    output:
        "results/{line}/absorber_tuning.nc",
    log:
        "logs/{line}/absorber_tuning.log",
    benchmark:
        "logs/{line}/absorber_tuning.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "absorber_tuning"),
        code=code_hash(SCRIPTS / "absorber_tuning.py"),
    message:
        "{wildcards.line}: designs of the absorber (Table 2)"
    script:
        "workflow/scripts/absorber_tuning.py"


rule frequency_response:
    input:
        absorber_tuning=rules.absorber_tuning.output[0],
    output:
        "results/{line}/frequency_response.nc",
    log:
        "logs/{line}/frequency_response.log",
    benchmark:
        "logs/{line}/frequency_response.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "frequency_response"),
        code=code_hash(SCRIPTS / "frequency_response.py"),
    message:
        "{wildcards.line}: frequency response (figure 7)"
    script:
        "workflow/scripts/frequency_response.py"


rule contact_geometry:
    output:
        "results/{line}/contact_geometry.nc",
    log:
        "logs/{line}/contact_geometry.log",
    benchmark:
        "logs/{line}/contact_geometry.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "contact_geometry"),
        code=code_hash(SCRIPTS / "contact_geometry.py"),
    message:
        "{wildcards.line}: contact tables of the profiles"
    script:
        "workflow/scripts/contact_geometry.py"


rule curving_equilibrium:
    input:
        contact_geometry=rules.contact_geometry.output[0],
        absorber_tuning=rules.absorber_tuning.output[0],
    output:
        "results/{line}/curving_equilibrium.nc",
    log:
        "logs/{line}/curving_equilibrium.log",
    benchmark:
        "logs/{line}/curving_equilibrium.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "curving_equilibrium"),
        code=code_hash(SCRIPTS / "curving_equilibrium.py"),
    message:
        "{wildcards.line}: steady curving of the bogie"
    script:
        "workflow/scripts/curving_equilibrium.py"


rule bogie_modes:
    input:
        contact_geometry=rules.contact_geometry.output[0],
        curving_equilibrium=rules.curving_equilibrium.output[0],
    output:
        "results/{line}/bogie_modes.nc",
    log:
        "logs/{line}/bogie_modes.log",
    benchmark:
        "logs/{line}/bogie_modes.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "bogie_modes"),
        code=code_hash(SCRIPTS / "bogie_modes.py"),
    message:
        "{wildcards.line}: modes of the bogie"
    script:
        "workflow/scripts/bogie_modes.py"


rule curve_entry:
    input:
        contact_geometry=rules.contact_geometry.output[0],
        curving_equilibrium=rules.curving_equilibrium.output[0],
    output:
        "results/{line}/curve_entry.nc",
    log:
        "logs/{line}/curve_entry.log",
    benchmark:
        "logs/{line}/curve_entry.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "curve_entry"),
        code=code_hash(SCRIPTS / "curve_entry.py"),
    message:
        "{wildcards.line}: ride into the curve (figure 9)"
    script:
        "workflow/scripts/curve_entry.py"


rule bogie_linearisation:
    input:
        contact_geometry=rules.contact_geometry.output[0],
        curving_equilibrium=branch(
            lambda w: w.absorber == "tuned", then=rules.curving_equilibrium.output[0]
        ),
    output:
        PER_ABSORBER,
    log:
        "logs/{line}/bogie_linearisation/{absorber}.log",
    benchmark:
        "logs/{line}/bogie_linearisation/{absorber}.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, f"bogie_linearisation_{w.absorber}"),
        code=code_hash(SCRIPTS / "bogie_linearisation.py"),
    message:
        "{wildcards.line}: bogie on wheels out of round, absorber {wildcards.absorber}"
    script:
        "workflow/scripts/bogie_linearisation.py"


rule bogie_simulation:
    input:
        contact_geometry=rules.contact_geometry.output[0],
        bogie_linearisation=rules.bogie_linearisation.output[0],
    output:
        PER_ORDER[0],
    log:
        "logs/{line}/bogie_simulation/{absorber}/order_{order}.log",
    benchmark:
        "logs/{line}/bogie_simulation/{absorber}/order_{order}.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "bogie_simulation"),
        code=code_hash(SCRIPTS / "bogie_simulation.py"),
    message:
        "{wildcards.line}: order {wildcards.order}, absorber {wildcards.absorber}"
    script:
        "workflow/scripts/bogie_simulation.py"


rule wear:
    input:
        bogie_simulation=rules.bogie_simulation.output[0],
    output:
        PER_ORDER[1],
    log:
        "logs/{line}/wear/{absorber}/order_{order}.log",
    benchmark:
        "logs/{line}/wear/{absorber}/order_{order}.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "wear"),
        code=code_hash(SCRIPTS / "wear.py"),
    message:
        "{wildcards.line}: wear by order {wildcards.order}, absorber {wildcards.absorber}"
    script:
        "workflow/scripts/wear.py"


rule evolution_tendency:
    input:
        bogie_linearisation=lambda w: expand(
            PER_ABSORBER, line=w.line, absorber=ABSORBERS[w.line]
        ),
        wear=lambda w: expand(
            PER_ORDER[1], line=w.line, absorber=ABSORBERS[w.line], order=ORDERS
        ),
    output:
        "results/{line}/evolution_tendency.nc",
    log:
        "logs/{line}/evolution_tendency.log",
    benchmark:
        "logs/{line}/evolution_tendency.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "evolution_tendency"),
        code=code_hash(SCRIPTS / "evolution_tendency.py"),
    message:
        "{wildcards.line}: evolution tendency (figure 10)"
    script:
        "workflow/scripts/evolution_tendency.py"


rule tendency_maps:
    input:
        contact_geometry=rules.contact_geometry.output[0],
        bogie_linearisation=lambda w: expand(
            PER_ABSORBER, line=w.line, absorber=ABSORBERS[w.line]
        ),
    output:
        "results/{line}/tendency_maps.nc",
    log:
        "logs/{line}/tendency_maps.log",
    benchmark:
        "logs/{line}/tendency_maps.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "tendency_maps"),
        code=code_hash(SCRIPTS / "tendency_maps.py"),
    message:
        "{wildcards.line}: tendency over speed, radius and absorber"
    script:
        "workflow/scripts/tendency_maps.py"


rule wheelset_designs:
    output:
        "results/{line}/wheelset_designs.nc",
    log:
        "logs/{line}/wheelset_designs.log",
    benchmark:
        "logs/{line}/wheelset_designs.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "wheelset_designs"),
        code=code_hash(SCRIPTS / "wheelset_designs.py"),
    message:
        "{wildcards.line}: the wheelset with any absorber"
    script:
        "workflow/scripts/wheelset_designs.py"


rule bogie_designs:
    input:
        contact_geometry=rules.contact_geometry.output[0],
    output:
        "results/{line}/bogie_designs.nc",
    log:
        "logs/{line}/bogie_designs.log",
    benchmark:
        "logs/{line}/bogie_designs.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "bogie_designs"),
        code=code_hash(SCRIPTS / "bogie_designs.py"),
    message:
        "{wildcards.line}: the bogie with any absorber"
    script:
        "workflow/scripts/bogie_designs.py"


rule robustness_sample:
    input:
        contact_geometry=rules.contact_geometry.output[0],
    output:
        PER_PART,
    log:
        "logs/{line}/robustness_sample/part_{part}.log",
    benchmark:
        "logs/{line}/robustness_sample/part_{part}.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "robustness_sample"),
        code=code_hash(SCRIPTS / "robustness_sample.py"),
    message:
        "{wildcards.line}: bogie under varied conditions, part {wildcards.part}"
    script:
        "workflow/scripts/robustness_sample.py"


rule robust_tuning:
    input:
        robustness_sample=lambda w: expand(PER_PART, line=w.line, part=PARTS),
    output:
        "results/{line}/robust_tuning.nc",
    log:
        "logs/{line}/robust_tuning.log",
    benchmark:
        "logs/{line}/robust_tuning.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "robust_tuning"),
        code=code_hash(SCRIPTS / "robust_tuning.py"),
    message:
        "{wildcards.line}: nominal and robust optimum of the absorber"
    script:
        "workflow/scripts/robust_tuning.py"


rule fig02_stability_map:
    input:
        stability_map=rules.stability_map.output[0],
    output:
        pdf="paper_figures/{line}/fig02_stability_map.pdf",
        png=report(
            "paper_figures/{line}/fig02_stability_map.png",
            category="Stability",
            caption="workflow/report/fig02.rst",
            labels={"line": "{line}", "shows": "Figure 2"},
        ),
    log:
        "logs/{line}/fig02_stability_map.log",
    benchmark:
        "logs/{line}/fig02_stability_map.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "fig02_stability_map"),
        code=code_hash(FIGURES / "fig02_stability_map.py", STYLE),
    message:
        "{wildcards.line}: figure 2"
    script:
        "paper_figures/fig02_stability_map.py"


rule fig03_bifurcation_diagram:
    input:
        hopf_points=rules.hopf_points.output[0],
        limit_cycles=rules.limit_cycles.output[0],
    output:
        pdf="paper_figures/{line}/fig03_bifurcation_diagram.pdf",
        png=report(
            "paper_figures/{line}/fig03_bifurcation_diagram.png",
            category="Self-excited vibrations",
            caption="workflow/report/fig03.rst",
            labels={"line": "{line}", "shows": "Figure 3"},
        ),
    log:
        "logs/{line}/fig03_bifurcation_diagram.log",
    benchmark:
        "logs/{line}/fig03_bifurcation_diagram.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "fig03_bifurcation_diagram"),
        code=code_hash(FIGURES / "fig03_bifurcation_diagram.py", STYLE),
    message:
        "{wildcards.line}: figure 3"
    script:
        "paper_figures/fig03_bifurcation_diagram.py"


rule fig04_hopf_curves:
    input:
        hopf_curves=rules.hopf_curves.output[0],
        critical_hopf_curve=rules.critical_hopf_curve.output[0],
    output:
        pdf="paper_figures/{line}/fig04_hopf_curves.pdf",
        png=report(
            "paper_figures/{line}/fig04_hopf_curves.png",
            category="Self-excited vibrations",
            caption="workflow/report/fig04.rst",
            labels={"line": "{line}", "shows": "Figure 4"},
        ),
    log:
        "logs/{line}/fig04_hopf_curves.log",
    benchmark:
        "logs/{line}/fig04_hopf_curves.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "fig04_hopf_curves"),
        code=code_hash(FIGURES / "fig04_hopf_curves.py", STYLE),
    message:
        "{wildcards.line}: figure 4"
    script:
        "paper_figures/fig04_hopf_curves.py"


rule fig05_critical_hopf_curve:
    input:
        critical_hopf_curve=rules.critical_hopf_curve.output[0],
    output:
        pdf="paper_figures/{line}/fig05_critical_hopf_curve.pdf",
        png=report(
            "paper_figures/{line}/fig05_critical_hopf_curve.png",
            category="Self-excited vibrations",
            caption="workflow/report/fig05.rst",
            labels={"line": "{line}", "shows": "Figure 5"},
        ),
    log:
        "logs/{line}/fig05_critical_hopf_curve.log",
    benchmark:
        "logs/{line}/fig05_critical_hopf_curve.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "fig05_critical_hopf_curve"),
        code=code_hash(FIGURES / "fig05_critical_hopf_curve.py", STYLE),
    message:
        "{wildcards.line}: figure 5"
    script:
        "paper_figures/fig05_critical_hopf_curve.py"


rule fig06_cycle_amplitudes:
    input:
        critical_hopf_curve=rules.critical_hopf_curve.output[0],
        cycle_amplitudes=rules.cycle_amplitudes.output[0],
    output:
        pdf="paper_figures/{line}/fig06_cycle_amplitudes.pdf",
        png=report(
            "paper_figures/{line}/fig06_cycle_amplitudes.png",
            category="Self-excited vibrations",
            caption="workflow/report/fig06.rst",
            labels={"line": "{line}", "shows": "Figure 6"},
        ),
    log:
        "logs/{line}/fig06_cycle_amplitudes.log",
    benchmark:
        "logs/{line}/fig06_cycle_amplitudes.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "fig06_cycle_amplitudes"),
        code=code_hash(FIGURES / "fig06_cycle_amplitudes.py", STYLE),
    message:
        "{wildcards.line}: figure 6"
    script:
        "paper_figures/fig06_cycle_amplitudes.py"


rule fig07_frequency_response:
    input:
        frequency_response=rules.frequency_response.output[0],
        absorber_tuning=rules.absorber_tuning.output[0],
    output:
        pdf="paper_figures/{line}/fig07_frequency_response.pdf",
        png=report(
            "paper_figures/{line}/fig07_frequency_response.png",
            category="Forced vibrations",
            caption="workflow/report/fig07.rst",
            labels={"line": "{line}", "shows": "Figure 7"},
        ),
    log:
        "logs/{line}/fig07_frequency_response.log",
    benchmark:
        "logs/{line}/fig07_frequency_response.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "fig07_frequency_response"),
        code=code_hash(FIGURES / "fig07_frequency_response.py", STYLE),
    message:
        "{wildcards.line}: figure 7"
    script:
        "paper_figures/fig07_frequency_response.py"


rule fig08_bogie:
    output:
        pdf="paper_figures/{line}/fig08_bogie.pdf",
        png=report(
            "paper_figures/{line}/fig08_bogie.png",
            category="Bogie",
            caption="workflow/report/fig08.rst",
            labels={"line": "{line}", "shows": "Figure 8"},
        ),
    log:
        "logs/{line}/fig08_bogie.log",
    benchmark:
        "logs/{line}/fig08_bogie.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "fig08_bogie"),
        code=code_hash(FIGURES / "fig08_bogie.py", STYLE),
    message:
        "{wildcards.line}: figure 8"
    script:
        "paper_figures/fig08_bogie.py"


rule fig09_curve_entry:
    input:
        curve_entry=rules.curve_entry.output[0],
        bogie_modes=rules.bogie_modes.output[0],
    output:
        pdf="paper_figures/{line}/fig09_curve_entry.pdf",
        png=report(
            "paper_figures/{line}/fig09_curve_entry.png",
            category="Bogie",
            caption="workflow/report/fig09.rst",
            labels={"line": "{line}", "shows": "Figure 9"},
        ),
    log:
        "logs/{line}/fig09_curve_entry.log",
    benchmark:
        "logs/{line}/fig09_curve_entry.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "fig09_curve_entry"),
        code=code_hash(FIGURES / "fig09_curve_entry.py", STYLE),
    message:
        "{wildcards.line}: figure 9"
    script:
        "paper_figures/fig09_curve_entry.py"


rule bogie_mode_shapes:
    input:
        bogie_modes=rules.bogie_modes.output[0],
    output:
        pdf="paper_figures/{line}/bogie_mode_shapes.pdf",
        png=report(
            "paper_figures/{line}/bogie_mode_shapes.png",
            category="Bogie",
            caption="workflow/report/bogie_mode_shapes.rst",
            labels={"line": "{line}", "shows": "Mode shapes"},
        ),
    log:
        "logs/{line}/bogie_mode_shapes.log",
    benchmark:
        "logs/{line}/bogie_mode_shapes.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "bogie_mode_shapes"),
        code=code_hash(FIGURES / "bogie_mode_shapes.py", STYLE),
    message:
        "{wildcards.line}: mode shapes of the front axle"
    script:
        "paper_figures/bogie_mode_shapes.py"


rule bogie_stability:
    input:
        bogie_modes=rules.bogie_modes.output[0],
    output:
        pdf="paper_figures/{line}/bogie_stability.pdf",
        png=report(
            "paper_figures/{line}/bogie_stability.png",
            category="Bogie",
            caption="workflow/report/bogie_stability.rst",
            labels={"line": "{line}", "shows": "Stability of the bogie"},
        ),
    log:
        "logs/{line}/bogie_stability.log",
    benchmark:
        "logs/{line}/bogie_stability.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "bogie_stability"),
        code=code_hash(FIGURES / "bogie_stability.py", STYLE),
    message:
        "{wildcards.line}: stability of the bogie"
    script:
        "paper_figures/bogie_stability.py"


rule campbell_chart:
    input:
        bogie_modes=rules.bogie_modes.output[0],
    output:
        pdf="paper_figures/{line}/campbell_chart.pdf",
        png=report(
            "paper_figures/{line}/campbell_chart.png",
            category="Bogie",
            caption="workflow/report/campbell_chart.rst",
            labels={"line": "{line}", "shows": "Orders over speed"},
        ),
    log:
        "logs/{line}/campbell_chart.log",
    benchmark:
        "logs/{line}/campbell_chart.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "campbell_chart"),
        code=code_hash(FIGURES / "campbell_chart.py", STYLE),
    message:
        "{wildcards.line}: order-frequency-speed chart"
    script:
        "paper_figures/campbell_chart.py"


rule fig10_evolution_tendency:
    input:
        evolution_tendency=rules.evolution_tendency.output[0],
    output:
        pdf="paper_figures/{line}/fig10_evolution_tendency.pdf",
        png=report(
            "paper_figures/{line}/fig10_evolution_tendency.png",
            category="Wheel wear",
            caption="workflow/report/fig10.rst",
            labels={"line": "{line}", "shows": "Figure 10"},
        ),
    log:
        "logs/{line}/fig10_evolution_tendency.log",
    benchmark:
        "logs/{line}/fig10_evolution_tendency.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "fig10_evolution_tendency"),
        code=code_hash(FIGURES / "fig10_evolution_tendency.py", STYLE),
    message:
        "{wildcards.line}: figure 10"
    script:
        "paper_figures/fig10_evolution_tendency.py"


rule worn_wheels:
    input:
        evolution_tendency=rules.evolution_tendency.output[0],
        wear=lambda w: expand(
            PER_ORDER[1], line=w.line, absorber=ABSORBERS[w.line], order=ORDERS
        ),
    output:
        pdf="paper_figures/{line}/worn_wheels.pdf",
        png=report(
            "paper_figures/{line}/worn_wheels.png",
            category="Wheel wear",
            caption="workflow/report/worn_wheels.rst",
            labels={"line": "{line}", "shows": "Wear around the wheels"},
        ),
    log:
        "logs/{line}/worn_wheels.log",
    benchmark:
        "logs/{line}/worn_wheels.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "worn_wheels"),
        code=code_hash(FIGURES / "worn_wheels.py", STYLE),
    message:
        "{wildcards.line}: wear around the wheels"
    script:
        "paper_figures/worn_wheels.py"


rule order_speed_chart:
    input:
        tendency_maps=rules.tendency_maps.output[0],
    output:
        pdf="paper_figures/{line}/order_speed_chart.pdf",
        png=report(
            "paper_figures/{line}/order_speed_chart.png",
            category="Wheel wear",
            caption="workflow/report/order_speed_chart.rst",
            labels={"line": "{line}", "shows": "Growing orders over speed"},
        ),
    log:
        "logs/{line}/order_speed_chart.log",
    benchmark:
        "logs/{line}/order_speed_chart.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "order_speed_chart"),
        code=code_hash(FIGURES / "order_speed_chart.py", STYLE),
    message:
        "{wildcards.line}: growing orders over speed and radius"
    script:
        "paper_figures/order_speed_chart.py"


rule tendency_design_chart:
    input:
        tendency_maps=rules.tendency_maps.output[0],
    output:
        pdf="paper_figures/{line}/tendency_design_chart.pdf",
        png=report(
            "paper_figures/{line}/tendency_design_chart.png",
            category="Wheel wear",
            caption="workflow/report/tendency_design_chart.rst",
            labels={"line": "{line}", "shows": "Absorbers against polygons"},
        ),
    log:
        "logs/{line}/tendency_design_chart.log",
    benchmark:
        "logs/{line}/tendency_design_chart.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "tendency_design_chart"),
        code=code_hash(FIGURES / "tendency_design_chart.py", STYLE),
    message:
        "{wildcards.line}: design chart of the absorber"
    script:
        "paper_figures/tendency_design_chart.py"


rule table2_absorber_designs:
    input:
        absorber_tuning=rules.absorber_tuning.output[0],
    output:
        table="paper_figures/{line}/table2_absorber_designs.csv",
        page=report(
            "paper_figures/{line}/table2_absorber_designs.html",
            category="Forced vibrations",
            caption="workflow/report/table2.rst",
            labels={"line": "{line}", "shows": "Table 2"},
        ),
    log:
        "logs/{line}/table2_absorber_designs.log",
    benchmark:
        "logs/{line}/table2_absorber_designs.tsv"
    threads: 1
    params:
        code=code_hash(FIGURES / "table2_absorber_designs.py"),
    message:
        "{wildcards.line}: Table 2"
    script:
        "paper_figures/table2_absorber_designs.py"


rule table_absorber_effect:
    input:
        evolution_tendency=rules.evolution_tendency.output[0],
    output:
        table="paper_figures/{line}/table_absorber_effect.csv",
        page=report(
            "paper_figures/{line}/table_absorber_effect.html",
            category="Wheel wear",
            caption="workflow/report/table_absorber_effect.rst",
            labels={"line": "{line}", "shows": "Effect of the absorbers"},
        ),
    log:
        "logs/{line}/table_absorber_effect.log",
    benchmark:
        "logs/{line}/table_absorber_effect.tsv"
    threads: 1
    params:
        code=code_hash(FIGURES / "table_absorber_effect.py"),
    message:
        "{wildcards.line}: effect of the absorbers on the peaks"
    script:
        "paper_figures/table_absorber_effect.py"


rule explorer:
    input:
        wheelset_designs=rules.wheelset_designs.output[0],
        bogie_designs=rules.bogie_designs.output[0],
    output:
        page=report(
            "paper_figures/{line}/explorer.html",
            category="Explorer",
            caption="workflow/report/explorer.rst",
            labels={"line": "{line}", "shows": "Any absorber"},
        ),
    log:
        "logs/{line}/explorer.log",
    benchmark:
        "logs/{line}/explorer.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "explorer"),
        code=code_hash(FIGURES / "explorer.py", *EXPLORER),
    message:
        "{wildcards.line}: explorer of absorber designs"
    script:
        "paper_figures/explorer.py"


rule design_sheet:
    input:
        stability_map=rules.stability_map.output[0],
        bogie_modes=rules.bogie_modes.output[0],
        tendency_maps=rules.tendency_maps.output[0],
        robust_tuning=rules.robust_tuning.output[0],
    output:
        pdf="paper_figures/{line}/design_sheet.pdf",
        html=report(
            "paper_figures/{line}/design_sheet.html",
            category="Design sheet",
            caption="workflow/report/design_sheet.rst",
            labels={"line": "{line}", "shows": "Design sheet"},
        ),
    log:
        "logs/{line}/design_sheet.log",
    benchmark:
        "logs/{line}/design_sheet.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "design_sheet"),
        code=code_hash(FIGURES / "design_sheet.py", STYLE),
    message:
        "{wildcards.line}: design sheet of the absorber"
    script:
        "paper_figures/design_sheet.py"
