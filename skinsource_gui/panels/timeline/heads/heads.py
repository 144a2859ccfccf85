"""The heads of the tracks: what they show, and what is done to them."""

from functools import partial

from PySide6.QtCore import QObject, QPoint, Qt, Signal
from PySide6.QtWidgets import QMenu

from skinsource.design.amplitudes import is_gain, peak_text
from skinsource.design.design import AMPLITUDE_GAIN, Design, amplitude_spec, audible_inputs
from skinsource.design.edits.edit import clip_of
from skinsource.design.view import View
from skinsource_gui.panels.timeline.heads.input_list import InputList
from skinsource_gui.panels.timeline.heads.list_edits import ListEdits
from skinsource_gui.panels.timeline.heads.list_selection import ListSelection
from skinsource_gui.panels.timeline.heads.row_state import RowState
from skinsource_gui.panels.timeline.settings import shown_gain_curves, toggle_gain_curves
from skinsource_gui.widgets.inputs.inputs_menu import ENTRIES, ORDER, Entry, fill_inputs_menu


class Heads(QObject):
    """Selects, mutes, duplicates, orders and removes tracks, and sets their amplitude.

    Attributes
    ----------
    list
        The widget.
    """

    edited = Signal(object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.list = InputList()
        self._edits, self._selection = ListEdits(self), ListSelection(self)
        self._gain_shown: frozenset[int] = frozenset()
        self._connect()

    def show_state(self, design: Design, view: View) -> None:
        """Show the tracks of a design."""
        for part in (self._edits, self._selection):
            part.show_state(design, view)
        self._gain_shown = shown_gain_curves(view)
        audible = {id(one) for one in audible_inputs(design.inputs)}
        amplitude = amplitude_spec(design)
        peaks = {one.id: peak_text(design, one) for one in design.inputs if is_gain(design, one)}
        self.list.rows.show_rows(
            [
                RowState(
                    shown=one,
                    silent=id(one) not in audible,
                    selected=one.id in view.selected_inputs,
                    last=one.id == view.selected_input,
                    list_focused=False,
                    amplitude=AMPLITUDE_GAIN if one.id in peaks else amplitude,
                    peak=peaks.get(one.id, ""),
                    clip=clip_of(one, view),
                    limb=design.limb,
                )
                for one in design.inputs
            ]
        )
        self.list.reveal_selected()

    def _connect(self) -> None:
        of_rows = self.list.rows
        rows, keys, mouse = of_rows.signals, of_rows.keys, of_rows.mouse
        selection, changes = self._selection, self._edits
        selection.edited.connect(self.edited)
        changes.edited.connect(self.edited)
        rows.entered.connect(selection.enter)
        rows.amplitude_edited.connect(changes.change_amplitude)
        rows.mute_toggled.connect(changes.toggle_mute)
        rows.solo_toggled.connect(changes.toggle_solo)
        rows.removed.connect(changes.remove)
        mouse.selected.connect(selection.select)
        mouse.toggled.connect(selection.toggle)
        mouse.reached.connect(selection.select_through)
        mouse.dropped.connect(changes.put)
        mouse.menu_wanted.connect(self._open_menu)
        keys.moved.connect(selection.go)
        keys.all_selected.connect(selection.select_all)
        keys.shifted.connect(changes.shift)
        keys.mute_toggled.connect(changes.toggle_mute)
        keys.solo_toggled.connect(changes.toggle_solo)
        keys.removed.connect(changes.remove)
        keys.duplicated.connect(changes.duplicate)
        keys.gain_toggled.connect(self._toggle_gain)

    def _toggle_gain(self) -> None:
        self._edits.edit(self._edits.together(None), toggle_gain_curves)

    def _open_menu(self, one: int, at: QPoint) -> None:
        self._selection.enter(one)
        menu = QMenu(self.list)
        menu.setObjectName("inputs_menu")
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        ids = self._edits.together(one)
        chosen = [row.state.shown for row in self.list.rows.rows if row.id in ids]
        act = partial(self._edits.edit, ids)
        gain = Entry(
            words="Gain curve",
            key="gain_curve",
            edit=toggle_gain_curves,
            on=lambda one: one.id in self._gain_shown,
            separated=True,
        )
        fill_inputs_menu(menu, chosen, act, place="inputs", entries=(*ENTRIES, *ORDER, gain))
        menu.popup(at)
