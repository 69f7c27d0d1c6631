"""transport.md: photons of all orders against exact transport, and how fast they are."""

from __future__ import annotations

from tables import rate, table_from_markdown
from page import Page

# Google Benchmark's name, its counter, and what it measures.
RATES = (
    ("bare_rays/short:0", "rays/s", "bare rays through the ray caster, unlimited, in random directions"),
    ("bare_rays/short:1", "rays/s", "bare rays of one mean free path, in random directions"),
    ("bare_flights", "rays/s", "the very flights that photons of all orders made, cast again and nothing else"),
    ("trace_benchmark/all_orders", "interactions/s", "photons of all orders: interactions"),
    ("trace_benchmark/fluxes_in_one_cell", "interactions/s", "the same with U and F in one cell"),
    ("trace_benchmark/fluxes_in_32_cubed_cells", "interactions/s",
     "the same with U and F in 32 x 32 x 32 cells, 50 000 photons"),
    ("trace_benchmark/first_order", "arrived/s", "photons, first interaction: arrivals"),
)


def make(page: Page) -> None:
    quick = ["--quick"] if page.quick else []
    slabs = table_from_markdown(page.benchmark("bench/transport_bench", "slabs", *(quick or ["2e-4"])))
    page.table("slabs", " | ".join(slabs.columns), slabs.rows)
    shapes = table_from_markdown(page.benchmark("bench/transport_bench", "shapes", *quick))
    page.table("shapes", " | ".join(shapes.columns), shapes.rows)
    timed = page.timings("bench/photon_bench", "trace|bare")
    page.table("rates", "what | rate", [[what, rate(timed[name][counter])] for name, counter, what in RATES])
