"""One of several names, as a list that drops down."""

from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QPalette, QPen, QWheelEvent
from PySide6.QtWidgets import (
    QComboBox,
    QSizePolicy,
    QStyle,
    QStyleOptionComboBox,
    QStylePainter,
    QWidget,
)

from skinsource.fields import ChoiceSpec
from skinsource.quoting import printable
from skinsource_gui.widgets.fields.burst import Burst
from skinsource_gui.widgets.tooltips import tooltip

# Between a picture and its words.
_BESIDE_PX = 4


class ChoiceField(QComboBox):
    """A drop-down list of the options of ``spec``.

    The wheel acts only while it has the focus, so that scrolling a panel changes nothing.  A value
    that is not among the options is shown as not available, until another is chosen.
    """

    #: The chosen option; number of the gesture that quick further choices share.
    chosen = Signal(str, object)

    def __init__(self, spec: ChoiceSpec, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._burst = Burst(self)
        self._strange = ""
        self.offer(spec)
        self.setAccessibleName(spec.label)
        self.setToolTip(tooltip(spec.label, spec.hint))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(8)
        self.setMaxVisibleItems(20)
        # A drop-down list of Qt takes the focus from the wheel, and then acts on it.
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.activated.connect(self._choose)

    def offer(self, spec: ChoiceSpec) -> None:
        """Offer other options; what is chosen stays so, whether or not it is among them."""
        value = self.value
        self.blockSignals(True)
        self.clear()
        for option, words in spec.options:
            self.addItem(words, option)
        self.blockSignals(False)
        index = self.findData(value) if value else self.currentIndex()
        self._strange = "" if index >= 0 else value
        self.setCurrentIndex(index)

    @property
    def value(self) -> str:
        """The chosen option."""
        return self._strange if self.currentIndex() < 0 else self.currentData()

    def set_value(self, option: str) -> None:
        """Show another choice, and tell nobody."""
        if option != self.value:
            self._burst.end()
            index = self.findData(option)
            self._strange = "" if index >= 0 else option
            self.setCurrentIndex(index)
            self.update()

    @property
    def shown_text(self) -> str:
        """The words for the choice."""
        if self.currentIndex() >= 0:
            return self.currentText()
        # Without any choice there is nothing that could be missing.
        return f"{printable(self._strange)} (not available)" if self._strange else "Nothing yet"

    def choose(self, option: str) -> None:
        """Choose an option, as a user does."""
        index = self.findData(option)
        self.setCurrentIndex(index)
        self.activated.emit(index)

    def showPopup(self) -> None:
        # The list may be wider than the field, so that no name is cut off.
        self.view().setMinimumWidth(self.view().sizeHintForColumn(0) + 24)
        super().showPopup()

    def paintEvent(self, event: QPaintEvent) -> None:
        option = QStyleOptionComboBox()
        self.initStyleOption(option)
        painter = QStylePainter(self)
        painter.drawComplexControl(QStyle.ComplexControl.CC_ComboBox, option)
        # Qt cuts what is too long in the middle of a letter.
        room = self.style().subControlRect(
            QStyle.ComplexControl.CC_ComboBox, option, QStyle.SubControl.SC_ComboBoxEditField, self
        )
        picture_px = 0 if option.currentIcon.isNull() else option.iconSize.width() + _BESIDE_PX
        option.currentText = self.fontMetrics().elidedText(
            self.shown_text, Qt.TextElideMode.ElideRight, room.width() - picture_px
        )
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

    def _choose(self, index: int) -> None:
        self.chosen.emit(self.itemData(index), self._burst.gesture())
