"""Pages that one command of the program writes: chart, stability, thesis."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from tables import shown_charts
from page import Page

CHART_SCENES = ("sphere", "torus", "plate", "bunny")
CHART_FULL = ("--budget", 180, "--levels", 5)
# A small picture, one setting of each line: seconds instead of minutes.
CHART_QUICK = ("--budget", 30, "--levels", 1, "--repeats", 1, "--noise", 0.3,
               "--set", "camera.resolution=[64,64]", "--set", "camera.samples=1")


def make_chart(page: Page) -> None:
    scenes = list(CHART_SCENES)
    if not page.has_bunny():
        scenes.remove("bunny")
        page.leave("chart/bunny-", "no .fetched/bunny.obj")
    folder = page.folder / "chart"
    command = ["chart", *(f"scenes/pictures/{scene}.yaml" for scene in scenes), "-o", folder,
               "--quiet", *(CHART_QUICK if page.quick else CHART_FULL)]
    page.knotlight(*command)
    if not page.quick and shutil.which("tetgen") is None:
        page.note("finite elements left out: no tetgen")
    elif not page.quick:
        for scene in scenes:
            # The bunny's surface alone takes 40 s, whatever is inside.
            page.finite_elements(f"scenes/pictures/{scene}.yaml", folder / scene, 2 if scene == "bunny" else 5)
        page.knotlight(*command)  # measures nothing again, but shows them
    for scene in scenes:
        page.save(f"docs/results/chart/{scene}.csv", folder / scene / "measurements.csv")
        if (folder / scene / "finite_elements.csv").exists():
            page.save(f"docs/results/chart/{scene}-finite-elements.csv", folder / scene / "finite_elements.csv")
        for chart in sorted((folder / scene).glob("*.svg")):
            page.save(f"docs/results/chart/{scene}-{chart.name}", chart)
    page.save("docs/results/chart/ratios.csv", folder / "ratios.csv")
    ratios = page.csv("docs/results/chart/ratios.csv")
    page.table("ratios", " | ".join(ratios[0]), [list(row.values()) for row in ratios])


def make_stability(page: Page) -> None:
    """Copies the pictures that the page shows, of all that the command draws."""
    folder = page.folder / "stability"
    page.knotlight("stability", "-o", folder, "--quiet", *(["--quick"] if page.quick else []))
    text = (page.target / "docs/results/stability.md").read_text(encoding="utf-8")
    for chart in shown_charts(text):
        page.save(os.path.normpath(f"docs/results/{chart}"), folder / Path(chart).name)


def make_thesis(page: Page) -> None:
    """The command writes the page too."""
    folder, text = page.folder / "thesis", page.folder / "thesis.md"
    page.has_bunny()
    page.knotlight("study", "all", "-o", folder, "--markdown", text, "--quiet",
                   *(["--quick"] if page.quick else []))
    (folder / "index.html").unlink()
    page.save_folder("docs/results/thesis", folder)
    page.save("docs/results/thesis.md", text)
