"""The hand on which inputs are placed."""

from collections.abc import Callable
from functools import partial
from typing import ClassVar

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtWidgets import QLabel, QMenu, QStackedLayout, QWidget

from skinsource.base.quoting import quoted
from skinsource.design import edits
from skinsource.design.design import Design, Input, audible_inputs
from skinsource.design.edits import Edit, Refusal
from skinsource.design.view import View
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.panel import Panel
from skinsource_gui.panels.hand.drawings import drawing_of
from skinsource_gui.panels.hand.hand_diagram import HandDiagram
from skinsource_gui.panels.hand.hand_state import Mark
from skinsource_gui.panels.hand.pointing import Pointing
from skinsource_gui.theme import current_theme, set_tone
from skinsource_gui.widgets.drop_place import DropPlace
from skinsource_gui.widgets.inputs.input_words import EMPTY
from skinsource_gui.widgets.inputs.inputs_menu import fill_inputs_menu
from skinsource_gui.widgets.keys import key_text


class HandPanel(Panel):
    """Places inputs on the hand, moves and removes them; draws nothing that is computed."""

    title: ClassVar[str] = "Hand"
    name: ClassVar[str] = "hand"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view = View()
        self._words: dict[int, tuple[Input, str]] = {}
        self.diagram = HandDiagram(drawing_of(""), self)
        self.diagram.add_requested.connect(self._add)
        self.diagram.add_besides_requested.connect(partial(self._add, besides=True))
        self.diagram.select_requested.connect(self._select)
        self.diagram.move_requested.connect(self._move)
        self.diagram.toggle_requested.connect(self._toggle)
        self.diagram.all_requested.connect(partial(self._edit, edits.select_all_inputs))
        self.diagram.remove_requested.connect(self._remove)
        self.diagram.menu_requested.connect(self._open_menu)
        self._pointing = Pointing(self.diagram.stage)
        self._pointing.pointed_at.connect(self.input_pointed_at)
        # Of a limb that is missing no hand is known: that of another has other places.
        self._missing = QLabel()
        self._missing.setObjectName("hand_missing")
        set_tone(self._missing, "dim")
        self._missing.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._missing.setWordWrap(True)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self.diagram)
        self._stack.addWidget(self._missing)
        self.setFocusProxy(self.diagram)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self._pointing.show_design(design)
        missing = facts_of(design.limb).missing
        if missing:
            self._missing.setText(f"The limb {quoted(design.limb)} is missing")
        else:
            self.diagram.show_drawing(drawing_of(design.limb))
        self._stack.setCurrentWidget(self._missing if missing else self.diagram)
        self._show_inputs()

    def show_pointed_input(self, input_id: int | None) -> None:
        self._pointing.show(input_id)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._show_inputs()

    def drop_place(self, at: QPoint) -> DropPlace | None:
        if self._stack.currentWidget() is not self.diagram:
            return None
        site = self.diagram.stage.site_at(QPointF(self.diagram.mapFrom(self, at)))
        return None if site is None else DropPlace(location=site)

    def show_drop(self, at: QPoint | None) -> None:
        place = None if at is None else self.drop_place(at)
        self.diagram.stage.change(target=None if place is None else place.location)

    def _show_inputs(self) -> None:
        if self._design is None:
            return
        heard = {id(one) for one in audible_inputs(self._design.inputs)}
        # Words of inputs that are as they were are not made again.
        known, self._words = self._words, {one.id: (one, "") for one in self._design.inputs}
        anew = not any(known.get(one.id, (None, ""))[0] is one for one in self._design.inputs)
        for number, (one, _) in self._words.items():
            before, words = known.get(number, (None, ""))
            self._words[number] = one, words if before is one else _words(one)
        marks = tuple(
            Mark(
                site=one.location,
                colour=current_theme().input_colour(one.colour),
                silent=id(one) not in heard,
                words=self._words[one.id][1],
                chosen=one.id in self._view.selected_inputs,
            )
            for one in self._design.inputs
        )
        self.diagram.show_inputs(marks, self._selected(), anew=anew)

    def _selected(self) -> int | None:
        """Index of the input that was selected last, unless the design has lost it."""
        if self._design is None or self._view.selected_input not in self._design.ids:
            return None
        return self._design.index_of(self._view.selected_input)

    def _select(self, index: int) -> None:
        self._edit(edits.select_inputs, self._together(index, alone=True))

    def _toggle(self, index: int) -> None:
        for one in self._together(index, alone=True):
            self._edit(edits.toggle_selected, one)

    def _add(self, site: int, besides: bool = False) -> None:
        self._edit(edits.place_input, site, besides)

    def _move(self, index: int, site: int, gesture: int) -> None:
        self._edit(edits.move_inputs, self._together(index, alone=True), site, gesture=gesture)

    def _remove(self) -> None:
        self._edit(edits.remove_inputs, self._view.selected_inputs)

    def _together(self, index: int, *, alone: bool = False) -> tuple[int, ...]:
        """Ids of all selected inputs if this is one of them; else of this one, if it exists."""
        # What is held may have gone.
        ids = self._design.ids[index : index + 1] if self._design else ()
        several = not alone and set(ids) & set(self._view.selected_inputs)
        return self._view.selected_inputs if several else ids

    def _edit(
        self, edit: Callable[..., Edit | Refusal], *what: object, gesture: int | None = None
    ) -> None:
        if self._design is not None:
            self.edited.emit(edit(self._design, self._view, *what), gesture)

    def _open_menu(self, site: int, at: QPoint) -> None:
        index = self.diagram.state.front_at(site)
        menu = QMenu(self)
        menu.setObjectName("hand_menu")
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        add = f"Add input here\t{key_text('hand', 'place_another')}"
        menu.addAction(add, partial(self._add, site))
        menu.addSeparator()
        ids = () if index is None else self._together(index)
        chosen = [one for one in self._design.inputs if one.id in ids] if self._design else []
        fill_inputs_menu(menu, chosen, lambda edit: self._edit(edit, ids), place="hand")
        menu.popup(at)


def _titles(one: Input) -> list[str]:
    """What an input plays: each kind once, at most three of them."""
    titles = list(dict.fromkeys(clip.waveform.title for clip in one.clips))
    return [*titles[:3], *(["…"] if len(titles) > 3 else [])] or [EMPTY]


def _words(one: Input) -> str:
    return ", ".join(
        [*_titles(one), *(["muted"] if one.muted else []), *(["solo"] if one.solo else [])]
    )
