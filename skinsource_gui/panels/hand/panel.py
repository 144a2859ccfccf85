"""The hand on which inputs are placed."""

from dataclasses import replace
from functools import partial
from typing import ClassVar

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QMenu, QVBoxLayout, QWidget

from skinsource import edits
from skinsource.design import Design, Input, audible_inputs
from skinsource.synthetic import standard_hand
from skinsource.view import View
from skinsource_gui.panel import Panel
from skinsource_gui.panels.hand.hand_diagram import HandDiagram
from skinsource_gui.panels.hand.hand_drawing import palmar_drawing
from skinsource_gui.panels.hand.hand_picture import Mark
from skinsource_gui.theme import LIGHT, Theme


class HandPanel(Panel):
    """Places inputs on the hand, moves and removes them; draws nothing that is computed."""

    title: ClassVar[str] = "Hand"
    name: ClassVar[str] = "hand"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view = View()
        self._theme = LIGHT
        self.diagram = HandDiagram(palmar_drawing(standard_hand()), self._theme, self)
        self.diagram.add_requested.connect(self._add)
        self.diagram.select_requested.connect(self._select)
        self.diagram.move_requested.connect(self._move)
        self.diagram.remove_requested.connect(self._remove)
        self.diagram.menu_requested.connect(self._open_menu)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.diagram)
        self.setFocusProxy(self.diagram)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self._show_inputs()

    def show_theme(self, theme: Theme) -> None:
        self._theme = theme
        self.diagram.show_theme(theme)
        self._show_inputs()

    def _show_inputs(self) -> None:
        if self._design is None:
            return
        heard = {id(one) for one in audible_inputs(self._design.inputs)}
        marks = tuple(
            Mark(
                site=one.location,
                colour=self._theme.input_colour(one.colour),
                silent=id(one) not in heard,
                words=_words(one),
            )
            for one in self._design.inputs
        )
        self.diagram.show_inputs(marks, self._selected())

    def _selected(self) -> int | None:
        """Index of the selected input, unless the design has lost it."""
        if self._design is None or self._view.selected_input not in self._design.ids:
            return None
        return self._design.index_of(self._view.selected_input)

    def _select(self, index: int | None) -> None:
        chosen = () if index is None else (self._id(index),)
        if chosen != self._view.selected_inputs:
            self.view_changed.emit(replace(self._view, selected_inputs=chosen))

    def _id(self, index: int) -> int:
        return self._design.inputs[index].id

    def _add(self, site: int) -> None:
        if self._design is not None:
            self._tell(edits.place_input(self._design, self._view, site))

    def _move(self, index: int, site: int, gesture: int) -> None:
        if self._design is not None:
            moved = edits.move_inputs(self._design, self._view, (self._id(index),), site)
            self.edited.emit(moved, gesture)

    def _remove(self, index: int) -> None:
        if self._design is not None:
            self._tell(edits.remove_inputs(self._design, self._view, (self._id(index),)))

    def _tell(self, outcome: edits.Edit | edits.Refusal) -> None:
        self.edited.emit(outcome, None)

    def _open_menu(self, site: int, at: QPoint) -> None:
        index = self.diagram.state.front_at(site)
        menu = QMenu(self)
        menu.setObjectName("hand_menu")
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.addAction("Add input here\tIns", partial(self._add, site))
        menu.addSeparator()
        remove, mute, solo = (
            menu.addAction("Remove\tDel"),
            menu.addAction("Mute"),
            menu.addAction("Solo"),
        )
        mute.setCheckable(True)
        solo.setCheckable(True)
        if self._design is None or index is None:
            for action in (remove, mute, solo):
                action.setEnabled(False)
        else:
            mute.setChecked(self._design.inputs[index].muted)
            solo.setChecked(self._design.inputs[index].solo)
            remove.triggered.connect(partial(self._remove, index))
            mute.toggled.connect(partial(self._mute, index))
            solo.toggled.connect(partial(self._set_solo, index))
        menu.popup(at)

    def _mute(self, index: int, muted: bool) -> None:
        if self._design is not None:
            ids = (self._id(index),)
            self._tell(edits.mute_inputs(self._design, self._view, ids, muted))

    def _set_solo(self, index: int, solo: bool) -> None:
        if self._design is not None:
            ids = (self._id(index),)
            self._tell(edits.solo_inputs(self._design, self._view, ids, solo))


def _words(one: Input) -> str:
    return ", ".join(
        [one.waveform.title, *(["muted"] if one.muted else []), *(["solo"] if one.solo else [])]
    )
