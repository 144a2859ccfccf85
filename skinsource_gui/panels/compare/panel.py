"""The Compare panel: choices, cards of snapshots, and the maps below them."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any, ClassVar

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QRectF, QSize, Qt, Signal

from skinsource.design import edits
from skinsource.design.comparing import MOST_SIDE_BY_SIDE, other_snapshot
from skinsource.design.design import EDITED, NUMBERS, Design, View, shown_snapshot
from skinsource.design.edits.view import rename_snapshot
from skinsource.design.labels import limb_label
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.limbs.catalog import available_limbs
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.editors import NumbersEditor
from skinsource_gui.panels.compare.card import Card, told_limbs, told_titles
from skinsource_gui.panels.compare.content import KINDS, LEAST_COMPARED, tab_separated
from skinsource_gui.panels.compare.maps import MapsPanel
from skinsource_gui.panels.compare.settings import (
    FREQUENCIES,
    MOTION,
    OF,
    OWN_MAXIMUM,
    SHOWN,
    CompareSettings,
)
from skinsource_gui.panels.compare.view import paint_page
from skinsource_gui.plots.figure import NoteLabel
from skinsource_gui.qt.buttons import menu_of, tool_button
from skinsource_gui.qt.fitting import FoldingRow
from skinsource_gui.qt.layouts import Policy, in_column, in_row, named
from skinsource_gui.qt.questions import CopyButton
from skinsource_gui.qt.theme import LIGHT, UNIT_PX, Theme, on_paper, tabular

_TICKING = Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space


class LimbsButton(QtWidgets.QToolButton):
    """Opens a list of all limbs, of which two to six are ticked.

    Attributes
    ----------
    menu_of_limbs
        The menu that it opens.
    """

    #: Names of the limbs that are chosen; none: those that are related to the design's.
    limbs_chosen = Signal(object)

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self._chosen: tuple[str, ...] = ()
        self._usual = True
        named(self, "compare_limbs", hint="Limbs to show, two to six")
        self.setText("Limbs…")
        # The dots in the text show that a menu opens.
        self.setStyleSheet("QToolButton::menu-indicator { image: none; }")
        self.menu_of_limbs = menu_of(self)
        self.menu_of_limbs.aboutToShow.connect(self.fill)
        self.menu_of_limbs.installEventFilter(self)

    def show_chosen(self, chosen: Sequence[str], *, usual: bool) -> None:
        """Take over which limbs are shown, and whether these are the usual ones."""
        self._chosen, self._usual = tuple(chosen), usual

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        menu = self.menu_of_limbs
        entry, ticks = menu.activeAction(), event.type() == QEvent.Type.MouseButtonRelease
        if isinstance(event, QtGui.QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            ticks = event.key() in _TICKING
        if not ticks or entry is None or not entry.isEnabled():
            return super().eventFilter(watched, event)
        # The menu stays open for the next tick.
        at = menu.actions().index(entry)
        entry.trigger()
        self.fill()
        menu.setActiveAction(menu.actions()[at])
        return True

    def fill(self) -> None:
        """Offer the limbs that there are now."""
        menu = self.menu_of_limbs
        menu.clear()
        usual = menu.addAction("Related limbs")
        usual.setToolTip("The four of one kind, or own limbs with the same outputs")
        usual.setCheckable(True)
        usual.setChecked(self._usual)
        usual.triggered.connect(partial(self.limbs_chosen.emit, ()))
        menu.addSeparator()
        known = available_limbs()
        # A limb that no longer exists can be removed from the choice.
        for name in (*known, *(limb for limb in self._chosen if limb not in known)):
            action = menu.addAction(limb_label(name).title)
            action.setCheckable(True)
            ticked = name in self._chosen
            action.setChecked(ticked)
            full = len(self._chosen) >= MOST_SIDE_BY_SIDE
            action.setEnabled(len(self._chosen) > LEAST_COMPARED if ticked else not full)
            action.triggered.connect(partial(self._toggle, name))

    def _toggle(self, name: str) -> None:
        without = tuple(limb for limb in self._chosen if limb != name)
        self.limbs_chosen.emit(without if name in self._chosen else (*self._chosen, name))


# Where fewer lines of text fit, the maps need the room.
_LINES_WITH_ROOM = 14


# Names, texts and hints of buttons, and what they do.
_OF_SNAPSHOTS = (
    ("match", "Match levels", "Give the loudest 100 ms of each the same level", "match_levels"),
    ("toggle", "A/B (X)", "Show the other one of the last two", "toggle_snapshots"),
    ("file", "From file…", "Keep the design of a file as a snapshot", "take_snapshot"),
)


_FIXED = Policy.Fixed


class ChoicesBar(QtWidgets.QWidget):
    """The choices above the maps; a choice emits another view.

    Attributes
    ----------
    settings
        Settings of the present view.
    of, shown, own_maximum, limbs, frequencies, match, toggle, file
        The choices; all but the first two are shown only where they apply.
    """

    #: The new `View`.
    view_changed = Signal(object)
    #: The name of an action of the window.
    action_requested = Signal(str)

    def __init__(self, panel_name: str, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self._panel_name = panel_name
        self._view, self.settings = View(), CompareSettings()
        self.of, self.shown = named(ChoiceField(OF, self), "compare_of"), ChoiceField(SHOWN, self)
        self.shown.setObjectName("compare_shown")
        # Whatever is chosen, both stay in their place.
        for chooser, spec in ((self.of, OF), (self.shown, SHOWN)):
            chooser.setMinimumContentsLength(max(len(title) for _, title in spec.options))
            chooser.setSizePolicy(_FIXED, _FIXED)
        self.of.edited.connect(lambda of, _: self._change(of=of))
        self.shown.edited.connect(lambda what, _: self._change(shown=what))
        own = OWN_MAXIMUM
        self.own_maximum = tool_button(
            self, "compare_own_maximum", own.label, own.hint, checkable=True
        )
        self.own_maximum.clicked.connect(lambda on: self._change(own_maximum=on))
        self.limbs = LimbsButton(self)
        self.limbs.limbs_chosen.connect(lambda limbs: self._change(limbs=" ".join(limbs)))
        self.frequencies = named(NumbersEditor(FREQUENCIES, self), "compare_frequencies")
        self.frequencies.edited.connect(lambda numbers, _: self._change(frequencies_hz=numbers))
        self.match, self.toggle, self.file = self._of_snapshots = tuple(
            tool_button(self, f"compare_{name}", text, hint)
            for name, text, hint, _ in _OF_SNAPSHOTS
        )
        self.match.setCheckable(True)
        for button, (*_, action) in zip(self._of_snapshots, _OF_SNAPSHOTS, strict=True):
            button.clicked.connect(partial(self.action_requested.emit, action))
        of_others = self.own_maximum, self.limbs, self.frequencies
        self._row = FoldingRow((self.of, self.shown, *of_others, *self._of_snapshots), UNIT_PX // 2)
        margins = UNIT_PX // 2, 1, UNIT_PX // 2, 1
        in_column(self._row, of=self, margins=margins, gap_px=2)

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._view = view
        before, settings = self.settings, settings_of(view, self._panel_name, CompareSettings)
        self.settings, kind = settings, KINDS[settings.of]
        self.of.set_value(settings.of)
        self.own_maximum.setChecked(settings.own_maximum)
        if settings.of != before.of:
            self.shown.set_options([each for each in SHOWN.options if each[0] in kind.choices])
        self.shown.set_value(kind.shown(settings))
        fields = kind.fields
        # Differences have no maximum to be relative to, and a mean is one map.
        self.own_maximum.setVisible(kind.shown(settings) == "levels")
        self.limbs.setVisible("limbs" in fields)
        self.frequencies.setVisible("frequencies_hz" in fields)
        self.frequencies.set_value(settings.frequencies_hz)
        self.match.setChecked(view.levels_matched)
        self.toggle.setEnabled(other_snapshot(view.snapshots, design) is not None)
        if "limbs" in fields:
            usual = not settings.limbs.strip()
            self.limbs.show_chosen(settings.chosen(design.limb), usual=usual)
        for part in self._of_snapshots:
            part.setVisible("snapshots" in fields)

    def _change(self, **changes: Any) -> None:
        settings = replace(self.settings, **changes)
        self.view_changed.emit(with_settings(self._view, self._panel_name, settings))


_LEAST_PX = 240


class ComparePanel(MapsPanel):
    """Maps of snapshots, of limbs, axes or frequencies, with one pointer and one selection.

    Attributes
    ----------
    cards
        A card for each snapshot; in sight while snapshots are compared.
    has_room
        Whether there is room for more than the maps and their choices: where there is not, cards
        and words are away, and menus and keys do what they do.
    """

    title: ClassVar[str] = "Compare"
    name: ClassVar[str] = "compare"

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.bar = ChoicesBar(self.name, self)
        self.bar.view_changed.connect(self.view_changed)
        self.bar.action_requested.connect(self.action_requested)
        self.has_room = True
        self.cards = [Card(number, self) for number in (*NUMBERS, EDITED)]
        for card in self.cards:
            card.requested.connect(self._act)
            card.renamed.connect(self._rename)
        self._row = FoldingRow(self.cards, UNIT_PX // 4, left=True, parent=self)
        self.maps.pointed_at.connect(self._read)
        self.text_label = NoteLabel("compare_words", self)
        self.copy = CopyButton(self.name, lambda: tab_separated(self.maps.content), self)
        foot = in_row(self.text_label, self.copy, margins=(UNIT_PX, 1, UNIT_PX // 2, 1))
        cards = in_row((self._row, 1), margins=(UNIT_PX // 2, 0, UNIT_PX // 2, 0))
        in_column(self.bar, cards, (self.maps, 1), foot, of=self, margins=0, gap_px=0)
        self.setFocusProxy(self.maps)
        self.guessed = self._row, self.maps, self.text_label
        self.computed = (self.maps,)
        self._show_cards()

    def sizeHint(self) -> QSize:
        return QSize(560, 520)

    def minimumSizeHint(self) -> QSize:
        height = self.bar.minimumSizeHint().height() + self.maps.minimumSizeHint().height()
        return QSize(_LEAST_PX, height)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self.has_room = self.height() >= _LINES_WITH_ROOM * self.fontMetrics().lineSpacing()
        for part in (self.text_label, self.copy):
            part.setVisible(self.has_room)
        self._show_cards()

    def show_state(self, design: Design, view: View) -> None:
        self.bar.show_state(design, view)
        settings = self.bar.settings
        kind = KINDS[settings.of]
        moves = kind.shown(settings) == MOTION
        self.take_state(design, view, kind, settings, moves=moves)
        self._show_cards()

    def show_maps(self) -> None:
        super().show_maps()
        self._show_cards()
        # A table would lack the columns that are still computed.
        cells = self.maps.content.cells
        drawn = [cell.small is not None for cell in cells]
        computing = any(not (cell.small or cell.text) for cell in cells)
        self.copy.offer(any(drawn) and not computing and not self.moves)

    def draw_picture(
        self, painter: QtGui.QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw the maps and their scale for a page or a slide; size in px."""
        painter.fillRect(QRectF(0, 0, width, height), QtGui.QColor(theme.base))
        # Words grow with the picture, and are no smaller than on the screen.
        scale = max(min(width / max(self.width(), 1), height / max(self.height(), 1)), 1.0)
        painter.save()
        painter.scale(scale, scale)
        with on_paper():
            painter.setFont(tabular(self.font()))
            room = QRectF(0, 0, width / scale, height / scale)
            content = self.maps.content
            if self.moves and self.moving.longest_s:
                content = replace(content, about=self.moving.clock_text)
            paint_page(painter, content, room, theme)
        painter.restore()

    def _show_cards(self) -> None:
        """Show a card for each snapshot, and for what is edited where it is none of them."""
        self._row.setVisible(self.has_room and "snapshots" in self.kind.fields)
        present = None
        if self.design is not None:
            present = shown_snapshot(self.view.snapshots, self.design)
        in_window = EDITED if present is None else present.number
        titles, limbs = told_titles(self.compared), told_limbs(self.compared)
        sides = {side.snapshot.number: side for side in self.compared}
        for card in self.cards:
            side, title = sides.get(card.number), titles.get(card.number, "")
            card.setVisible(card.number != EDITED or side is not None)
            on_limb = limbs.get(card.number, "")
            shown = side is not None and card.number == in_window
            card.show_snapshot(side, title, on_limb, present=shown)

    def _act(self, number: int, what: str) -> None:
        if what == "store":
            self.action_requested.emit(f"store_snapshot_{number}")
        elif what == "show":
            self.snapshot_requested.emit(number)
        elif self.design is not None:
            self.edited.emit(edits.forget_snapshot(self.design, self.view, number), None)

    def _rename(self, number: int, title: str) -> None:
        if self.design is not None:
            self.edited.emit(rename_snapshot(self.design, self.view, number, title), None)

    def _read(self, output: int | None) -> None:
        # Maps that move under the pointer cannot be pointed at.
        self.text_label.say(self.maps.content.readout(output), holding=True)
