"""One line in the terminal that shows how far a job is."""

import time
from types import TracebackType
from typing import Self, TextIO

from skinsource.job import left_in_words, seconds_left

_WIDTH = 30


class ProgressBar:
    """Draws itself over and over on one line; draws nothing where there is no terminal.

    Use it in a ``with`` statement, and hand it to a job as its ``progress``.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._shown = ""
        self._is_terminal = stream.isatty()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._draw("")

    def __call__(self, done: int, total: int, text: str) -> None:
        """Show ``done`` of ``total``."""
        share = done / total if total else 1.0
        filled = "#" * int(_WIDTH * share)
        self._draw(f"[{filled:.<{_WIDTH}}] {share:4.0%} {text}"[:79])

    def _draw(self, line: str) -> None:
        if self._is_terminal and line != self._shown:
            self._stream.write("\r" + line.ljust(len(self._shown)) + ("" if line else "\r"))
            self._stream.flush()
            self._shown = line


class WithTimeLeft:
    """Shows progress with the time left, as seen since the start of this run."""

    def __init__(self, bar: ProgressBar) -> None:
        self._bar = bar
        self._start_s = time.monotonic()
        self._before: int | None = None

    def __call__(self, done: int, total: int, text: str) -> None:
        """Show ``done`` of ``total``."""
        if self._before is None:
            self._before = done
        elapsed_s = time.monotonic() - self._start_s
        left = left_in_words(seconds_left(done - self._before, total - self._before, elapsed_s))
        self._bar(done, total, f"{text}  {left}".rstrip())
