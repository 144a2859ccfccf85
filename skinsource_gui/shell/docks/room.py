"""Which panels of an arrangement stand beside each other, and how much room each has."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QSize

from skinsource_gui.shell.docks.arrangement_spec import ArrangementSpec, Place

#: Panels that share a place, as tabs; the first one is in front.
Tabs = tuple[str, ...]
#: Widths of columns; height of them and of what is below; heights in each column, px.
Room = tuple[list[int], list[int], list[list[int]]]


@dataclass(frozen=True, slots=True)
class Folded:
    """Where panels stand once those that have no room became tabs.

    Attributes
    ----------
    columns
        From the left; in each, from the top, panels that share a place.
    foot
        Panels beside each other below all columns.
    """

    columns: tuple[tuple[Tabs, ...], ...]
    foot: tuple[str, ...]

    @property
    def tabs(self) -> tuple[Tabs, ...]:
        """Where several panels share a place."""
        return tuple(tabs for column in self.columns for tabs in column if len(tabs) > 1)


@dataclass(frozen=True, slots=True, kw_only=True)
class Needs:
    """What the panels of an arrangement need.

    Attributes
    ----------
    room
        What the window has for all panels, px.
    spec, places
        The arrangement, and where its panels stand in it.
    least
        Room in which nothing of a panel has to scroll, its title included, px.
    tab_px
        Height of a row of tabs.
    gap_px
        Between two panels.
    """

    room: QSize
    spec: ArrangementSpec
    places: Mapping[str, Place]
    least: Mapping[str, QSize]
    tab_px: int
    gap_px: int

    def widths(self, columns: Sequence[Sequence[Tabs]]) -> int:
        """Least width of columns with the gaps between them, px."""
        return sum(map(self.width, columns)) + self.gap_px * (len(columns) - 1)

    def heights(self, column: Sequence[Tabs]) -> int:
        """Least height of a column with the gaps in it, px."""
        return sum(map(self.height, column)) + self.gap_px * (len(column) - 1)

    def width(self, column: Sequence[Tabs]) -> int:
        """Least width of a column, px."""
        return max(self.least[panel].width() for tabs in column for panel in tabs)

    def height(self, tabs: Tabs) -> int:
        """Least height of panels that share a place, px."""
        row = self.tab_px if len(tabs) > 1 else 0
        return max(self.least[panel].height() for panel in tabs) + row


def folded(columns: Sequence[Sequence[str]], foot: Sequence[str], needs: Needs) -> Folded:
    """Put panels that have too little room behind others, as tabs.

    Those of a column that is too low come behind its first one; what stands below all columns, and
    columns that yield, come behind the host.
    """
    stacks: list[tuple[Tabs, ...]] = [
        tuple((panel,) for panel in column) for column in columns if column
    ]
    host = needs.spec.host
    hosted = any(host in column for column in columns)
    below = max((needs.least[panel].height() + needs.gap_px for panel in foot), default=0)
    found = _stacked(stacks, needs, needs.room.height() - below)
    if foot and hosted and found is None:
        found = _stacked(stacks, needs, needs.room.height())
        stacks = _behind_host(found or _tabbed(stacks), tuple(foot), host)
        foot = ()
    else:
        stacks = found or _tabbed(stacks)
    for panel in needs.spec.yields if hosted else ():
        if needs.widths(stacks) <= needs.room.width():
            break
        yielding = [column for column in stacks if any(panel in tabs for tabs in column)]
        stacks = [column for column in stacks if column not in yielding]
        moved = tuple(one for column in yielding for tabs in column for one in tabs)
        stacks = _behind_host(stacks, moved, host)
    return Folded(tuple(stacks), tuple(foot))


def room_of(folded: Folded, needs: Needs) -> Room:
    """Widths of the columns; height of them and of what is below; heights in each column, px."""
    shares = [needs.spec.columns[_column(column, needs)] for column in folded.columns]
    width = needs.room.width() - needs.gap_px * (len(folded.columns) - 1)
    widths = shared(width, shares, list(map(needs.width, folded.columns)))
    height, below = needs.room.height(), 0
    least = [list(map(needs.height, column)) for column in folded.columns]
    if folded.foot:
        share = max(needs.places[panel].height for panel in folded.foot)
        needed = [
            max(map(needs.heights, folded.columns)),
            max(needs.least[panel].height() for panel in folded.foot),
        ]
        height, below = shared(height - needs.gap_px, (100 - share, share), needed)
    parts = [[needs.places[tabs[0]].height for tabs in column] for column in folded.columns]
    heights = [
        shared(height - needs.gap_px * (len(part) - 1), part, need)
        for part, need in zip(parts, least, strict=True)
    ]
    return widths, [height, below], heights


def shared(whole: int, shares: Sequence[int], least: Sequence[int]) -> list[int]:
    """Split ``whole`` by ``shares``, but give each part what it needs at least, if that fits."""
    if sum(least) >= whole:
        return [whole * need // sum(least) for need in least]
    short = [whole * share // sum(shares) < need for share, need in zip(shares, least, strict=True)]
    if not any(short):
        return [whole * share // sum(shares) for share in shares]
    # Those that would come off too badly get what they need, and the others share the rest.
    rest = whole - sum(need for need, is_short in zip(least, short, strict=True) if is_short)
    others = [k for k, is_short in enumerate(short) if not is_short]
    among = shared(rest, [shares[k] for k in others], [least[k] for k in others])
    given = dict(zip(others, among, strict=True))
    return [given.get(k, need) for k, need in enumerate(least)]


def _column(column: Sequence[Tabs], needs: Needs) -> int:
    return min(needs.places[column[0][0]].column, len(needs.spec.columns) - 1)


def _stacked(
    stacks: list[tuple[Tabs, ...]], needs: Needs, height: int
) -> list[tuple[Tabs, ...]] | None:
    """Columns in that height, those as tabs that are too low; None where even that is too low."""
    if needs.spec.stacks:
        return stacks
    found = [
        column if needs.heights(column) <= height else as_tabs
        for column, as_tabs in zip(stacks, _tabbed(stacks), strict=True)
    ]
    fit = all(needs.heights(column) <= height for column in found)
    return found if fit else None


def _tabbed(stacks: list[tuple[Tabs, ...]]) -> list[tuple[Tabs, ...]]:
    return [(tuple(panel for tabs in column for panel in tabs),) for column in stacks]


def _behind_host(
    stacks: list[tuple[Tabs, ...]], panels: tuple[str, ...], host: str
) -> list[tuple[Tabs, ...]]:
    return [tuple(tabs + panels if host in tabs else tabs for tabs in column) for column in stacks]
