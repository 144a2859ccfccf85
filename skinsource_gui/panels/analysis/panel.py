"""The Analysis panel: a chooser, what the chosen view answers, and the view."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from operator import attrgetter
from pathlib import Path
from typing import Any, ClassVar

from PySide6 import QtWidgets
from PySide6.QtCore import QEvent

from skinsource.design.design import Design, View
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.panels.analysis.settings import SHOWN, VIEWS, AnalysisSettings
from skinsource_gui.panels.analysis.view import AnalysisView
from skinsource_gui.plots.figure import NoteLabel
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.questions import CopyButton
from skinsource_gui.qt.theme import UNIT_PX, letter_scale
from skinsource_gui.state.panel import Panel

# How much larger than usual letters are in which the view's answer is not shown.
_LARGE_LETTERS = 2.0
_ANSWERS = {spec.name: spec.answer for spec in VIEWS}
# Signals of a view that are those of the panel.
_FORWARDED = ("edited", "view_changed", "action_requested", "playhead_requested", "failed", "done")


def _of_view(name: str) -> Any:
    """Return an attribute of the panel that is the one of its view."""
    return property(attrgetter(f"view.{name}"))


class AnalysisPanel(Panel):
    """Shows one of its views, and asks for the results of that one alone.

    Attributes
    ----------
    choice
        The chooser.
    view
        The chosen view, which is made when it is chosen first.
    """

    title: ClassVar[str] = "Analysis"
    name: ClassVar[str] = "analysis"
    compares: ClassVar[bool] = True

    needs = _of_view("needs")
    needs_of_snapshots = _of_view("needs_of_snapshots")
    needs_on_limbs = _of_view("needs_on_limbs")
    snapshots_drawn = _of_view("snapshots_drawn")
    is_stale = _of_view("is_stale")
    reset_range = _of_view("reset_range")
    show_playhead = _of_view("show_playhead")
    show_problem = _of_view("show_problem")
    show_snapshots = _of_view("show_snapshots")
    show_on_limbs = _of_view("show_on_limbs")
    show_newer = _of_view("show_newer")
    draw_picture = _of_view("draw_picture")

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._state = Design(limb=""), View()
        self._views: dict[str, AnalysisView] = {}
        # The view that is drawn for a picture, whatever is chosen; "": none is.
        self._for_picture = ""
        self._covered = False
        # Whether the view was chosen since results came.
        self._just_chosen = False
        self._folder = Path()
        self.choice = named(ChoiceField(SHOWN, self), f"{self.name}_view")
        self.choice.edited.connect(self._choose)
        self.answer = NoteLabel(f"{self.name}_answer")
        self.copy = CopyButton(self.name, self._numbers, self)
        margins = UNIT_PX // 2, 1, UNIT_PX // 2, 1
        choice = in_row((self.choice, 1), self.copy, margins=margins, gap_px=UNIT_PX // 2)
        answer = in_row((self.answer, 1), margins=(UNIT_PX, 1, UNIT_PX, 2))
        self._column = in_column(choice, answer, of=self, margins=0, gap_px=0)
        self.view = self._made(AnalysisSettings().shown)
        self._show_view(self.view)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._fit_answer()

    def _fit_answer(self) -> None:
        # In the largest letters, the room is that of the view.
        self.answer.setHidden(letter_scale(self.font()) > _LARGE_LETTERS)

    def show_state(self, design: Design, view: View) -> None:
        self._state = design, view
        self._follow_choice()
        self.view.show_state(design, view)

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._just_chosen = False
        self.view.show_results(results)

    def show_stale(self, stale: bool) -> None:
        self.view.comes_into_sight = self.comes_into_sight or self._just_chosen
        self.view.show_stale(stale)
        self.view.comes_into_sight = False

    def show_covered(self, covered: bool) -> None:
        self._covered = covered
        self.view.show_covered(covered)

    def show_folder(self, folder: Path) -> None:
        self._folder = folder
        self.view.show_folder(folder)

    @contextmanager
    def showing(self, view: str) -> Iterator[None]:
        """Show the view of that name for a while, whatever is chosen; "": the chosen one."""
        self._for_picture = view
        self._turn()
        try:
            yield
        finally:
            self._for_picture = ""
            self._turn()

    def _turn(self) -> None:
        """Show the view that is wanted now, and have its results requested."""
        before = self.view
        self._follow_choice()
        if self.view is not before:
            self.view.show_state(*self._state)
            self.visibility_changed.emit()

    def _numbers(self) -> str:
        table, words = self.view.table_text(), self.view.words
        return f"{table}# {words}\n" if table and words else table

    def _choose(self, name: str, _gesture: int | None) -> None:
        settings = AnalysisSettings(shown=name)
        self.view_changed.emit(with_settings(self._state[1], self.name, settings))

    def _follow_choice(self) -> None:
        """Show the view that is chosen, or that of a picture."""
        shown = settings_of(self._state[1], self.name, AnalysisSettings).shown
        self.choice.set_value(shown)
        view = self._made(self._for_picture or shown)
        if view is not self.view:
            self._just_chosen = True
            self._show_view(view)

    def _made(self, name: str) -> AnalysisView:
        """Return the view of that name, which is imported and made now if it was not before."""
        view = self._views.get(name)
        if view is None:
            module = import_module(f"skinsource_gui.panels.analysis.{name}")
            words = (word.capitalize() for word in name.split("_"))
            view = self._views[name] = getattr(module, f"{''.join(words)}View")()
            for signal in _FORWARDED:
                getattr(view, signal).connect(getattr(self, signal))
            view.copy_requested.connect(self.copy.click)
            view.hide()
            self._column.addWidget(view, 1)
            view.copy_changed.connect(self._offer_copy)
        return view

    def _show_view(self, view: AnalysisView) -> None:
        self.view.hide()
        self.view = view
        view.show_covered(self._covered)
        view.show_folder(self._folder)
        self.setFocusProxy(view)
        self.answer.say(_ANSWERS[view.name])
        self._fit_answer()
        self.copy.setVisible(view.copies)
        view.show()
        self._offer_copy()

    def _offer_copy(self) -> None:
        self.copy.offer(self.view.has_table)
        self.copy.show_staleness(self.view.is_stale)


class Analysis2Panel(AnalysisPanel):
    """A second one, to be seen beside the first."""

    title: ClassVar[str] = "Analysis 2"
    name: ClassVar[str] = "analysis_2"
