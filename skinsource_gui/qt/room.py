"""Widths that grow with letters."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QFont, QFontInfo, QFontMetrics, QHideEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QBoxLayout,
    QGridLayout,
    QHBoxLayout,
    QScrollArea,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from skinsource_gui.qt.theme import UNIT_PX, letter_scale, scaled
from skinsource_gui.qt.wheel import areas_around, bars_px


class LetterWidth(QObject):
    """Keeps a widget, in letters of any size, as wide as it is in usual ones.

    Parameters
    ----------
    widget
        What is kept; also the parent.
    usual_px
        Its width in letters of the usual size, or the most of it.
    at_most
        Whether it may be narrower.
    """

    def __init__(self, widget: QWidget, usual_px: int, *, at_most: bool = False) -> None:
        super().__init__(widget)
        self._widget, self._usual_px, self._at_most = widget, usual_px, at_most
        widget.installEventFilter(self)
        self._fit()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.FontChange:
            self._fit()
        return super().eventFilter(watched, event)

    def _fit(self) -> None:
        width_px = round(self._usual_px * letter_scale(self._widget.font()))
        self._widget.setMaximumWidth(width_px)
        if not self._at_most:
            self._widget.setMinimumWidth(width_px)


# Tells when a widget has another room, or when words in it are others.

_OTHERS = (QEvent.Type.Resize, QEvent.Type.LayoutRequest, QEvent.Type.FontChange)


class RoomOrText(QObject):
    """Tells when a widget has another room, or when words in it are others, or of another size.

    Who follows may tell the widget's layout so: that is told again.  It ends where the same room
    and the same words lead to the same answer, however the widget is laid out when it is asked.

    Parameters
    ----------
    widget
        Who is looked at; also the parent.
    """

    changed = Signal()

    def __init__(self, widget: QWidget) -> None:
        super().__init__(widget)
        widget.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # Qt tells a layout before who filters, and a resized widget knows its size already.
        if event.type() in _OTHERS:
            self.changed.emit()
        return False


# What scrolls, with a bar that comes and goes, but not without end.

# So often it may come in a row: while something is laid out anew it comes once and goes once.
_MOST_TIMES, _IN_A_ROW_MS = 2, 2000
# One size of what is inside may lead to another one at once: so often, or until the stack runs out.
_MOST_DEPTH = 5
_AS_NEEDED, _ALWAYS = (
    Qt.ScrollBarPolicy.ScrollBarAsNeeded,
    Qt.ScrollBarPolicy.ScrollBarAlwaysOn,
)


class SteadyArea(QScrollArea):
    """Has its upright bar stay where that would come and go, until there is another room.

    What is lower in less width, as words are that are written smaller there, has room beside the
    bar and none without: Qt would put it there and take it away for as long as anybody looks.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._times, self._depth, self._in_sight = 0, 0, False
        self._room = QSize()
        self._row = QTimer(self, interval=_IN_A_ROW_MS, singleShot=True)
        self._row.timeout.connect(self._forget)
        self.setWidgetResizable(True)
        self.verticalScrollBar().installEventFilter(self)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._in_sight = True

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        self._in_sight = False

    def resizeEvent(self, event: QResizeEvent) -> None:
        # The bar takes its room from the viewport, whose events these are, not from the area.
        if self.size() != self._room:
            self._room = self.size()
            self._begin_anew()
        super().resizeEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._begin_anew()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # With the area itself it comes into sight before that knows.
        if event.type() == QEvent.Type.Show and self._in_sight:
            self._times += 1
            self._row.start()
        self._depth += 1
        if self._times > _MOST_TIMES or self._depth > _MOST_DEPTH:
            self._put(_ALWAYS)
        handled = super().eventFilter(watched, event)
        self._depth -= 1
        return handled

    def _begin_anew(self) -> None:
        self._forget()
        self._put(_AS_NEEDED)

    def _put(self, policy: Qt.ScrollBarPolicy) -> None:
        # Even the same one has it laid out anew, and the bar come.
        if self.verticalScrollBarPolicy() != policy:
            self.setVerticalScrollBarPolicy(policy)

    def _forget(self) -> None:
        self._times = 0


# Buttons whose words are written smaller where there is too little room for them.

