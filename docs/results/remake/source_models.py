"""source-models.md: the source models side by side on eight scenes, and the power under a sky."""

from __future__ import annotations

import json
import math

from tables import read_csv
from page import NOT_TRUSTED, Page

SKY = "lights=[{type: environment, radiance: 1}]"
AREA = "lights=[{type: area, center: [0, 0, 3], u: [1.5, 0, 0], v: [0, -1.5, 0], radiance: 1}]"


def medium(**values: float) -> list[str]:
    return [f"materials.medium.{key}={value:g}" for key, value in values.items()]


BALL = medium(sigma_a=0.2, sigma_s=19.8)
SPHERE = "validation/sphere"
SCENES: dict[str, tuple[str, list[str]]] = {
    "knot.yaml: area light, faint sky": ("knot", []),
    "ball, beam": (SPHERE, BALL),
    "ball, area light 3 x 3 at distance 3": (SPHERE, [*BALL, AREA]),
    "ball, beam, index 1.4": (SPHERE, [*BALL, *medium(ior=1.4)]),
    "ball, beam, g = 0.8": (SPHERE, [*BALL, *medium(g=0.8)]),
    "ball, sky": (SPHERE, [*BALL, SKY]),
    "ball of radius 4 mean free paths, sky": (SPHERE, [*medium(sigma_a=0.04, sigma_s=3.96), SKY]),
    "box.yaml: oblique beam, edges": ("validation/box", []),
}
QUICK_SCENES = ("ball of radius 4 mean free paths, sky",)
QUICK = ["solver.tolerance=0.3", "camera.resolution=[16,16]"]
# A body that glows is not compared with photons of all orders, which take most of the time.
QUICK_COMPARE = [*QUICK, "materials.medium.emission=0.001", "solver.knots=60"]
# Under a sky, Milne boundary: sigma_a, sigma_s, index.
POWERS = ((0.2, 19.8, 1.0), (0.2, 19.8, 1.4), (1.0, 19.0, 1.4), (2.0, 18.0, 1.0), (2.0, 18.0, 1.4))


def settings(overrides: list[str]) -> list[str]:
    return [word for override in overrides for word in ("--set", override)]


def make(page: Page) -> None:
    rows = []
    for label in QUICK_SCENES if page.quick else SCENES:
        scene, overrides = SCENES[label]
        folder = page.folder / "compare"
        effort = [*settings(QUICK_COMPARE), "--photons", "5000"] if page.quick else []
        page.knotlight("compare", f"scenes/{scene}.yaml", *settings(overrides), *effort, "-o", folder, "--quiet",
                       allowed=(0, NOT_TRUSTED))
        rows += [model_row(label, row) for row in read_csv(folder / "compare.csv") if row["ran"] == "yes"]
    page.table("models", "scene | model | surface | picture | inside | inside, against photons | seconds | MiB", rows)
    page.table("powers", "sigma_a, sigma_s, index | escaped, all orders | photon_map | boundary_flux | "
               "seconds, photon_map | seconds, boundary_flux",
               [power_row(page, *power) for power in (POWERS[:1] if page.quick else POWERS)])


def off(value: float) -> str:
    """0.9 %, 12 %, 744 %, x 30; not-a-number: nothing to compare with."""
    if math.isnan(value):
        return "not known"
    if value >= 10.0:
        return f"x {value:.0f}"
    return f"{100 * value:.1f} %" if value < 0.0995 else f"{100 * value:.0f} %"


def model_row(label: str, row: dict[str, str]) -> list[str]:
    converged = row["model"] == "converged"
    errors = ["" if converged else off(float(row[f"error_{where}"])) for where in ("surface", "picture", "inside")]
    seconds = sum(float(row[f"seconds_{stage}"]) for stage in ("light", "grid", "solve"))
    return [label, "converged diffusion" if converged else row["model"], *errors,
            off(float(row["error_inside_against_photons"])), f"{seconds:.1f}", f"{float(row['memory_MiB']):.0f}"]


def power_row(page: Page, sigma_a: float, sigma_s: float, ior: float) -> list[str]:
    """The part of the incident power that escapes, and what two models are off.

    Of the other diffusion equations the power leaving is a part only.
    """
    summary = page.folder / "summary.json"
    chosen = settings([SKY, "solver.boundary=milne", *medium(sigma_a=sigma_a, sigma_s=sigma_s, ior=ior)])
    page.knotlight("info", f"scenes/{SPHERE}.yaml", *chosen, "--quiet", "--json", summary)
    exact = json.loads(summary.read_text(encoding="utf-8"))["objects"][0]
    errors, seconds = [], []
    for source in ("photon_map", "boundary_flux"):
        model = [f"solver.source={source}", "solver.diffusion=p1", *(QUICK if page.quick else [])]
        page.knotlight("render", f"scenes/{SPHERE}.yaml", *chosen, *settings(model), "-o",
                       page.folder / "picture.exr", "--quiet", "--json", summary, allowed=(0, NOT_TRUSTED))
        said = json.loads(summary.read_text(encoding="utf-8"))
        escaped = said["objects"][0]["power_leaving"] / exact["incident_power"]
        errors.append(f"{100 * (escaped / exact['escaped_fraction'] - 1):+.1f} %")
        seconds.append(f"{sum(said['seconds'].values()):.1f}")
    return [f"{sigma_a:g}, {sigma_s:g}, {ior:g}", f"{exact['escaped_fraction']:.4f} ± "
            f"{exact['standard_error']:.4f}", *errors, *seconds]
