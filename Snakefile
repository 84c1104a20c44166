"""The paper's table of contents: what each stage reads and is, what each figure shows."""

# Stage: the stages whose files it reads, and what it makes. Its script, module in
# src/tramdva/stages, variables and file in results/{line} bear the same name.
STAGES = {
    "stability_map": (["basic_model"], "stability maps (figure 2)"),
    "hopf_points": (["stability_map", "basic_model"], "Hopf points (figure 3)"),
    "limit_cycles": (["hopf_points", "basic_model"], "limit cycles (figure 3)"),
    "hopf_curves": (["basic_model"], "Hopf curves (figure 4)"),
    "critical_hopf_curve": (["hopf_curves", "basic_model"], "critical Hopf curve (figure 5)"),
    "cycle_amplitudes": (["critical_hopf_curve", "basic_model"], "cycle amplitudes (figure 6)"),
    "absorber_tuning": (
        ["critical_hopf_curve", "basic_model"],
        "designs of the absorber (Table 2)",
    ),
    "frequency_response": (["absorber_tuning", "basic_model"], "frequency response (figure 7)"),
    "contact_geometry": ([], "contact tables of the profiles"),
    "basic_model": (["contact_geometry"], "basic model of the line"),
    "preflight": (["contact_geometry", "basic_model"], "the line at a glance"),
    "curving_equilibrium": (["contact_geometry", "absorber_tuning"], "steady curving of the bogie"),
    "bogie_modes": (["contact_geometry", "curving_equilibrium"], "modes of the bogie"),
    "growth_band": (["contact_geometry"], "how sure the growth rate is"),
    "curve_entry": (["contact_geometry", "curving_equilibrium"], "ride into the curve (figure 9)"),
    "evolution_tendency": (
        ["bogie_linearisation", "wear", "basic_model"],
        "evolution tendency (figure 10)",
    ),
    "tendency_maps": (
        ["contact_geometry", "bogie_linearisation", "basic_model"],
        "tendency over speed and radius",
    ),
    "wheelset_designs": (["basic_model"], "the wheelset with any absorber"),
    "bogie_designs": (["contact_geometry", "basic_model"], "the bogie with any absorber"),
    "robust_tuning": (
        ["robustness_sample", "basic_model"],
        "nominal and robust optimum of the absorber",
    ),
    "route_tuning": (["contact_geometry"], "the absorber that buys the most kilometres"),
    "route_response": (
        ["contact_geometry", "robust_tuning", "route_tuning"],
        "wear by own waves on the route",
    ),
    "route_remedies": (
        ["contact_geometry", "robust_tuning", "route_tuning", "basic_model"],
        "what changes of the route buy",
    ),
    "polygon_growth": (["route_response"], "growth of orders over kilometres"),
    "polygon_simulation": (
        ["contact_geometry", "route_response"],
        "a wheel that wears on, all orders at once",
    ),
}
# Stages of many files each: per absorber, order or part of a sample (workflow/rules/jobs.smk).
JOBS = {
    "bogie_linearisation": (
        ["contact_geometry", "curving_equilibrium"],
        "bogie on wheels out of round",
    ),
    "bogie_simulation": (["contact_geometry", "bogie_linearisation"], "simulation of orders"),
    "wear": (["bogie_simulation"], "wear by orders"),
    "robustness_sample": (["contact_geometry", "basic_model"], "bogie under varied conditions"),
}
PICTURE, TABLE = {"pdf": "pdf", "png": "png"}, {"table": "csv", "page": "html"}
SHEET, PAGE = {"pdf": "pdf", "html": "html"}, {"page": "html"}
# Figure: the stages whose files it reads, its chapter in the report, its name there, its files.
FIGURES = {
    "preflight_page": (["preflight"], "Before all", "The line at a glance", PAGE),
    "preflight_chart": (["preflight"], "Before all", "Running and modes", PICTURE),
    "fig02_stability_map": (["stability_map", "basic_model"], "Stability", "Figure 2", PICTURE),
    "fig03_bifurcation_diagram": (
        ["hopf_points", "limit_cycles"],
        "Self-excited vibrations",
        "Figure 3",
        PICTURE,
    ),
    "fig04_hopf_curves": (
        ["hopf_curves", "critical_hopf_curve"],
        "Self-excited vibrations",
        "Figure 4",
        PICTURE,
    ),
    "fig05_critical_hopf_curve": (
        ["critical_hopf_curve", "basic_model"],
        "Self-excited vibrations",
        "Figure 5",
        PICTURE,
    ),
    "fig06_cycle_amplitudes": (
        ["critical_hopf_curve", "cycle_amplitudes"],
        "Self-excited vibrations",
        "Figure 6",
        PICTURE,
    ),
    "fig07_frequency_response": (
        ["frequency_response", "absorber_tuning"],
        "Forced vibrations",
        "Figure 7",
        PICTURE,
    ),
    "table2_absorber_designs": (["absorber_tuning"], "Forced vibrations", "Table 2", TABLE),
    "fig08_bogie": ([], "Bogie", "Figure 8", PICTURE),
    "fig09_curve_entry": (["curve_entry", "bogie_modes"], "Bogie", "Figure 9", PICTURE),
    "bogie_mode_shapes": (["bogie_modes"], "Bogie", "Mode shapes", PICTURE),
    "bogie_stability": (["bogie_modes"], "Bogie", "Stability of the bogie", PICTURE),
    "growth_band_chart": (["growth_band"], "Bogie", "How sure the growth rate is", PICTURE),
    "campbell_chart": (["bogie_modes"], "Bogie", "Orders over speed", PICTURE),
    "fig10_evolution_tendency": (["evolution_tendency"], "Wheel wear", "Figure 10", PICTURE),
    "worn_wheels": (
        ["evolution_tendency", "wear"],
        "Wheel wear",
        "Wear around the wheels",
        PICTURE,
    ),
    "order_speed_chart": (["tendency_maps"], "Wheel wear", "Growing orders over speed", PICTURE),
    "tendency_design_chart": (
        ["tendency_maps", "basic_model"],
        "Wheel wear",
        "Absorbers against polygons",
        PICTURE,
    ),
    "table_absorber_effect": (
        ["evolution_tendency"],
        "Wheel wear",
        "Effect of the absorbers",
        TABLE,
    ),
    "route_chart": (["polygon_growth"], "Kilometres", "Route", PICTURE),
    "polygon_growth_chart": (["polygon_growth"], "Kilometres", "Orders over kilometres", PICTURE),
    "kilometres_chart": (
        ["polygon_growth", "route_tuning"],
        "Kilometres",
        "Kilometres between turnings",
        PICTURE,
    ),
    "remedies_chart": (["route_remedies"], "Kilometres", "What would help", PICTURE),
    "turned_wheels": (["polygon_growth"], "Kilometres", "Wheels when they are turned", PICTURE),
    "explorer": (
        ["wheelset_designs", "bogie_designs", "basic_model"],
        "Explorer",
        "Any absorber",
        PAGE,
    ),
    "design_sheet": (
        [
            "stability_map",
            "curving_equilibrium",
            "bogie_modes",
            "tendency_maps",
            "robust_tuning",
            "polygon_growth",
            "route_remedies",
            "basic_model",
        ],
        "Design sheet",
        "Design sheet",
        SHEET,
    ),
}


include: "workflow/rules/start.smk"
include: "workflow/rules/files.smk"


rule all:
    input:
        [
            files_of(stage, line)
            for line in LINES
            for stage in (*STAGES, *JOBS)
            if stage not in ON_DEMAND
        ],
        [pictures_of(figure, line) for line in LINES for figure in FIGURES],
    message:
        "all numbers, figures and tables"


rule check:
    input:
        [files_of("preflight", line) for line in LINES],
    log:
        "logs/check.log",
    params:
        python=sys.executable,
    message:
        "the lines at a glance"
    shell:
        "{params.python:q} -m tramdva.report.preflight {input:q} 2> {log:q}"


include: "workflow/rules/stages.smk"
include: "workflow/rules/jobs.smk"
include: "workflow/rules/figures.smk"
