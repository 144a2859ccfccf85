"""What maps side by side show."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.design.design import Design
from skinsource_gui.widgets.fields.level_text import output_text
from skinsource_gui.widgets.map.scale_row import SILENT, Scale
from skinsource_gui.widgets.map.small_map import SmallMap


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Cell:
    """One of the maps.

    Attributes
    ----------
    headings
        Whose it is, or what of whom: the same thing in ever fewer words.
    limb
        Whose outputs and outline they are.
    small
        The map, its levels in dB; None: there is none.
    scale
        Its colours; None where there is no map.
    maximum_db
        The level that its values are relative to, dB re 1 m/s²; None: they are not.
    design
        Its inputs are marked; None: none are.
    words
        Why there is no map.
    late
        Whether it belongs to the design before.
    synthetic
        Whether responses are computed, not measured.
    """

    headings: tuple[str, ...]
    limb: str
    small: SmallMap | None = None
    scale: Scale | None = None
    maximum_db: float | None = None
    design: Design | None = None
    words: str = ""
    late: bool = False
    synthetic: bool = False

    @property
    def heading(self) -> str:
        """All of the heading."""
        return self.headings[0]

    @property
    def values_db(self) -> Floats | None:
        """The value of each output, (n_outputs,); None where there are none."""
        return None if self.small is None else self.small.levels_db

    def value_text(self, output: int | None) -> str:
        """The value of an output; of none: the largest one, and where it is."""
        return self.value_texts(output)[0]

    def value_texts(self, output: int | None) -> tuple[str, ...]:
        """The same in ever fewer words."""
        values = self.values_db
        if values is None or self.scale is None:
            return ("",)
        if output is not None and output > values.size:
            return ("no such output", "none")
        if output is not None:
            value = self.scale.text(float(values[output - 1]))
            return value, value.removesuffix(" dB")
        largest = int(np.argmax(np.abs(values) if self.scale.signed else values))
        value = self.scale.text(float(values[largest]))
        if value == SILENT:
            return (SILENT,)
        if self.maximum_db is not None:
            # 0 dB of each would be said of each.
            value = f"max {self.scale.text(self.maximum_db)}"
            whole = f"{value} re 1 m/s² at {largest + 1}"
            return whole, f"{value} at {largest + 1}", value, value.removesuffix(" dB")
        return f"{value} at {largest + 1}", value, value.removesuffix(" dB")


@dataclass(frozen=True, kw_only=True, eq=False)
class Content:
    """All of them.

    Attributes
    ----------
    cells
        In their order.
    outputs
        Selected ones.
    message
        What stands in their place; empty: they are shown.
    about
        What is shown, said below while no output is pointed at.
    """

    cells: tuple[Cell, ...] = ()
    outputs: tuple[int, ...] = ()
    message: str = ""
    about: str = ""

    @cached_property
    def common_scale(self) -> Scale | None:
        """The scale that all maps share; None where they differ."""
        scales = {cell.scale for cell in self.cells if cell.scale is not None}
        return scales.pop() if len(scales) == 1 else None

    @property
    def late(self) -> bool:
        """Whether any of the maps belongs to the design before."""
        return any(cell.late for cell in self.cells)

    def readout(self, output: int | None) -> str:
        """What all maps say of an output; without one what they are."""
        drawn = [cell for cell in self.cells if cell.small is not None]
        if output is None or not drawn:
            return self.about
        texts = [cell.value_text(output) for cell in drawn]
        values = " · ".join(texts)
        if all(text.endswith(" dB") for text in texts):
            values = f"{values.replace(' dB', '')} dB"
        if any(cell.maximum_db is not None for cell in drawn):
            values = f"{values} re each map's maximum"
        return f"{output_text(output, drawn[0].limb)}: {values}"
