"""How long the last edit took until it was seen."""

from time import perf_counter

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import QLabel, QWidget

from skinsource.design import Design, audible_inputs
from skinsource.work import Work
from skinsource_gui.engine import Outcome
from skinsource_gui.theme import tabular

# Numbers that change faster cannot be read.
_PAUSE_MS = 250


_ABOUT = (
    "From the last edit until the window shows it, and the part of it spent on computing.\n"
    "All numbers are computed in double precision (float64)."
)


class TimingLabel(QLabel):
    """Says how many inputs are heard, and how fast results reach the screen.

    Parameters
    ----------
    window
        The window whose painting is waited for.
    """

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self.setObjectName("timing")
        self.setFont(tabular(self.font()))
        self.setContentsMargins(8, 0, 0, 0)
        self.setToolTip(_ABOUT)
        self._inputs = ""
        self._speed = ""
        self._delivered: Outcome | None = None
        self._pause = QTimer(self, singleShot=True, interval=_PAUSE_MS)
        self._pause.timeout.connect(self._say)
        window.installEventFilter(self)

    def show_design(self, design: Design) -> None:
        """Count the inputs of ``design``."""
        count, heard = len(design.inputs), len(audible_inputs(design.inputs))
        silent = f", {heard} heard" if heard < count else ""
        self._inputs = f"{count} input{'' if count == 1 else 's'}{silent}"
        self._say_soon()

    def show_outcome(self, outcome: Outcome) -> None:
        """Wait until results, which the panels have by now, are painted."""
        self._delivered = outcome

    def show_no_outcome(self) -> None:
        """Forget the last time: there are no results."""
        self._delivered, self._speed = None, ""
        self._say()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.UpdateRequest and self._delivered is not None:
            # The window is painted while it handles this event.
            QTimer.singleShot(0, self._note_painted)
        return super().eventFilter(watched, event)

    def _note_painted(self) -> None:
        outcome, self._delivered = self._delivered, None
        if outcome is not None:
            total_ms = (perf_counter() - outcome.request.since_s) * 1e3
            compute_ms = outcome.compute_s * 1e3
            self.setToolTip(f"{_ABOUT}\n{_work_words(outcome.work)}")
            self._speed = f" · on screen in {total_ms:.0f} ms ({compute_ms:.1f} ms computing)"
            self._say_soon()

    def _say_soon(self) -> None:
        if not self._pause.isActive():
            self._say()
            self._pause.start()

    def _say(self) -> None:
        words = self._inputs + self._speed
        if words != self.text():
            self.setText(words)


def _work_words(work: Work) -> str:
    return (
        f"Work for it: {work.forward_transforms} forward and {work.inverse_transforms} inverse "
        f"transforms, {work.samples_drawn} samples drawn, {work.bytes_read / 1e6:.1f} MB read."
    )
