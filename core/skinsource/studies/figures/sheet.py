"""The page of a figure: heading, drawing and notes below it, with the data that figures share."""

import textwrap
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.errors import sentence
from skinsource.base.measurement_conditions import AXES, Axes, axis_numbers
from skinsource.design.clips import Clip
from skinsource.design.design import Design, View
from skinsource.design.labels import SCALINGS, label_of, limb_label
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.evaluation import evaluate
from skinsource.export.plot import (
    DIM,
    INK,
    MM_PER_INCH,
    SYNTHETIC,
    Levels,
    levels_of,
    new_figure,
    style,
)
from skinsource.limbs.own_limbs import facts_of
from skinsource.perception.validity import Judged, in_full
from skinsource.studies.scenes.opened_scene import OpenedScene


def setup_text(opened: OpenedScene) -> str:
    """Return sentences on limbs and scaling."""
    scaling = label_of(SCALINGS, opened.design.scaling).title
    limbs = ", ".join(limb_label(limb).title for limb in limbs_of(opened))
    return f"Limb: {limbs}. Scaling: {scaling}."


def broken_conditions_text(opened: OpenedScene, *, maps: bool) -> str:
    """Return which conditions of the measurement are not met; "": all are.

    ``maps``: whether the figure shows maps; only these need values between outputs.
    """
    findings = [
        finding for judged in _judgements(opened, maps=maps) for finding in judged.findings or ()
    ]
    # A synthetic limb has a larger note of its own.
    broken = dict.fromkeys(
        finding.name for finding in findings if finding.state == "left" and finding.name != "limb"
    )
    heading = "Conditions of the measurement that are not met (see the table)"
    return f"{heading}: {', '.join(broken)}." if broken else ""


def condition_lines(opened: OpenedScene, *, maps: bool) -> tuple[str, ...]:
    """Return a line for each condition that is not met, with the designs that do not meet it."""
    return in_full(_judgements(opened, maps=maps))


def limbs_of(opened: OpenedScene) -> tuple[str, ...]:
    """Return the names of the limbs of a scene, each once."""
    return tuple(dict.fromkeys(condition.design.limb for condition in opened.conditions))


def _judgements(opened: OpenedScene, *, maps: bool) -> list[Judged]:
    judged = [
        Judged(
            label=condition.label,
            findings=evaluate(condition.design, "validity", view=opened.view)["validity"],
        )
        for condition in opened.conditions
    ]
    return judged if maps else [each.without_maps() for each in judged]


def field_of(design: Design) -> tuple[Floats, Floats]:
    """Return times, (n_times,), in s, and the field, (n_outputs, n_axes, n_times), in m/s²."""
    limb = evaluate(design, "limb_data")["limb_data"]
    view = View(axes="xyz", outputs=tuple(range(1, limb.n_outputs + 1)))
    results = evaluate(design, "response_time_s", "axis_traces", view=view)
    return results["response_time_s"], results["axis_traces"]


def axes_of_sensors(design: Design) -> tuple[Axes, ...]:
    """Return the single axes along which the limb of a design was measured."""
    measured = facts_of(design.limb).axes
    return tuple(axis for axis in AXES if len(axis) == 1 and axis in measured)


def normal_of(design: Design, field: Floats) -> Floats:
    """Return the part of a field that is normal to the skin, z, (n_outputs, n_times)."""
    (normal,) = axis_numbers("z", facts_of(design.limb).axes)
    return field[:, normal]


def frequency_of(clip: Clip) -> float:
    """Return the frequency of the tone that a clip plays, Hz."""
    if not isinstance(clip.waveform, Tone):
        raise TypeError(f"{clip.waveform} is no tone")
    return clip.waveform.frequency_hz


def levels_of_values(design: Design, values: Floats) -> Levels:
    """Return any values at the outputs for a map, with the input places of the design.

    Nothing is hatched: the noise of the whole record says little of an instant.
    """
    return replace(levels_of(design, None, None), values=np.asarray(values), noisy=())


#: Width of two columns of a journal.
WIDTH_MM = 180.0
_EDGE_MM, _HEAD_MM, _LINE_MM, _FOOT_EDGE_MM = 4.0, 9.0, 3.2, 3.0
_LINE_CHARACTERS = 128


