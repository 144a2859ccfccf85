"""Widgets that adapt to the room they have: widths, fonts, rows that fold, steady scroll bars."""

from collections.abc import Sequence

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QSize, Qt, QTimer, Signal

from skinsource_gui.qt.layouts import in_row
from skinsource_gui.qt.theme import UNIT_PX, letter_scale, scaled
from skinsource_gui.qt.wheel import bars_px


class LetterWidth(QObject):
    """Scales the width of a widget with the size of its letters.

    Parameters
    ----------
    widget
        The widget; also the parent.
    usual_px
        Its width in letters of the usual size.
    at_most
        Whether it may be narrower.
    """

    def __init__(self, widget: QtWidgets.QWidget, usual_px: int, *, at_most: bool = False) -> None:
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


_ROOM_EVENTS = (QEvent.Type.Resize, QEvent.Type.LayoutRequest, QEvent.Type.FontChange)


class LayoutWatcher(QObject):
    """Signals when the size of a widget, or the text or font in it, may have changed.

    A slot that changes the layout of the widget causes a further signal.  That ends if the same
    room and texts always lead to the same layout.

    Parameters
    ----------
    widget
        The widget; also the parent.
    """

    changed = Signal()

    def __init__(self, widget: QtWidgets.QWidget) -> None:
        super().__init__(widget)
        widget.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # A resized widget already has its new size.
        if event.type() in _ROOM_EVENTS:
            self.changed.emit()
        return False


# The bar may appear so often within this time: a new layout shows and hides it once.
_MOST_TIMES, _IN_A_ROW_MS = 2, 2000
# One size of the content may lead at once to another one, but not deeper than this.
_MOST_DEPTH = 5
_AS_NEEDED, _ALWAYS = (
    Qt.ScrollBarPolicy.ScrollBarAsNeeded,
    Qt.ScrollBarPolicy.ScrollBarAlwaysOn,
)


class SteadyArea(QtWidgets.QScrollArea):
    """A scroll area that keeps its vertical bar where the bar would come and go without end.

    A content that is lower in less width, because letters shrink there, fits beside the bar but not
    without it: Qt would show and hide the bar for ever.  The bar stays until the area is resized.
    """

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._times, self._depth, self._in_sight = 0, 0, False
        self._room = QSize()
        self._row = QTimer(self, interval=_IN_A_ROW_MS, singleShot=True)
        self._row.timeout.connect(self._forget)
        self.setWidgetResizable(True)
        self.verticalScrollBar().installEventFilter(self)

    def showEvent(self, event: QtGui.QShowEvent) -> None:
        super().showEvent(event)
        self._in_sight = True

    def hideEvent(self, event: QtGui.QHideEvent) -> None:
        super().hideEvent(event)
        self._in_sight = False

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        # These are also events of the viewport, which the bar resizes; the area keeps its size.
        if self.size() != self._room:
            self._room = self.size()
            self._restart()
        super().resizeEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._restart()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # The bar is shown before the area itself knows that it is visible.
        if event.type() == QEvent.Type.Show and self._in_sight:
            self._times += 1
            self._row.start()
        self._depth += 1
        if self._times > _MOST_TIMES or self._depth > _MOST_DEPTH:
            self._set_policy(_ALWAYS)
        handled = super().eventFilter(watched, event)
        self._depth -= 1
        return handled

    def _restart(self) -> None:
        self._forget()
        self._set_policy(_AS_NEEDED)

    def _set_policy(self, policy: Qt.ScrollBarPolicy) -> None:
        # Setting the same policy would cause a new layout, too.
        if self.verticalScrollBarPolicy() != policy:
            self.setVerticalScrollBarPolicy(policy)

    def _forget(self) -> None:
        self._times = 0


# Scales to which letters may shrink; and large letters, if they keep at least so many px.
_SCALES = (1.0, 0.9, 0.8, 0.7, 0.6)
_SCALES_OF_LARGE, _LEAST_PX = (0.55, 0.5, 0.45, 0.4), 12
# Smaller letters are hard to read: a second row is better, if it is possible.
_READABLE = 0.8


def fitting_font(
    rows: Sequence[Sequence[QtWidgets.QAbstractButton]], font: QtGui.QFont, room_px: int
) -> QtGui.QFont:
    """Return the largest font, up to ``font``, in which the texts of each row fit."""
    fonts = shrinking_fonts(font)
    fit = (smaller for smaller in fonts if max(width_in(smaller, row) for row in rows) <= room_px)
    return next(fit, fonts[-1])


