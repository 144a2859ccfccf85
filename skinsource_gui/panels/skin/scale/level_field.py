"""A number field for an end of the range."""

from PySide6.QtWidgets import QWidget

from skinsource.specs.fields import NumberSpec
from skinsource_gui.panels.skin.scale.level_range import HIGHEST_DB, LOWEST_DB, SMALLEST_SPAN_DB
from skinsource_gui.widgets.fields.number_field import NumberField

_UNIT = "dB"


def high_field(parent: QWidget) -> NumberField:
    """Field for the level of the highest colour."""
    return _level_field(
        "range_high_field", "Level of the highest colour", LOWEST_DB + SMALLEST_SPAN_DB, parent
    )


def low_field(parent: QWidget) -> NumberField:
    """Field for the level of the lowest colour."""
    return _level_field("range_low_field", "Level of the lowest colour", LOWEST_DB, parent)


def _level_field(name: str, words: str, lowest_db: float, parent: QWidget) -> NumberField:
    highest_db = HIGHEST_DB - (LOWEST_DB + SMALLEST_SPAN_DB - lowest_db)
    spec = NumberSpec(label=words, unit=_UNIT, minimum=lowest_db, maximum=highest_db, step=1.0)
    field = NumberField(spec, parent, widest_unit=_UNIT)
    field.setObjectName(name)
    return field
