"""Colours and range that were chosen on the skin map, for all maps of levels beside it."""

from dataclasses import dataclass, replace

from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.specs import fields
from skinsource.specs.fields import ChoiceSpec, Range, RangeSpec
from skinsource_gui.widgets.map.colour_maps import VIRIDIS

#: Said where the colours span what was chosen, and do not follow the design.
FIXED_MARK = "range fixed"
MAP_RANGE = RangeSpec(label="Range", unit="dB")
COLOURS = ChoiceSpec(
    label="Colours",
    options=(
        (VIRIDIS, "Viridis"),
        ("cividis", "Cividis"),
        ("magma", "Magma"),
        ("CET-L1", "Grey"),
        ("turbo", "Turbo, like MATLAB's jet"),
    ),
    hint="Colours of levels. All but the last grow evenly lighter, and are told apart with any "
    "colour vision",
)

# Where they are chosen, and whose settings hold them in files.
_PANEL = "skin"


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelLook:
    """How maps of levels look, whichever panel shows them.

    Attributes
    ----------
    map_range_db
        Levels of the ends of the colour bar, dB re 1 m/s²; ``None``: each map follows what it
        shows (`skinsource.signals.map_range.map_range_db`).
    colours
        Colour map of levels.
    """

    map_range_db: Range | None = fields.interval(None, MAP_RANGE)
    colours: str = fields.choice(VIRIDIS, COLOURS)

    def __post_init__(self) -> None:
        fields.check(self)


#: Where nothing was chosen.
USUAL_LOOK = LevelLook()


def level_look(view: View) -> LevelLook:
    """What was chosen for all maps of levels."""
    return settings_of(view, _PANEL, LevelLook)


def coloured_like(view: View, other: View) -> View:
    """Return ``view`` with the colours of ``other``, unless it has chosen some itself."""
    return in_colours(view, level_look(other).colours)


def in_colours(view: View, colours: str) -> View:
    """Return ``view`` in these colours, unless it has chosen some itself."""
    look = level_look(view)
    if look.colours != USUAL_LOOK.colours or look.colours == colours:
        return view
    return with_settings(view, _PANEL, replace(look, colours=colours))
