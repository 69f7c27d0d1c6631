"""accuracy.md: every method against exact values; the program prints the tables."""

from __future__ import annotations

from tables import table_from_markdown
from page import Page


def make(page: Page) -> None:
    for method in ("grid", "bkm_thesis"):
        printed = page.benchmark("bench/method_error_bench", method, *(["--quick"] if page.quick else []))
        table = table_from_markdown(printed)
        page.table(method, " | ".join(table.columns), table.rows)
