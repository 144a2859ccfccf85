"""What only the timeline looks at."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

from skinsource.design.design import MAX_INPUTS, Design
from skinsource.design.edits import Edit
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.specs import fields
from skinsource.specs.fields import ListSpec, NumberSpec

#: Name of the panel, under which a view keeps its settings.
TIMELINE = "timeline"
GAIN_CURVES = ListSpec(
    label="Gain curves",
    of=NumberSpec(label="Id of an input", minimum=1, maximum=2**31 - 1, whole=True),
    most=MAX_INPUTS,
    different=True,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TimelineSettings:
    """What lanes show besides clips: ``gain_curves``, ids of the tracks that show theirs."""

    gain_curves: tuple[int, ...] = fields.field(GAIN_CURVES, ())

    def __post_init__(self) -> None:
        fields.check(self)


def shown_gain_curves(view: View) -> frozenset[int]:
    """Ids of the tracks whose gain curve is shown for editing."""
    return frozenset(settings_of(view, TIMELINE, TimelineSettings).gain_curves)


def show_gain_curves(view: View, ids: Iterable[int]) -> View:
    """The view in which these tracks, and no others, show their gain curve."""
    settings = settings_of(view, TIMELINE, TimelineSettings)
    shown = replace(settings, gain_curves=tuple(sorted(set(ids))))
    return with_settings(view, TIMELINE, shown)


def toggle_gain_curves(design: Design, view: View, ids: Iterable[int]) -> Edit:
    """Show the gain curves of tracks; if all of them are shown, hide them."""
    wanted, shown = set(ids) & set(design.ids), shown_gain_curves(view) & set(design.ids)
    after = shown - wanted if wanted <= shown else shown | wanted
    return Edit(label="Show gain curves", design=design, view=show_gain_curves(view, after))
