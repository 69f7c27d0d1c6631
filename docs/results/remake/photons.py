"""estimators.md and expected-values.md: what photon maps and expected values give, at what cost."""

from __future__ import annotations

import math
from statistics import linear_regression

from tables import figures, percent, rate
from page import ROOT, Page

Rows = list[dict[str, str]]

# As estimator_bench names them; the second name heads a narrow column.
OBJECTS = {
    "slab": ("box 10 x 10 x 5 mean free paths, beam at right angles", "slab"),
    "slab_oblique": ("the same, beam at 37 degrees", "oblique"),
    "sphere": ("sphere, radius 5 mean free paths, beam", "sphere 5"),
    "torus": ("torus 1/0.35, tube of 5 mean free paths, point light", "torus"),
    "sphere_20": ("sphere, radius 20 mean free paths, beam", "sphere 20"),
}
PLACES = ("U_volume", "U_layer", "U_surface", "Q_volume", "Q_layer", "Q_surface")
BAR, BAR_PHOTONS = 0.01, 1_000_000
# Shown of settings.csv: label, estimator, nearest, largest radius, what the count or radius is.
SETTINGS = (
    ("carried (each photon along its ray; what the program had)", "carried", 200, 1.0, "200"),
    ("carried", "carried", 2000, 1.0, "2000"),
    ("slope (carried, and a slope fitted: `slope_fit.h`)", "slope", 2000, 1.0, "2000"),
    ("**nearest** (beams: `beams.h`)", "nearest", 200, 1.0, "200"),
    ("**nearest**", "nearest", 2000, 1.0, "2000"),
    ("kernel (1 - s^2)^2, beams", "kernel", 2000, 1.0, "2000"),
    ("radius 0.3 mean free paths, beams", "radius", 2, 0.3, "all in it"),
    ("radius 0.7, beams", "radius", 2, 0.7, "all in it"),
    ("radius 1, beams", "radius", 2, 1.0, "all in it"),
)
SCHEMES = ("random", "low_discrepancy")


def make_estimators(page: Page) -> None:
    """The charts are gnuplot's, whose script reads and writes below the folder it is run in."""
    csv, charts = page.folder / "docs/results/estimators", page.folder / "docs/pictures"
    csv.mkdir(parents=True)
    charts.mkdir()
    page.benchmark("bench/estimator_bench", csv, *(["--quick"] if page.quick else []))
    page.run(["gnuplot", ROOT / "docs/results/estimators.gp"], cwd=page.folder)
    for name in ("n", "settings", "depth", "divergence"):
        page.save(f"docs/results/estimators/{name}.csv", csv / f"{name}.csv")
        page.save(f"docs/pictures/estimators-{name}.svg", charts / f"estimators-{name}.svg")
    n = page.csv("docs/results/estimators/n.csv")
    page.table("bar", "object, light | U_ri: volume | layer | surface | Q_ri: volume | layer | surface | met",
               [bar_row(name, [row for row in n if row["case"] == name and row["scheme"] == SCHEMES[1]])
                for name in OBJECTS])
    page.table("slopes", " | " + " | ".join(short for _, short in OBJECTS.values()), [
        [scheme.replace("_", " "), *(f"{slope([r for r in n if (r['case'], r['scheme']) == (name, scheme)]):.2f}"
                                     for name in OBJECTS)] for scheme in SCHEMES])
    settings = [row for row in page.csv("docs/results/estimators/settings.csv") if row["case"] == "sphere"]
    page.table("settings", "estimate | k or radius | bias, low discrepancy | noise, random | noise, low discrepancy | "
               "estimates/s, one core", [setting_row(settings, *setting) for setting in SETTINGS])
    page.table("seconds", "1 million photons, sphere of 5, one core | random | low discrepancy",
               seconds_rows([row for row in n if row["case"] == "sphere"]))


def nearest_count(rows: Rows, wanted: int) -> dict[str, str]:
    """The row of the most photons up to `wanted`."""
    return max((row for row in rows if int(row["n"]) <= wanted), key=lambda row: int(row["n"]))


def bar_row(name: str, rows: Rows) -> list[str]:
    at_bar, most = nearest_count(rows, BAR_PHOTONS), max(rows, key=lambda row: int(row["n"]))
    met = "yes"
    if any(float(at_bar[place]) > BAR for place in PLACES):
        met = f"no; {int(most['n']) / 1e6:g} M photons: " + ", ".join(
            f"{100 * float(most[place]):.2f} %" for place in PLACES[:3])
    return [OBJECTS[name][0], *(f"{100 * float(at_bar[place]):.2f} %" for place in PLACES), met]


def slope(rows: Rows) -> float:
    """Of log error in the layer over log n, least squares."""
    return linear_regression([math.log(float(row["n"])) for row in rows],
                             [math.log(float(row["U_layer"])) for row in rows]).slope


def setting_row(rows: Rows, label: str, estimator: str, nearest: int, radius: float, count: str) -> list[str]:
    """Bias is told by the quieter photons; with random ones it drowns below 0.5 %."""
    random, even = (next(row for row in rows if row["scheme"] == scheme and row["estimator"] == estimator
                         and int(row["nearest"]) == nearest and float(row["max_radius"]) == radius)
                    for scheme in SCHEMES)
    return [label, count, f"{100 * float(even['bias']):.1f} %", percent(float(random["noise"])),
            percent(float(even["noise"])),
            rate(float(even["estimates_per_s"])).removesuffix("/s")]


def seconds_rows(rows: Rows) -> list[list[str]]:
    columns = [nearest_count([row for row in rows if row["scheme"] == scheme], BAR_PHOTONS) for scheme in SCHEMES]
    return [["tracing", *(f"{float(row['trace_s']):.2f} s" for row in columns)],
            ["sorting and tree", *(f"{float(row['tree_s']):.2f} s" for row in columns)],
            ["estimates of " + " or ".join(dict.fromkeys(row["nearest"] for row in columns)) + " photons",
             *(rate(float(row["estimates_per_s"])) for row in columns)]]


def make_expected_values(page: Page) -> None:
    page.benchmark("bench/expected_values_bench", page.folder, *(["--quick"] if page.quick else []))
    page.save("docs/results/expected-values.csv", page.folder / "expected-values.csv")
    for light in ("beam", "area"):
        page.save(f"docs/pictures/expected-values-{light}.svg", page.folder / f"expected-values-{light}.svg")
    lines: dict[tuple[str, str], Rows] = {}
    for row in page.csv("docs/results/expected-values.csv"):
        lines.setdefault((row["light"], row["scheme"]), []).append(row)
    counts = [int(row["rays"]) for row in next(iter(lines.values()))]
    timed = counts[-2]  # the last costs most and tells no more
    rows = []
    for (light, scheme), line in lines.items():
        errors = [float(row["relative_error"]) for row in line]
        order = math.log(errors[-1] / errors[0]) / math.log(counts[-1] / counts[0])
        rows.append([light, scheme, *(figures(error, 2) for error in errors), f"{order:.2f}", line[-2]["seconds"]])
    page.table("errors", "light | scheme | " + " | ".join(f"{count:,} rays".replace(",", " ") for count in counts)
               + f" | slope | seconds at {timed:,}".replace(",", " "), rows)
