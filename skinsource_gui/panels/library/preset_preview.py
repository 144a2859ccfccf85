"""What a preset plays, and what is known about it."""

from html import escape

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QFrame, QLabel, QScrollArea, QVBoxLayout, QWidget

from skinsource.base.errors import SkinSourceError
from skinsource.base.quoting import sentence
from skinsource.design.presets.presets import Preset, mixed
from skinsource.limbs.locations import input_words
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.inputs.clip_strip import ClipStrip, strip_lanes
from skinsource_gui.widgets.plot.spectrum_preview import SpectrumPreview

_LEAST_WIDTH_PX = 160
_LEAST_STRIP_PX, _LEAST_SPECTRUM_PX, _LEAST_WORDS_PX = 58, 64, 40
_MOST_STRIP_PX, _MOST_SPECTRUM_PX, _MOST_WORDS_PX = 84, 96, 92


class PresetPreview(QWidget):
    """Clips on their tracks, the spectrum of their sum, and words."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._preset: Preset | None = None
        self._limb = ""
        self.strip, self.spectrum, self.words = ClipStrip(), SpectrumPreview(), QLabel()
        self.strip.setAccessibleName("Clips of the preset")
        about = QScrollArea()
        about.setObjectName("preset_about")
        about.setFrameShape(QFrame.Shape.NoFrame)
        about.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        about.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        about.setWidgetResizable(True)
        about.setWidget(self.words)
        about.viewport().setAutoFillBackground(False)
        for part, least, most in (
            (self.strip, _LEAST_STRIP_PX, _MOST_STRIP_PX),
            (self.spectrum, _LEAST_SPECTRUM_PX, _MOST_SPECTRUM_PX),
            (about, _LEAST_WORDS_PX, _MOST_WORDS_PX),
        ):
            part.setMinimumHeight(least)
            part.setMaximumHeight(most)
        self.setMinimumWidth(_LEAST_WIDTH_PX)
        self.words.setObjectName("preset_words")
        self.words.setWordWrap(True)
        self.words.setTextFormat(Qt.TextFormat.RichText)
        self.words.setAlignment(Qt.AlignmentFlag.AlignTop)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.strip, 3)
        column.addWidget(self.spectrum, 4)
        column.addWidget(about, 3)

    @property
    def preset(self) -> Preset | None:
        """What is shown."""
        return self._preset

    def show_limb(self, limb: str) -> None:
        """Take over on which limb it would be placed."""
        if limb != self._limb:
            self._limb, preset = limb, self._preset
            self._preset = None
            self.show_preset(preset)

    def show_preset(self, preset: Preset | None) -> None:
        """Show another one, or nothing."""
        if preset == self._preset:
            return
        self._preset = preset
        self.setVisible(preset is not None)
        if preset is None:
            return
        try:
            limb = facts_of(self._limb)
            rate_hz = limb.sample_rate_hz
            samples = mixed(preset.fragment, rate_hz)
            self.strip.show_lanes(strip_lanes(preset.fragment, rate_hz))
            self.spectrum.show_samples(samples, rate_hz, limb.band_hz)
        except SkinSourceError as error:
            self.strip.show_words(sentence(str(error)))
            self.spectrum.show_samples(None)
        self._show_words(preset)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self._preset is not None:
            self._show_words(self._preset)

    def _show_words(self, preset: Preset) -> None:
        parts = [f"<b>{escape(preset.name)}</b> · {escape(_facts(preset, self._limb))}"]
        if preset.description:
            parts.append(escape(preset.description))
        if preset.source:
            dim = current_theme().dim
            parts.append(f"<span style='color:{dim}'>Source: {escape(preset.source)}</span>")
        self.words.setText("<br>".join(parts))


def _facts(preset: Preset, limb: str) -> str:
    """How long, how many clips, and for which places."""
    lanes = preset.fragment.lanes
    length_s = preset.fragment.duration_s
    length = f"{length_s:.3g} s" if length_s >= 1.0 else f"{1e3 * length_s:.3g} ms"
    if len(lanes) == 1:
        n = len(lanes[0].clips)
        return length if n == 1 else f"{length}, {n} clips"
    places = (lane.location for lane in lanes)
    names = (input_words(k, limb).short_name if _is_there(k, limb) else str(k) for k in places)
    return f"{length}, {len(lanes)} tracks: {', '.join(names)}"


def _is_there(place: int, limb: str) -> bool:
    return place <= facts_of(limb).n_inputs
