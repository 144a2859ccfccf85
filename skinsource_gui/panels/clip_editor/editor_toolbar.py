"""Tools of the editor, and words about its clip."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QButtonGroup, QHBoxLayout, QSizePolicy, QToolButton, QWidget

from skinsource_gui.theme import set_tone
from skinsource_gui.widgets.fitting_label import FittingLabel
from skinsource_gui.widgets.keys import key_text
from skinsource_gui.widgets.tooltips import show_tooltip

_PLACE = "clip_editor"
_TOOLS = (
    ("look", "Look", "Read values; a drag moves what is seen"),
    (
        "pen",
        "Draw",
        "Draw samples; with Shift held a straight line, with the right button back to zero",
    ),
    (
        "envelope",
        "Envelope",
        "Shape the envelope: a click on the curve adds a point, a drag moves it",
    ),
    (
        "glide",
        "Glide",
        "Shape frequency and amplitude of a glide: a click on a curve adds a point",
    ),
)


class EditorToolbar(QWidget):
    """Look, draw, envelope; bound to the band; see everything."""

    tool_wanted = Signal(str)
    bound_wanted = Signal()
    everything_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setStyleSheet("QToolButton { padding: 2px 8px; }")
        row = QHBoxLayout(self)
        row.setContentsMargins(4, 2, 4, 2)
        row.setSpacing(2)
        self._group = QButtonGroup(self)
        self._tools: dict[str, QToolButton] = {}
        for name, text, hint in _TOOLS:
            button = self._button(text, f"{hint} ({key_text(_PLACE, name)})")
            button.setCheckable(True)
            self._group.addButton(button)
            self._tools[name] = button
            button.clicked.connect(lambda _=False, name=name: self.tool_wanted.emit(name))
            row.addWidget(button)
        self._tools["look"].setChecked(True)
        row.addSpacing(8)
        self._bound, self._band_known = self._button("Bound to band", ""), False
        self._bound.clicked.connect(lambda: self.bound_wanted.emit())
        row.addWidget(self._bound)
        self._fit = self._button("Fit", f"See all of the clip ({key_text(_PLACE, 'whole')})")
        self._fit.clicked.connect(lambda: self.everything_wanted.emit())
        row.addWidget(self._fit)
        self._words = FittingLabel()
        self._words.setObjectName("clip_words")
        set_tone(self._words, "dim")
        self._words.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self._words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        row.addWidget(self._words, 1)

    def show_tool(self, name: str) -> None:
        """Which tool is taken."""
        self._tools[name].setChecked(True)

    def show_words(self, words: str, *, enabled: bool, hint: str = "") -> None:
        """Words about the clip, and how to begin; whether there is one to edit."""
        whole = f"{words} · {hint}" if hint else words
        self._words.show_phrases((whole, hint or words, words))
        show_tooltip(self._words, whole)
        for button in (*self._tools.values(), self._fit):
            button.setEnabled(enabled)
        self._bound.setEnabled(enabled and self._band_known)

    def show_band(self, band_hz: tuple[float, float] | None) -> None:
        """In which band the limb was measured; None: not known, and nothing can be bound to it.

        It counts from the next words on.
        """
        words = "In which band this limb was measured is not known"
        if band_hz is not None:
            words = (
                f"Take away what lies outside {band_hz[0]:g} to {band_hz[1]:g} Hz, where nothing "
                "was measured; the waveform becomes samples"
            )
        show_tooltip(self._bound, words)
        self._band_known = band_hz is not None

    def offer_glide(self, offered: bool) -> None:
        """Whether the clip plays a glide, whose curves can be shaped."""
        self._tools["glide"].setVisible(offered)

    def _button(self, text: str, hint: str) -> QToolButton:
        button = QToolButton(self)
        button.setObjectName(f"clip_{text.lower()}")
        button.setText(text)
        button.setToolTip(hint)
        button.setAccessibleName(text)
        button.setAutoRaise(True)
        return button
