"""The photograph, the outline and the places, as they lie; places are clicked here."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QImage,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QTransform,
)
from PySide6.QtWidgets import QWidget

from skinsource.base.arrays import Floats
from skinsource.base.work import counted
from skinsource_gui.limb_page.draft import Draft
from skinsource_gui.theme import UNIT_PX, current_theme

_RADIUS_PX, _DOT_PX = 8.0, 4.0
# In a crowd a mark takes this share of the way to the nearest one of its kind, but stays to be
# seen; numbers stand in those that are not smaller than this.
_OF_SPACING, _CROWDED_PX, _NUMBERED_PX = 0.44, 2.0, 7.0
_NOTHING = "Outline and places appear here. Open a photograph to click them."


class PlacesCanvas(QWidget):
    """Shows a draft; tells where it was clicked, in the coordinates of the draft."""

    #: x, y
    clicked = Signal(float, float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._draft = Draft()
        self._photograph = QImage()
        self.setObjectName("places_canvas")
        self.setAccessibleName("Outline and places of the limb")
        self.setMinimumSize(260, 320)

    def show_photograph(self, photograph: QImage) -> None:
        """Lay a photograph under the places."""
        self._photograph = photograph
        can_click = not photograph.isNull()
        self.setCursor(Qt.CursorShape.CrossCursor if can_click else Qt.CursorShape.ArrowCursor)
        self.update()

    def show_draft(self, draft: Draft) -> None:
        """Show outline and places."""
        self._draft = draft
        placed = f"{counted(len(draft.inputs), 'input')}, {counted(len(draft.outputs), 'output')}"
        self.setAccessibleDescription(
            f"{placed}, outline of {counted(len(draft.outline), 'corner')}"
        )
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(380, 460)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton or self._photograph.isNull():
            return
        back, can_turn = self._transform().inverted()
        if can_turn:
            at = back.map(event.position())
            self.clicked.emit(at.x(), at.y())

    def place_of(self, x: float, y: float) -> QPointF:
        """Where a point of the draft is on the screen."""
        return self._transform().map(QPointF(x, y))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, theme, draft = QPainter(self), current_theme(), self._draft
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.fillRect(self.rect(), QColor(theme.base))
        transform = self._transform()
        if not self._photograph.isNull():
            painter.save()
            painter.setTransform(transform)
            painter.drawImage(0, 0, self._photograph)
            painter.restore()
        if self._bounds().isEmpty():
            painter.setPen(QColor(theme.dim))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(self.rect().adjusted(8, 8, -8, -8), int(flags), _NOTHING)
        self._paint_outline(painter, transform, draft.outline)
        self._paint_hand(painter, transform, draft.hand)
        font = painter.font()
        font.setPixelSize(10)
        painter.setFont(font)
        for points, colour, radius in (
            (draft.outputs, theme.text, _DOT_PX),
            (draft.inputs, theme.accent, _RADIUS_PX),
        ):
            self._paint_points(painter, transform, points, QColor(colour), radius)
        painter.end()

    def _paint_outline(self, painter: QPainter, transform: QTransform, outline: Floats) -> None:
        line = QPolygonF([transform.map(QPointF(x, y)) for x, y in outline])
        painter.setPen(QPen(QColor(current_theme().accent), 2.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPolygon(line)

    def _paint_hand(self, painter: QPainter, transform: QTransform, hand: Floats) -> None:
        painter.setPen(QPen(QColor(current_theme().error), 2.0))
        ends = [transform.map(QPointF(x, y)) for x, y in hand]
        for end in ends:
            painter.drawEllipse(end, 3.0, 3.0)
        if len(ends) == 2:
            painter.drawLine(ends[0], ends[1])

    def _paint_points(
        self, painter: QPainter, transform: QTransform, points: Floats, fill: QColor, radius: float
    ) -> None:
        painter.setPen(QPen(QColor(current_theme().base), 1.0))
        painter.setBrush(fill)
        scale = abs(transform.m11())
        radii = np.clip(_OF_SPACING * scale * spacing_of(points), _CROWDED_PX, radius)
        for number, ((x, y), own) in enumerate(zip(points, radii, strict=True), start=1):
            if not np.isfinite((x, y)).all():
                continue
            centre = transform.map(QPointF(x, y))
            painter.drawEllipse(centre, float(own), float(own))
            if own >= _NUMBERED_PX:
                area = QRectF(centre.x() - 12, centre.y() - 7, 24, 14)
                painter.drawText(area, Qt.AlignmentFlag.AlignCenter, str(number))

    def _bounds(self) -> QRectF:
        if not self._photograph.isNull():
            return QRectF(self._photograph.rect())
        parts = (self._draft.outline, self._draft.inputs, self._draft.outputs)
        points = np.vstack(parts)
        points = points[np.isfinite(points).all(axis=1)]
        if len(points) < 2:
            return QRectF()
        low, high = points.min(axis=0), points.max(axis=0)
        return QRectF(QPointF(*low), QPointF(*np.maximum(high, low + 1e-6)))

    def _transform(self) -> QTransform:
        """From the coordinates of the draft to pixels."""
        bounds = self._bounds()
        room = QRectF(self.rect()).adjusted(UNIT_PX, UNIT_PX, -UNIT_PX, -UNIT_PX)
        if bounds.isEmpty():
            return QTransform()
        scale = min(room.width() / bounds.width(), room.height() / bounds.height())
        up = -1.0 if not self._draft.y_down and self._photograph.isNull() else 1.0
        middle, centre = room.center(), bounds.center()
        found = QTransform.fromTranslate(middle.x(), middle.y())
        found.scale(scale, up * scale)
        found.translate(-centre.x(), -centre.y())
        return found


def spacing_of(points: Floats) -> Floats:
    """From each point to the nearest other one, (n,); infinite where there is none."""
    apart = np.linalg.norm(points[:, None] - points[None], axis=-1)
    apart[np.isnan(apart)] = np.inf
    np.fill_diagonal(apart, np.inf)
    return np.asarray(apart.min(axis=1, initial=np.inf))
