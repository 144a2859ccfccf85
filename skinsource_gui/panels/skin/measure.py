"""The measure line: what the skin map shows, of which axes, over what; each word is a menu."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QSize, Qt, Signal

from skinsource.design import edits
from skinsource.design.design import Design, View
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.labels import AXES, METHODS, SPANS, TRIAD_SENTENCE, Word
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.skin.content import MapContent
from skinsource_gui.panels.skin.settings import (
    LEVELS,
    MAP_STYLE,
    PEOPLE,
    QUANTITY,
    RMS,
    RMS_WINDOW,
    SENSORS_SHOWN,
    SkinSettings,
    with_range,
)
from skinsource_gui.plots.small_map import COLOURS, offer_arm
from skinsource_gui.qt.buttons import menu_of, tool_button
from skinsource_gui.qt.fitting import FoldingRow, fit_to_letters
from skinsource_gui.qt.keys import key_text
from skinsource_gui.qt.layouts import in_row, named, show_tooltip, tooltip

_ARROW, _ARM_HINT = " ▾", f"Show hand and arm ({key_text('skin', 'arm')})"


def offer(
    menu: QtWidgets.QMenu,
    options: Iterable[tuple[str, ...]],
    current: str,
    choose: Callable[[str], object],
) -> list[QtGui.QAction]:
    """Add exclusive entries, each with name, title and perhaps a hint, to a menu; return them."""
    group = QtGui.QActionGroup(menu)
    menu.setToolTipsVisible(True)
    actions = []
    for name, title, *hint in options:
        action = menu.addAction(title, partial(choose, name))
        action.setData(name)
        action.setToolTip(tooltip(*hint) if hint else "")
        action.setCheckable(True)
        action.setChecked(name == current)
        group.addAction(action)
        actions.append(action)
    return actions


def _explained(words: Iterable[Word]) -> list[tuple[str, ...]]:
    return [(word.name, word.title, word.sentence) for word in words]


class MeasureWord(QtWidgets.QToolButton):
    """A word of the measure line that opens a menu; ``fill`` fills that anew each time."""

    def __init__(
        self,
        name: str,
        title: str,
        hint: str,
        fill: Callable[[QtWidgets.QMenu], object],
        parent: QtWidgets.QWidget,
    ) -> None:
        super().__init__(parent)
        named(self, name, title, tooltip(title, hint))
        menu_of(self, fill)
        self.setText(_ARROW)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Down):
            self.showMenu()
        else:
            super().keyPressEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.EnabledChange and not self.isEnabled():
            # An open menu would stay, and nothing could be chosen from it.
            self.menu().close()

    def width_of(self, word: str) -> int:
        """Return how wide it is with a word, whatever it shows; without one it is hidden."""
        shown, words = (
            self.fontMetrics().size(Qt.TextFlag.TextShowMnemonic, text).width()
            for text in (self.text(), word + _ARROW)
        )
        return self.sizeHint().width() - shown + words if word else 0

    def show_word(self, word: str) -> None:
        """Show the present choice, perhaps in short."""
        self.setVisible(bool(word))
        if word:
            self.setText(word + _ARROW)


class MeasureLine(QtWidgets.QWidget):
    """Says what the numbers on the map are, and lets each part of that be chosen.

    Attributes
    ----------
    quantity, axes, span, unit
        Its words.
    rms_window, arm
        Length of a sliding RMS; whether the arm is seen beside the hand.
    """

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)
    #: Other `SkinSettings`.
    settings_chosen = Signal(object)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._design = Design(limb="")
        self._view, self._settings, self._content = View(), SkinSettings(), MapContent()
        self.quantity = MeasureWord(
            "measure_quantity", QUANTITY.label, QUANTITY.hint, self._offer_quantities, self
        )
        self.axes = MeasureWord("measure_axes", "Axes", TRIAD_SENTENCE, self._offer_axes, self)
        self.span = MeasureWord("measure_span", "Levels", "", self._offer_spans, self)
        self.unit = MeasureWord(
            "measure_unit",
            "Colours",
            "Range, colours and style of the map",
            self._offer_looks,
            self,
        )
        self.rms_window = NumberField(RMS_WINDOW, self, widest_unit="ms")
        fit_to_letters(self.rms_window, 84)
        hint = tooltip(RMS_WINDOW.label, RMS_WINDOW.hint)
        named(self.rms_window, "skin_rms_window", RMS_WINDOW.label, hint)
        self.arm = tool_button(self, "map_arm", "Whole arm", _ARM_HINT, checkable=True)
        self._words = (self.quantity, self.axes, self.span, self.unit)
        row = (self.quantity, self.axes, self.span, self.rms_window, self.unit)
        words = FoldingRow(row, 0, left=True)
        line = in_row((words, 1), self.arm, of=self, margins=0, gap_px=0)
        line.setAlignment(self.arm, Qt.AlignmentFlag.AlignTop)
        self.rms_window.edited.connect(lambda window_s, _: self._choose("rms_window_s", window_s))

    def show_state(
        self, design: Design, view: View, settings: SkinSettings, content: MapContent
    ) -> None:
        """Show what the map shows, and how it is looked at."""
        before = self._content.quantity, self._settings, self._view.axes
        if content.limb_map not in (None, self._content.limb_map):
            offer_arm(self.arm, (content.limb_map,), _ARM_HINT)
        self._design, self._view, self._settings = design, view, settings
        self._content = content
        actuated = view.span == "record" and design.actuated
        without = ": its length without the actuator" if actuated else ""
        show_tooltip(self.span, tooltip("Levels", f"Time over which a level is the RMS{without}"))
        if before == (content.quantity, settings, view.axes):
            return
        # Other quantities are of axes and of a window of their own.
        self.axes.setEnabled(settings.quantity in (LEVELS, PEOPLE, RMS))
        self.span.setEnabled(settings.quantity in (LEVELS, PEOPLE))
        self.rms_window.setVisible(settings.quantity == RMS)
        self.rms_window.set_value(settings.rms_window_s)
        self._fit()

    def minimumSizeHint(self) -> QSize:
        # With less room, the words stand in several rows.
        metrics = self.arm.fontMetrics()
        narrower = metrics.horizontalAdvance(self.arm.text()) - metrics.horizontalAdvance("Arm")
        least = self.quantity.sizeHint().width() + self.arm.sizeHint().width() - narrower
        return QSize(least, super().minimumSizeHint().height())

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def event(self, event: QEvent) -> bool:
        # Letters of another size come one by one.
        if event.type() == QEvent.Type.LayoutRequest:
            self._fit()
        return super().event(event)

    def _fit(self) -> None:
        """Show the words, in short where there is too little room."""
        what, signal, over, unit = self._content.quantity.words
        over = "" if self._settings.quantity == RMS else over
        for button, word in zip(self._words, (what, signal, over, unit), strict=True):
            button.setAccessibleDescription(word)
        show_tooltip(self.axes, tooltip(signal, TRIAD_SENTENCE))
        show_tooltip(self.unit, tooltip(unit, "Range, colours and style of the map"))
        # That levels are matched is said in any width.
        short_unit = self._content.quantity.matched or unit.split(" ")[0]
        combined = self._settings.quantity in (LEVELS, PEOPLE, RMS)
        *axes, how = signal.split(", ")
        method = f"{''.join(axes)} {how.split(' ')[0]}".lstrip()
        shorter = method if combined else signal.split(" t")[0]
        brief = what.replace("Sensation level", "Sensation")
        length = over.split(", ")[-1].removeprefix("loudest ")
        shortened = (
            ("Whole arm", what, signal, over, unit),
            ("Whole arm", what, signal, over, short_unit),
            ("Whole arm", what, shorter, over, short_unit),
            ("Whole arm", brief, shorter, over.split(" ", 1)[-1], short_unit),
            ("Whole arm", brief, shorter, length, short_unit),
            ("Arm", brief, shorter, length, short_unit),
        )
        others = (part for part in (self.rms_window, self.arm) if not part.isHidden())
        advance = self.arm.fontMetrics().horizontalAdvance
        widths = (min(part.sizeHint().width(), part.maximumWidth()) for part in others)
        room = self.width() - sum(widths)
        room += advance(self.arm.text())
        fitting = (row for row in shortened if advance(row[0]) + self._width_of(row[1:]) <= room)
        arm, *words = next(fitting, shortened[-1])
        self.arm.setText(arm)
        for button, word in zip(self._words, words, strict=True):
            button.show_word(word)

    def _width_of(self, words: tuple[str, ...]) -> int:
        return sum(b.width_of(word) for b, word in zip(self._words, words, strict=True))

    def _offer_quantities(self, menu: QtWidgets.QMenu) -> None:
        offer(menu, QUANTITY.options, self._settings.quantity, partial(self._choose, "quantity"))

    def _offer_axes(self, menu: QtWidgets.QMenu) -> None:
        axes, methods = _explained(AXES), _explained(METHODS)
        measured = set(facts_of(self._design.limb).axes)
        for action in offer(menu, axes, self._view.axes, partial(self._edit, edits.look_along)):
            action.setEnabled(set(action.data()) <= measured)
        menu.addSeparator()
        choose = partial(self._edit, edits.look_by_method)
        for action in offer(menu, methods, self._view.method, choose):
            # A single axis needs no method.
            action.setEnabled(len(self._view.axes) > 1)

    def _offer_spans(self, menu: QtWidgets.QMenu) -> None:
        offer(menu, _explained(SPANS), self._view.span, partial(self._edit, edits.level_over))

    def _offer_looks(self, menu: QtWidgets.QMenu) -> None:
        shown, settings = self._content, self._settings
        automatic = menu.addAction("Automatic range")
        automatic.setCheckable(True)
        automatic.setChecked(not shown.fixed)
        automatic.toggled.connect(
            lambda on: self.settings_chosen.emit(
                with_range(settings, None if on else shown.value_range)
            )
        )
        menu.addSeparator()
        offer(menu, MAP_STYLE.options, settings.map_style, partial(self._choose, "map_style"))
        sensors = menu.addAction("Mark sensors")
        sensors.setToolTip(SENSORS_SHOWN.hint)
        sensors.setCheckable(True)
        sensors.setChecked(settings.sensors_shown or settings.map_style == "sensors")
        sensors.setEnabled(settings.map_style != "sensors")
        sensors.toggled.connect(partial(self._choose, "sensors_shown"))
        menu.addSeparator()
        self.offer_colours(menu)

    def offer_colours(self, menu: QtWidgets.QMenu) -> None:
        """Add the colours to a menu."""
        offer(menu, COLOURS.options, self._settings.colours, partial(self._choose, "colours"))

    def _choose(self, field: str, value: Any) -> None:
        self.settings_chosen.emit(replace(self._settings, **{field: value}))

    def _edit(self, edit: Callable[[Design, View, str], Edit | Refusal], value: str) -> None:
        self.edited.emit(edit(self._design, self._view, value), None)
