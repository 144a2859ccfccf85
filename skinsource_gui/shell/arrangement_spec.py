"""The arrangements of the docks to start from, and places in them."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Place:
    """Where a panel stands in an arrangement.

    Attributes
    ----------
    column
        From the left, 0 is the first.  Panels of one column stand in the order of their table.
    height
        Share of the column's height, beside the shares of the others.
    at_foot
        Whether it stands below all columns, in a row of its own as wide as the window; ``column``
        is then its place in that row, and ``height`` its share of the window.
    """

    column: int
    height: int = 40
    at_foot: bool = False


@dataclass(frozen=True, slots=True)
class Behind:
    """Where a panel comes up that an arrangement does not show: as a tab with another one.

    Attributes
    ----------
    panel
        Name of one that has a place of its own in the arrangement.
    """

    panel: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrangementSpec:
    """One arrangement.

    Attributes
    ----------
    name, text, hint, keys
        As those of an action; ``text`` goes on after "Arrange for".
    columns
        Widths of the columns, as shares.
    host
        Name of the panel with which those come up that it does not show, if nothing else is said.
    text_scale
        Size of all words, beside the size that is chosen otherwise.
    yields
        Names of panels whose columns become tabs with the host, one after the other, where columns
        are too narrow for all.
    stacks
        Whether panels of a column stay above each other even where that is too low for them.
    """

    name: str
    text: str
    hint: str
    keys: tuple[str, ...]
    columns: tuple[int, ...]
    host: str
    text_scale: float = 1.0
    yields: tuple[str, ...] = ()
    stacks: bool = False


#: The name of the arrangement in which an audience sees whatever is shown.
PRESENTATION = "presentation"

ARRANGEMENTS: tuple[ArrangementSpec, ...] = (
    ArrangementSpec(
        name="design",
        text="designing",
        hint="All panels, the hand and the skin in front",
        keys=("Alt+1",),
        columns=(22, 25, 24, 29),
        host="inspector",
        yields=("traces", "hand"),
    ),
    ArrangementSpec(
        name="drawing",
        text="drawing",
        hint="One clip large, to draw and to shape it, beside what the skin does",
        keys=("Alt+2",),
        columns=(28, 72),
        host="skin",
    ),
    ArrangementSpec(
        name="analysis",
        text="analysis",
        hint="The skin, traces and spectra, large",
        keys=("Alt+3",),
        columns=(32, 68),
        # Not the skin: outputs are chosen there.
        host="spectra",
    ),
    ArrangementSpec(
        name=PRESENTATION,
        text="presenting",
        hint="The hand, the skin, and frequency and amplitude to turn, in large words",
        keys=("Alt+4",),
        columns=(50, 50),
        host="hand",
        text_scale=1.25,
        # Who turns the number looks at the hand.
        stacks=True,
    ),
)

#: For each panel its place in each arrangement, or behind what it comes up; None: behind the host.
Places = Mapping[str, Mapping[str, Place | Behind | None]]
