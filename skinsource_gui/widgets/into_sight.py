"""Parts of what scrolls are brought where they can be seen."""

from collections.abc import Iterator

from PySide6.QtWidgets import QScrollArea, QWidget


def areas_around(widget: QWidget) -> Iterator[QScrollArea]:
    """Areas that scroll a widget, the innermost first."""
    around = widget.parentWidget()
    while around is not None:
        if isinstance(around, QScrollArea):
            yield around
        around = around.parentWidget()


def bars_px(widget: QWidget) -> int:
    """Width that scroll bars around a widget have taken."""
    return sum(
        max(area.maximumViewportSize().width() - area.viewport().width(), 0)
        for area in areas_around(widget)
    )


def bring_into_sight(widget: QWidget) -> None:
    """Scroll what is around a widget until it is seen."""
    for area in areas_around(widget):
        area.ensureWidgetVisible(widget)
