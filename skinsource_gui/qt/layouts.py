"""Names and tooltips of widgets, and rows and columns of them."""

from functools import lru_cache
from textwrap import fill
from typing import TypeVar

from PySide6 import QtWidgets
from PySide6.QtCore import QPoint, QRect, QSize, Qt

#: How much of the room in a layout a widget takes.
Policy = QtWidgets.QSizePolicy.Policy
# Characters in a line: about as wide as a panel.
_LINE = 64


def tooltip(*sentences: str) -> str:
    """Return sentences below each other, in lines of readable length, without empty ones."""
    return "\n".join(_in_lines(sentence) for sentence in sentences if sentence)


def show_tooltip(widget: QtWidgets.QWidget, text: str) -> None:
    """Set the tooltip of a widget, unless it is the same, which would cause an event."""
    if widget.toolTip() != text:
        widget.setToolTip(text)


def show_tip_below(widget: QtWidgets.QWidget, text: str) -> None:
    """Show a tooltip below a widget at once, if the widget is visible."""
    if widget.isVisible():
        QtWidgets.QToolTip.showText(widget.mapToGlobal(QPoint(0, widget.height())), text, widget)


@lru_cache(maxsize=512)
def _in_lines(sentence: str) -> str:
    # Many fields have the same sentences on keys and mouse.
    return fill(sentence, _LINE)


#: A widget or a layout, with its share of the spare room if it gets some; None: empty room.
Part = (
    QtWidgets.QWidget | QtWidgets.QLayout | tuple[QtWidgets.QWidget | QtWidgets.QLayout, int] | None
)
#: Left, top, right and bottom, px, or the same at all sides.
Margins = int | tuple[int, int, int, int]
Box = TypeVar("Box", bound=QtWidgets.QBoxLayout)
Widget = TypeVar("Widget", bound=QtWidgets.QWidget)


def named(widget: Widget, name: str = "", title: str = "", hint: str = "") -> Widget:
    """Return a widget with other names, and another tooltip; "": those that it has.

    Parameters
    ----------
    widget
        The widget.
    name
        Its name for style sheets and for what looks for it.
    title
        Its name for assistive technology.
    hint
        Its tooltip.
    """
    for text, put in (
        (name, widget.setObjectName),
        (title, widget.setAccessibleName),
        (hint, widget.setToolTip),
    ):
        if text:
            put(text)
    return widget


def in_column(
    *parts: Part,
    of: QtWidgets.QWidget | None = None,
    margins: Margins | None = None,
    gap_px: int | None = None,
) -> QtWidgets.QVBoxLayout:
    """Lay out parts below each other.

    Parameters
    ----------
    parts
        From the top down.
    of
        The widget that gets them; None: the column is a part of another layout.
    margins, gap_px
        Around the parts and between them; None: those of the style.
    """
    return _filled(
        QtWidgets.QVBoxLayout() if of is None else QtWidgets.QVBoxLayout(of), parts, margins, gap_px
    )


def in_row(
    *parts: Part,
    of: QtWidgets.QWidget | None = None,
    margins: Margins | None = None,
    gap_px: int | None = None,
) -> QtWidgets.QHBoxLayout:
    """Lay out parts from left to right, see `in_column`."""
    return _filled(
        QtWidgets.QHBoxLayout() if of is None else QtWidgets.QHBoxLayout(of), parts, margins, gap_px
    )


def form_of(widget: QtWidgets.QWidget) -> QtWidgets.QFormLayout:
    """Return an empty form that fills a widget: labels, and fields as wide as there is room."""
    form = QtWidgets.QFormLayout(widget)
    form.setContentsMargins(0, 0, 0, 0)
    form.setFieldGrowthPolicy(form.FieldGrowthPolicy.AllNonFixedFieldsGrow)
    return form


def add_row(
    form: QtWidgets.QFormLayout, name: str, label: str, field: QtWidgets.QWidget, hint: str = ""
) -> None:
    """Add a field with its label to a form, and its names."""
    form.addRow(label, named(field, name, label, hint and tooltip(label, hint)))