# How much smaller words may be; and large ones, while they are no smaller than so many px.
_SCALES = (1.0, 0.9, 0.8, 0.7, 0.6)
_SCALES_OF_LARGE, _LEAST_PX = (0.55, 0.5, 0.45, 0.4), 12
# Words that can be cut instead are no smaller than this.
_WORTH_READING = 0.7
# Below this they are hard to read: where they can, some go into a row below instead.
_READABLE = 0.8


def fitting_font(rows: Sequence[Sequence[QAbstractButton]], font: QFont, room_px: int) -> QFont:
    """The largest font, of about the size of ``font``, in which each row has room for its words."""
    fonts = fonts_of(font)
    fit = (
        candidate for candidate in fonts if max(width_in(candidate, row) for row in rows) <= room_px
    )
    return next(fit, fonts[-1])


def width_in(font: QFont, buttons: Sequence[QAbstractButton]) -> int:
    """Width of buttons that are written in ``font``, px, whatever they are written in now.

    Did it depend on that, words would change to and fro without end.
    """
    metrics = QFontMetrics(font)
    # What the style leaves around words does not depend on them.
    return sum(
        _words_px(button, metrics)
        + button.sizeHint().width()
        - _words_px(button, button.fontMetrics())
        for button in buttons
    )


def _words_px(button: QAbstractButton, metrics: QFontMetrics) -> int:
    """What Qt counts as words: around those of a tool button there are blanks as well."""
    words_px = metrics.size(int(Qt.TextFlag.TextShowMnemonic), button.text()).width()
    if isinstance(button, QToolButton):
        words_px += 2 * metrics.horizontalAdvance(" ")
    return words_px


def readable_in(text: str, font: QFont, room_px: float) -> QFont:
    """The largest font in which words have room of those that are not too small to be read.

    For words that may be cut, if they have to be: in the smallest of these.
    """
    fonts = [scaled(font, scale) for scale in _SCALES if scale >= _WORTH_READING]
    fit = (
        candidate
        for candidate in fonts
        if QFontMetrics(candidate).horizontalAdvance(text) <= room_px
    )
    return next(fit, fonts[-1])


def smallest_of(font: QFont) -> QFont:
    """The smallest font in which words of ``font`` are written."""
    return fonts_of(font)[-1]


def readable_of(font: QFont) -> QFont:
    """The smallest font in which all words of a row shall stand, while there may be another row."""
    return scaled(font, _READABLE)


def write_in(font: QFont, buttons: Sequence[QAbstractButton]) -> None:
    """Have the words of buttons in that font."""
    for button in buttons:
        if button.font() != font:
            button.setFont(font)


def fonts_of(font: QFont) -> list[QFont]:
    """Those in which words of ``font`` may be written, from large to small."""
    large = (scaled(font, scale) for scale in _SCALES_OF_LARGE)
    readable = [candidate for candidate in large if QFontInfo(candidate).pixelSize() >= _LEAST_PX]
    return [*(scaled(font, scale) for scale in _SCALES), *readable]


# Buttons beside each other, whose words are whole in a narrow room too.


