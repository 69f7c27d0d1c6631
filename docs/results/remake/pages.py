"""The pages and what makes each. Pages of which nothing can be made without benchmarks are marked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import accuracy
import bars
import bkm_thesis
import commands
import estimates
import photons
import pictures
import source_models
import speed
import transport
import validate
from page import Page


@dataclass(frozen=True)
class Maker:
    make: Callable[[Page], None]
    needs_benchmarks: bool


PAGES = {
    "accuracy": Maker(accuracy.make, True),
    "pictures": Maker(pictures.make, True),
    "chart": Maker(commands.make_chart, False),
    "bars": Maker(bars.make, True),
    "estimates": Maker(estimates.make, True),
    "bkm-thesis": Maker(bkm_thesis.make, True),
    "speed": Maker(speed.make, False),
    "validate": Maker(validate.make, False),
    "estimators": Maker(photons.make_estimators, True),
    "source-models": Maker(source_models.make, False),
    "expected-values": Maker(photons.make_expected_values, True),
    "transport": Maker(transport.make, True),
    "boundary-methods": Maker(bars.make_boundary_methods, True),
    "stability": Maker(commands.make_stability, False),
    "thesis": Maker(commands.make_thesis, False),
}
