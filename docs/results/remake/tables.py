"""Markdown tables between markers, and numbers as people read them.

A page says `<!-- table NAME -->` ... `<!-- end -->`; what stands between is replaced, nothing else.
"""

from __future__ import annotations

import csv
import math
import re
from dataclasses import dataclass
from pathlib import Path

Row = list[str]


class RemakeError(Exception):
    """What stopped a page, in one line."""


@dataclass
class Table:
    """Columns and rows of cells that are text already."""

    columns: Row
    rows: list[Row]

    def markdown(self) -> str:
        lines = [self.columns, ["---"] * len(self.columns), *self.rows]
        return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)

    def fault(self) -> str:
        """Why this is no table to show; empty if it is one."""
        if not self.rows:
            return "has no rows"
        wrong = next((row for row in self.rows if len(row) != len(self.columns)), None)
        if wrong is not None:
            return f"has a row of {len(wrong)} cells, expected {len(self.columns)}: {' | '.join(wrong)}"
        return ""


def table_from_markdown(text: str) -> Table:
    """The first table that a program printed."""
    lines = [line.strip() for line in text.splitlines() if line.lstrip().startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    if len(cells) < 2:
        raise RemakeError("a program printed no table")
    return Table(cells[0], cells[2:])


def read_csv(path: Path) -> list[dict[str, str]]:
    """Rows by column; lines that start with # are remarks."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise RemakeError(f"{path}: {error.strerror}") from error
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


MARKED = re.compile(r"<!-- table (?P<name>[\w-]+) -->\n(?P<body>.*?)<!-- end -->", re.DOTALL)
CHART = re.compile(r"!\[[^]]*\]\((?P<path>[^)]+\.svg)\)")


def marked_tables(page: str) -> list[str]:
    return [match["name"] for match in MARKED.finditer(page)]


def shown_charts(page: str) -> list[str]:
    """Paths of the SVG files shown, relative to the page."""
    return [match["path"] for match in CHART.finditer(page)]


def with_tables(page: str, tables: dict[str, Table]) -> str:
    """The page with the tables of these names replaced; blank lines keep Markdown apart."""

    def replaced(match: re.Match[str]) -> str:
        if match["name"] not in tables:
            return match[0]
        return f"<!-- table {match['name']} -->\n\n{tables[match['name']].markdown()}\n<!-- end -->"

    return MARKED.sub(replaced, page)


def figures(value: float, count: int = 3) -> str:
    """So many significant digits, no exponent from 1e-4 to 1e6: 0.000312, 0.63, 12.7, 1940."""
    if not math.isfinite(value) or value == 0.0:
        return f"{value:g}"
    if not 1e-4 <= abs(value) < 1e6:
        return f"{value:.{count - 1}e}"
    digits = count - 1 - math.floor(math.log10(abs(float(f"{value:.{count - 1}e}"))))
    return f"{round(value, digits):.{max(0, digits)}f}"


def percent(value: float, count: int = 2) -> str:
    """0.0063 as 0.63 %; trailing zeros go."""
    return f"{100.0 * value:.{count}g} %" if abs(100.0 * value) < 10.0**count else f"{100.0 * value:.0f} %"


def rate(per_second: float) -> str:
    """4.2 M/s, 12 k/s."""
    unit, name = (1e6, "M") if per_second >= 1e6 else (1e3, "k")
    return f"{figures(per_second / unit, 2)} {name}/s"


def thousands(count: float) -> str:
    """1 286 400."""
    return f"{count:,.0f}".replace(",", " ")
