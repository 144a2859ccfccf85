"""How wrong the numbers on screen are."""

import math

import numpy as np
from PySide6.QtWidgets import QWidget

from skinsource.engine.gains import N_SAMPLES, TraceError
from skinsource_gui.qt.labels import FittingLabel
from skinsource_gui.qt.theme import set_tone, tabular

#: What the engine promises, and what would be wrong to the eye, relative to the largest sample.
PROMISED, VISIBLE = 1e-14, 1e-3


class ErrorLabel(FittingLabel):
    """Says the estimated error of the traces; amber above the promise, red above 1e-3."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("trace_error")
        self.setAccessibleName("Error of the traces")
        self.setFont(tabular(self.font()))
        self._error: TraceError | None = None
        set_tone(self, "dim")

    @property
    def error(self) -> TraceError | None:
        """What is known of the error on screen."""
        return self._error

    def show_error(self, error: TraceError | None) -> None:
        """Show what is known of the error; None: nothing yet."""
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
    """Return estimate and bound, as short as can be."""
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
    """Round ``error`` up to one digit, so that it is never shown smaller than it is."""
    # Less than one rounding is not an error that anything in float64 could have.
    error = max(error, float(np.finfo(np.float64).eps))
    exponent = math.floor(math.log10(error))
    digit = math.ceil(error / 10.0**exponent - 1e-9)
    return f"{digit}e{exponent}" if digit < 10 else f"1e{exponent + 1}"
