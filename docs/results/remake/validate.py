"""validate.md: the whole program on cases whose answer is known, from the JSON of one command."""

from __future__ import annotations

import json

from tables import percent
from page import Page

Figures = dict[str, dict[str, float]]
MODEL_ERROR = "diffusion against transport"
SLAB_COLUMNS = {"U_d, lit face": "U_d, lit face", "U_d, middle": "middle", "U_d, far face": "far face",
                "U_d(z), relative L2": "L2 over z", "R, diffuse part": "R", "T, diffuse part": "T"}
BALANCES = ("(leaving + absorbed - in) / in", "incident - reflected - absorbed - escaped")


def validated(page: Page, *arguments: str) -> dict[str, Figures]:
    """By case and quantity."""
    summary = page.folder / "validate.json"
    page.knotlight("validate", *arguments, "--json", summary, "--quiet")
    cases = json.loads(summary.read_text(encoding="utf-8"))["cases"]
    return {case["name"]: {figure["quantity"]: figure for figure in case["figures"]} for case in cases}


def make(page: Page) -> None:
    cases = {**validated(page, "--quick"), **validated(page, "--only", MODEL_ERROR)} if page.quick else validated(page)
    model = cases.pop(MODEL_ERROR)
    slabs = {name: figures for name, figures in cases.items() if "U_d, lit face" in figures and "slab" in name}
    page.table("slabs", "case | " + " | ".join(SLAB_COLUMNS.values()) + " | allowed",
               [slab_row(name, figures) for name, figures in slabs.items()])
    page.table("balls", "case | quantity | value | reference | error | allowed", [
        [name, quantity, f"{figure['value']:.5g}", f"{figure['reference']:.5g}", percent(figure["error"]),
         percent(figure["allowed"])]
        for name, figures in cases.items() if name not in slabs
        for quantity, figure in figures.items() if quantity not in BALANCES])
    page.table("model", "case | R, P1 | R, exact | error | T, P1 | T, exact | error", [
        [quantity.removeprefix("R: "), *(cell for part in (figure, model[quantity.replace("R: ", "T: ", 1)])
                                         for cell in (f"{part['value']:.4f}", f"{part['reference']:.4f}",
                                                      percent(part["error"])))]
        for quantity, figure in model.items() if quantity.startswith("R: ")])


def slab_row(name: str, figures: Figures) -> list[str]:
    """What is allowed, and in brackets what is at the lit face, if more."""
    allowed = percent(figures["U_d, middle"]["allowed"])
    at_face = percent(figures["U_d, lit face"]["allowed"])
    return [name, *(percent(figures[quantity]["error"]) for quantity in SLAB_COLUMNS),
            allowed if at_face == allowed else f"{allowed} ({at_face})"]
