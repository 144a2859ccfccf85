"""What is under the pointer, in words."""

from PySide6.QtCore import QPointF

from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.map_layout import MapLayout
from skinsource_gui.widgets.fields.level_text import level_text, output_text


def output_readout(content: MapContent, number: int) -> str:
    """Number and place of an output, and in a second line its level."""
    levels = content.coloured_levels_db
    words = output_text(number)
    return words if levels is None else f"{words}\n{level_text(levels[number - 1], content.span)}"


def pixel_readout(content: MapContent, layout: MapLayout, at: QPointF) -> str:
    """Level of the interpolated map at a screen place, empty outside."""
    field, levels = content.shown_field, content.field_levels_db
    on_card = layout.palmar_card.contains(at) or layout.triad_card.contains(at)
    if field is None or levels is None or on_card:
        return ""
    level = field.level_at(levels, *layout.frame.to_drawing(at))
    return "" if level is None else level_text(level, content.span)
