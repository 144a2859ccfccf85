"""A snapshot as a card, the map of a difference, and the texts of both."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from math import ceil

from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QHelpEvent, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QSizePolicy, QToolTip, QWidget

from skinsource.base.decibels import FLOOR_DB
from skinsource.base.quoting import printable
from skinsource.design.comparing import (
    EDITED,
    gain_text,
    louder,
    loudest_db,
    match_text,
    same_but_rounding,
    scale_end_db,
)
from skinsource.design.labels import short_limb_title
from skinsource.studies import scenes
from skinsource_gui.fields.units import minus, output_text
from skinsource_gui.plots.colour_maps import DIVERGING, colour_table
from skinsource_gui.plots.outputs import output_at
from skinsource_gui.plots.small_map import (
    ColourScale,
    Range,
    SmallMap,
    paint_numbers,
    paint_rings,
    paint_scale_row,
    paint_small_map,
    scale_row_px,
    small_frame,
)
from skinsource_gui.qt.buttons import passing_menu
from skinsource_gui.qt.keys import claims_shortcut, meaning_of, shortcut_text
from skinsource_gui.qt.theme import UNIT_PX, current_theme, tabular
from skinsource_gui.state.compared import (
    LEVELS_MATCHED,
    Compared,
    gain_db,
    have_matching_level,
    is_silent,
    matched_text,
)

#: Levels that differ by less are shown as the same.
LEAST_DB = 0.05

_UNIT = "dB re 1 m/s²"


def played_db(compared: Compared) -> float | None:
    """Return the level of the loudest output of a snapshot as it is shown, dB; None: not known."""
    if compared.values is None:
        return None
    stored = loudest_db(compared.values["output_levels_db"])
    return stored if stored <= FLOOR_DB else stored + gain_db(compared)


def card_level_text(compared: Compared) -> str:
    """Return the level of the loudest output, "−12.3 dB"; "…" while it is not known."""
    level = played_db(compared)
    if level is None:
        return "–" if compared.problem else "…"
    return "silent" if level <= FLOOR_DB else minus(f"{level:z.1f} dB")


def snapshot_title(compared: Compared) -> str:
    """Return the name of a snapshot in a sentence."""
    number = compared.snapshot.number
    return "edited" if number == EDITED else f"snapshot {number}"


def matching_text(compared: Sequence[Compared], *, matched: bool) -> str:
    """Return the text on which quantity all designs share, and its level."""
    known = [side for side in compared if played_db(side) is not None]
    if len(known) < 2:
        return ""
    if not matched:
        return "As loud as they were stored"
    if not have_matching_level(compared, matched=matched):
        name = snapshot_title(compared[0])
        why = "cannot be predicted" if compared[0].problem else "is silent"
        return f"{name[:1].upper()}{name[1:]} {why}: levels cannot be matched to it"
    return f"Alike at the loudest output: {card_level_text(known[0])[:-3]} {_UNIT}"


def difference_captions(present: Compared, other: Compared, *, matched: bool) -> tuple[str, str]:
    """Return the texts above and below a map of their difference."""
    name = snapshot_title(present)
    heading = f"{name[:1].upper()}{name[1:]} minus {snapshot_title(other)}"
    caption = "dB, as stored"
    if matched:
        caption = f"dB, {matched_text((other, present)) or LEVELS_MATCHED}"
    mine, theirs = (side.snapshot.design.limb for side in (present, other))
    if mine == theirs:
        return heading, caption
    return heading, f"{caption}, {short_limb_title(mine)} minus {short_limb_title(theirs)}"


def equal_captions(present: Compared, other: Compared) -> tuple[str, str]:
    """Return the texts above and below the map of two designs with the same levels."""
    name = snapshot_title(present)
    heading = f"{name[:1].upper()}{name[1:]} and {snapshot_title(other)} are equal"
    mine, theirs = present.snapshot, other.snapshot
    if mine.design == theirs.design:
        return heading, "dB, the same inputs, scaling and limb"
    # The louder one is turned down: an amplitude may be the largest there is.
    ratio = present.gain / other.gain
    turned_down = louder(mine.design, min(ratio, 1.0)), louder(theirs.design, min(1.0 / ratio, 1.0))
    if same_but_rounding(*turned_down):
        return heading, "dB, the same inputs once levels match"
    return heading, "dB, the same levels by other inputs"


def card_text(compared: Compared, *, present: bool) -> str:
    """Return all that a card shows, as it is read aloud."""
    name = snapshot_title(compared)
    gain = gain_text(compared.gain)
    parts = [
        f"{name[:1].upper()}{name[1:]}",
        printable(scenes.title_of(compared.snapshot.design)).strip(),
        f"loudest output {card_level_text(compared)}",
        f"shown {gain} to match" if gain else "",
        "in the window" if present else "",
        compared.problem,
        compared.left_out,
    ]
    return ", ".join(part for part in parts if part)


_PLACE = "snapshot"
_RADIUS_PX, _FRAME_PX, _TALLEST_PX, _RINGS_PX = 4, 2, 200, 6


class Card(QAbstractButton):
    """A snapshot as a card: a click shows it in the window, an empty card stores.

    Parameters
    ----------
    number
        Number of the snapshot; 0: the edited design.

    Attributes
    ----------
    compared
        The snapshot; None: nothing is stored.
    present
        Whether the snapshot is in the window.
    """

    #: What to do with this number: ``"show"``, ``"store"`` or ``"forget"``.
    requested = Signal(int, str)

    def __init__(self, number: int, parent: QWidget) -> None:
        super().__init__(parent)
        self.number = number
        # The design that is edited is never stored, and without it its card is away.
        self._store_key = shortcut_text(f"store_snapshot_{number}") if number else ""
        self.compared: Compared | None = None
        self._map: SmallMap | None = None
        self._scale: ColourScale | None = None
        self.present = False
        self.setObjectName(f"snapshot_card_{number}")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.customContextMenuRequested.connect(self._open_menu)
        self.clicked.connect(self._act)
        self.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Expanding)
        self.setMaximumHeight(_TALLEST_PX)
        self.show_snapshot(None, None, None, present=False)

    def show_snapshot(
        self,
        compared: Compared | None,
        shown: SmallMap | None,
        scale: ColourScale | None,
        *,
        present: bool,
    ) -> None:
        """Take over what to show, in which colours; None: nothing is stored."""
        self.compared, self._map, self._scale = compared, shown, scale
        self.present = present
        text = (
            f"Snapshot {self.number}: nothing stored; click, or press {self._store_key}, to store"
            if compared is None
            else card_text(compared, present=present)
        )
        self.setAccessibleName(text)
        self.setToolTip(text)
        self.update()

    def sizeHint(self) -> QSize:
        line = self.fontMetrics().height()
        widest = self.fontMetrics().horizontalAdvance("−88.8 dB")
        return QSize(widest + UNIT_PX + 2, 3 * line + 11 * UNIT_PX)

    def minimumSizeHint(self) -> QSize:
        return self.sizeHint() - QSize(UNIT_PX, 0)

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, partial(meaning_of, _PLACE)) or super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        means = meaning_of(_PLACE, event)
        if means == "forget" and self.compared is not None:
            self.requested.emit(self.number, "forget")
        elif means == "act":
            self._act()
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, theme = QPainter(self), current_theme()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = QRectF(self.rect()).adjusted(1, 1, -1, -1)
        focused = self.hasFocus()
        line = QPen(QColor(theme.accent if focused else theme.border), _FRAME_PX if focused else 1)
        if self.compared is None:
            line.setStyle(Qt.PenStyle.DashLine)
        painter.setPen(line)
        painter.setBrush(QColor(theme.base))
        painter.drawRoundedRect(frame, _RADIUS_PX, _RADIUS_PX)
        inside = frame.adjusted(4, 4, -4, -3)
        if self.present:
            head = QRectF(inside.left(), inside.top(), inside.width(), self.fontMetrics().height())
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(theme.accent))
            painter.drawRoundedRect(head, _RADIUS_PX / 2, _RADIUS_PX / 2)
        self._paint_inside(painter, inside)
        painter.end()

    def _paint_inside(self, painter: QPainter, area: QRectF) -> None:
        theme, compared = current_theme(), self.compared
        line = self.fontMetrics().height()
        centre = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignVCenter
        heading = QFont(self.font())
        heading.setBold(True)
        painter.setFont(heading)
        heading_colour = theme.on_accent if self.present else theme.text
        painter.setPen(QColor(heading_colour if compared else theme.dim))
        name = compared.name if compared else str(self.number)
        painter.drawText(QRectF(area.left(), area.top(), area.width(), line), centre, name)
        painter.setFont(tabular(self.font()))
        if compared is None:
            painter.drawText(area, centre, self._store_key)
            return
        below = QRectF(area.left(), area.bottom() - 2 * line, area.width(), line)
        painter.setPen(QColor(theme.error if compared.left_out else theme.text))
        painter.drawText(
            below, centre, fitted_level(painter, card_level_text(compared), area.width())
        )
        painter.setPen(QColor(theme.dim))
        gain = match_text(compared.gain)
        if painter.fontMetrics().horizontalAdvance(gain) > area.width():
            gain = fitted_level(painter, gain_text(compared.gain), area.width())
        painter.drawText(below.translated(0, line), centre, gain)
        if self._map is not None and self._scale is not None:
            # Rings of inputs reach beyond the outline.
            room = area.adjusted(0, line + _RINGS_PX, 0, -2 * line - _RINGS_PX)
            design, scale = compared.snapshot.design, self._scale
            table = colour_table(scale.colours)
            # Silence has no colour: the lowest one would be a level.
            shown = SmallMap(limb_map=self._map.limb_map) if is_silent(compared) else self._map
            paint_small_map(painter, room, shown, design, theme, scale.range_db, table)

    def _act(self) -> None:
        self.requested.emit(self.number, "show" if self.compared else "store")

    def _open_menu(self, at: QPoint) -> None:
        menu = passing_menu(self)
        if self.compared is not None:
            menu.addAction("Show it", lambda: self.requested.emit(self.number, "show"))
        if self.number:
            menu.addAction(
                "Store the present design here", lambda: self.requested.emit(self.number, "store")
            )
        if self.compared is not None and not (self.present and not self.number):
            menu.addAction("Forget it", lambda: self.requested.emit(self.number, "forget"))
        menu.popup(self.mapToGlobal(at))


def fitted_level(painter: QPainter, text: str, width: float) -> str:
    """Return a level without its unit where there is no room for it; the tooltip has both."""
    wide = painter.fontMetrics().horizontalAdvance(text) > width
    return text.removesuffix(" dB") if wide else text


_LEAST_MAP_PX = 70.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Difference:
    """What the map of a difference shows.

    Attributes
    ----------
    shown
        Differences in dB, in place of levels; None: nothing can be shown.
    heading, text
        What minus what, and a note; without a map: why there is none.
    outputs
        Selected outputs, which are marked.
    """

    shown: SmallMap | None = None
    heading: str = ""
    text: str = ""
    limb: str = ""
    outputs: tuple[int, ...] = ()

    @property
    def end_db(self) -> float:
        """Largest difference that has its own colour, dB."""
        levels = None if self.shown is None else self.shown.levels_db
        return scale_end_db() if levels is None else scale_end_db(levels)

    @property
    def reached_db(self) -> Range | None:
        """The smallest and the largest difference, dB."""
        levels = None if self.shown is None else self.shown.levels_db
        return None if levels is None else (float(levels.min()), float(levels.max()))


class DifferenceMap(QWidget):
    """The map of a difference, and below it a scale with zero in its middle."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.difference = Difference()
        self.setObjectName("difference_map")

    def show_difference(self, difference: Difference) -> None:
        """Take over what to show."""
        self.difference = difference
        text = f"{difference.heading}. {difference.text}".strip(". ")
        self.setAccessibleName(text)
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(240, 320)

    def minimumSizeHint(self) -> QSize:
        line = self.fontMetrics().height()
        return QSize(180, ceil(line + scale_row_px(line) + UNIT_PX + _LEAST_MAP_PX))

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            text = self.text_at(QPointF(event.pos()))
            QToolTip.showText(event.globalPos(), text, self)
            return True
        return super().event(event)

    def text_at(self, point: QPointF) -> str:
        """Return the difference at the output under the pointer; empty where there is none."""
        shown = self.difference.shown
        if shown is None or shown.levels_db is None:
            return ""
        places = small_frame(shown.limb_map, self._areas()[1]).to_screen(
            shown.limb_map.output_positions
        )
        number = output_at(places, point)
        if number is None:
            return ""
        difference = minus(f"{shown.levels_db[number - 1]:+z.1f} dB")
        return f"{output_text(number, self.difference.limb)}: {difference}"

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, theme, difference = QPainter(self), current_theme(), self.difference
        painter.setFont(tabular(self.font()))
        top, area, bottom = self._areas()
        flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
        if difference.shown is None:
            painter.setPen(QColor(theme.dim))
            painter.drawText(QRectF(self.rect()), flags, difference.text)
            painter.end()
            return
        painter.setPen(QColor(theme.text))
        painter.drawText(top, flags, difference.heading)
        end, reached = difference.end_db, difference.reached_db
        scale = ColourScale(
            range_db=(-end, end),
            text_below=difference.text,
            colours=DIVERGING,
            signed=True,
            reached_db=reached,
        )
        table = colour_table(DIVERGING)
        paint_small_map(painter, area, difference.shown, None, theme, scale.range_db, table)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_rings(painter, difference.shown, area, difference.outputs, theme)
        paint_numbers(painter, difference.shown, area, difference.outputs, theme)
        paint_scale_row(painter, bottom, scale, theme)
        painter.end()

    def _areas(self) -> tuple[QRectF, QRectF, QRectF]:
        """Return the areas of the heading, the map and the scale."""
        line = self.fontMetrics().height()
        room = QRectF(self.rect())
        top = QRectF(room.left(), room.top(), room.width(), line)
        below = scale_row_px(line)
        bottom = QRectF(room.left(), room.bottom() - below, room.width(), below)
        area = room.adjusted(UNIT_PX, line + UNIT_PX // 2, -UNIT_PX, -below - UNIT_PX // 2)
        return top, area, bottom
