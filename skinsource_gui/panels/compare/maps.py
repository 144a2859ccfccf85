"""The base of panels that show maps side by side, still or in motion."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from PySide6 import QtGui, QtWidgets

from skinsource.design import edits
from skinsource.design.design import Design, View
from skinsource_gui.panels.compare.content import (
    ALL_AXES,
    KINDS,
    Cell,
    CompareContent,
    Kind,
    about_range,
)
from skinsource_gui.panels.compare.motion import Clock, MovingMaps
from skinsource_gui.panels.compare.settings import RANGE, CompareSettings
from skinsource_gui.panels.compare.view import MapsView
from skinsource_gui.plots.small_map import Range
from skinsource_gui.state.compared import Compared, display_gain_text
from skinsource_gui.state.engine import Beside
from skinsource_gui.state.panel import Panel


class MapsPanel(Panel):
    """Maps of what is compared, all in one scale.

    Attributes
    ----------
    maps
        The maps; a panel lays them out.
    moving
        Makes them while they move.
    clock
        Runs while they move in sight.
    design, view, settings
        Those of the window, and what is compared.
    kind, moves
        Where the designs come from, and whether they are shown in motion.
    held
        Ends of the scale of all maps while it stays; None: it follows what they show.
    compared
        The designs, and what is known of them.
    """

    compares: ClassVar[bool] = True

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.design: Design | None = None
        self.view, self.settings = View(), CompareSettings()
        self.kind: Kind = KINDS[self.settings.of]
        self.moves = False
        self.held: Range | None = None
        self.compared: Sequence[Compared] = ()
        # Of the design in the window: results, whether they are older than it, why there are none.
        self._results: Mapping[str, Any] = {}
        self._stale, self._problem = False, ""
        self.moving, self.clock = MovingMaps(), Clock(self)
        self.clock.ticked.connect(self.move_on)
        self.maps = MapsView(self)
        self.maps.outputs_chosen.connect(self._choose_outputs)

    @property
    def needs(self) -> frozenset[str]:
        return self.kind.needs | self.needs_of_motion if self.moves else self.kind.needs

    @property
    def needs_of_motion(self) -> frozenset[str]:
        """What moving maps and their traces need beside it."""
        if self.design is None:
            return frozenset()
        limbs = {self.design.limb, *self.kind.limbs(self.settings, self.design, self.view)}
        names = {self.kind.moving(limb, self.view.axes) for limb in limbs}
        # Of limbs that were measured along different axes, one may move along z alone.
        return frozenset(names if len(names) == 1 else {ALL_AXES})

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        return self.needs if "snapshots" in self.kind.fields else frozenset()

    @property
    def needs_on_limbs(self) -> Mapping[Beside, frozenset[str]]:
        if self.design is None:
            return {}
        return dict.fromkeys(self.kind.beside(self.settings, self.design), self.needs)

    def take_state(
        self, design: Design, view: View, kind: Kind, settings: CompareSettings, *, moves: bool
    ) -> None:
        """Take over what is compared, and whether it moves."""
        self.design, self.view, self.settings = design, view, settings
        self.moves, moving = moves and kind.moves, self.moving
        before, self.kind = self.kind, kind
        moving.axes, moving.chosen = view.axes, view.slow_motion
        moving.delay_removed = view.delay_removed
        moving.matched = display_gain_text(design, view)
        if kind is not before:
            # The engine sends the results for the new kind.
            self.compared = ()
            moving.update((), ())
        if kind.own:
            self._show_own()
        elif not (self.needs_of_snapshots or self.needs_on_limbs):
            # Nothing is sent where there is nothing to compare.
            self.show_on_limbs(())

    def reset_range(self) -> None:
        self.moving.restart()

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._results, self._problem = results, ""
        if self.kind.own:
            self.compared = ()
            self._show_own()

    def show_stale(self, stale: bool) -> None:
        self._stale = stale
        if self.kind.own:
            super().show_stale(stale)
            # An edit of what is silent changes no results.
            if not stale and any(side.snapshot.design is not self.design for side in self.compared):
                self.compared = ()
                self._show_own()

    def show_problem(self, reason: str) -> None:
        self._problem = reason
        if self.kind.own:
            self._show_own()

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        self.compared = compared
        self.show_maps()

    show_on_limbs = show_snapshots

    def show_maps(self) -> None:
        """Draw what is known of the designs."""
        kind, compared, design, view = self.kind, self.compared, self.design, self.view
        problem = self._problem if kind.own else ""
        message = problem or kind.hindrance(compared, view)
        cells: tuple[Cell, ...] = ()
        if not compared or design is None or message:
            self.moving.update((), ())
        elif self.moves:
            names = kind.names(compared, view)
            self.moving.update(compared, names, self.held)
            cells = self.moving.cells()
        else:
            drawn = kind.drawn(compared, design, view, self.settings)
            cells = tuple(cell.in_range(self.held) for cell in drawn)
        about = [kind.about(compared, design, view)]
        if kind.shown(self.settings) == RANGE:
            about.insert(0, about_range(cells))
        content = CompareContent(
            cells=cells,
            outputs=view.outputs,
            message=message,
            about="" if self.moves else " · ".join(about),
        )
        super().show_stale(self._stale if kind.own else content.stale)
        self.maps.show_content(content)
        self.run_clock()

    def run_clock(self) -> None:
        """Let the maps move, if they do and can be seen."""
        content = self.maps.content
        on = self.moves and self.isVisible() and bool(content.cells)
        self.clock.run(on, self.moving.pictures_per_s)

    def showEvent(self, event: QtGui.QShowEvent) -> None:
        super().showEvent(event)
        self.run_clock()

    def hideEvent(self, event: QtGui.QHideEvent) -> None:
        super().hideEvent(event)
        self.run_clock()

    def _show_own(self) -> None:
        """Draw what is known of the design in the window."""
        if self.design is not None and not self.compared and self.needs <= self._results.keys():
            self.compared = self.kind.sides(self.design, self._results)
        self.show_maps()

    def move_on(self, seconds: float) -> None:
        """Show the maps a moment later."""
        self.moving.advance(seconds)
        self.maps.show_frame(self.moving.cells())

    def _choose_outputs(self, outputs: tuple[int, ...]) -> None:
        if self.design is not None:
            self.edited.emit(edits.select_outputs(self.design, self.view, outputs), None)