class ButtonRow(QWidget):
    """Keeps buttons to the left, and writes them smaller where there is too little room.

    Parameters
    ----------
    buttons
        From left to right.
    parent
        As in Qt.
    """

    def __init__(self, buttons: Sequence[QAbstractButton], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._buttons = tuple(buttons)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(UNIT_PX // 2)
        for button in self._buttons:
            row.addWidget(button)
        row.addStretch(1)
        self._gap_px = row.spacing()
        RoomOrText(self).changed.connect(self._fit)

    def _fit(self) -> None:
        shown = [button for button in self._buttons if not button.isHidden()]
        gaps_px = self._gap_px * len(shown)
        write_in(fitting_font((shown,), self.font(), self.width() - gaps_px), self._buttons)
        self.setMinimumWidth(width_in(smallest_of(self.font()), shown) + gaps_px)


# Tells how much of the height of a widget can be seen at once.


class HeightInSight(RoomOrText):
    """Tells when there may be another height in sight, and how much that is.

    What scrolls is as high as it wants to be: its own height does not say whether it has room.

    Parameters
    ----------
    widget
        Who is looked at; also the parent.
    """

    def __init__(self, widget: QWidget) -> None:
        super().__init__(widget)
        self._widget = widget

    @property
    def px(self) -> int:
        """The height of the widget, or of what it scrolls in."""
        heights = (area.viewport().height() for area in areas_around(self._widget))
        return min((self._widget.height(), *heights))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Show:
            # What scrolls it is known by now.
            for area in areas_around(self._widget):
                area.viewport().installEventFilter(self)
            self.changed.emit()
        return super().eventFilter(watched, event)


# Groups of widgets that go below each other where they do not fit beside each other.

_BESIDE, _BELOW = QBoxLayout.Direction.LeftToRight, QBoxLayout.Direction.TopToBottom


class BesideOrBelow(QWidget):
    """Puts groups beside each other, or, where it is narrow, each into a row of its own.

    Parameters
    ----------
    groups
        Widgets that stay beside each other; None is room between them.
    spacing_px
        Between widgets, groups and rows.
    """

    def __init__(self, *groups: Sequence[QWidget | None], spacing_px: int) -> None:
        super().__init__()
        self._box = QBoxLayout(_BESIDE, self)
        self._box.setContentsMargins(0, 0, 0, 0)
        self._box.setSpacing(spacing_px)
        self._rows: list[QHBoxLayout] = []
        for group in groups:
            row = QHBoxLayout()
            row.setSpacing(spacing_px)
            for part in group:
                if part is None:
                    row.addStretch(1)
                else:
                    row.addWidget(part)
            self._rows.append(row)
            # What is left over belongs to the last group.
            self._box.addLayout(row, int(len(self._rows) == len(groups)))
        RoomOrText(self).changed.connect(self._fold)

    @property
    def folded(self) -> bool:
        """Whether groups are below each other."""
        return self._box.direction() == _BELOW

    def minimumSizeHint(self) -> QSize:
        widest = max(row.minimumSize().width() for row in self._rows)
        return QSize(widest, self._box.minimumSize().height())

    def _fold(self) -> None:
        needed = sum(row.minimumSize().width() for row in self._rows)
        needed += self._box.spacing() * (len(self._rows) - 1)
        direction = _BESIDE if needed <= self.width() else _BELOW
        if direction != self._box.direction():
            self._box.setDirection(direction)
        height = self._box.minimumSize().height()
        if height != self.minimumHeight():
            self.setMinimumHeight(height)
            self.updateGeometry()


# A row of widgets that folds into several where it is narrow.


class FoldingRow(QWidget):
    """Puts widgets beside each other; those that do not fit go below.

    A scroll bar beside it takes a little of each: if the row folded for that, it would become
    higher, and keep the scroll bar that made it fold.

    Parameters
    ----------
    widgets
        In their order; hidden ones take no room.
    spacing_px
        Between them.
    left
        Whether they keep to the left; else they share the width.
    parent
        As in Qt.
    """

    def __init__(
        self,
        widgets: Sequence[QWidget],
        spacing_px: int,
        *,
        left: bool = False,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._widgets, self._spacing_px, self._left = tuple(widgets), spacing_px, left
        self._placed: tuple[tuple[QWidget, ...], int] = ((), 0)
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(spacing_px)
        for widget in self._widgets:
            # One that is hidden now would be a window of its own once it is shown.
            widget.setParent(self)
        self.fold()

    def minimumSizeHint(self) -> QSize:
        return QSize(self._widest_px, self._grid.minimumSize().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.fold()

    def fold(self) -> None:
        """Place them anew: the width is another one, or others are shown."""
        shown = tuple(widget for widget in self._widgets if not widget.isHidden())
        room = self.width() + bars_px(self) + self._spacing_px
        fit = max(room // max(self._widest_px + self._spacing_px, 1), 1)
        rows = -(-len(shown) // fit) or 1
        columns = -(-len(shown) // rows) or 1
        if (shown, columns) == self._placed:
            return
        self._placed = shown, columns
        for widget in self._widgets:
            self._grid.removeWidget(widget)
        for k, widget in enumerate(shown):
            self._grid.addWidget(widget, k // columns, k % columns)
        for column in range(len(self._widgets) + 1):
            self._grid.setColumnStretch(column, int(self._left and column == columns))
        self.setMinimumHeight(self._grid.minimumSize().height())
        self.updateGeometry()

    def px_of(self, columns: int) -> int:
        """How wide it has to be for so many widgets in a row, or for all if they are fewer."""
        count = min(sum(not widget.isHidden() for widget in self._widgets), columns)
        return count * (self._widest_px + self._spacing_px) - self._spacing_px

    @property
    def _widest_px(self) -> int:
        return max((widget.minimumSizeHint().width() for widget in self._widgets), default=0)