def _filled(
    layout: Box, parts: tuple[Part, ...], margins: Margins | None, gap_px: int | None
) -> Box:
    if margins is not None:
        layout.setContentsMargins(*(4 * (margins,) if isinstance(margins, int) else margins))
    if gap_px is not None:
        layout.setSpacing(gap_px)
    for part in parts:
        item, share = part if isinstance(part, tuple) else (part, 0)
        if item is None:
            layout.addStretch(1)
        elif isinstance(item, QtWidgets.QLayout):
            layout.addLayout(item, share)
        else:
            layout.addWidget(item, share)
    return layout


class FlowLayout(QtWidgets.QLayout):
    """Puts widgets beside each other, and in further rows where there is no room for them.

    Parameters
    ----------
    of
        The widget that it lays out.
    gap_px
        Space between widgets.
    shares
        Whether those of a row share its width, from its upper edge on; else each has the width
        that it likes.
    """

    def __init__(self, of: QtWidgets.QWidget, gap_px: int, *, shares: bool = False) -> None:
        super().__init__(of)
        self._items: list[QtWidgets.QLayoutItem] = []
        self._shares = shares
        self.setContentsMargins(0, 0, 0, 0)
        self.setSpacing(gap_px)

    def insert(self, index: int, widget: QtWidgets.QWidget) -> None:
        """Insert a widget before the one of that index."""
        self.addChildWidget(widget)
        self._items.insert(index, QtWidgets.QWidgetItem(widget))
        self.invalidate()

    def addItem(self, item: QtWidgets.QLayoutItem) -> None:
        self._items.append(item)

    def count(self) -> int:
        return len(self._items)

    def itemAt(self, index: int) -> QtWidgets.QLayoutItem | None:
        return self._items[index] if 0 <= index < len(self._items) else None

    def takeAt(self, index: int) -> QtWidgets.QLayoutItem:
        return self._items.pop(index)

    def expandingDirections(self) -> Qt.Orientation:
        return Qt.Orientation(0)

    def hasHeightForWidth(self) -> bool:
        return True

    def heightForWidth(self, width: int) -> int:
        return self._lay_out(QRect(0, 0, width, 0), moves=False)

    def setGeometry(self, room: QRect) -> None:
        super().setGeometry(room)
        self._lay_out(room, moves=True)

    def sizeHint(self) -> QSize:
        return self._size([item.sizeHint() for item in self._shown], in_row=True)

    def minimumSize(self) -> QSize:
        return self._size([item.minimumSize() for item in self._shown], in_row=False)

    @property
    def _shown(self) -> list[QtWidgets.QLayoutItem]:
        return [item for item in self._items if not item.isEmpty()]

    def _size(self, sizes: list[QSize], *, in_row: bool) -> QSize:
        widths = [size.width() for size in sizes]
        gaps_px = self.spacing() * (len(sizes) - 1)
        width = sum(widths) + gaps_px if in_row else max(widths, default=0)
        margins = self.contentsMargins()
        size = QSize(width, max((size.height() for size in sizes), default=0))
        return size.grownBy(margins)

    def _lay_out(self, room: QRect, *, moves: bool) -> int:
        """Place the widgets in ``room`` if it ``moves`` them; return the height that they need."""
        inside, gap_px = room.marginsRemoved(self.contentsMargins()), self.spacing()
        rows: list[list[tuple[QtWidgets.QLayoutItem, QSize]]] = []
        free_px = 0
        for item in self._shown:
            size = item.minimumSize() if self._shares else item.sizeHint()
            if not rows or size.width() + gap_px > free_px:
                rows.append([])
                free_px = inside.width() + gap_px
            rows[-1].append((item, size))
            free_px -= size.width() + gap_px
        top = inside.top()
        for row in rows:
            high = max(size.height() for _, size in row)
            left, used_px = inside.left(), sum(size.width() + gap_px for _, size in row) - gap_px
            more_px = max(inside.width() - used_px, 0) // len(row) if self._shares else 0
            for item, size in row:
                width = min(size.width() + more_px, item.maximumSize().width(), inside.width())
                if moves:
                    lower_px = 0 if self._shares else (high - size.height()) // 2
                    item.setGeometry(QRect(left, top + lower_px, width, size.height()))
                left += width + gap_px
            top += high + gap_px
        return max(top - gap_px - room.top(), 0) + self.contentsMargins().bottom()
