"""The way of the Tab key through a window.

Qt follows the order in which widgets were made, and a panel that hands its focus on to its
picture makes it skip what stands between.
"""

from collections.abc import Sequence

from PySide6.QtCore import QPoint, QRect, QSize, Qt
from PySide6.QtWidgets import QAbstractButton, QMainWindow, QWidget

from skinsource_gui.widgets.into_sight import bring_into_sight


def tab_stops(top: QWidget, regions: Sequence[QWidget]) -> list[QWidget]:
    """Widgets inside ``top`` that Tab reaches now, region by region.

    Parameters
    ----------
    top
        A window, or a part of one; what floats in a window of its own does not belong to it.
    regions
        Parts of ``top`` in the order of reading.  What lies in none of them comes last.
    """
    found = [one for one in _chain(top) if top.isAncestorOf(one) and _takes_tab(one)]
    _give_back(top.window())

    def region_of(stop: QWidget) -> int:
        inside = (k for k, part in enumerate(regions) if part is stop or part.isAncestorOf(stop))
        return next(inside, len(regions))

    groups: list[list[QWidget]] = [[] for _ in range(len(regions) + 1)]
    for stop in found:
        groups[region_of(stop)].append(stop)
    for part in (top, *regions):
        if getattr(part, "reads_down", False):
            groups = [_as_read(group, part) for group in groups]
    return [stop for group in groups for stop in group]


def move_focus(window: QMainWindow, regions: Sequence[QWidget], *, forward: bool) -> bool:
    """Give the keyboard to the next stop, or the one before; return whether there is any."""
    stops = tab_stops(window, regions)
    if not stops:
        return False
    here: QWidget | None = window.focusWidget()
    while here is not None and here not in stops:
        # What is clicked but no stop, such as a number in a row that is not selected.
        here = here.parentWidget()
    if here is None:
        target = stops[0 if forward else -1]
    else:
        target = stops[(stops.index(here) + (1 if forward else -1)) % len(stops)]
    reason = Qt.FocusReason.TabFocusReason if forward else Qt.FocusReason.BacktabFocusReason
    target.setFocus(reason)
    bring_into_sight(target)
    return True


def focus_into(part: QWidget, reason: Qt.FocusReason) -> bool:
    """Give the keyboard to what stands for ``part``, else to its first stop; whether it has one."""
    stops = tab_stops(part, ())
    if stops:
        first = part.focusProxy()
        (first if first in stops else stops[0]).setFocus(reason)
    return bool(stops)


def _chain(top: QWidget) -> list[QWidget]:
    # Within one region, Qt's order is the right one.
    window = top.window()
    last = window.previousInFocusChain()
    ring: list[QWidget] = [window]
    # No further: who asks the last one for the next takes the window for its child.
    while ring[-1] is not last and (after := ring[-1].nextInFocusChain()) is not None:
        ring.append(after)
    start = ring.index(top)
    return ring[start:] + ring[:start]


def _as_read(stops: Sequence[QWidget], part: QWidget) -> list[QWidget]:
    """Stops inside ``part`` from top to bottom, those beside each other from left to right."""
    if not all(part.isAncestorOf(stop) for stop in stops):
        return list(stops)
    places = {stop: _place(stop, stops, part) for stop in stops}
    lines: list[list[QWidget]] = []
    for stop in sorted(stops, key=lambda one: places[one].center().y()):
        above = places[lines[-1][0]] if lines else None
        if above is not None and places[stop].center().y() <= above.bottom():
            lines[-1].append(stop)
        else:
            lines.append([stop])
    return [stop for line in lines for stop in sorted(line, key=lambda one: places[one].x())]


def _place(stop: QWidget, stops: Sequence[QWidget], part: QWidget) -> QRect:
    # What holds other stops, and scrolls them, is read before them, not half way down.
    holds = any(stop is not one and stop.isAncestorOf(one) for one in stops)
    return QRect(stop.mapTo(part, QPoint()), QSize() if holds else stop.size())


def _give_back(window: QWidget) -> None:
    # PySide takes a widget for a child of the one that was asked for it - its neighbour in the
    # chain, what hands its focus on, a group - and takes it for deleted as soon as that one is.
    # What a window finds among its children it takes for a child of the window again.
    window.findChildren(QWidget)


def _takes_tab(widget: QWidget) -> bool:
    tab = Qt.FocusPolicy.TabFocus
    if widget.focusPolicy() & tab != tab or widget.focusProxy() is not None:
        return False
    if isinstance(widget, QAbstractButton) and widget.isCheckable() and not widget.isChecked():
        # Of buttons that exclude each other Tab reaches the one that is on; arrows do the rest.
        group = widget.group()
        if group is not None and group.exclusive() and group.checkedButton() is not None:
            return False
    return widget.isVisible() and widget.isEnabled()
