"""Drop-down lists: the common look, and the field of a choice among named options."""

from collections.abc import Iterable

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPointF, Qt, Signal

from skinsource.base.errors import printable
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.editor import MIXED, Burst, Editor
from skinsource_gui.qt.layouts import Policy, named, tooltip

# Between an icon and its text.
_BESIDE_PX = 4


class DropDown(QtWidgets.QComboBox):
    """A drop-down list with an arrow; the open list is as wide as its longest entry.

    The wheel acts only while it has the focus, so that scrolling a panel changes nothing.  The
    tooltip begins with a text that is cut off.
    """

    _is_cut = False

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setSizeAdjustPolicy(
            QtWidgets.QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.setMinimumContentsLength(8)
        self.setMaxVisibleItems(20)
        # Qt's drop-down list takes the focus on a turn of the wheel, and then acts on it.
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    @property
    def shown_text(self) -> str:
        """The text of the choice."""
        return self.currentText()

    def showPopup(self) -> None:
        # The list may be wider than the field, so that no name is cut.
        self.view().setMinimumWidth(self.view().sizeHintForColumn(0) + 24)
        super().showPopup()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        option = QtWidgets.QStyleOptionComboBox()
        self.initStyleOption(option)
        painter = QtWidgets.QStylePainter(self)
        painter.drawComplexControl(QtWidgets.QStyle.ComplexControl.CC_ComboBox, option)
        room = self.style().subControlRect(
            QtWidgets.QStyle.ComplexControl.CC_ComboBox,
            option,
            QtWidgets.QStyle.SubControl.SC_ComboBoxEditField,
            self,
        )
        picture_px = 0 if option.currentIcon.isNull() else option.iconSize.width() + _BESIDE_PX
        # Qt would cut it within a letter.
        option.currentText = self.fontMetrics().elidedText(
            self.shown_text, Qt.TextElideMode.ElideRight, room.width() - picture_px
        )
        painter.drawControl(QtWidgets.QStyle.ControlElement.CE_ComboBoxLabel, option)
        self._is_cut = option.currentText != self.shown_text
        # The theme's style sheet takes away the arrow of the style.
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.setPen(
            QtGui.QPen(self.palette().color(QtGui.QPalette.ColorRole.PlaceholderText), 1.5)
        )
        tip = QPointF(self.width() - 13, self.height() / 2 + 2)
        painter.drawPolyline([tip + QPointF(-4, -4), tip, tip + QPointF(4, -4)])

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QtGui.QHelpEvent) and self._is_cut:
            text = f"{tooltip(self.shown_text)}\n{self.toolTip()}"
            QtWidgets.QToolTip.showText(event.globalPos(), text.rstrip(), self)
            return True
        return super().event(event)

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()


class ChoiceField(Editor, DropDown):
    """A drop-down list of the options of ``spec``.

    A value that is not among the options is shown as not available, until another is chosen.
    ``empty`` is shown while there is no value.
    """

    #: The chosen option; number of the gesture that quick further choices share.
    edited = Signal(str, object)

    def __init__(
        self,
        spec: ChoiceSpec,
        parent: QtWidgets.QWidget | None = None,
        *,
        empty: str = "Nothing yet",
    ) -> None:
        super().__init__(parent)
        self._burst = Burst(self)
        self._unknown, self._empty, self._mixed = "", empty, False
        self.set_spec(spec)
        named(self, title=spec.label, hint=tooltip(spec.label, spec.hint))
        self.setSizePolicy(Policy.Expanding, Policy.Fixed)
        self.activated.connect(self._choose)

    def set_spec(self, spec: ChoiceSpec) -> None:
        """Offer the options of another specification."""
        self.set_options(spec.options)

    def set_options(self, options: Iterable[tuple[str, str]]) -> None:
        """Offer other options, with their titles; the value stays, even if it is not among them."""
        value = self.value
        self.blockSignals(True)
        self.clear()
        for option, title in options:
            self.addItem(title, option)
        self.blockSignals(False)
        index = self.findData(value) if value else self.currentIndex()
        self._unknown = "" if index >= 0 else value
        self.setCurrentIndex(index)

    @property
    def value(self) -> str:
        """The chosen option."""
        return self._unknown if self.currentIndex() < 0 else self.currentData()

    def set_value(self, option: str) -> None:
        """Show another choice without a signal."""
        if option != self.value:
            self._burst.end()
            index = self.findData(option)
            self._unknown = "" if index >= 0 else option
            self.setCurrentIndex(index)
            self.update()

    @property
    def shown_text(self) -> str:
        """The text of the choice."""
        if self._mixed:
            return MIXED
        if self.currentIndex() >= 0:
            return self.currentText()
        # Without a value, no option is missing.
        return f"{printable(self._unknown)} (not available)" if self._unknown else self._empty

    def show_mixed(self, mixed: bool) -> None:
        """Say "mixed" in place of the choice, or show it."""
        if mixed != self._mixed:
            self._mixed = mixed
            self.update()

    def choose(self, option: str) -> None:
        """Choose an option, as a user does."""
        index = self.findData(option)
        self.setCurrentIndex(index)
        self.activated.emit(index)

    def _choose(self, index: int) -> None:
        self.edited.emit(self.itemData(index), self._burst.gesture())
