"""How fast a wave travels along the selected outputs, and what it loses."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from PySide6 import QtWidgets
from PySide6.QtCore import QPointF

from skinsource.base.conventions import Booleans, Floats
from skinsource.design.comparing import match_text
from skinsource.design.design import Design, View
from skinsource.engine.analysis_rules import LineWave
from skinsource.signals.analysis.wave_speed import LEAST_EXPLAINED, LEAST_STRAIGHT, TravellingWave
from skinsource_gui.fields.units import minus
from skinsource_gui.panels.analysis.linearity import Curve, Diagram, DiagramsPicture
from skinsource_gui.panels.analysis.view import FigureView
from skinsource_gui.plots.figure import Axis
from skinsource_gui.qt.questions import copied_level, tab_separated
from skinsource_gui.state.compared import SILENT

_REACH_PX = 14.0
_DISTANCE_TITLE = "Distance along the line (mm)"
_LINE_PX, _PALE = 1.2, 0.6


class WavePicture(DiagramsPicture):
    """Two diagrams: delay and level; outputs that do not count are pale."""

    def __init__(self) -> None:
        super().__init__("wave_picture", "Delay and level along the line")
        self.content: LineWave | None = None

    def show_wave(self, content: LineWave, outputs: tuple[int, ...], matched: str) -> None:
        """Take over what to show; ``outputs`` are all that are selected.

        ``matched``: text on how much louder or softer than stored it is, or "".
        """
        self.content, wave = content, content.wave
        ranks = [outputs.index(output) for output in content.outputs]
        distance = Axis(shown=_range_around(wave.distance_m), title=_DISTANCE_TITLE, factor=1e3)
        delay = Axis(shown=_range_around(wave.delay_s), title="Delay (ms)", factor=1e3)
        title = ", ".join(filter(None, (f"Level {content.axis} (dB)", matched)))
        level = Axis(shown=_range_around(wave.level_db), title=title)
        loss_db_per_m = 100.0 * wave.attenuation_db_per_cm
        diagrams = (
            Diagram(x=distance, y=axis, curves=_fit(wave.distance_m, values, slope, used, ranks))
            for axis, values, slope, used in (
                (delay, wave.delay_s, 1.0 / wave.speed_m_per_s, wave.timed),
                (level, wave.level_db, -loss_db_per_m, wave.counted),
            )
        )
        self.show_diagrams(tuple(diagrams), outputs)

    def read(self, at: QPointF) -> str:
        if self.content is None:
            return ""
        wave, outputs = self.content.wave, self.content.outputs
        of_diagrams = zip(self.placed, (wave.delay_s, wave.level_db), strict=False)
        for (origin, axes), values in of_diagrams:
            places = axes.to_screen(wave.distance_m, values) + origin.toTuple()
            distances = np.hypot(*(places - (at.x(), at.y())).T)
            if np.isfinite(distances).any() and np.nanmin(distances) <= _REACH_PX:
                k = int(np.nanargmin(distances))
                left_out = "" if wave.counted[k] else " · left out: silent or mostly noise"
                if wave.counted[k] and not wave.timed[k]:
                    left_out = " · no delay: too different from the first"
                delay = f"{wave.delay_s[k] * 1e3:.2f} ms, " if np.isfinite(wave.delay_s[k]) else ""
                return minus(
                    f"{outputs[k]}: {wave.distance_m[k] * 1e3:.0f} mm, {delay}"
                    f"{wave.level_db[k]:z.1f} dB, alike {wave.similarity[k]:.0%}{left_out}"
                )
        return ""


def _fit(
    x: Floats, values: Floats, slope: float, used: Booleans, ranks: Sequence[int]
) -> tuple[Curve, ...]:
    """Return a line through the outputs that count, if it has a slope, and a dot for each."""
    curves: list[Curve] = []
    if np.isfinite(slope):
        ends = np.array([x[used].min(), x[used].max()])
        heights = values[used].mean() + slope * (ends - x[used].mean())
        curves.append(Curve(x=ends, y=heights, rank=None, width_px=_LINE_PX, pale=_PALE))
    for k, rank in enumerate(ranks):
        at, pale = slice(k, k + 1), 0.0 if used[k] else _PALE
        curves.append(Curve(x=x[at], y=values[at], rank=rank, width_px=0.0, pale=pale))
    return tuple(curves)


def _range_around(values: Floats) -> tuple[float, float]:
    """Return a range with some room around values; any range where there are none."""
    known = values[np.isfinite(values)]
    if not known.size:
        return 0.0, 1.0
    low, high = float(known.min()), float(known.max())
    air = 0.08 * (high - low) or max(abs(high) * 0.1, 1e-3)
    return low - air, high + air


_OVERLAP = "waves of several inputs overlap"
_ABOUT = "Along {axis}: distance on the map, group delay"


class WaveView(FigureView):
    """Delay and level over the distance, and speed and attenuation from them."""

    name: ClassVar[str] = "wave"
    needs = frozenset({"line_wave", "shown_outputs", "limb_data", "match_gain", "moving_places"})

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        self.picture = WavePicture()
        super().__init__(self.picture, parent)
        self.about = self.add_above("wave_about")
        self.about.say(_ABOUT.format(axis="z"))
        self.about.setToolTip(
            "Line: selected outputs in order; delays: peak of the correlation's envelope"
        )
        self.choices.addWidget(self.about, 1)
        self.say_instead(self.no_outputs)

    def show_state(self, design: Design, view: View) -> None:
        self.show_selection(view, fewest=2)

    def show_results(self, results: Mapping[str, Any]) -> None:
        line: LineWave | None = results["line_wave"]
        if line is None:
            self.say_instead(self.no_outputs)
            return
        if not line.wave.similarity.any():
            self.say_instead(SILENT)
            return
        outputs = results["shown_outputs"]
        self.offer_copy(True)
        self.about.say(_ABOUT.format(axis=line.axis))
        self.picture.show_wave(line, outputs, match_text(results["match_gain"]))
        left_out = len(outputs) - len(line.outputs)
        note = f" · {left_out} not on the map" if left_out else ""
        synthetic = " · synthetic limb" if results["limb_data"].synthetic else ""
        # Waves from several places: none of them is seen alone.
        several = f" · {_OVERLAP}" if len(results["moving_places"]) > 1 else ""
        self.show_result(f"{wave_text(line.wave)}{several}{note}{synthetic}")

    def table_text(self) -> str:
        content = self.picture.content
        if content is None or self.picture.message:
            return ""
        wave = content.wave
        header = ("output", "way_mm", "delay_ms", f"level_{content.axis}_db_re_1_m_per_s2", "alike")
        lines = (
            (
                str(output),
                1e3 * wave.distance_m[k],
                1e3 * wave.delay_s[k],
                copied_level(wave.level_db[k]),
                wave.similarity[k],
                *("yes" if flags[k] else "no" for flags in (wave.counted, wave.timed)),
            )
            for k, output in enumerate(content.outputs)
        )
        return tab_separated(((*header, "counted", "timed"), *lines))

    @property
    def no_outputs(self) -> str:
        return (
            "Select two or more outputs on the skin map, one after the other along a line: "
            "Shift+click adds one"
        )


def wave_text(wave: TravellingWave) -> str:
    """Return speed and attenuation, with their uncertainty as far as it is known."""
    speed = "No speed: farther outputs are not reached later"
    if wave.counted.sum() < 2:
        return "fewer than two outputs are more than noise"
    if wave.timed.sum() < 2:
        speed = "No speed: the shapes are too different"
    elif wave.straight < LEAST_STRAIGHT:
        speed = "No speed: the selected outputs do not form a line"
    elif wave.explained < LEAST_EXPLAINED or wave.speed_deviation_m_per_s >= abs(
        wave.speed_m_per_s
    ):
        speed = "No speed: delays do not grow with the distance"
    elif np.isfinite(wave.speed_m_per_s):
        speed = f"Speed {wave.speed_m_per_s:.1f}{_spread(wave.speed_deviation_m_per_s, 1)} m/s"
    loss = f"{wave.attenuation_db_per_cm:.2f}{_spread(wave.attenuation_deviation_db_per_cm, 2)}"
    # Through two points there is always a line.
    alone = 2 in (wave.timed.sum(), wave.counted.sum())
    unsure = ". Choose three outputs or more to estimate the uncertainty" if alone else ""
    text = f"{speed} · attenuation {loss} dB/cm, spreading included{unsure}".replace("-", "−")
    return f"{text} · ±: standard deviation of the fit" if "±" in text else text


def _spread(deviation: float, decimals: int) -> str:
    return f" ± {deviation:.{decimals}f}" if np.isfinite(deviation) else ""
