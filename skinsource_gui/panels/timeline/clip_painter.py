"""How a clip looks."""

from math import ceil, floor

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen, QPolygonF

from skinsource.base.arrays import Floats
from skinsource_gui.panels.timeline.clip_pictures import ClipPictures, Look, Played
from skinsource_gui.panels.timeline.lane import Box
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.kept_picture import KeptPicture
from skinsource_gui.widgets.paper import dots_in_px

_ROUNDING_PX = 3.0
_WORDS_FROM_PX = 40.0
_BODY_ALPHA, _PALE_BODY_ALPHA, _SELECTED_ALPHA = 46, 18, 84
_PALE = 0.45
_HANDLE_PX = 5.0


def words_of(box: Box) -> str:
    """What stands on a clip: its label, or what it plays."""
    clip = box.clip
    return clip.label or clip.waveform.title


def paint_clip(
    painter: QPainter,
    box: Box,
    samples: Floats | None,
    sample_rate_hz: float,
    pictures: ClipPictures,
    theme: Theme,
    *,
    loudest: float,
    selected: bool,
    shown_elsewhere: bool,
    unplayable: bool,
    awaited: bool,
    handles: bool,
    view: QRectF,
) -> None:
    """Paint a clip.

    Parameters
    ----------
    samples, sample_rate_hz : (n_times,)
        What it plays, or None while it is not known.
    loudest
        The largest gain of its track, which takes the full height.
    selected, shown_elsewhere, unplayable, awaited, handles
        Whether it is selected; whether the inspector shows it; whether its track cannot be played
        because of it; whether what it plays is late; whether its ends show that they can be
        dragged.
    view
        What can be seen: no more is painted.
    """
    pale = box.clip.muted or bool(box.lane.silent)
    colour = QColor(theme.dim) if pale else theme.input_colour(box.lane.track.colour)
    shown = box.rect.intersected(view.adjusted(-2, 0, 2, 0))
    if shown.isEmpty():
        # Of its lane no more is in sight than the edge.
        return
    _paint_body(painter, box.rect, shown, colour, selected=selected, pale=pale)
    if samples is not None and shown.width() >= 1:
        painter.setOpacity(_PALE if pale else 1.0)
        played = Played(samples, sample_rate_hz)
        _paint_samples(painter, box, shown, played, pictures, colour, loudest)
        painter.setOpacity(1.0)
    if any(box.fades_px):
        _paint_fades(painter, box, QColor(theme.text))
    # Over the lines of fades: the name is read first.
    if shown.width() >= _WORDS_FROM_PX:
        words = words_of(box)
        _write(painter, f"{words} · updating…" if awaited else words, shown, theme, pale=pale)
    _paint_frame(painter, box.rect, shown, theme, colour, selected=selected)
    if unplayable:
        _paint_frame(painter, box.rect, shown, theme, QColor(theme.error), selected=False)
    if shown_elsewhere and not selected:
        mark_clip(painter, box.rect, shown, pictures.mark, QColor(theme.accent))
    if handles:
        _paint_handles(painter, box, QColor(theme.text))


def _paint_body(
    painter: QPainter, rect: QRectF, shown: QRectF, colour: QColor, *, selected: bool, pale: bool
) -> None:
    body = QColor(colour)
    alpha = _PALE_BODY_ALPHA if pale else _BODY_ALPHA
    body.setAlpha(_SELECTED_ALPHA if selected else alpha)
    painter.fillRect(shown, body)
    # What starts here is marked: clips that follow each other are told apart.
    if rect.left() >= shown.left():
        painter.fillRect(QRectF(rect.left(), rect.top(), 2, rect.height()), colour)


def _paint_samples(
    painter: QPainter,
    box: Box,
    shown: QRectF,
    played: Played,
    pictures: ClipPictures,
    colour: QColor,
    loudest: float,
) -> None:
    rect = box.rect
    whole = shown.width() >= rect.width() - 1
    part = (
        (0.0, 1.0)
        if whole
        else (
            (shown.left() - rect.left()) / rect.width(),
            (shown.right() - rect.left()) / rect.width(),
        )
    )
    left, width = (rect.left(), rect.width()) if whole else (shown.left(), shown.width())
    peak = max(abs(box.clip.gain) * _peak(played.samples), 1e-12)
    reach = box.clip.gain / max(loudest, peak)
    pictures.paint(
        painter,
        played,
        QRectF(left, rect.top() + 1, max(round(width), 1), max(round(rect.height()) - 2, 1)),
        Look(colour.rgba(), reach, part, dots_in_px(painter)),
    )


