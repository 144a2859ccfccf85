"""What is promised about errors, times and memory, beside what is measured now."""

from collections.abc import Callable, Sequence

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QScrollArea, QVBoxLayout, QWidget

from skinsource.method_comparison.table import Row
from skinsource.rendering.check import N_SAMPLES
from skinsource_gui.accuracy_page.bench_table import OURS, on_limb
from skinsource_gui.accuracy_page.memory_use import resident_bytes
from skinsource_gui.status.edit_times import milliseconds, most_within
from skinsource_gui.status.error_label import PROMISED, VISIBLE, one_digit_up
from skinsource_gui.status.status_line import StatusLine
from skinsource_gui.theme import UNIT_PX, set_tone, tabular

#: Name of each figure: words, and what is promised.
_PROMISES = {
    "error": ("Error of any sample", f"{PROMISED:.0e} of the largest sample"),
    "window": ("Error in the worst 100 ms", "1e-9 of their own peak, down to −120 dB"),
    "silence": ("Where nothing can arrive", "exactly 0"),
    "median": ("Edit to screen, half of all edits", "8 ms with 20 inputs of 1 s"),
    "most": ("Edit to screen, 95 of 100 edits", "16 ms with 20 inputs of 1 s"),
    "long": ("20 inputs of 10 minutes", "10 s and 500 MB"),
    "memory": ("Memory", "350 MB at rest, with one limb"),
    "last": ("Last edit", ""),
    "scope": ("Computed for it", ""),
}
#: Why a figure may be above its promise: by name the promised number, and what it is promised for.
_ABOVE = {
    "error": (
        PROMISED,
        "above the promise: many inputs, long ones or sums that cancel lose digits; the benchmark "
        "shows for which scenes it is kept",
    ),
    "median": (
        8e-3,
        "above the promise, which is for 20 inputs of 1 s on a machine with nothing else to do: "
        "longer inputs, hidden work and a busy machine take longer",
    ),
    "most": (
        16e-3,
        "above the promise, which is for 20 inputs of 1 s: the first edits, another limb and a "
        "busy machine take longer",
    ),
    "memory": (
        350e6,
        "above what is promised at rest: what was computed for this scene is kept for the next "
        "edit, within a bound, and each further limb adds its responses",
    ),
}
_BY_BENCHMARK = "measured by the benchmark"
_NO_EDITS = "nothing was edited yet"
_HEADINGS = ("", "Promised", "Now")
_MODEL = (
    "These are rounding errors: how exactly the studio computes what the impulse responses imply. "
    "They say nothing about how well the responses describe another hand. Measured responses are "
    "measurements on a few people, synthetic ones come from a model; what another hand feels can "
    "differ by far more than any figure here."
)
_CHECK = (
    f"The error is an estimate: when edits pause, {N_SAMPLES} samples of the traces are computed "
    "again in extended precision, and four times the largest difference is told. By theory no "
    "sample is further off than the figure after “at most”: a bound for the worst signals of this "
    "length, and so above what is promised of the estimate. The status bar turns amber above the "
    f"promise and red above {one_digit_up(VISIBLE)}."
)
_SELECTABLE = (
    Qt.TextInteractionFlag.TextSelectableByMouse | Qt.TextInteractionFlag.TextSelectableByKeyboard
)


class AccuracyFigures(QScrollArea):
    """A table of promises and present figures, and what they mean.

    Parameters
    ----------
    status
        Knows the present figures.
    """

    def __init__(self, status: StatusLine, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("accuracy_figures")
        self.setAccessibleName("Promised, and measured now")
        self.setWidgetResizable(True)
        self._status = status
        self._now: dict[str, QLabel] = {}
        self._rows: list[Row] = []
        content = QWidget()
        column = QVBoxLayout(content)
        column.setContentsMargins(2 * UNIT_PX, 2 * UNIT_PX, 2 * UNIT_PX, 2 * UNIT_PX)
        column.setSpacing(2 * UNIT_PX)
        column.addLayout(self._table())
        for text in (_CHECK, _MODEL):
            label = QLabel(text)
            label.setWordWrap(True)
            column.addWidget(label)
        column.addStretch(1)
        self.setWidget(content)

    def refresh(self) -> None:
        """Show the present figures."""
        for name, words in self._present().items():
            if words != self._now[name].text():
                self._now[name].setText(words)
        error, tone = self._status.error.error, ""
        if error is not None and error.estimate > PROMISED:
            tone = "error" if error.estimate > VISIBLE else "warning"
        set_tone(self._now["error"], tone)

    def show_rows(self, rows: Sequence[Row]) -> None:
        """Take over what the benchmark has measured; nothing: it has not yet."""
        self._rows = [row for row in rows if row.engine == OURS and not row.failure]
        self.refresh()

    def _benchmarked(self, figure: Callable[[Row], float | None]) -> str:
        found = [value for value in map(figure, self._rows) if value is not None]
        if not found:
            return _BY_BENCHMARK
        worst = max(found)
        return f"{f'{worst:.1e}' if worst else 'exactly 0'} in the benchmark{on_limb(self._rows)}"

    def _table(self) -> QGridLayout:
        grid = QGridLayout()
        grid.setHorizontalSpacing(3 * UNIT_PX)
        grid.setVerticalSpacing(UNIT_PX)
        for column, heading in enumerate(_HEADINGS):
            label = QLabel(f"<b>{heading}</b>")
            grid.addWidget(label, 0, column)
        for row, (name, (words, promise)) in enumerate(_PROMISES.items(), start=1):
            now = QLabel()
            now.setObjectName(f"now_{name}")
            now.setAccessibleName(words)
            now.setFont(tabular(now.font()))
            now.setWordWrap(True)
            now.setTextInteractionFlags(_SELECTABLE)
            self._now[name] = now
            for column, widget in enumerate((QLabel(words), QLabel(promise), now)):
                grid.addWidget(widget, row, column, Qt.AlignmentFlag.AlignTop)
        grid.setColumnStretch(2, 1)
        return grid

    def _present(self) -> dict[str, str]:
        last, seconds = self._status.last_times()
        error, scope, memory = self._status.error.error, self._status.scope, resident_bytes()
        count = f" ({len(seconds)} edit{'' if len(seconds) == 1 else 's'})"
        return {
            "error": "not checked yet: it is when edits pause and traces are shown"
            if error is None
            else _compared(
                "error",
                error.estimate,
                f"≈ {one_digit_up(error.estimate)} estimated; by theory at most "
                f"{one_digit_up(error.bound)}",
            ),
            "window": self._benchmarked(lambda row: row.err_window),
            "silence": self._benchmarked(lambda row: row.err_silence),
            "median": _timed("median", float(np.median(seconds)), count) if seconds else _NO_EDITS,
            "most": _timed("most", most_within(seconds), count) if seconds else _NO_EDITS,
            "long": "measured by “skinsource bench” in a terminal, about ten minutes",
            "memory": "unknown: this system does not tell"
            if memory is None
            else _compared("memory", memory, f"{memory / 1e6:.0f} MB"),
            "last": "nothing is shown" if last is None else last.sentence(),
            "scope": "nothing is shown" if scope is None else scope.figures(),
        }


def _timed(name: str, seconds: float, count: str) -> str:
    return _compared(name, seconds, milliseconds(seconds) + count)


def _compared(name: str, value: float, words: str) -> str:
    """``words``, and what the promise is for where the value is above it."""
    promised, reason = _ABOVE[name]
    return f"{words} – {reason}" if value > promised else words
