"""What is chosen above the maps: of what, what of it, and on which limbs."""

from dataclasses import replace
from typing import Any

from PySide6.QtCore import QEvent, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from skinsource.design.design import Design
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource_gui.panels.side_by_side.kinds import KINDS
from skinsource_gui.panels.side_by_side.limbs_menu import LimbsButton
from skinsource_gui.panels.side_by_side.settings import OF, OWN_MAXIMUM, SHOWN, SideBySideSettings
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.folding_row import FoldingRow
from skinsource_gui.widgets.room.height_in_sight import HeightInSight
from skinsource_gui.widgets.room.words_in_room import fonts_of
from skinsource_gui.widgets.tool_button import tool_button

# A panel that shows fewer lines of text has no room for many rows: so many choices stand in each.
_LINES_WITH_ROOM, _BESIDE = 14, 2


class ChoicesBar(QWidget):
    """Turns choices into another view.

    Where the maps below need the room its words are written smaller until two stand in each row.

    Attributes
    ----------
    settings
        Those of the present view.
    of, shown, own_maximum, limbs, file
        Its parts; of all but the first those that are about what is compared.
    """

    #: The new `View`.
    view_changed = Signal(object)
    #: A design of a file is to stand beside the others.
    file_wanted = Signal()

    def __init__(self, panel_name: str, parent: QWidget) -> None:
        super().__init__(parent)
        self._panel_name = panel_name
        self._view, self.settings = View(), SideBySideSettings()
        self._has_room = True
        self.of, self.shown = ChoiceField(OF, self), ChoiceField(SHOWN, self)
        self.of.setObjectName("side_by_side_of")
        self.shown.setObjectName("side_by_side_shown")
        self.of.chosen.connect(lambda of, _: self._change(of=of))
        self.shown.chosen.connect(lambda what, _: self._change(shown=what))
        own = OWN_MAXIMUM
        self.own_maximum = tool_button(
            self, "side_by_side_own_maximum", own.label, own.hint, checkable=True
        )
        self.own_maximum.clicked.connect(lambda on: self._change(own_maximum=on))
        self.limbs = LimbsButton(self)
        self.limbs.limbs_chosen.connect(lambda limbs: self._change(limbs=" ".join(limbs)))
        hint = "Keep the design of a file as a snapshot, and show it here"
        self.file = tool_button(self, "side_by_side_file", "From file…", hint)
        self.file.clicked.connect(self.file_wanted)
        self._parts = self.of, self.shown, self.own_maximum, self.limbs, self.file
        self._row = FoldingRow(self._parts, UNIT_PX // 2)
        self._in_sight = HeightInSight(parent)
        self._in_sight.changed.connect(self._look_for_room)
        around = QVBoxLayout(self)
        around.setContentsMargins(UNIT_PX // 2, 1, UNIT_PX // 2, 1)
        around.addWidget(self._row)

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._view = view
        self.settings = settings = settings_of(view, self._panel_name, SideBySideSettings)
        self.of.set_value(settings.of)
        self.shown.set_value(settings.shown)
        self.own_maximum.setChecked(settings.own_maximum)
        kind = KINDS[settings.of]
        fields = kind.fields
        # A difference has no maximum that others are measured by, and a mean is one map.
        self.own_maximum.setVisible(kind.shown(settings) == "levels")
        for name, part in (("shown", self.shown), ("limbs", self.limbs), ("file", self.file)):
            part.setVisible(name in fields)
        if "limbs" in fields:
            usual = not settings.limbs.strip()
            self.limbs.show_chosen(settings.chosen(design.limb), usual=usual)
        self._fit()

    def _look_for_room(self) -> None:
        has_room = self._in_sight.px >= _LINES_WITH_ROOM * self.fontMetrics().lineSpacing()
        if has_room != self._has_room:
            self._has_room = has_room
            self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self._fit()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._fit()

    def _fit(self) -> None:
        """Write as large as leaves few rows, where there shall be no more; else as usual."""
        around = self.contentsMargins().left() + self.contentsMargins().right() + UNIT_PX
        for font in fonts_of(self.font()) if not self._has_room else (self.font(),):
            for one in self._parts:
                one.setFont(font)
            self._row.fold()
            if self._row.px_of(_BESIDE) <= self.width() - around:
                return

    def _change(self, **changes: Any) -> None:
        settings = replace(self.settings, **changes)
        self.view_changed.emit(with_settings(self._view, self._panel_name, settings))
