"""estimates.md: how the error estimate of a run compares with its true error, over random scenes."""

from __future__ import annotations

import math
from statistics import median

from page import NOT_TRUSTED, Page

METHODS = ("grid", "auto", "bkm", "mfs")
SCENES = 20
GOOD = (0.2, 1.0)  # true error / estimate, as in tests/bars/estimates.h
TOLERANCES_ALLOWED = 3.0


def make(page: Page) -> None:
    csv, chart = page.folder / "estimates.csv", page.folder / "estimates.svg"
    effort = [1, "--set", "solver.photons=20000"] if page.quick else [SCENES]
    page.benchmark("bars/bars", *METHODS, "--seed", 2, "--csv", csv, "--svg", chart, "--estimates", *effort)
    page.save("tests/bars/results/estimates.csv", csv)
    page.save("docs/pictures/estimates.svg", chart)
    runs = page.csv("tests/bars/results/estimates.csv")
    page.table("summary", "method | scenes | good | least ratio | median | largest | exit 3 | "
               "more than 3 tolerances off with exit 0",
               [summary(method, [run for run in runs if run["method"] == method]) for method in METHODS])


def summary(method: str, runs: list[dict[str, str]]) -> list[str]:
    """A ratio that is no number is not good, and an error that is none is too large."""
    ratios = [float(run["ratio"]) for run in runs]
    known = [ratio for ratio in ratios if not math.isnan(ratio)]
    good = sum(GOOD[0] <= ratio <= GOOD[1] for ratio in ratios)
    wrong = sum(int(run["exit_code"]) == 0
                and not float(run["relative_l2_error"]) <= TOLERANCES_ALLOWED * float(run["tolerance"])
                for run in runs)
    return [method, str(len(runs)), f"{100 * good / len(runs):.0f} %",
            *(f"{value:.2f}" for value in (min(known), median(known), max(known))),
            str(sum(int(run["exit_code"]) == NOT_TRUSTED for run in runs)), str(wrong)]
