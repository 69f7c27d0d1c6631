"""A page of docs/results while it is made; what was made goes to its place whole or not at all."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from programs import Programs, say
from tables import RemakeError, Table, marked_tables, read_csv, shown_charts, with_tables

ROOT = Path(__file__).resolve().parents[3]
NOT_TRUSTED = 3  # exit code of a run that finished but distrusts its own numbers


class Page:
    """What a page is made with: programs, tables, files."""

    def __init__(self, name: str, target: Path, scratch: Path, program: Path,
                 benchmarks: Path | None, quick: bool) -> None:
        self.name, self.target, self.quick = name, target, quick
        self.folder = scratch / name  # empty at first; what programs write
        self.folder.mkdir()
        self._program, self._benchmarks = program, benchmarks
        self._tables: dict[str, Table] = {}
        self._files: dict[str, Path] = {}
        self._emptied: list[str] = []
        self._left: list[str] = []
        self._programs = Programs(name, self.folder)

    @property
    def benchmarks(self) -> bool:
        return self._benchmarks is not None

    def knotlight(self, *arguments: object, allowed: tuple[int, ...] = (0,)) -> str:
        return self.run([self._program, *arguments], allowed)

    def finite_elements(self, scene: str, folder: Path, levels: int) -> None:
        """The optional rival, on the scene of a chart's folder; needs Debian's Python for its packages."""
        self.run(["/usr/bin/python3", "-B", ROOT / "tests/bars/fem.py", scene, folder, "--program", self._program,
                  "--levels", levels])

    def benchmark(self, program: str, *arguments: object) -> str:
        """`program` as its place in the build's folder tests: bench/bkm_bench, bars/bars."""
        if self._benchmarks is None:
            raise RemakeError(f"needs {program}: expected --benchmarks FOLDER")
        return self.run([self._benchmarks / program, *arguments])

    def timings(self, program: str, pattern: str) -> dict[str, dict[str, Any]]:
        """Google Benchmark's figures by name, for the benchmarks that the pattern names."""
        text = self.benchmark(program, "--benchmark_format=json", f"--benchmark_filter={pattern}",
                              *(["--benchmark_min_time=0.01"] if self.quick else []))
        try:
            return {entry["name"]: entry for entry in json.loads(text)["benchmarks"]}
        except ValueError as error:
            raise RemakeError(f"{program}: no benchmark matches {pattern}") from error

    def run(self, command: list[object], allowed: tuple[int, ...] = (0,), cwd: Path = ROOT) -> str:
        return self._programs.run(command, allowed, cwd)

    def note(self, text: str) -> None:
        say(f"{self.name}: {text}")

    def leave(self, start: str, why: str) -> None:
        """Tables and charts whose names start so stay as they are."""
        self._left.append(start)
        self.note(f"{start} left out: {why}")

    def has_bunny(self) -> bool:
        if (ROOT / ".fetched/bunny.obj").exists():
            return True
        if not self.quick:
            raise RemakeError(".fetched/bunny.obj is missing: ./knotlight info scenes/bunny.yaml fetches it")
        return False

    def table(self, name: str, columns: str, rows: list[list[str]]) -> None:
        """`columns` as in Markdown, without the outer bars."""
        self._tables[name] = Table([cell.strip() for cell in columns.split("|")], rows)

    def save(self, place: str, source: Path) -> None:
        """A file to put at `place`, relative to the repository."""
        if not source.is_file():
            raise RemakeError(f"{place} was not made")
        self._files[place] = source

    def save_folder(self, place: str, source: Path) -> None:
        """All of a folder; what the old one has beyond it goes."""
        for file in sorted(source.iterdir()):
            self.save(f"{place}/{file.name}", file)
        self._emptied.append(place)

    def csv(self, place: str) -> list[dict[str, str]]:
        return read_csv(self._files[place] if place in self._files else self.target / place)

    def finish(self) -> int:
        """Checks that all is there, then puts it in place. Returns the seconds all took."""
        text_place = f"docs/results/{self.name}.md"
        text = self._files.pop(text_place, self.target / text_place).read_text(encoding="utf-8")
        for name, table in self._tables.items():
            if name not in marked_tables(text):
                raise RemakeError(f"{text_place}: no marker <!-- table {name} --> ... <!-- end -->")
            if table.fault():
                raise RemakeError(f"{text_place}: table {name} {table.fault()}")
        for name in marked_tables(text):
            if name not in self._tables and not self._is_left(name):
                raise RemakeError(f"{text_place}: nothing makes table {name}")
        for chart in shown_charts(text):
            place = os.path.normpath(f"docs/results/{chart}")
            if place not in self._files and not self._is_left(chart):
                raise RemakeError(f"{text_place}: chart {chart} was not made")
        for place, source in self._files.items():
            self._replace(place, source.read_bytes())
        self._replace(text_place, with_tables(text, self._tables).encode())
        for place in self._emptied:
            for old in (self.target / place).glob("*"):
                if f"{place}/{old.name}" not in self._files:
                    old.unlink()
        return round(self._programs.seconds())

    def _is_left(self, name: str) -> bool:
        return any(name.startswith(start) for start in self._left)

    def _replace(self, place: str, content: bytes) -> None:
        final = self.target / place
        final.parent.mkdir(parents=True, exist_ok=True)
        part = final.with_name(final.name + ".part")
        part.write_bytes(content)
        part.replace(final)
