"""What is under the pointer, or else selected, in words."""

from PySide6.QtCore import QPointF

from skinsource.base.work import counted
from skinsource.design.labels import TRIAD_SENTENCE
from skinsource_gui.panels.skin.inputs.pointing import inputs_words
from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.map_quantity import LEVELS
from skinsource_gui.panels.skin.stage.map_layout import MapLayout
from skinsource_gui.widgets.fields.level_text import level_text, output_text
from skinsource_gui.widgets.outputs.picking import output_at
from skinsource_gui.widgets.tooltips import tooltip


def output_readout(content: MapContent, number: int) -> str:
    """Number and place of an output, and in a second line its value."""
    values = content.coloured_values
    words = output_text(number, content.limb)
    return (
        words if values is None else f"{words}\n{_value_text(float(values[number - 1]), content)}"
    )


def pixel_readout(content: MapContent, layout: MapLayout, at: QPointF) -> str:
    """Value of the interpolated map at a screen place, empty outside."""
    field, levels = content.shown_field, content.field_values
    on_card = layout.palmar_card.contains(at) or layout.triad_card.contains(at)
    if field is None or levels is None or on_card:
        return ""
    level = field.level_at(levels, *layout.frame.to_drawing(at))
    return "" if level is None else _value_text(level, content)


def hover_words(content: MapContent, layout: MapLayout | None, at: QPointF) -> str:
    """What a tooltip says at a screen place: of the axes, of an output, of inputs, or nothing."""
    if layout is None:
        return ""
    if layout.triad_card.contains(at):
        return tooltip(TRIAD_SENTENCE)
    number = output_at(layout.points, at)
    lines = [] if number is None else [output_readout(content, number)]
    return "\n".join(filter(None, [*lines, inputs_words(content, layout, at)]))


def selection_readout(outputs: tuple[int, ...]) -> str:
    """How many outputs are selected, and in a second line how to select others."""
    if not outputs:
        return "No output selected\nClick one, or drag around several"
    return f"{counted(len(outputs), 'output')} selected\nShift+click adds or removes one"


def _value_text(value: float, content: MapContent) -> str:
    quantity = content.quantity
    is_level = quantity.name == LEVELS
    return level_text(value, quantity.span) if is_level else quantity.text(value)