def _peak(samples: Floats) -> float:
    return float(max(samples.max(initial=0.0), -samples.min(initial=0.0)))


def _write(painter: QPainter, words: str, shown: QRectF, theme: Theme, *, pale: bool) -> None:
    metrics = QFontMetricsF(painter.font())
    line_px = metrics.height()
    room = QRectF(shown.left() + 5, shown.top() + 1, shown.width() - 10, line_px)
    text = metrics.elidedText(words, Qt.TextElideMode.ElideRight, room.width())
    ground = QColor(theme.base)
    ground.setAlpha(190)
    painter.fillRect(
        QRectF(room.left() - 2, room.top(), metrics.horizontalAdvance(text) + 4, line_px), ground
    )
    painter.setPen(QColor(theme.dim if pale else theme.text))
    painter.drawText(room, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, text)


def _paint_frame(
    painter: QPainter, rect: QRectF, shown: QRectF, theme: Theme, colour: QColor, *, selected: bool
) -> None:
    if selected:
        painter.setPen(QPen(QColor(theme.accent), 2))
    else:
        edge = QColor(colour)
        edge.setAlpha(130)
        painter.setPen(QPen(edge, 1))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    left = max(rect.left(), shown.left() - 2)
    right = min(rect.right(), shown.right() + 2)
    frame = QRectF(left, rect.top(), right - left, rect.height())
    painter.drawRoundedRect(frame.adjusted(0.5, 0.5, -0.5, -0.5), _ROUNDING_PX, _ROUNDING_PX)


def mark_clip(
    painter: QPainter, rect: QRectF, shown: QRectF, mark: KeptPicture, colour: QColor
) -> None:
    """Frame a clip with dots, which take Qt longer than the clip: painted once for each size."""
    # Where pixels of the screen begin, so that the picture is what would be painted here.
    on_screen = painter.deviceTransform()
    first = on_screen.map(QPointF(shown.left() - 1, rect.top() - 1))
    from_screen, _ = on_screen.inverted()
    corner = from_screen.map(QPointF(floor(first.x()), floor(first.y())))
    end = shown.bottomRight() - corner + QPointF(1, 1)
    frame = rect.adjusted(1, 1, -1, -1).translated(-corner)

    def paint_dots(painter: QPainter) -> None:
        painter.setPen(QPen(colour, 2, Qt.PenStyle.DotLine))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRoundedRect(frame, _ROUNDING_PX, _ROUNDING_PX)

    painter.translate(corner)
    room = QRectF(0, 0, ceil(end.x()), ceil(end.y()))
    # The same place among the pixels, but for rounding.
    edges = frame.left(), frame.top(), frame.right(), frame.bottom()
    place = tuple(round(edge, 4) for edge in edges)
    mark.paint(painter, room, (colour.rgba(), place), paint_dots)
    painter.translate(-corner)


def _paint_fades(painter: QPainter, box: Box, colour: QColor) -> None:
    rect, (in_px, out_px) = box.rect, box.fades_px
    painter.setPen(QPen(colour, 1, Qt.PenStyle.DashLine))
    if in_px > 0:
        painter.drawLine(rect.bottomLeft(), rect.topLeft() + QPointF(in_px, 0))
    if out_px > 0:
        painter.drawLine(rect.bottomRight(), rect.topRight() - QPointF(out_px, 0))


def _paint_handles(painter: QPainter, box: Box, colour: QColor) -> None:
    rect, (in_px, out_px) = box.rect, box.fades_px
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour)
    fades = (
        (rect.topLeft() + QPointF(in_px, 0), 1),
        (rect.topRight() - QPointF(out_px, 0), -1),
    )
    for corner, aside in fades:
        ends = (
            corner,
            corner + QPointF(aside * 2 * _HANDLE_PX, 0),
            corner + QPointF(0, 2 * _HANDLE_PX),
        )
        painter.drawPolygon(QPolygonF(ends))
    middle = rect.center().y()
    for x in (rect.left() + 2, rect.right() - 4):
        painter.drawRect(QRectF(x, middle - _HANDLE_PX, 2, 2 * _HANDLE_PX))
