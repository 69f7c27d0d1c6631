"""speed.md: seconds of the shipped scenes, stage by stage, and rates of what they are made of."""

from __future__ import annotations

import json

from tables import RemakeError, figures, rate
from page import NOT_TRUSTED, Page

SCENES = ("knot", "bunny", "lamp", "validation/sphere", "validation/slab", "validation/box")
STAGES = ("photons", "grid", "solve", "surface", "picture", "write")
READING = ("scene", "geometry")
QUICK = ("--set", "solver.tolerance=0.3", "--set", "solver.photons=20000",
         "--set", "camera.resolution=[16,16]", "--set", "camera.samples=1")
COLUMNS = "scene | reading | photons | grid | solve | surface | picture | write | total, s | memory, MiB"


def make(page: Page) -> None:
    rows = []
    for scene in SCENES:
        if scene == "bunny" and not page.has_bunny():
            page.note("bunny.yaml left out: no .fetched/bunny.obj")
            continue
        rows.append(scene_row(page, scene))
    page.table("scenes", COLUMNS + " | error estimate | exit", rows)
    if page.benchmarks:
        make_rates(page)
    else:
        page.leave("rates", "needs benchmarks (--benchmarks FOLDER)")


def scene_row(page: Page, scene: str) -> list[str]:
    summary = page.folder / "summary.json"
    page.knotlight("render", f"scenes/{scene}.yaml", "-o", page.folder / "picture.exr", "--quiet",
                   "--json", summary, *(QUICK if page.quick else []), allowed=(0, NOT_TRUSTED))
    said = json.loads(summary.read_text(encoding="utf-8"))
    seconds = said["seconds"]
    unknown = [stage for stage in seconds if stage not in (*READING, *STAGES)]
    if unknown:
        raise RemakeError(f"stage {unknown[0]} of render has no column in the table")
    estimate = said["error_estimate"]
    return [f"`{scene.split('/')[-1]}.yaml`", f"{sum(seconds.get(stage, 0.0) for stage in READING):.2f}",
            *(f"{seconds.get(stage, 0.0):.{3 if stage == 'surface' else 2}f}" for stage in STAGES),
            f"**{sum(seconds.values()):.1f}**", f"{said['peak_memory_MiB']:.0f}",
            "none" if estimate is None else f"{estimate:.3f}",
            str(0 if said["trusted"] else NOT_TRUSTED)]


def make_rates(page: Page) -> None:
    photons = page.timings("bench/photon_bench", "first_order|all_orders|bare_rays|build_tree|estimates")
    trace = "trace_benchmark/"
    knots = 100 if page.quick else 961
    dense = page.timings("bench/bkm_bench", f"^(particular|gemm)/{knots}/1/")
    decomposition, product = (next(entry["GFlop/s"] for name, entry in dense.items() if name.startswith(part))
                              for part in ("particular", "gemm"))
    estimates = [photons[f"estimates/inside:{inside}"]["estimates/s"] for inside in (0, 1)]
    first = photons[trace + "first_order"]
    page.table("rates", "what | rate", [
        ["bare rays, Embree, every hit recomputed in double",
         f"{rate(photons['bare_rays/short:0']['rays/s'])} unlimited, "
         f"{rate(photons['bare_rays/short:1']['rays/s'])} of one mean free path"],
        ["photons, first interaction: two to three rays each, so close to the rate of bare rays",
         f"{rate(first['emitted/s'])} emitted, {rate(first['arrived/s'])} arriving"],
        ["photons, all orders: interactions", rate(photons[trace + "all_orders"]["interactions/s"])],
        ["kd-tree: photons", rate(photons["build_tree"]["photons/s"])],
        ["density estimates, at most 200 photons in 0.25 mean free paths",
         f"{rate(estimates[0])} on the surface, {rate(estimates[1])} inside"],
        [f"decomposition of the particular matrix of {knots} knots",
         f"{figures(decomposition, 2)} GFlop/s of a measured {figures(product, 2)} (matrix product)"],
    ])
