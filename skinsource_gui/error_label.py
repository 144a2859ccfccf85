"""How wrong the numbers on screen are."""

from PySide6.QtWidgets import QLabel, QWidget

from skinsource.rendering.check import N_SAMPLES, TraceError
from skinsource_gui.theme import LIGHT, Theme, tabular

#: What the engine promises, and what would be wrong to the eye, relative to the largest sample.
PROMISED, VISIBLE = 1e-14, 1e-3


class ErrorLabel(QLabel):
    """Says the estimated error of the traces; amber above the promise, red above 1e-3."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("trace_error")
        self.setAccessibleName("Error of the traces")
        self.setFont(tabular(self.font()))
        self._theme = LIGHT
        self._error: TraceError | None = None

    def show_error(self, error: TraceError | None) -> None:
        """Show what is known of the error; None: nothing yet."""
        self._error = error
        if error is None:
            self.clear()
            self.setToolTip("")
        else:
            self.setText(f"· error < {error.estimate:.0e}")
            self.setToolTip(
                f"{N_SAMPLES} samples of the traces were computed again in extended precision.\n"
                f"Four times the largest difference is {error.estimate:.1e} of the peak; "
                f"by theory it is at most {error.bound:.1e}."
            )
        self._paint()

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self._paint()

    def _paint(self) -> None:
        colour = self._theme.dim
        if self._error is not None and self._error.estimate > VISIBLE:
            colour = self._theme.error
        elif self._error is not None and self._error.estimate > PROMISED:
            colour = self._theme.warning
        self.setStyleSheet(f"color: {colour};")
