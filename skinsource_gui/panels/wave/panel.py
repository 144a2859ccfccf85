"""How fast a wave travels along the selected outputs, and what it loses."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from PySide6.QtWidgets import QWidget

from skinsource.design.comparing import match_words
from skinsource.design.design import Design
from skinsource.design.signal_path import Voice
from skinsource.design.view import View
from skinsource.engine.analysis_rules import LineWave
from skinsource.signals.analysis.wave_speed import LEAST_EXPLAINED, LEAST_STRAIGHT, TravellingWave
from skinsource_gui.figure_panel import SILENT, FigurePanel
from skinsource_gui.panels.wave.picture import WavePicture
from skinsource_gui.widgets.copied_numbers import copied, copied_level
from skinsource_gui.widgets.empty_words import SKIN

_LINE = "The line goes through the selected outputs, in the order in which they were selected"
_OVERLAP = "waves of several inputs overlap"
_ABOUT = "Along {axis}; distances on the map, delays of the group"


class WavePanel(FigurePanel):
    """Delay and level over the way, and speed and attenuation from them."""

    title: ClassVar[str] = "Wave"
    name: ClassVar[str] = "wave"

    def __init__(self, parent: QWidget | None = None) -> None:
        self.picture = WavePicture()
        super().__init__(self.picture, parent)
        self.about = self.add_above("wave_about")
        self.about.say(_ABOUT.format(axis="z"))
        self.about.setToolTip(
            f"{_LINE}. Delays are where the envelope of the cross-correlation with the first "
            "output is highest; outputs that are mostly noise are left out. A speed takes a line "
            f"whose ends are at least {LEAST_STRAIGHT:.0%} of its way apart, and delays of "
            f"whose variance the way explains {LEAST_EXPLAINED:.0%} or more."
        )
        self.choices.addWidget(self.about, 1)
        self.copy = self.add_copy(self.table)
        self.say_instead(self._few())

    @property
    def needs(self) -> frozenset[str]:
        return frozenset({"line_wave", "shown_outputs", "limb_data", "match_gain", "voices"})

    def show_state(self, design: Design, view: View) -> None:
        if len(view.outputs) < 2:
            self.say_instead(self._few())
        elif self.figure.message == self._few():
            self.await_results()

    def show_results(self, results: Mapping[str, Any]) -> None:
        found: LineWave | None = results["line_wave"]
        if found is None:
            self.say_instead(self._few())
            return
        if not found.wave.alike.any():
            self.say_instead(SILENT)
            return
        outputs = results["shown_outputs"]
        self.copy.offer(True)
        self.about.say(_ABOUT.format(axis=found.axis))
        ranks = tuple(outputs.index(one) for one in found.outputs)
        self.picture.show_wave(found, ranks, match_words(results["match_gain"]))
        left_out = len(outputs) - len(found.outputs)
        note = f" · {left_out} not on the map" if left_out else ""
        synthetic = " · synthetic limb" if results["limb_data"].synthetic else ""
        several = f" · {_OVERLAP}" if _several(results["voices"]) else ""
        self.show_found(f"{wave_words(found.wave)}{several}{note}{synthetic}")

    def show_in_sight(self, names: frozenset[str]) -> None:
        said = self.figure.message == self._few()
        super().show_in_sight(names)
        if said:
            self.figure.say(self._few())

    def table(self) -> str:
        """The numbers, with tabs between the columns."""
        shown = self.picture.shown
        if shown is None or self.picture.message:
            return ""
        wave = shown.wave
        header = ("output", "way_mm", "delay_ms", f"level_{shown.axis}_db", "alike")
        lines = ["\t".join((*header, "counted", "timed"))]
        ways = wave.distance_m * 1e3, wave.delay_s * 1e3
        for k, output in enumerate(shown.outputs):
            way, delay = (copied(one[k]) for one in ways)
            numbers = way, delay, copied_level(wave.level_db[k]), copied(wave.alike[k])
            used = ("yes" if one[k] else "no" for one in (wave.counted, wave.timed))
            lines.append("\t".join((str(output), *numbers, *used)))
        return "\n".join(lines) + "\n"

    def _few(self) -> str:
        if SKIN in self.in_sight:
            return (
                "Select two or more outputs on the skin map, one after the other along a line: "
                "Shift+click adds one"
            )
        return "Show the skin map (View > Panels) to select outputs along a line"


def wave_words(wave: TravellingWave) -> str:
    """Speed and attenuation, with what is known of their error."""
    speed = "No speed: the arrival is not later farther away"
    if wave.counted.sum() < 2:
        return "fewer than two outputs are more than noise"
    if wave.timed.sum() < 2:
        speed = "No speed: the shapes are too unlike"
    elif wave.straight < LEAST_STRAIGHT:
        speed = "No speed: the selected outputs do not go one way"
    elif wave.explained < LEAST_EXPLAINED or wave.speed_deviation_m_per_s >= abs(
        wave.speed_m_per_s
    ):
        speed = "No speed: delays do not grow in step with the distance"
    elif np.isfinite(wave.speed_m_per_s):
        speed = f"Speed {wave.speed_m_per_s:.1f}{_spread(wave.speed_deviation_m_per_s, 1)} m/s"
    loss = f"{wave.attenuation_db_per_cm:.2f}{_spread(wave.attenuation_deviation_db_per_cm, 2)}"
    # Through two points there is always a line.
    alone = 2 in (wave.timed.sum(), wave.counted.sum())
    unsure = " · two outputs: no uncertainty" if alone else ""
    return f"{speed} · attenuation {loss} dB/cm, spreading included{unsure}".replace("-", "−")


def _several(voices: Sequence[Voice]) -> bool:
    """Whether waves come from more than one place: then none of them is seen alone."""
    return len({one.location for one in voices if one.heard and one.amplitude != 0.0}) > 1


def _spread(deviation: float, decimals: int) -> str:
    return f" ± {deviation:.{decimals}f}" if np.isfinite(deviation) else ""
