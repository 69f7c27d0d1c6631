"""bkm-thesis.md: the thesis's method by itself, from the properties its tests record and its benchmarks."""

from __future__ import annotations

import xml.etree.ElementTree as xml
from typing import Any

from tables import figures, rate
from page import Page

Timings = dict[str, dict[str, Any]]

FORMS = {  # as the test names them
    "linear": "linear", "cubic": "cubic", "thin_plate": "thin_plate", "gaussian": "gaussian",
    "multiquadric": "multiquadric, b = 1", "inverse_multiquadric": "inverse_multiquadric, b = 3",
    "compact_c0": "compact_c0", "compact_c2": "compact_c2", "compact_c4": "compact_c4",
    "nonsingular 1": "nonsingular, m = 1", "nonsingular 2": "nonsingular, m = 2",
    "nonsingular 4": "nonsingular, m = 4",
}
RANKS = ((2.74, 100), (2.74, 500), (2.74, 700), (0.27, 500))  # lambda R, knots
DISTANCES = ("4", "2", "1", "0.5", "0.25")
OF_THE_THESIS = {100: 0.235, 484: 40.5, 961: 349.9, 1764: 2378.0}  # seconds [V09 tab. 7.3]
ONE_THREAD = "gemm|assembly|particular|homogeneous|whole_solve"


def make(page: Page) -> None:
    make_accuracy(page)
    make_widths(page)
    make_seconds(page)


def small(value: float) -> str:
    """8.7e-6; from 1 on as it is."""
    mantissa, exponent = f"{value:.1e}".split("e")
    return figures(value, 2) if value >= 1.0 else f"{mantissa}e{int(exponent)}"


def make_accuracy(page: Page) -> None:
    """The test program judges the same figures; here they are only read."""
    file = page.folder / "figures.xml"
    page.benchmark("bench/bkm_figures", f"--gtest_output=xml:{file}", "--gtest_brief=1",
                   "--gtest_filter=ThesisCase.ErrorIs*:ThesisForms.Every*:Rank.*:*PointSourceOutside*")
    recorded = {each.get("name", ""): each.get("value", "") for each in xml.parse(file).iter("property")}
    page.table("thesis-test", "cube | largest error", [
        [cube, small(float(recorded[f"error_of_cube_from_{start}"]))]
        for cube, start in (("[0, 2]^3", "0"), ("[-1, 1]^3", "-1"))])
    page.table("rank", "lambda R | knots | rank", [
        [f"{size:g}", str(knots), recorded[f"rank_of_{knots}_knots_at_{size:.2f}"]] for size, knots in RANKS])
    page.table("distance", " | ".join(["d / R", *DISTANCES]), [
        ["relative error", *(small(float(recorded[f"error_at_distance_{at}"])) for at in DISTANCES)]])
    page.table("forms", "psi | svd | qr | lu | tikhonov_gcv | tikhonov_l_curve", [
        [label, *(small(float(error)) for error in recorded[name].split())] for name, label in FORMS.items()])


def make_widths(page: Page) -> None:
    """rms of f~ - f over f, the worst of the four materials."""
    timed = page.timings("bench/bkm_shape_parameter_bench",
                         "sphere/.*sigma_tr:5/lambda:0.5/knots:150/width:(1|8)/" if page.quick else ".")
    worst: dict[tuple[str, str, int], dict[float, float]] = {}
    for name, entry in timed.items():
        body, source, _, _, knots, width, *_ = (part.split(":")[-1] for part in name.split("/"))
        row = worst.setdefault((source, body, int(knots)), {})
        row[float(width)] = max(row.get(float(width), 0.0), entry["f_rms"])
    widths = sorted({width for row in worst.values() for width in row})
    page.table("widths", "source | body | knots | " + " | ".join(f"{width:g}" for width in widths), [
        [source, body, str(knots), *(f"{worst[source, body, knots][width]:.1e}" for width in widths)]
        for source, body, knots in sorted(worst)])


def duration(milliseconds: float) -> str:
    return f"{figures(milliseconds, 2)} ms" if milliseconds < 100.0 else f"{figures(milliseconds / 1e3, 2)} s"


def make_seconds(page: Page) -> None:
    sizes = (100,) if page.quick else tuple(OF_THE_THESIS)
    timed = page.timings("bench/bkm_bench", f"^({ONE_THREAD})/({'|'.join(map(str, sizes))})/1/")
    evaluated = page.timings("bench/bkm_bench", "^evaluation/" + ("100$" if page.quick else ""))

    def of(part: str, size: int) -> dict[str, Any]:
        return next(entry for name, entry in timed.items() if name.startswith(f"{part}/{size}/"))

    solves = {size: of("whole_solve", size)["real_time"] for size in sizes}
    lines = {
        "assembly, both matrices": lambda n: duration(of("assembly", n)["real_time"]),
        "particular matrix (3 x 3 times the size): rank": lambda n: f"{of('particular', n)['rank']:.0f}",
        "its truncated decomposition": lambda n: duration(of("particular", n)["real_time"]),
        "as a part of the rate of dgemm": lambda n: f"{100 * of('particular', n)['of_gemm']:.0f} %",
        "boundary matrix: rank": lambda n: f"{of('homogeneous', n)['rank']:.0f}",
        "its decomposition": lambda n: duration(of("homogeneous", n)["real_time"]),
        "as a part of dgemm's rate": lambda n: f"{100 * of('homogeneous', n)['of_gemm']:.0f} %",
        "whole solve": lambda n: duration(solves[n]),
        "the thesis [V09 tab. 7.3]": lambda n: f"{OF_THE_THESIS[n]:g} s",
        "times faster": lambda n: figures(OF_THE_THESIS[n] / (solves[n] / 1e3), 2),
        "dgemm at the size of the particular matrix, GFlop/s": lambda n: f"{of('gemm', n)['GFlop/s']:.0f}",
        "evaluation of the field, points": lambda n: (
            rate(evaluated[f"evaluation/{n}"]["points/s"]) if f"evaluation/{n}" in evaluated else ""),
    }
    page.table("seconds", " | ".join(["boundary knots", *map(str, sizes)]),
               [[label, *(cell(size) for size in sizes)] for label, cell in lines.items()])
    each = page.timings("bench/bkm_bench", "^candidate/" + ("lu" if page.quick else ""))
    page.table("factorisations", "factorisation of the particular matrix, 961 knots | seconds | as a part of dgemm", [
        [name.split("/")[1], figures(entry["real_time"] / 1e3, 2), f"{100 * entry['of_gemm']:.0f} %"]
        for name, entry in each.items()])
