"""A list that drops down, as it looks everywhere."""

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QFont, QFontMetrics, QPainter, QPaintEvent, QPalette, QPen, QWheelEvent
from PySide6.QtWidgets import (
    QComboBox,
    QStyle,
    QStyleOptionComboBox,
    QStylePainter,
    QWidget,
)

from skinsource_gui.widgets.room.words_in_room import readable_in

# Between a picture and its words.
_BESIDE_PX = 4


class DropDown(QComboBox):
    """A list that drops down, with an arrow that says so; the list is as wide as its longest entry.

    The wheel acts only while it has the focus, so that scrolling a panel changes nothing.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(8)
        self.setMaxVisibleItems(20)
        # A drop-down list of Qt takes the focus from the wheel, and then acts on it.
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    @property
    def shown_text(self) -> str:
        """The words for the choice."""
        return self.currentText()

    def showPopup(self) -> None:
        # The list may be wider than the field, so that no name is cut off.
        self.view().setMinimumWidth(self.view().sizeHintForColumn(0) + 24)
        super().showPopup()

    def words_in(self, room_px: int) -> tuple[QFont, str]:
        """The words for the choice as they are written in so much room, and in which letters.

        Smaller ones before words are cut, and those not in the middle of a letter, as Qt does.
        """
        font = readable_in(self.shown_text, self.font(), room_px)
        cut = QFontMetrics(font).elidedText(self.shown_text, Qt.TextElideMode.ElideRight, room_px)
        return font, cut

    def paintEvent(self, event: QPaintEvent) -> None:
        option = QStyleOptionComboBox()
        self.initStyleOption(option)
        painter = QStylePainter(self)
        painter.drawComplexControl(QStyle.ComplexControl.CC_ComboBox, option)
        room = self.style().subControlRect(
            QStyle.ComplexControl.CC_ComboBox, option, QStyle.SubControl.SC_ComboBoxEditField, self
        )
        picture_px = 0 if option.currentIcon.isNull() else option.iconSize.width() + _BESIDE_PX
        font, option.currentText = self.words_in(room.width() - picture_px)
        painter.setFont(font)
        painter.drawControl(QStyle.ControlElement.CE_ComboBoxLabel, option)
        # The theme's style sheet takes away the arrow of the style.
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self.palette().color(QPalette.ColorRole.PlaceholderText), 1.5))
        tip = QPointF(self.width() - 13, self.height() / 2 + 2)
        painter.drawPolyline([tip + QPointF(-4, -4), tip, tip + QPointF(4, -4)])

    def wheelEvent(self, event: QWheelEvent) -> None:
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()
