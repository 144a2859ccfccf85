"""Telling the eye that something is out of date, but not at once."""

from PySide6.QtCore import QEvent, QObject, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QWidget

from skinsource_gui.qt.theme import UNIT_PX

# Results come many times a second while something is dragged; only lateness is worth a word.
_LATE_MS = 150


class Staleness(QObject):
    """Whether what is drawn has been out of date for a while.

    Attributes
    ----------
    late
        Whether that is so.
    """

    #: `late` is something else now.
    changed = Signal(bool)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.late = False
        self._timer = QTimer(self, interval=_LATE_MS, singleShot=True)
        self._timer.timeout.connect(self._be_late)

    def set_stale(self, stale: bool, *, at_once: bool = False) -> None:
        """Say whether what is drawn is out of date; being up to date is told at once.

        ``at_once``: so is being out of date.
        """
        if not stale:
            self._timer.stop()
            if self.late:
                self.late = False
                self.changed.emit(False)
        elif self.late:
            return
        elif at_once:
            self._timer.stop()
            self._be_late()
        elif not self._timer.isActive():
            self._timer.start()

    def count_anew(self) -> None:
        """Something newer is drawn: what was not late yet is not for a while from now."""
        if self._timer.isActive():
            self._timer.start()

    def _be_late(self) -> None:
        self.late = True
        self.changed.emit(True)


# What lies over all of another widget, however large that becomes.


class OverAll(QWidget):
    """Lies over all of another widget until it is taken away.

    Parameters
    ----------
    part
        What lies below; also its parent.
    """

    def __init__(self, part: QWidget) -> None:
        super().__init__(part)
        self._part = part
        part.installEventFilter(self)
        self.setGeometry(part.rect())
        self.show()
        self.raise_()

    def take_away(self) -> None:
        """Show what is below as it is."""
        self._part.removeEventFilter(self)
        self.hide()
        self.deleteLater()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize:
            self.setGeometry(self._part.rect())
        return super().eventFilter(watched, event)


# What hides a picture from an audience that shall guess first.

#: What stands on what is covered.
COVERED = "Covered"
_LEAST_LINES = 2


class Cover(OverAll):
    """Lies over all of another widget, and lets neither eyes nor the mouse through.

    Parameters
    ----------
    part
        What it hides; also its parent.
    """

    def __init__(self, part: QWidget) -> None:
        super().__init__(part)
        self.setObjectName("cover")
        self.setAccessibleName(COVERED)
        self.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip:
            return True  # that of what is below would tell
        return super().event(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, palette = QPainter(self), self.palette()
        painter.fillRect(self.rect(), palette.color(QPalette.ColorRole.Window))
        # Beside something larger that says it, a line of words says nothing.
        if self.height() >= _LEAST_LINES * self.fontMetrics().height():
            painter.setPen(palette.color(QPalette.ColorRole.WindowText))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, COVERED)
        painter.end()


# What lies over results of an older design until newer ones are there.

#: What stands on them.
UPDATING = "Updating…"
#: How much of them is still seen.
PALE = 0.45

_RADIUS_PX = 4.0


class StaleOverlay(OverAll):
    """Lies over all of another widget, which stays readable and can be used.

    Parameters
    ----------
    part
        What belongs to an older design; also its parent.
    """

    def __init__(self, part: QWidget) -> None:
        super().__init__(part)
        self.setObjectName("veil")
        self.setAccessibleName(UPDATING)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, palette = QPainter(self), self.palette()
        ground = palette.color(QPalette.ColorRole.Base)
        thin = QColor(ground)
        thin.setAlphaF(1.0 - PALE)
        painter.fillRect(self.rect(), thin)
        # Beside something larger that says it, a line of words says nothing.
        if self.height() >= _LEAST_LINES * self.fontMetrics().height():
            text_colour = palette.color(QPalette.ColorRole.Text)
            paint_updating(painter, QRectF(self.rect()), ground, text_colour)
        painter.end()


def paint_updating(painter: QPainter, room: QRectF, ground: QColor, text_colour: QColor) -> None:
    """Write in the middle of ``room``, on a ground of its own, that its content is not new."""
    metrics = painter.fontMetrics()
    card = QRectF(0, 0, metrics.horizontalAdvance(UPDATING) + 2 * UNIT_PX, 1.6 * metrics.height())
    card.moveCenter(room.center())
    painter.setPen(text_colour)
    painter.setBrush(ground)
    painter.drawRoundedRect(card, _RADIUS_PX, _RADIUS_PX)
    painter.drawText(card, Qt.AlignmentFlag.AlignCenter, UPDATING)
