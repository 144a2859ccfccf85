"""The spectrogram of one of the selected outputs."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, ClassVar

from PySide6.QtWidgets import QComboBox, QLabel, QSizePolicy, QWidget

from skinsource.design.comparing import match_words
from skinsource.design.design import Design
from skinsource.design.labels import signal_words
from skinsource.design.panel_settings import (
    CEILING,
    FLOOR,
    WINDOW,
    SpectrogramSettings,
    settings_of,
    with_settings,
)
from skinsource.design.view import View
from skinsource.limbs.locations import output_words
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.fields import ChoiceSpec
from skinsource_gui.figure_panel import SILENT, FigurePanel
from skinsource_gui.panels.spectrogram.picture import Shown, SpectrogramPicture
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.beside_or_below import BesideOrBelow
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.fields.level_text import output_text
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.plot.ranges import Range
from skinsource_gui.widgets.room.letter_width import LetterWidth

_NARROWEST_HZ, _MOST_NUMBER_PX = 5.0, 84


class SpectrogramPanel(FigurePanel):
    """How much of each frequency there is in an output, and when."""

    title: ClassVar[str] = "Spectrogram"
    name: ClassVar[str] = "spectrogram"

    def __init__(self, parent: QWidget | None = None) -> None:
        self.picture = SpectrogramPicture()
        super().__init__(self.picture, parent)
        self._view, self._settings = View(), SpectrogramSettings()
        self._results: Mapping[str, Any] | None = None
        self.output = ChoiceField(ChoiceSpec(label="Output", options=()), empty="Select outputs")
        self.output.setObjectName("spectrogram_output")
        self.window_length = ChoiceField(WINDOW)
        self.window_length.setObjectName("spectrogram_window")
        self.floor = NumberField(FLOOR, widest_unit="Hz")
        self.ceiling = NumberField(CEILING, widest_unit="Hz")
        for choice in (self.output, self.window_length):
            # Never narrower than its words.
            choice.setMinimumContentsLength(0)
            choice.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.window_length.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        for field in (self.floor, self.ceiling):
            LetterWidth(field, _MOST_NUMBER_PX, at_most=True)
        what, band = (
            (self.output, self.window_length),
            (self.floor, QLabel("–"), self.ceiling, None),
        )
        self.choices.addWidget(BesideOrBelow(what, band, spacing_px=UNIT_PX // 2))
        self.output.chosen.connect(self._choose_output)
        self.window_length.chosen.connect(self._choose_window)
        self.floor.edited.connect(self._choose_floor)
        self.ceiling.edited.connect(self._choose_ceiling)
        self.figure.say(self.no_outputs)

    @property
    def picture_words(self) -> str:
        return f"Window {self.window_length.currentText()}"

    @property
    def needs(self) -> frozenset[str]:
        drawn = {"output_spectrogram", "spectrogram_output", "response_time_s"}
        drawn |= {"sample_rate_hz", "axes", "match_gain", "method", "limb_data"}
        return frozenset(drawn)

    def begin_anew(self) -> None:
        self.picture.begin_anew()

    def show_state(self, design: Design, view: View) -> None:
        settings = settings_of(view, self.name, SpectrogramSettings)
        redrawn = (settings.floor_hz, settings.ceiling_hz) != (
            self._settings.floor_hz,
            self._settings.ceiling_hz,
        )
        self._view, self._settings = view, settings
        self._show_choices(design.limb)
        self.picture.show_playhead(view.playhead_s)
        if not view.outputs:
            self.say_instead(self.no_outputs)
        elif self.figure.message == self.no_outputs:
            self.await_results()
        elif redrawn and self._results is not None:
            self._draw(self._results)

    def show_playhead(self, view: View) -> None:
        self._view = view
        self.picture.show_playhead(view.playhead_s)

    def show_results(self, results: Mapping[str, Any]) -> None:
        if results["output_spectrogram"] is None:
            self.say_instead(self.no_outputs)
            return
        if not results["output_spectrogram"].amplitude.any():
            self.say_instead(SILENT)
            return
        self._results = dict(results)
        self._draw(results)

    def say_instead(self, message: str) -> None:
        self._results = None
        super().say_instead(message)

    def _show_choices(self, limb: str) -> None:
        settings, outputs = self._settings, self._view.outputs
        known = [self.output.itemText(k) for k in range(self.output.count())]
        wanted = [f"{number} {output_words(number, limb).short_name}" for number in outputs]
        if known != wanted:
            self.output.clear()
            for number, words in zip(outputs, wanted, strict=True):
                self.output.addItem(words, str(number))
        chosen = settings.output if settings.output in outputs else (outputs or (0,))[-1]
        self.output.set_value(str(chosen) if chosen else "")
        self.output.setEnabled(len(outputs) > 1)
        self.window_length.set_value(settings.window_ms)
        self.floor.set_value(settings.floor_hz)
        self.ceiling.set_value(min(settings.ceiling_hz, facts_of(limb).sample_rate_hz / 2.0))

    def _draw(self, results: Mapping[str, Any]) -> None:
        found = results["output_spectrogram"]
        band = _band(self._settings, results["sample_rate_hz"] / 2.0)
        first_s = float(results["response_time_s"][0])
        matched = match_words(results["match_gain"])
        self.picture.show_spectrogram(
            Shown(found=found, first_s=first_s, band_hz=band, matched=matched)
        )
        number = results["spectrogram_output"]
        limb = results["limb_data"]
        words = [output_text(number, limb.name)]
        words.append(signal_words(results["axes"], results["method"]))
        if results["method"] == "mag" and len(results["axes"]) > 1:
            words.append("of a magnitude: rectified, doubled frequencies")
        if limb.synthetic:
            words.append("synthetic limb")
        self.show_found(" · ".join(words))

    def _choose_output(self, number: str, gesture: int | None) -> None:
        del gesture
        self._change(output=float(number))

    def _choose_window(self, window_ms: str, gesture: int | None) -> None:
        del gesture
        self._change(window_ms=window_ms)

    def _choose_floor(self, value_hz: float, gesture: int | None) -> None:
        del gesture
        self._change(floor_hz=value_hz)

    def _choose_ceiling(self, value_hz: float, gesture: int | None) -> None:
        del gesture
        self._change(ceiling_hz=value_hz)

    def _change(self, **changes: Any) -> None:
        settings = replace(self._settings, **changes)
        if settings != self._settings:
            self.view_changed.emit(with_settings(self._view, self.name, settings))


def _band(settings: SpectrogramSettings, highest_hz: float) -> Range:
    """Floor and ceiling inside of what there is, some hertz apart."""
    floor = min(settings.floor_hz, highest_hz - _NARROWEST_HZ)
    ceiling = min(settings.ceiling_hz, highest_hz)
    return (floor, ceiling) if ceiling - floor >= _NARROWEST_HZ else (floor, highest_hz)
