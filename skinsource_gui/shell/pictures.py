"""Pictures of panels and of the whole window, as they are on the screen."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial

from PySide6.QtCore import QEventLoop, QPoint, QRect, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontInfo, QPainter
from PySide6.QtWidgets import QApplication, QWidget

from skinsource_gui.made_panels import MadePanels
from skinsource_gui.panel import Panel
from skinsource_gui.panels.skin.panel import SkinPanel
from skinsource_gui.shell.appearance import Appearance
from skinsource_gui.shell.carrying import Carrying
from skinsource_gui.shell.docks.dock import Dock
from skinsource_gui.shell.docks.in_use import PanelInUse
from skinsource_gui.shell.docks.stage import staged, usual_size
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Engine
from skinsource_gui.theme import LIGHT, Theme, apply_theme, current_theme
from skinsource_gui.widgets.pictures.caption import height_above, with_caption
from skinsource_gui.widgets.pictures.whole_picture import (
    ALL_IN_SIGHT,
    IN_USE,
    Letters,
    WholePicture,
)

_TITLE_PX, _EDGE_PX = 22, 6
# The smallest letters of panels, as a part of usual ones: those of notes on the skin map.
_SMALLEST_LETTERS = 2 / 3


class PanelPictures:
    """Draws panels, one or all that are in sight.

    Parameters
    ----------
    frame
        The window in which the panels stand.
    document, engine
        Whose design, and who judges it: captions say what is played, and what that is not good for.
    panels
        All of them.
    appearance
        The colours in use.
    catch_up
        Waits until the panels in sight show the present design.
    docks
        Where panels stand, by name.
    in_use
        Knows which of them is.
    """

    def __init__(
        self,
        frame: QWidget,
        document: Document,
        engine: Engine,
        panels: MadePanels,
        appearance: Appearance,
        catch_up: Callable[[], None],
        docks: Mapping[str, Dock],
        in_use: PanelInUse,
    ) -> None:
        self._frame, self._panels = frame, panels
        self._carrying = Carrying(document, engine, panels, catch_up)
        self._appearance, self._catch_up, self._docks = appearance, catch_up, docks
        self._in_use = in_use

    def picture_of(self, name: str) -> WholePicture:
        """The picture of a panel, `IN_USE` or `ALL_IN_SIGHT`, with its caption."""
        panel: Panel | None = None
        if name != ALL_IN_SIGHT:
            panel = self._in_use.panel if name == IN_USE else self._panels[name]
        self._catch_up()
        caption = self._carrying.caption(*((panel,) if panel else self._in_the_window()))
        size: tuple[int, int] | None = None
        draw: Callable[..., None] = self._draw_all
        letters: Letters | None = None
        if panel is None:
            size = self._frame.width(), self._frame.height()
            letters = partial(self._letters_px, caption)
        else:
            draw = partial(self._draw_one, panel)
            likes = panel.size() if panel.isVisible() else usual_size(panel)
            size = None if name != IN_USE else (2 * likes.width(), 2 * likes.height())
        seen = panel.map.stage.seen if isinstance(panel, SkinPanel) else None
        draw = with_caption(draw, caption)
        return WholePicture(
            draw=draw,
            title="" if panel is None else panel.title,
            caption=caption,
            size_px=size,
            seen=seen,
            letters_px=letters,
        )

    def _in_the_window(self) -> list[Panel]:
        """Panels in sight that stand in no window of their own."""
        return [one for one in self._panels if one.isVisible() and one.window() is self._frame]

    def _draw_one(
        self, panel: Panel, painter: QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """A panel, which need not be in sight."""
        if panel.isVisible():
            with self._carrying.as_stored(), self._in_colours(theme):
                panel.draw_picture(painter, width, height, theme)
            return
        stage = staged(self._docks[panel.name], width, height)
        with self._carrying.as_stored(), stage as make_room:
            self._catch_up()
            # Parts that come and go with results ask for their room now.
            QApplication.processEvents(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
            make_room()
            QApplication.processEvents(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
            with self._in_colours(theme):
                panel.draw_picture(painter, width, height, theme)

    def _draw_all(self, painter: QPainter, width: int, height: int, theme: Theme = LIGHT) -> None:
        """All panels in sight, each where it is, with its title."""
        places, whole = self._places()
        painter.fillRect(QRectF(0, 0, width, height), QColor(theme.base))
        if whole.isEmpty():
            return
        scale = min(width / whole.width(), height / whole.height())
        with self._carrying.as_stored(), self._in_colours(theme):
            painter.save()
            painter.scale(scale, scale)
            painter.translate(-whole.topLeft())
            for panel, place in places.items():
                _draw_titled(painter, panel, place, theme)
            painter.restore()

    def _places(self) -> tuple[dict[Panel, QRect], QRect]:
        """Where each panel in sight is, and a box around them and their titles."""
        places = {
            panel: QRect(panel.mapTo(self._frame, QPoint()), panel.size())
            for panel in self._in_the_window()
        }
        whole = QRect()
        for place in places.values():
            whole = whole.united(place.adjusted(0, -_TITLE_PX, 0, 0))
        return places, whole

    def _letters_px(self, caption: str, width: int, height: int) -> float:
        """Height of the smallest letters of panels in a picture of all."""
        _, whole = self._places()
        font = QApplication.font()
        above = height_above(caption, font, width, height)
        scale = min(width / max(whole.width(), 1), above / max(whole.height(), 1))
        return scale * _SMALLEST_LETTERS * QFontInfo(font).pixelSize()

    @contextmanager
    def _in_colours(self, theme: Theme) -> Iterator[None]:
        """Show the studio in other colours, and back; nothing of it comes onto the screen."""
        application, before = QApplication.instance(), current_theme()
        if theme == before or not isinstance(application, QApplication):
            yield
            return
        text_scale = self._appearance.text_scale
        apply_theme(application, theme, text_scale)
        try:
            yield
        finally:
            apply_theme(application, before, text_scale)


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
