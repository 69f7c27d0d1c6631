"""Remakes the tables and charts of docs/results: python3 docs/results/remake [PAGE...] [options].

`./knotlight results` builds what this needs and calls it. Python 3.11, standard library only.
"""

from __future__ import annotations

import argparse
import difflib
import shutil
import sys
import tempfile
import time
from pathlib import Path

from pages import PAGES
from tables import RemakeError
from page import ROOT, Page

# What reading the output of another version of a program ends in; SyntaxError is that of XML.
UNEXPECTED = (LookupError, TypeError, ValueError, StopIteration, SyntaxError)
COPIED = ("docs", "tests/bars/results", "tests/bars/fem.csv")  # what -o works on a copy of


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="results", description="Remakes tables and charts of docs/results.")
    parser.add_argument("pages", nargs="*", metavar="PAGE", help=f"{', '.join(PAGES)}; none: all")
    parser.add_argument("--quick", action="store_true",
                        help="small effort: shows that every table and chart can be made, not what is true")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR",
                        help="work on a copy of docs there; default: in place, with --quick build/results")
    parser.add_argument("--program", type=Path, default=ROOT / "build/bench/knotlight", help="knotlight")
    parser.add_argument("--benchmarks", type=Path, metavar="FOLDER",
                        help="the build's folder tests; left out: so are pages that need benchmarks")
    parser.add_argument("--check", action="store_true", help="look at these arguments, make nothing")
    chosen = parser.parse_args()
    for page in chosen.pages:
        if page not in PAGES:
            near = difflib.get_close_matches(page, PAGES, 1, 0.0)[0]
            print(f"results: no page '{page}', expected one of docs/results; nearest: {near}", file=sys.stderr)
            sys.exit(2)
    if chosen.quick and chosen.output is None:
        chosen.output = ROOT / "build/results"
    if chosen.output is not None and chosen.output.resolve() == ROOT:
        print("results: -o is the repository itself, expected another folder", file=sys.stderr)
        sys.exit(2)
    return chosen


def copied(target: Path) -> Path:
    """A fresh copy of what is remade."""
    for place in COPIED:
        source, copy = ROOT / place, target / place
        if source.is_dir():
            shutil.copytree(source, copy, dirs_exist_ok=True, ignore=shutil.ignore_patterns("remake"))
        else:
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, copy)
    return target


def remake(chosen: argparse.Namespace) -> None:
    target = ROOT if chosen.output is None else copied(chosen.output.resolve())
    benchmarks = chosen.benchmarks.resolve() if chosen.benchmarks else None
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="knotlight-results-") as scratch:
        for name in chosen.pages or PAGES:
            page = Page(name, target, Path(scratch), chosen.program.resolve(), benchmarks, chosen.quick)
            if PAGES[name].needs_benchmarks and benchmarks is None:
                page.note("left out: needs benchmarks (--benchmarks FOLDER)")
                continue
            try:
                PAGES[name].make(page)
                page.note(f"made in {page.finish()} s")
            except RemakeError as error:
                raise RemakeError(f"{name}: {error}") from error
            except UNEXPECTED as error:
                raise RemakeError(f"{name}: a program wrote something unexpected: {error!r}") from error
            shutil.rmtree(page.folder)
    print(f"{target}/docs/results: {time.monotonic() - start:.0f} s", file=sys.stderr)


def main() -> int:
    chosen = arguments()
    if chosen.check:
        return 0
    try:
        remake(chosen)
    except (RemakeError, OSError) as error:
        print(f"results: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\nresults: interrupted; the pages before this one are made", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
