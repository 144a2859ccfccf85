"""What a recording will be: its waveform, its spectrum, and some numbers."""

import numpy as np
from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from skinsource.base.published import Band
from skinsource.design.recordings import UNITS, ImportChoice, Taken
from skinsource.signals.spectra import share_outside_band
from skinsource.specs.samples import Samples
from skinsource_gui.theme import UNIT_PX, set_tone, tabular
from skinsource_gui.widgets.inputs.waveform_preview import WaveformPreview
from skinsource_gui.widgets.plot.spectrum_preview import SpectrumPreview


class ImportPreview(QWidget):
    """Shows a `Taken`, or a sentence that says why there is none."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("import_preview")
        self._waveform = WaveformPreview(axis=True)
        self._spectrum = SpectrumPreview()
        self._numbers, self._notes = QLabel(), QLabel()
        self._numbers.setObjectName("import_numbers")
        self._numbers.setFont(tabular(self._numbers.font()))
        self._notes.setObjectName("import_notes")
        set_tone(self._notes, "dim")
        for label in (self._numbers, self._notes):
            label.setWordWrap(True)
            label.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self._waveform.setMinimumHeight(120)
        self._spectrum.setMinimumHeight(120)
        self._numbers.setMinimumHeight(2 * self.fontMetrics().lineSpacing())
        self._notes.setMinimumHeight(3 * self.fontMetrics().lineSpacing())
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(UNIT_PX)
        column.addWidget(self._waveform, 1)
        column.addWidget(self._spectrum, 1)
        column.addWidget(self._numbers)
        column.addWidget(self._notes)

    @property
    def words(self) -> str:
        """All that is said below the pictures, or in their place."""
        return " ".join((self._waveform.words, self._numbers.text(), self._notes.text())).strip()

    def sizeHint(self) -> QSize:
        return QSize(440, 420)

    def show_taken(self, taken: Taken, choice: ImportChoice, band_hz: Band | None) -> None:
        """Show what ``choice`` will import, and the band in which the limb was measured."""
        samples = taken.samples
        rate = samples.sample_rate_hz
        self._waveform.show_samples(samples.values / (samples.peak or 1.0), rate)
        self._spectrum.show_samples(samples.values, rate, band_hz)
        rms = float(np.sqrt(np.mean(samples.values**2)))
        unit = f" {samples.unit}" if samples.unit else ""
        also = _in_own_unit(samples, choice)
        self._numbers.setText(
            f"{samples.duration_s:.4g} s · peak {samples.peak:.3g}{unit}{also} · "
            f"RMS {rms:.3g}{unit} · {samples.values.size} samples at {rate:g} Hz"
            + ("" if band_hz is None else f"\n{_outside(samples, band_hz)}")
        )
        self._notes.setText(" ".join(taken.notes))
        self.set_pale(False)

    def show_words(self, words: str) -> None:
        """Show nothing, and say why."""
        self._waveform.show_words(words)
        self._spectrum.show_samples(None)
        self._numbers.clear()
        self._notes.clear()

    def set_pale(self, pale: bool) -> None:
        """Whether something newer is on its way."""
        self._waveform.set_pale(pale)


def _in_own_unit(samples: Samples, choice: ImportChoice) -> str:
    """The peak in the unit of the file, where that is another acceleration: ``" (0.50 g)"``."""
    unit = UNITS[choice.unit]
    if choice.scale != "keep" or unit.factor == 1.0 or unit.derivatives:
        return ""
    peak = samples.peak / unit.factor
    return f" ({peak:.2f} {unit.name})" if peak >= 0.1 else f" ({peak:.2g} {unit.name})"


def _outside(samples: Samples, band_hz: Band) -> str:
    share = _percent(share_outside_band(samples.values, samples.sample_rate_hz, band_hz))
    low_hz, high_hz = band_hz
    return f"{share} of the energy lies outside the measured band, {low_hz:g} to {high_hz:g} Hz"


def _percent(share: float) -> str:
    if share < 0.001:
        return "Less than 0.1 %"
    return f"{100.0 * share:.1f} %" if share < 0.1 else f"{100.0 * share:.0f} %"
