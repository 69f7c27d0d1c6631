"""Runs one program after the other and says on the terminal which one, for which page, since when."""

from __future__ import annotations

import shutil
import subprocess
import sys
import time
from pathlib import Path

from tables import RemakeError

POLL = 0.05  # seconds between looks at a running program


def say(line: str, stays: bool = True) -> None:
    """A line on the terminal; one that does not stay is written over by the next, and in a file left out."""
    if not sys.stderr.isatty():
        if stays:
            print(line, file=sys.stderr, flush=True)
        return
    width = shutil.get_terminal_size().columns - 1
    print(f"\r\033[K{line if stays else line[:width]}", end="\n" if stays else "", file=sys.stderr, flush=True)


class Programs:
    """Those of one page. Their output goes to files in `folder`, where they may write too."""

    def __init__(self, page: str, folder: Path) -> None:
        self._page, self._folder = page, folder
        self._start = time.monotonic()

    def seconds(self) -> float:
        return time.monotonic() - self._start

    def run(self, command: list[object], allowed: tuple[int, ...], cwd: Path) -> str:
        """Standard output. Any exit code but those allowed is an error with the program's last words."""
        words = [str(word) for word in command]
        shown = " ".join([Path(words[0]).name, *words[1:]]).replace(f"{self._folder}/", "")
        out, err = self._folder / ".stdout", self._folder / ".stderr"
        with out.open("wb") as stdout, err.open("wb") as stderr:
            try:
                process = subprocess.Popen(words, cwd=cwd, stdout=stdout, stderr=stderr,
                                           stdin=subprocess.DEVNULL)
            except OSError as error:
                raise RemakeError(f"{words[0]}: {error.strerror}") from error
            try:
                self._say(shown, stays=not sys.stderr.isatty())
                while process.poll() is None:
                    time.sleep(POLL)
                    self._say(shown, stays=False)
            finally:
                process.kill()
                process.wait()
        if process.returncode not in allowed:
            said = err.read_text(errors="replace").strip().splitlines() or ["no message"]
            raise RemakeError(f"{shown}: exit code {process.returncode}: {said[-1]}")
        return out.read_text(encoding="utf-8")

    def _say(self, command: str, stays: bool) -> None:
        say(f"{self._page}, {self.seconds():.0f} s: {command}", stays)
