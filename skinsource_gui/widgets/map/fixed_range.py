"""The range of colours that was chosen on the skin map, for all maps of levels beside it."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.fields import Range, RangeSpec
from skinsource.panel_settings import settings_of
from skinsource.view import View

#: Said where the colours span what was chosen, and do not follow the design.
FIXED_MARK = "range fixed"
MAP_RANGE = RangeSpec(label="Range", unit="dB")

# Where it is chosen, and whose settings hold it in files.
_PANEL = "skin"


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelRangeSettings:
    """What maps of levels have in common.

    Attributes
    ----------
    map_range_db
        Levels of the ends of the colour bar; ``None``: they follow the loudest output
        (`skinsource.map_range.map_range_db`).
    """

    map_range_db: Range | None = fields.interval(None, MAP_RANGE)

    def __post_init__(self) -> None:
        fields.check(self)


def fixed_range_db(view: View) -> Range | None:
    """Ends of the colours of levels, dB re 1 m/s²; None: each map follows what it shows."""
    return settings_of(view, _PANEL, LevelRangeSettings).map_range_db