def width_in(font: QtGui.QFont, buttons: Sequence[QtWidgets.QAbstractButton]) -> int:
    """Return the width of buttons in ``font``, px, whatever their present font is.

    If it depended on the present font, fonts would change back and forth without end.
    """
    metrics = QtGui.QFontMetrics(font)
    # The space that the style leaves around a text does not depend on the text.
    return sum(
        _text_px(button, metrics)
        + button.sizeHint().width()
        - _text_px(button, button.fontMetrics())
        for button in buttons
    )


def _text_px(button: QtWidgets.QAbstractButton, metrics: QtGui.QFontMetrics) -> int:
    """Return the width that Qt gives to the text: that of a tool button has blanks around it."""
    text_px = metrics.size(int(Qt.TextFlag.TextShowMnemonic), button.text()).width()
    if isinstance(button, QtWidgets.QToolButton):
        text_px += 2 * metrics.horizontalAdvance(" ")
    return text_px


def smallest_font(font: QtGui.QFont) -> QtGui.QFont:
    """Return the smallest font to which ``font`` may shrink."""
    return shrinking_fonts(font)[-1]


def readable_of(font: QtGui.QFont) -> QtGui.QFont:
    """Return the smallest font for a single row, as long as a second row is possible."""
    return scaled(font, _READABLE)


def set_fonts(font: QtGui.QFont, buttons: Sequence[QtWidgets.QAbstractButton]) -> None:
    """Set the font of buttons."""
    for button in buttons:
        if button.font() != font:
            button.setFont(font)


def shrinking_fonts(font: QtGui.QFont) -> list[QtGui.QFont]:
    """Return the fonts to which ``font`` may shrink, from large to small."""
    large = (scaled(font, scale) for scale in _SCALES_OF_LARGE)
    readable = [smaller for smaller in large if QtGui.QFontInfo(smaller).pixelSize() >= _LEAST_PX]
    return [*(scaled(font, scale) for scale in _SCALES), *readable]


class ButtonRow(QtWidgets.QWidget):
    """A row of buttons, aligned left, whose letters shrink where there is little room."""

    def __init__(
        self, buttons: Sequence[QtWidgets.QAbstractButton], parent: QtWidgets.QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._buttons = tuple(buttons)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Fixed)
        row = in_row(*self._buttons, None, of=self, margins=0, gap_px=UNIT_PX // 2)
        self._gap_px = row.spacing()
        LayoutWatcher(self).changed.connect(self._fit)

    def _fit(self) -> None:
        shown = [button for button in self._buttons if not button.isHidden()]
        gaps_px = self._gap_px * len(shown)
        set_fonts(fitting_font((shown,), self.font(), self.width() - gaps_px), self._buttons)
        self.setMinimumWidth(width_in(smallest_font(self.font()), shown) + gaps_px)


def grouped(*widgets: QtWidgets.QWidget | None, gap_px: int) -> QtWidgets.QWidget:
    """Return widgets that stay beside each other; None is a stretch between them."""
    group = QtWidgets.QWidget()
    in_row(*widgets, of=group, margins=0, gap_px=gap_px)
    return group


class FoldingRow(QtWidgets.QWidget):
    """Puts widgets beside each other, in several rows where it is narrow.

    The row does not fold for the width of a scroll bar: it would become higher, and keep the bar.

    Parameters
    ----------
    widgets
        Widgets in their order; hidden ones take no room.
    spacing_px
        Space between them.
    left
        Whether they are aligned left; else they share the width.
    """

    def __init__(
        self,
        widgets: Sequence[QtWidgets.QWidget],
        spacing_px: int,
        *,
        left: bool = False,
        parent: QtWidgets.QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._widgets, self._spacing_px, self._left = tuple(widgets), spacing_px, left
        self._placed: tuple[tuple[QtWidgets.QWidget, ...], int] = ((), 0)
        self._grid = QtWidgets.QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(spacing_px)
        for widget in self._widgets:
            # A hidden widget without a parent would become a window when it is shown.
            widget.setParent(self)
        self.fold()

    def minimumSizeHint(self) -> QSize:
        return QSize(self._widest_px, self._grid.minimumSize().height())

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self.fold()

    def event(self, event: QEvent) -> bool:
        done = super().event(event)
        if event.type() == QEvent.Type.LayoutRequest:
            self.fold()
        return done

    def fold(self) -> None:
        """Arrange the widgets for the present width and visibility."""
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

    @property
    def _widest_px(self) -> int:
        shown = (widget for widget in self._widgets if not widget.isHidden())
        return max((widget.minimumSizeHint().width() for widget in shown), default=0)
