"""The hand on which inputs are placed."""

from dataclasses import replace
from functools import partial
from typing import ClassVar

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QMenu, QVBoxLayout, QWidget

from skinsource.design import MAX_INPUTS, Design, Input, audible_inputs
from skinsource.locations import input_place
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
        """The selected input, unless the design has lost it."""
        index = self._view.selected_input
        present = self._design is not None and index is not None
        return index if present and index < len(self._design.inputs) else None

    def _select(self, index: int | None) -> None:
        if index != self._view.selected_input:
            self.view_changed.emit(replace(self._view, selected_input=index))

    def _add(self, site: int) -> None:
        design, selected = self._design, self._selected()
        if design is None:
            return
        if len(design.inputs) >= MAX_INPUTS:
            self.diagram.show_note(f"No more than {MAX_INPUTS} inputs; remove one first")
            return
        new = Input(location=site)
        if selected is not None:
            model = design.inputs[selected]
            new = replace(new, waveform=model.waveform, amplitude=model.amplitude)
        self.design_edited.emit(f"Place input at {_site_words(site)}", design.adding(new), None)
        self._select(len(design.inputs))

    def _move(self, index: int, site: int, gesture: int) -> None:
        if self._design is not None:
            label = f"Move input to {_site_words(site)}"
            self.design_edited.emit(label, self._design.with_input(index, location=site), gesture)

    def _remove(self, index: int) -> None:
        design = self._design
        if design is None:
            return
        left = len(design.inputs) - 1
        # Selected first: this index is good before and after, the old one perhaps only before.
        self._select(min(index, left - 1) if left else None)
        label = f"Remove input at {_site_words(design.inputs[index].location)}"
        self.design_edited.emit(label, design.without_input(index), None)

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
            verb = "Mute" if muted else "Unmute"
            label = f"{verb} input at {_site_words(self._design.inputs[index].location)}"
            self.design_edited.emit(label, self._design.with_input(index, muted=muted), None)

    def _set_solo(self, index: int, solo: bool) -> None:
        if self._design is not None:
            verb = "Solo" if solo else "Unsolo"
            label = f"{verb} input at {_site_words(self._design.inputs[index].location)}"
            self.design_edited.emit(label, self._design.with_input(index, solo=solo), None)


def _site_words(site: int) -> str:
    return f"{site} ({input_place(site).short_name})"


def _words(one: Input) -> str:
    return ", ".join(
        [one.waveform.title, *(["muted"] if one.muted else []), *(["solo"] if one.solo else [])]
    )
