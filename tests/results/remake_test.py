"""Parts of docs/results/remake: tables, numbers, and that a page is replaced whole or not at all."""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

from tables import RemakeError, Table, figures, percent, rate, table_from_markdown, thousands, with_tables
from page import Page

TEXT = """# Page

Prose before.

<!-- table one -->

| old |
|---|
| 1 |

<!-- end -->

![chart](../pictures/chart.svg)
"""


class Tables(unittest.TestCase):
    def test_numbers_as_people_read_them(self):
        self.assertEqual([figures(value) for value in (0.000312, 0.63, 12.66, 1940.0, 999.6)],
                         ["0.000312", "0.630", "12.7", "1940", "1000"])
        self.assertEqual(figures(3.2e-7, 2), "3.2e-07")
        self.assertEqual([figures(float("nan")), figures(0.0)], ["nan", "0"])
        self.assertEqual([percent(value) for value in (0.00087, 0.1, 0.284, 3.1)],
                         ["0.087 %", "10 %", "28 %", "310 %"])
        self.assertEqual([rate(4.17e6), rate(11.04e6), rate(32374.0)], ["4.2 M/s", "11 M/s", "32 k/s"])
        self.assertEqual(thousands(1286400), "1 286 400")

    def test_only_what_lies_between_the_markers_changes(self):
        made = with_tables(TEXT, {"one": Table(["a", "b"], [["1", "2"]])})
        before, after = TEXT.split("| old")[0], TEXT.split("| 1 |\n")[1]
        self.assertEqual(made, before + "| a | b |\n| --- | --- |\n| 1 | 2 |\n" + after)
        self.assertEqual(with_tables(made, {}), made)

    def test_faults(self):
        self.assertEqual(Table(["a"], []).fault(), "has no rows")
        self.assertIn("row of 1 cells, expected 2", Table(["a", "b"], [["1"]]).fault())
        self.assertEqual(Table(["a", "b"], [["1", "2"]]).fault(), "")
        with self.assertRaises(RemakeError):
            table_from_markdown("no table here")

    def test_table_of_a_program(self):
        table = table_from_markdown("a line\n| a | b |\n|---|---|\n| 1 | |\n")
        self.assertEqual((table.columns, table.rows), (["a", "b"], [["1", ""]]))


class Pages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.target = Path(folder.name) / "target"
        self.text = self.target / "docs/results/page.md"
        self.text.parent.mkdir(parents=True)
        self.text.write_text(TEXT)
        self.page = Page("page", self.target, Path(folder.name), Path(sys.executable), None, True)
        self.chart = self.page.folder / "chart.svg"
        self.chart.write_text("<svg/>")
        quiet = contextlib.redirect_stderr(io.StringIO())
        quiet.__enter__()
        self.addCleanup(quiet.__exit__, None, None, None)

    def refused(self, why):
        with self.assertRaisesRegex(RemakeError, why):
            self.page.finish()
        self.assertEqual(self.text.read_text(), TEXT)
        self.assertFalse((self.target / "docs/pictures").exists())

    def test_all_made(self):
        self.page.table("one", "a | b", [["1", "2"]])
        self.page.save("docs/pictures/chart.svg", self.chart)
        self.page.finish()
        self.assertIn("| 1 | 2 |", self.text.read_text())
        self.assertEqual((self.target / "docs/pictures/chart.svg").read_text(), "<svg/>")

    def test_missing_chart(self):
        self.page.table("one", "a", [["1"]])
        self.refused("chart ../pictures/chart.svg was not made")

    def test_missing_table(self):
        self.page.save("docs/pictures/chart.svg", self.chart)
        self.refused("nothing makes table one")

    def test_missing_marker(self):
        self.page.table("two", "a", [["1"]])
        self.refused("no marker <!-- table two -->")

    def test_empty_table(self):
        self.page.save("docs/pictures/chart.svg", self.chart)
        self.page.table("one", "a", [])
        self.refused("table one has no rows")

    def test_what_is_left_out_stays(self):
        self.page.leave("one", "a reason")
        self.page.leave("../pictures/chart", "a reason")
        self.page.finish()
        self.assertEqual(self.text.read_text(), TEXT)

    def test_a_failing_program(self):
        with self.assertRaisesRegex(RemakeError, "exit code 3: it says why"):
            self.page.knotlight("-c", "import sys; print('it says why', file=sys.stderr); sys.exit(3)")
        self.assertEqual(self.page.knotlight("-c", "print('out'); exit(3)", allowed=(0, 3)), "out\n")


if __name__ == "__main__":
    unittest.main()