class Sheet:
    """A page for a drawing.

    Parameters
    ----------
    opened
        The scene: its heading stands above, its sentence, source and inferred parts below.
    height_mm
        Height of the drawing alone.
    note
        Further note on the drawing; "": none.
    maps
        Whether it shows maps, so that conditions of the measurement that concern maps are named.

    Attributes
    ----------
    figure
        The figure of matplotlib.
    """

    def __init__(
        self, opened: OpenedScene, height_mm: float, note: str = "", *, maps: bool = False
    ) -> None:
        self.maps = maps
        lines = _footer(opened, note, broken_conditions_text(opened, maps=maps))
        self._foot_mm = _LINE_MM * len(lines) + 2 * _FOOT_EDGE_MM
        self._height_mm = height_mm + _HEAD_MM + self._foot_mm
        self.figure = new_figure(WIDTH_MM, self._height_mm)
        with style():
            self._write(self._height_mm - 6.0, opened.scene.heading, INK, 9.0, "bold")
            for k, (line, colour) in enumerate(lines):
                y_mm = self._foot_mm - _FOOT_EDGE_MM - _LINE_MM * (k + 1)
                self._write(y_mm, line, colour, 6.5)

    def axes(self, x_mm: float, y_mm: float, width_mm: float, height_mm: float) -> Any:
        """Return axes at a position in the drawing, measured from its lower left corner."""
        height = self._height_mm
        return self.figure.add_axes(
            (
                x_mm / WIDTH_MM,
                (y_mm + self._foot_mm) / height,
                width_mm / WIDTH_MM,
                height_mm / height,
            )
        )

    def picture_inches(self) -> tuple[float, float, float, float]:
        """Return the corners of the drawing without heading and notes, in inches."""
        low, high = self._foot_mm, self._height_mm - _HEAD_MM + 1.0
        return 0.0, low / MM_PER_INCH, WIDTH_MM / MM_PER_INCH, high / MM_PER_INCH

    def row_of_axes(
        self, n: int, x_mm: float, y_mm: float, width_mm: float, height_mm: float
    ) -> list[Any]:
        """Return ``n`` axes side by side that fill an area."""
        each = width_mm / n
        return [self.axes(x_mm + k * each, y_mm, each - 1.0, height_mm) for k in range(n)]

    def colour_bar(
        self, image: Any, x_mm: float, y_mm: float, height_mm: float, label: str
    ) -> None:
        """Draw a colour bar 2.5 mm wide."""
        bar = self.figure.colorbar(image, cax=self.axes(x_mm, y_mm, 2.5, height_mm))
        bar.set_label(label)
        bar.outline.set_linewidth(0.4)

    def _write(
        self, y_mm: float, text: str, colour: str, size: float, weight: str = "normal"
    ) -> None:
        x, y = _EDGE_MM / WIDTH_MM, y_mm / self._height_mm
        self.figure.text(x, y, text, color=colour, fontsize=size, fontweight=weight)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Drawn:
    """A figure and its numbers.

    Attributes
    ----------
    sheet
        Page of the figure.
    tables
        Tables by the suffix of the name of their file, which is empty for the first one: the
        numbers of each column, (n_rows,), by its name, with its unit.
    """

    sheet: Sheet
    tables: dict[str, dict[str, Floats]]

    @property
    def figure(self) -> Any:
        """The figure of matplotlib."""
        return self.sheet.figure


def _footer(opened: OpenedScene, note: str, broken: str) -> list[tuple[str, str]]:
    """Return the lines below a drawing, each with its colour.

    ``broken``: the conditions of the measurement that are not met.
    """
    scene = opened.scene
    notes = [(scene.sentence, INK), (f"After {scene.source}.", DIM)]
    if scene.inferred:
        notes.append((sentence(f"Inferred: {'; '.join(scene.inferred)}"), DIM))
    notes += [(text, DIM) for text in (setup_text(opened), broken, note) if text]
    if opened.chosen:
        notes.append((opened.chosen, INK))
    if opened.synthetic:
        notes.append((f"{SYNTHETIC}; they may not show what the sentence says.", "#B00020"))
    return [
        (line, colour) for text, colour in notes for line in textwrap.wrap(text, _LINE_CHARACTERS)
    ]
