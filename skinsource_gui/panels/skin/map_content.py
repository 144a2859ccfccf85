"""What the map shows."""

from dataclasses import dataclass, fields

from skinsource.arrays import Floats
from skinsource.limb import LimbMap
from skinsource_gui.panels.skin.level_range import SILENT_RANGE, Range
from skinsource_gui.widgets.map.field_image import FieldImage


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MapContent:
    """What the map shows.

    Attributes
    ----------
    limb_map
        Outline and places; ``None`` before there are any.
    levels_db : (n_outputs,) or None
        Level of each output; ``None``: no colours.
    field, field_levels_db
        Interpolated map and its levels, (rows, columns); ``None``: sensors carry the colours.
    range_db
        Levels of the lowest and the highest colour.
    outputs
        Selected outputs.
    sensors_shown
        Whether sensors are marked on the interpolated map.
    synthetic
        Whether the responses are computed, not measured.
    span
        What levels are the RMS over.
    message
        Why there is no map; shown in its middle, instead of it.
    note
        What one should know about the map.
    outdated
        Whether something newer is being computed.
    """

    limb_map: LimbMap | None = None
    levels_db: Floats | None = None
    field: FieldImage | None = None
    field_levels_db: Floats | None = None
    range_db: Range = SILENT_RANGE
    outputs: tuple[int, ...] = ()
    sensors_shown: bool = True
    synthetic: bool = False
    span: str = "record"
    message: str = ""
    note: str = ""
    outdated: bool = False

    def same_as(self, other: "MapContent") -> bool:
        """Whether ``other`` looks the same; arrays are compared by identity."""
        return all(
            mine is theirs
            or (type(mine) in (tuple, bool, str) and type(mine) is type(theirs) and mine == theirs)
            for mine, theirs in (
                (getattr(self, field.name), getattr(other, field.name)) for field in fields(self)
            )
        )

    @property
    def coloured_levels_db(self) -> Floats | None:
        """Levels that may be shown, (n_outputs,); none while a message stands in their place."""
        return None if self.message else self.levels_db

    @property
    def shown_field(self) -> FieldImage | None:
        """The interpolated map, where it may be shown."""
        return None if self.message or self.field_levels_db is None else self.field
