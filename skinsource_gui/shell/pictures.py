"""Pictures of panels and of the whole window, as they are on the screen."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, QRect, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter
from PySide6.QtWidgets import QApplication

from skinsource_gui.panel import Panel
from skinsource_gui.theme import LIGHT, Theme, apply_theme
from skinsource_gui.widgets.pictures.caption import caption_of, with_caption
from skinsource_gui.widgets.pictures.whole_picture import ALL_IN_SIGHT, IN_USE, WholePicture

if TYPE_CHECKING:
    from skinsource_gui.shell.window import MainWindow

_TITLE_PX, _EDGE_PX = 22, 6


def picture_of(window: "MainWindow", name: str) -> WholePicture:
    """The picture of a panel, with the stimulus in its caption.

    Parameters
    ----------
    window
        Whose panels; it shows the present design first.
    name
        Of a panel, `IN_USE` or `ALL_IN_SIGHT`.
    """
    window.catch_up()
    caption = caption_of(window.document.design)
    if name == ALL_IN_SIGHT:
        draw, size = partial(_draw_arrangement, window), (window.width(), window.height())
    else:
        panel = _in_use(window) if name == IN_USE else window.panel(name)
        draw = partial(_draw_in_colours, window, panel.draw_picture)
        size = None if name != IN_USE else (2 * panel.width(), 2 * panel.height())
    return WholePicture(draw=with_caption(draw, caption), size_px=size)


def _in_use(window: "MainWindow") -> Panel:
    """The panel that has the keyboard, or else the first one in sight."""
    focused = QApplication.focusWidget()
    in_sight = [panel for panel in window.panels if panel.isVisible()]
    with_focus = [one for one in in_sight if focused is not None and one.isAncestorOf(focused)]
    return (with_focus or in_sight or list(window.panels))[0]


def _draw_in_colours(
    window: "MainWindow",
    draw: Callable[..., None],
    painter: QPainter,
    width: int,
    height: int,
    theme: Theme = LIGHT,
) -> None:
    with _in_colours(window, theme):
        draw(painter, width, height, theme)


def _draw_arrangement(
    window: "MainWindow", painter: QPainter, width: int, height: int, theme: Theme = LIGHT
) -> None:
    """All panels in sight, each where it is, with its title."""
    panels = [panel for panel in window.panels if panel.isVisible()]
    places = {
        panel: QRect(panel.mapTo(window, QPoint()), panel.size())
        for panel in panels
        if panel.window() is window
    }
    whole = QRect()
    for place in places.values():
        whole = whole.united(place.adjusted(0, -_TITLE_PX, 0, 0))
    painter.fillRect(QRectF(0, 0, width, height), QColor(theme.base))
    if whole.isEmpty():
        return
    scale = min(width / whole.width(), height / whole.height())
    with _in_colours(window, theme):
        painter.save()
        painter.scale(scale, scale)
        painter.translate(-whole.topLeft())
        for panel, place in places.items():
            _draw_titled(painter, panel, place, theme)
        painter.restore()


def _draw_titled(painter: QPainter, panel: Panel, place: QRect, theme: Theme) -> None:
    font = QFont(QApplication.font())
    font.setBold(True)
    painter.setFont(font)
    painter.setPen(QColor(theme.text))
    head = QRectF(place.left() + _EDGE_PX, place.top() - _TITLE_PX, place.width(), _TITLE_PX)
    painter.drawText(head, Qt.AlignmentFlag.AlignVCenter, panel.title)
    painter.save()
    painter.translate(place.topLeft())
    painter.setClipRect(QRectF(0, 0, place.width(), place.height()))
    painter.setFont(QApplication.font())
    panel.draw_picture(painter, place.width(), place.height(), theme)
    painter.restore()


@contextmanager
def _in_colours(window: "MainWindow", theme: Theme) -> Iterator[None]:
    """Show the studio in other colours, and back; nothing of it comes onto the screen."""
    application, before = QApplication.instance(), window.theme
    if theme == before or not isinstance(application, QApplication):
        yield
        return
    _show(window, application, theme)
    try:
        yield
    finally:
        _show(window, application, before)


def _show(window: "MainWindow", application: QApplication, theme: Theme) -> None:
    apply_theme(application, theme, window.appearance.text_scale)
    for panel in window.panels:
        panel.show_theme(theme)
