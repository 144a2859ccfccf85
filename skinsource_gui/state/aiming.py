"""Finds the drives of the target of the open design, and what they do, away from the GUI thread."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from PySide6.QtCore import QObject, QTimer, Signal

from skinsource import inverse
from skinsource.base.errors import InvalidInputError, Stopped
from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit
from skinsource.design.panel_settings import (
    NO_BRUSH,
    TARGET,
    TargetSettings,
    brush_of,
    with_settings,
)
from skinsource.design.target import Target, conditions_of, is_unsolved, target_in
from skinsource.limbs.catalog import load_limb
from skinsource.limbs.limb import Limb
from skinsource.limbs.own_limbs import facts_of, missing_limb
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.limbs.surface.surface import cached_surface_operator
from skinsource_gui.plots.small_map import SmallMap, field_image
from skinsource_gui.state.panel import Panel
from skinsource_gui.state.services import Services
from skinsource_gui.state.worker import Worker, fault_text

#: After the last move, until a target is judged.
PAUSE_MS = 50


@dataclass(frozen=True, kw_only=True, eq=False)
class Person:
    """What the drives of a target do on another limb.

    Attributes
    ----------
    title
        Of the limb.
    loudest_db
        Level at the loudest output that is not strong.
    shown
        Levels in dB re the strong outputs of this limb.
    """

    title: str
    loudest_db: float
    shown: SmallMap


@dataclass(frozen=True, kw_only=True, eq=False)
class Found:
    """What is known of the target of the open design.

    Attributes
    ----------
    design
        The design.
    ways
        Best single input, time reversal and the target; empty where it cannot be solved.
    said
        Sentences about it, such as why it cannot be solved.
    people
        What its drives do on the other limbs of the same kind.
    """

    design: Design
    ways: tuple[inverse.aiming.Way, ...] = ()
    said: tuple[str, ...] = ()
    people: tuple[Person, ...] = ()


class FoundPanel(Panel):
    """A panel that shows what is found of the target."""

    def show_found(self, found: Found | None) -> None:
        """Show what is known of the target; None: there is none."""
        raise NotImplementedError


class Aiming(QObject):
    """Solves the target of the open design whenever it, or what it depends on, has changed.

    The drives join the step of the history that made them necessary.  What they do is judged when
    nothing has moved for a moment.

    Attributes
    ----------
    rest
        Runs from the last move until the target is judged.
    """

    #: `Found`, or None where there is no target.
    found = Signal(object)

    def __init__(self, services: Services, bring: Callable[[str], None]) -> None:
        super().__init__(services.window)
        self._document, self._limbs, self._bring = services.document, services.limbs, bring
        self._worker = Worker("skinsource-aiming", self)
        self._panel: Panel | None = None
        # Limbs of other people, as long as they are compared, and their surfaces.
        self._others: dict[str, tuple[Limb, SurfaceOperator]] = {}
        # The target that was judged last, and what it depends on.
        self._judged: object = None
        self.rest = QTimer(self, singleShot=True, interval=PAUSE_MS)
        self.rest.timeout.connect(self._judge)
        self._document.changed.connect(self._follow)
        services.panels.each(self._meet)

    @property
    def busy(self) -> bool:
        """Whether something is solved or judged."""
        return self._worker.busy or self.rest.isActive()

    def toggle(self) -> None:
        """Take the strong brush for the skin map and show the panel, or put the brush away."""
        view = self._document.view
        brush = NO_BRUSH if brush_of(view) else "strong"
        if brush != NO_BRUSH:
            self._bring(TARGET)
        self._document.look(with_settings(view, TARGET, TargetSettings(brush=brush)))

    def end(self) -> None:
        """Stop."""
        self.rest.stop()
        self._worker.close()

    def _meet(self, panel: Panel) -> None:
        if isinstance(panel, FoundPanel):
            self._panel = panel
            self.found.connect(panel.show_found)
            panel.visibility_changed.connect(self._follow)

    def _follow(self) -> None:
        design = self._document.design
        is_shown = self._panel is not None and self._panel.isVisible()
        found = target_in(design)
        if not (found or is_shown) or missing_limb(design.limb, design.limb_digest):
            return
        if found is not None and is_unsolved(design):
            self._worker.run_newest("solve", partial(_solved, design, found[1]), self._take)
        elif is_shown:
            self._judge_soon(design)

    def _take(self, solved: Target | None, error: Exception | None) -> None:
        """Have the target play its drives, those of an older one as well."""
        design, view = self._document.design, self._document.view
        if solved is None:
            self._show(None, error)
            return
        outcome = edits.solve_target(design, view, solved)
        if isinstance(outcome, Edit) and is_unsolved(design):
            self._document.amend(outcome)

    def _judge_soon(self, design: Design) -> None:
        found = target_in(design)
        wanted = found and (
            found[1],
            conditions_of(design),
            (design.actuation, design.rig, inverse.aiming.tracks_beside(design)),
            self._limbs.names,
        )
        if wanted == self._judged:
            return
        self._judged = wanted
        if found is None or not found[1].strong:
            self.rest.stop()
            self.found.emit(None)
            return
        self.rest.start()

    def _judge(self) -> None:
        design = self._document.design
        if is_unsolved(design):
            self._judged = None
            return
        work = partial(self._found_of, design, self._limbs.names)
        self._worker.run_newest("judge", work, self._show, again=True)

    def _show(self, found: Found | None, error: Exception | None) -> None:
        if found is None:
            found = Found(design=self._document.design, said=(fault_text(error),))
        self.found.emit(found)

    def _found_of(self, design: Design, names: tuple[str, ...]) -> Found:
        """Return what is known of a target; give way to one that is to be solved."""
        aimed = inverse.aiming.aim_of(design)
        self._give_way()
        beside = inverse.aiming.ways(aimed)
        kind = design.limb.rpartition("-")[0]
        known = [name for name in names if name.startswith(f"{kind}-") and name != design.limb]
        self._give_way()
        said = inverse.aiming.sentences(aimed, beside, design)
        shown = Found(design=design, ways=beside, said=said)
        if not self._others:
            # Other people are read for the first time, which takes long.
            self._worker.tell(self.found.emit, shown)
        return replace(shown, people=tuple(self._person(aimed, name) for name in known if kind))

    def _person(self, aimed: inverse.aiming.Aim, name: str) -> Person:
        self._give_way()
        if name not in self._others:
            limb = load_limb(name)
            stop = partial(self._worker.is_outdated, "solve")
            self._others[name] = limb, cached_surface_operator(limb, stop=stop)
        limb, surface = self._others[name]
        there = inverse.aiming.on_limb(aimed, limb)
        shown = SmallMap(
            limb_map=limb.map,
            levels_db=there.levels_db,
            field=field_image(surface, limb),
            field_levels_db=surface.interpolate(there.levels_db),
            hand_only=True,
        )
        title = facts_of(name).title.partition(" (")[0]
        return Person(title=title, loudest_db=there.loudest_db, shown=shown)

    def _give_way(self) -> None:
        if self._worker.is_outdated("solve"):
            raise Stopped


def _solved(design: Design, target: Target) -> Target:
    """Return the solved target of a design; one that cannot be solved plays nothing."""
    try:
        return inverse.aiming.aim_of(design).solved(design)
    except InvalidInputError:
        return replace(target, places=(), drives=(), solved_for=conditions_of(design))
