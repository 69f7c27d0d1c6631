"""bars.md and boundary-methods.md: accuracy, time and memory on cases whose answer is known."""

from __future__ import annotations

from tables import percent, read_csv, thousands
from page import NOT_TRUSTED, ROOT, Page

CSV = "tests/bars/results"
FEW_PHOTONS = ("--set", "solver.photons=20000")
MOST_TRIANGLES = 1_100_000


def measured(page: Page, name: str, *arguments: object) -> list[dict[str, str]]:
    """Runs `bars` and keeps its CSV; returns the rows."""
    file = page.folder / f"{name}.csv"
    page.benchmark("bars/bars", *arguments, "--csv", file)
    page.save(f"{CSV}/{name}.csv", file)
    return page.csv(f"{CSV}/{name}.csv")


def share(row: dict[str, str], column: str) -> str:
    return percent(float(row[column]))


def make(page: Page) -> None:
    page.has_bunny()
    rows = measured(page, "bars", "auto",
                    *(["--cases", "sphere-5-*", "torus+returning", *FEW_PHOTONS] if page.quick else []))
    page.table("cases", "case | bar | relative L2 error | max error / max U_d | error estimate | "
               "CPU seconds | peak MiB", [
        [row["case"], "" if row["case"].endswith("+returning") else share(row, "bar"),
         share(row, "relative_l2_error"), share(row, "largest_error"), share(row, "error_estimate"),
         f"{float(row['cpu_seconds']):.1f}", row["peak_mib"]]
        for row in rows])
    make_bunny(page)
    make_detail(page)


def make_bunny(page: Page) -> None:
    if not page.has_bunny():
        page.leave("bunny", "no .fetched/bunny.obj")
        page.leave("../pictures/bars-bunny", "no .fetched/bunny.obj")
        return
    chart = page.folder / "bunny.svg"
    tolerances = (0.08, 0.04) if page.quick else (0.08, 0.04, 0.02, 0.01, 0.005, 0.0025)
    rows = measured(page, "bunny", "auto", "--cases", "bunny", "--threads", 1, "--svg", chart,
                    *(FEW_PHOTONS if page.quick else []), "--tolerances", *tolerances)
    page.save("docs/pictures/bars-bunny.svg", chart)
    elements = [row for row in read_csv(ROOT / "tests/bars/fem.csv") if row["case"] == "bunny"]
    page.table("bunny", " | tolerance or mesh | unknowns | CPU seconds | relative L2 error", [
        [row["chosen"], str(tolerance), "", f"{float(row['cpu_seconds']):.1f}",
         share(row, "relative_l2_error")] for tolerance, row in zip(tolerances, rows)] + [
        ["finite elements", row["mesh"], thousands(float(row["unknowns"])),
         f"{float(row['cpu_seconds']):.0f}", share(row, "relative_l2_error")] for row in elements])


def make_detail(page: Page) -> None:
    rows = measured(page, "detail", "auto", "--detail", 1000 if page.quick else MOST_TRIANGLES,
                    "--svg", page.folder / "detail")
    for chart in ("seconds", "memory"):
        page.save(f"docs/pictures/bars-detail-{chart}.svg", page.folder / f"detail-{chart}.svg")
    of = {case: [row for row in rows if row["case"] == case] for case in ("bumpy", "rippled")}
    page.table("detail", "triangles, bumpy / rippled | bumpy: CPU seconds | MiB | relative L2 error | "
               "rippled: CPU seconds | MiB | error estimate", [
        [f"{thousands(float(bumpy['triangles']))} / {thousands(float(rippled['triangles']))}",
         f"{float(bumpy['cpu_seconds']):.1f}", bumpy["peak_mib"], share(bumpy, "relative_l2_error"),
         f"{float(rippled['cpu_seconds']):.1f}", rippled["peak_mib"], share(rippled, "error_estimate")]
        for bumpy, rippled in zip(of["bumpy"], of["rippled"], strict=True)])


def method_cell(row: dict[str, str]) -> str:
    """0.087 (0.21) %, 1.6 s: the true error, the run's own estimate, seconds."""
    error, estimate = (f"{100 * float(row[column]):.2g}" for column in ("relative_l2_error", "error_estimate"))
    doubt = ", exit 3" if int(row["exit_code"]) == NOT_TRUSTED else ""
    return f"{error} ({estimate}) %, {float(row['seconds']):.1f} s{doubt}"


def make_boundary_methods(page: Page) -> None:
    methods = ("grid", "bkm", "mfs", "lbkm")
    page.has_bunny()
    cases = ["sphere-5-0.99", *FEW_PHOTONS] if page.quick else [
        "sphere*", "torus", "box*", "bunny", "knot", "bumpy"]
    cells: dict[str, list[str]] = {}
    for row in measured(page, "methods", *methods, "--cases", *cases):
        cells.setdefault(row["case"], []).append(method_cell(row))
    page.table("methods", "case | " + " | ".join(f"`{method}`" for method in methods),
               [[case, *row] for case, row in cells.items()])

    timed = page.timings("bench/new_light_bench", "new_light/[01]/50000/" if page.quick else "new_light")
    rows: dict[str, dict[str, str]] = {}
    for name, entry in timed.items():
        _, method, photons, kept, *_ = name.split("/")
        rows.setdefault(f"`{methods[int(method)]}`", {})[f"{photons}, {kept}"] = f"{entry['cpu_time']:.0f}"
    page.table("new-light", " | 50 000 photons, from nothing | kept | 1 million, from nothing | kept", [
        [method, *(cells.get(f"{photons}, {kept}", "") for photons in (50_000, 1_000_000) for kept in (0, 1))]
        for method, cells in rows.items()])
