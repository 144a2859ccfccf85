"""The kind of a waveform, with its picture."""

from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QMenu, QWidget

from skinsource.design.waveforms import kinds
from skinsource.specs.fields import ChoiceSpec
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.inputs.kind_menu import fill_kind_menu
from skinsource_gui.widgets.inputs.waveform_picture import PICTURE_PX, waveform_icon


class KindField(ChoiceField):
    """A drop-down field whose list is a menu: the common kinds, and more.

    Keys choose among all of them, as in any list.
    """

    def __init__(self, spec: ChoiceSpec, parent: QWidget | None = None) -> None:
        super().__init__(spec, parent)
        self._menu: QMenu | None = None
        self.setIconSize(PICTURE_PX)
        self.currentIndexChanged.connect(self._picture)
        self._picture()

    def showPopup(self) -> None:
        self.hidePopup()
        menu = QMenu(self)
        menu.setObjectName("kind_menu")
        fill_kind_menu(menu, self.choose, current=self.value)
        menu.setMinimumWidth(self.width())
        menu.aboutToHide.connect(menu.deleteLater)
        menu.destroyed.connect(self._forget)
        self._menu = menu
        menu.popup(self.mapToGlobal(QPoint(0, self.height())))

    def hidePopup(self) -> None:
        if self._menu is not None:
            self._menu.close()
        super().hidePopup()

    def _picture(self) -> None:
        # Only that of the present kind: to draw those of noise and of samples takes long imports,
        # for which the first picture of the window need not wait.
        for kind in kinds():
            if kind.__name__ == self.currentData():
                self.setItemIcon(self.currentIndex(), waveform_icon(kind))

    def _forget(self) -> None:
        self._menu = None
