"""What the map shows."""

from dataclasses import dataclass, fields, replace

from skinsource.base.arrays import Floats
from skinsource.base.quoting import sentence
from skinsource.limbs.limb import Limb, LimbMap
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource_gui.panels.skin.inputs.marks import InputMark
from skinsource_gui.panels.skin.map_quantity import LEVELS, MapQuantity
from skinsource_gui.panels.skin.scale.level_range import SILENT_RANGE, Range
from skinsource_gui.widgets.map.colour_maps import VIRIDIS
from skinsource_gui.widgets.map.field_image import FieldImage
from skinsource_gui.widgets.over.cover import COVERED

_LEVELS = MapQuantity()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MapContent:
    """What the map shows.

    Attributes
    ----------
    limb_map, limb
        Outline and places, ``None`` before there are any; and whose they are.
    values : (n_outputs,) or None
        Level of each output in dB, or what ``quantity`` says; ``None``: no colours.
    field, field_values
        Interpolated map and its values, (rows, columns); ``None``: sensors carry the colours.
    quantity
        What the values are.
    value_range, fixed
        Values of the lowest and the highest colour; whether they were chosen, and stay.
    colours
        Name of the colour map.
    outputs
        Selected outputs.
    px_per_mm
        Outline pixels in a millimetre of the limb; 0 before that is known.
    inputs, pointed_at
        Marks of the inputs, and the id of the one that is pointed at here or on the hand.
    sensors_shown
        Whether sensors are marked on the interpolated map.
    noisy
        Outputs that are mostly noise; they are hatched.
    synthetic
        Whether the responses are computed, not measured.
    message
        Why there is no map; shown in its middle, instead of it.
    note
        What one should know about the map.
    drawn_note
        What of it stands in a picture: the caption below says the rest.
    outdated
        Whether something newer is being computed.
    """

    limb_map: LimbMap | None = None
    limb: str = ""
    values: Floats | None = None
    field: FieldImage | None = None
    field_values: Floats | None = None
    quantity: MapQuantity = _LEVELS
    value_range: Range = SILENT_RANGE
    fixed: bool = False
    colours: str = VIRIDIS
    outputs: tuple[int, ...] = ()
    px_per_mm: float = 0.0
    inputs: tuple[InputMark, ...] = ()
    pointed_at: int | None = None
    sensors_shown: bool = True
    noisy: tuple[int, ...] = ()
    synthetic: bool = False
    message: str = ""
    note: str = ""
    drawn_note: str = ""
    outdated: bool = False

    def same_as(self, other: "MapContent") -> bool:
        """Whether ``other`` looks the same; arrays are compared by identity."""
        return all(
            mine is theirs
            or (
                type(mine) in (tuple, bool, str, MapQuantity)
                and type(mine) is type(theirs)
                and mine == theirs
            )
            for mine, theirs in (
                (getattr(self, field.name), getattr(other, field.name)) for field in fields(self)
            )
        )

    @property
    def covered(self) -> "MapContent":
        """The same without anything that was computed, for an audience that shall guess first."""
        quantity = replace(self.quantity, name=LEVELS)
        return replace(self, values=None, field_values=None, quantity=quantity, message=COVERED)

    @property
    def coloured_values(self) -> Floats | None:
        """Values that may be shown, (n_outputs,); none while a message stands in their place."""
        return None if self.message else self.values

    @property
    def hatched(self) -> tuple[int, ...]:
        """Outputs that are drawn as mostly noise."""
        return () if self.message else self.noisy

    @property
    def shown_field(self) -> FieldImage | None:
        """The interpolated map, where it may be shown."""
        return None if self.message or self.field_values is None else self.field


def px_per_mm_of(limb: Limb) -> float:
    """Outline pixels in a millimetre."""
    return limb.map.hand_length_px / limb.hand_length_mm


def note_of(surface: SurfaceOperator | None, limb: Limb) -> str:
    """What one should know about the map and about where its numbers come from."""
    last = sentence(f"{limb.note[:1].upper()}{limb.note[1:]}") if limb.note else ""
    return " ".join(part for part in (drawn_note_of(surface), last) if part)


def drawn_note_of(surface: SurfaceOperator | None) -> str:
    """What one should know about the map itself."""
    return "" if surface is None else " ".join(surface.warnings)
