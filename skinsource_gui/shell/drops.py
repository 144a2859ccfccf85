"""Clips that are dragged between panels or stretched, and waveforms from the palette."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, cast

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QPoint

from skinsource.design import edits
from skinsource.design.edits.edit import leading_clip
from skinsource.design.labels import scalings_on
from skinsource.design.panel_settings import with_settings
from skinsource.design.waveforms import kinds
from skinsource.limbs.own_limbs import drive_unit_known
from skinsource.studies import scenes
from skinsource_gui.panels.analysis.settings import VIEWS, AnalysisSettings
from skinsource_gui.qt.frames import DropPlace
from skinsource_gui.qt.tooltips import tooltip
from skinsource_gui.shell.bars import choice_action
from skinsource_gui.shell.menus import KEYWORDS
from skinsource_gui.state.document import Document
from skinsource_gui.state.panel import Panel, PanelRegistry

if TYPE_CHECKING:
    from skinsource_gui.fields.editors import FieldCell
    from skinsource_gui.panels.inspector.panel import InspectorPanel


def pass_drops_on(panels: PanelRegistry) -> None:
    """Let each panel that drags something know where it would go in another one, which shows it."""

    def find(dragged_from: Panel, at: QPoint | None) -> DropPlace | None:
        """Where something goes that is held over a place of the screen; None: it is let go."""
        below = None if at is None else QtWidgets.QApplication.widgetAt(at)
        drop_place = None
        for panel in panels:
            if panel is dragged_from:
                continue
            # Panels may float above each other: only what is on top takes anything.
            is_there = below is not None and (below is panel or panel.isAncestorOf(below))
            own = panel.mapFromGlobal(at) if is_there and at is not None else None
            panel.show_drop(own)
            if own is not None:
                drop_place = panel.drop_place(own)
        return drop_place

    def meet(panel: Panel) -> None:
        panel.held_over = partial(find, panel)

    panels.each(meet)


class ClipStretching(QObject):
    """Asks how long the selected clip is to last, and stretches it."""

    def __init__(self, document: Document, window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self._document, self._window = document, window

    def ask(self) -> None:
        """Ask for the new length of the clip that was selected last."""
        design, view = self._document.design, self._document.view
        clip = leading_clip(design, view)
        if clip is None:
            return
        length_ms, sure = QtWidgets.QInputDialog.getDouble(
            self._window, "Stretch clip", "Length, ms", 1e3 * clip.duration_s, 1.0, 600e3, 1
        )
        if sure:
            end_s = clip.onset_s + length_ms / 1e3
            self._document.apply(edits.stretch_clip(design, view, clip.id, clip.onset_s, end_s))


def field_choices(panels: PanelRegistry, bring: Callable[[str], None]) -> list[QtGui.QAction]:
    """Return one new action for each field of the clip panel, which gives it the keyboard."""
    panel, hint = cast("InspectorPanel", panels["inspector"]), "Go to the field of the clip panel"

    def go_to(cell: "FieldCell") -> None:
        bring(panel.name)
        panel.go_to(cell)

    return [
        choice_action(f"Edit: {cell.label.text()}", hint, partial(go_to, cell))
        for cell in panel.fields
    ]


def analysis_choices(document: Document, bring: Callable[[str], None]) -> Iterator[QtGui.QAction]:
    """Yield a new action for each view of Analysis, which brings the panel and shows it there."""

    def analyse(name: str) -> None:
        bring("analysis")
        document.look(with_settings(document.view, "analysis", AnalysisSettings(shown=name)))

    for spec in VIEWS:
        action = choice_action(f"Analysis: {spec.title}", spec.answer, partial(analyse, spec.name))
        action.setProperty(KEYWORDS, spec.answer.lower())
        yield action


def scene_choices(show: Callable[[str], None]) -> Iterator[QtGui.QAction]:
    """Yield a new action for each scene of the paper, which opens it."""
    for scene in scenes.all_scenes():
        yield choice_action(f"Scene: {scene.heading}", scene.title, partial(show, scene.name))


def design_choices(document: Document) -> list[QtGui.QAction]:
    """Return new actions: for each meaning of an amplitude, then for each kind of waveform."""
    design, chosen = document.design, document.view.selected_inputs

    def scale(scaling: str) -> None:
        document.apply(edits.change_scaling(document.design, document.view, scaling))

    def play(kind: str) -> None:
        document.apply(edits.change_kind(document.design, document.view, chosen, kind))

    known = drive_unit_known(design.limb, design.limb_digest)
    scalings = [
        choice_action(f"Scaling: {word.title}", tooltip(word.sentence), partial(scale, word.name))
        for word in scalings_on(drive_unit_known=known)
    ]
    hint = "Use for the selected inputs"
    waveforms = [
        choice_action(
            f"Waveform: {kind.title}", hint, partial(play, kind.__name__), there=bool(chosen)
        )
        for kind in kinds()
    ]
    return scalings + waveforms
