"""The label of the estimated error of the traces on the screen."""

import math

import numpy as np
from PySide6.QtWidgets import QWidget

from skinsource.engine.gains import N_SAMPLES, TraceError
from skinsource_gui.qt.labels import FittingLabel
from skinsource_gui.qt.theme import set_tone, tabular

#: The error that the engine promises, and a visible one, relative to the largest sample.
PROMISED, VISIBLE = 1e-14, 1e-3


class ErrorLabel(FittingLabel):
    """Shows the estimated error of the traces; amber above the promise, red above 1e-3."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("trace_error")
        self.setAccessibleName("Error of the traces")
        self.setFont(tabular(self.font()))
        self._error: TraceError | None = None
        set_tone(self, "dim")

    @property
    def error(self) -> TraceError | None:
        """The error that is shown."""
        return self._error

    def show_error(self, error: TraceError | None) -> None:
        """Show an error; None: it is not known yet."""
        self._error, tone = error, "dim"
        if error is None:
            self.show_phrases(("",))
            self.setToolTip("")
        else:
            estimate = f"· error ≈ {rounded_up(error.estimate)}"
            self.show_phrases((f"· {error_text(error)}", estimate, ""))
            self.setToolTip(_sentences(error))
        if error is not None and error.estimate > PROMISED:
            tone = "error" if error.estimate > VISIBLE else "warning"
        set_tone(self, tone)


def error_text(error: TraceError) -> str:
    """Return a short text of estimate and bound."""
    return f"error ≈ {rounded_up(error.estimate)}, at most {rounded_up(error.bound)}"


def _sentences(error: TraceError) -> str:
    lines = [
        f"{N_SAMPLES} samples of the traces were computed again in extended precision.",
        f"Four times the largest difference is {error.estimate:.1e} of the peak; by theory it is "
        f"at most {error.bound:.1e}.",
    ]
    if error.estimate > PROMISED:
        lines.append(f"This is more than the {PROMISED:.0e} that is promised.")
    return "\n".join(lines)


def rounded_up(error: float) -> str:
    """Return ``error`` rounded up to one digit, so that it never looks smaller than it is."""
    # No error in float64 is smaller than one rounding.
    error = max(error, float(np.finfo(np.float64).eps))
    exponent = math.floor(math.log10(error))
    digit = math.ceil(error / 10.0**exponent - 1e-9)
    return f"{digit}e{exponent}" if digit < 10 else f"1e{exponent + 1}"
