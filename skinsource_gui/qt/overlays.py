"""Overlays of widgets that are out of date or covered, and the delay before they appear."""

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QRectF, Qt, QTimer, Signal

from skinsource_gui.qt.layouts import named
from skinsource_gui.qt.theme import UNIT_PX, translucent

# Results come many times a second during a drag; only a longer delay is shown.
_STALE_MS = 150


class Staleness(QObject):
    """Tells whether a picture has been out of date for a while.

    Attributes
    ----------
    is_stale
        Whether that is so.
    """

    #: `is_stale` has changed.
    changed = Signal(bool)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.is_stale = False
        self._timer = QTimer(self, interval=_STALE_MS, singleShot=True)
        self._timer.timeout.connect(self._become_stale)

    def set_stale(self, stale: bool, *, at_once: bool = False) -> None:
        """Say whether the picture is out of date.

        A picture that is up to date is signalled at once; one that is out of date after a while, or
        ``at_once``.
        """
        if not stale:
            self._timer.stop()
            if self.is_stale:
                self.is_stale = False
                self.changed.emit(False)
        elif self.is_stale:
            return
        elif at_once:
            self._timer.stop()
            self._become_stale()
        elif not self._timer.isActive():
            self._timer.start()

    def restart(self) -> None:
        """Restart the delay: a newer picture is drawn, which is not up to date either."""
        if self._timer.isActive():
            self._timer.start()

    def _become_stale(self) -> None:
        self.is_stale = True
        self.changed.emit(True)


class Overlay(QtWidgets.QWidget):
    """Base of overlays, which cover all of the widget ``part``, their parent."""

    def __init__(self, part: QtWidgets.QWidget) -> None:
        super().__init__(part)
        self._part = part
        part.installEventFilter(self)
        self.setGeometry(part.rect())
        self.show()
        self.raise_()

    def take_away(self) -> None:
        """Remove the overlay."""
        self._part.removeEventFilter(self)
        self.hide()
        self.deleteLater()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize:
            self.setGeometry(self._part.rect())
        return super().eventFilter(watched, event)


#: Text on a cover.
COVERED = "Covered"
_LEAST_LINES = 2


class Cover(Overlay):
    """Hides a picture from an audience that shall guess first; it blocks the mouse, too."""

    def __init__(self, part: QtWidgets.QWidget) -> None:
        super().__init__(part)
        named(self, "cover", COVERED)
        self.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip:
            return True  # the tooltip of the picture would reveal it
        return super().event(event)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, palette = QtGui.QPainter(self), self.palette()
        painter.fillRect(self.rect(), palette.color(QtGui.QPalette.ColorRole.Window))
        # A widget that is too low for a text stands beside one that has it.
        if self.height() >= _LEAST_LINES * self.fontMetrics().height():
            painter.setPen(palette.color(QtGui.QPalette.ColorRole.WindowText))
            font = painter.font()
            least_px, room_px = self.fontMetrics().height(), min(self.width() / 2, self.height())
            font.setPixelSize(round(max(room_px / 8, least_px)))
            painter.setFont(font)
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, COVERED)


#: Text on results of an older design.
UPDATING = "Updating…"
#: Opacity of results of an older design.
PALE = 0.45

_RADIUS_PX = 4.0


class StaleOverlay(Overlay):
    """Marks results of an older design, which stay readable and can be used."""

    def __init__(self, part: QtWidgets.QWidget) -> None:
        super().__init__(part)
        named(self, "veil", UPDATING)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, palette = QtGui.QPainter(self), self.palette()
        ground = palette.color(QtGui.QPalette.ColorRole.Base)
        thin = translucent(ground, round(255 * (1.0 - PALE)))
        painter.fillRect(self.rect(), thin)
        # A widget that is too low for a text stands beside one that has it.
        if self.height() >= _LEAST_LINES * self.fontMetrics().height():
            metrics = painter.fontMetrics()
            width = metrics.horizontalAdvance(UPDATING) + 2 * UNIT_PX
            card = QRectF(0, 0, width, 1.6 * metrics.height())
            card.moveCenter(QRectF(self.rect()).center())
            painter.setPen(palette.color(QtGui.QPalette.ColorRole.Text))
            painter.setBrush(ground)
            painter.drawRoundedRect(card, _RADIUS_PX, _RADIUS_PX)
            painter.drawText(card, Qt.AlignmentFlag.AlignCenter, UPDATING)
