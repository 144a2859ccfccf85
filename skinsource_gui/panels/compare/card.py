"""A snapshot as a card: its map, its number, how loud it is."""

from functools import partial

from PySide6.QtCore import QEvent, QPoint, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QMenu, QSizePolicy, QWidget

from skinsource.design.comparing import gain_words, match_words
from skinsource_gui.compared import Compared, is_silent
from skinsource_gui.panels.compare.card_words import level_words, sentence
from skinsource_gui.theme import UNIT_PX, current_theme, tabular
from skinsource_gui.widgets.keys import claims_shortcut, meaning_of, shortcut_text
from skinsource_gui.widgets.map.colour_maps import colour_table
from skinsource_gui.widgets.map.scale_row import Scale
from skinsource_gui.widgets.map.small_map import SmallMap, paint_small_map

_PLACE = "snapshot"
_RADIUS_PX, _FRAME_PX, _TALLEST_PX, _RINGS_PX = 4, 2, 200, 6


class Card(QAbstractButton):
    """Shows a snapshot, and is clicked to have it in the window; an empty one stores.

    Parameters
    ----------
    number
        Of the snapshot; 0: what is edited.
    parent
        As in Qt.
    """

    #: What is wanted of this number: ``"show"``, ``"store"`` or ``"forget"``.
    wanted = Signal(int, str)

    def __init__(self, number: int, parent: QWidget) -> None:
        super().__init__(parent)
        self.number = number
        # The design that is edited is never stored, and without it its card is away.
        self._store_key = shortcut_text(f"store_snapshot_{number}") if number else ""
        self._compared: Compared | None = None
        self._map: SmallMap | None = None
        self._scale: Scale | None = None
        self._present = False
        self.setObjectName(f"snapshot_card_{number}")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.customContextMenuRequested.connect(self._open_menu)
        self.clicked.connect(self._act)
        self.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Expanding)
        self.setMaximumHeight(_TALLEST_PX)
        self.show_snapshot(None, None, None, present=False)

    @property
    def compared(self) -> Compared | None:
        """The snapshot that it shows; None: empty."""
        return self._compared

    @property
    def present(self) -> bool:
        """Whether it is in the window."""
        return self._present

    def show_snapshot(
        self,
        compared: Compared | None,
        shown: SmallMap | None,
        scale: Scale | None,
        *,
        present: bool,
    ) -> None:
        """Take over what to show, in which colours; None: nothing is stored."""
        self._compared, self._map, self._scale = compared, shown, scale
        self._present = present
        words = (
            f"Snapshot {self.number}: nothing stored; click, or press {self._store_key}, to store"
            if compared is None
            else sentence(compared, present=present)
        )
        self.setAccessibleName(words)
        self.setToolTip(words)
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
        if means == "forget" and self._compared is not None:
            self.wanted.emit(self.number, "forget")
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
        if self._compared is None:
            line.setStyle(Qt.PenStyle.DashLine)
        painter.setPen(line)
        painter.setBrush(QColor(theme.base))
        painter.drawRoundedRect(frame, _RADIUS_PX, _RADIUS_PX)
        inside = frame.adjusted(4, 4, -4, -3)
        if self._present:
            head = QRectF(inside.left(), inside.top(), inside.width(), self.fontMetrics().height())
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(theme.accent))
            painter.drawRoundedRect(head, _RADIUS_PX / 2, _RADIUS_PX / 2)
        self._paint_inside(painter, inside)
        painter.end()

    def _paint_inside(self, painter: QPainter, area: QRectF) -> None:
        theme, compared = current_theme(), self._compared
        line = self.fontMetrics().height()
        centre = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignVCenter
        heading = QFont(self.font())
        heading.setBold(True)
        painter.setFont(heading)
        heading_colour = theme.on_accent if self._present else theme.text
        painter.setPen(QColor(heading_colour if compared else theme.dim))
        name = compared.name if compared else str(self.number)
        painter.drawText(QRectF(area.left(), area.top(), area.width(), line), centre, name)
        painter.setFont(tabular(self.font()))
        if compared is None:
            painter.drawText(area, centre, self._store_key)
            return
        below = QRectF(area.left(), area.bottom() - 2 * line, area.width(), line)
        painter.setPen(QColor(theme.error if compared.left_out else theme.text))
        painter.drawText(below, centre, fitted_level(painter, level_words(compared), area.width()))
        painter.setPen(QColor(theme.dim))
        gain = match_words(compared.gain)
        if painter.fontMetrics().horizontalAdvance(gain) > area.width():
            gain = fitted_level(painter, gain_words(compared.gain), area.width())
        painter.drawText(below.translated(0, line), centre, gain)
        if self._map is not None and self._scale is not None:
            # Rings of inputs reach beyond the outline.
            room = area.adjusted(0, line + _RINGS_PX, 0, -2 * line - _RINGS_PX)
            design, scale = compared.snapshot.design, self._scale
            table = colour_table(scale.colours)
            # Silence has no level, and no colour: the lowest one would be a level.
            shown = SmallMap(limb_map=self._map.limb_map) if is_silent(compared) else self._map
            paint_small_map(painter, room, shown, design, theme, scale.range_db, table)

    def _act(self) -> None:
        self.wanted.emit(self.number, "show" if self._compared else "store")

    def _open_menu(self, at: QPoint) -> None:
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        if self._compared is not None:
            menu.addAction("Show it", lambda: self.wanted.emit(self.number, "show"))
        if self.number:
            menu.addAction(
                "Store the present design here", lambda: self.wanted.emit(self.number, "store")
            )
        if self._compared is not None and not (self._present and not self.number):
            menu.addAction("Forget it", lambda: self.wanted.emit(self.number, "forget"))
        menu.popup(self.mapToGlobal(at))


def fitted_level(painter: QPainter, words: str, width: float) -> str:
    """A level without its unit where there is no room for it; the tooltip has both."""
    wide = painter.fontMetrics().horizontalAdvance(words) > width
    return words.removesuffix(" dB") if wide else words
