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


class ClipDrops(QObject):
    """Tells a panel that drags something where it would go in another one, which shows it.

    Parameters
    ----------
    panels
        All of a window, each of which gets to know whom to ask; the window is the parent.
    """

    def __init__(self, panels: PanelRegistry, parent: QObject) -> None:
        super().__init__(parent)
        self._panels = panels
        panels.each(self._meet)

    def _meet(self, panel: Panel) -> None:
        panel.held_over = partial(self._find, panel)

    def _find(self, dragged_from: Panel, at: QPoint | None) -> DropPlace | None:
        """Where something goes that is held over a place of the screen; None: it is let go."""
        below = None if at is None else QtWidgets.QApplication.widgetAt(at)
        drop_place = None
        for panel in self._panels:
            if panel is dragged_from:
                continue
            # Panels may float above each other: only what is on top takes anything.
            is_there = below is not None and (below is panel or panel.isAncestorOf(below))
            own = panel.mapFromGlobal(at) if is_there and at is not None else None
            panel.show_drop(own)
            if own is not None:
                drop_place = panel.drop_place(own)
        return drop_place


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

    def go_to(cell: "FieldCell", _checked: bool = False) -> None:
        bring(panel.name)
        panel.go_to(cell)

    return [
        choice_action(f"Edit: {cell.label.text()}", hint, partial(go_to, cell), None, there=True)
        for cell in panel.fields
    ]


def analysis_choices(document: Document, bring: Callable[[str], None]) -> Iterator[QtGui.QAction]:
    """Yield a new action for each view of Analysis, which brings the panel and shows it there."""
    for spec in VIEWS:
        analyse = partial(_analyse, document, bring, spec.name)
        action = choice_action(f"Analysis: {spec.title}", spec.answer, analyse, None, there=True)
        action.setProperty(KEYWORDS, spec.answer.lower())
        yield action


def scene_choices(show: Callable[[str], None]) -> Iterator[QtGui.QAction]:
    """Yield a new action for each scene of the paper, which opens it."""
    for scene in scenes.all_scenes():
        open_it = partial(lambda name, _checked=False: show(name), scene.name)
        yield choice_action(f"Scene: {scene.heading}", scene.title, open_it, None, there=True)


def kind_choices(document: Document) -> list[QtGui.QAction]:
    """Return one new action for each kind of waveform, which lets the selected inputs play it."""
    actions = []
    for kind in kinds():
        play = partial(_play, document, kind.__name__)
        there = bool(document.view.selected_inputs)
        hint = "Use for the selected inputs"
        actions.append(choice_action(f"Waveform: {kind.title}", hint, play, None, there=there))
    return actions


def scaling_choices(document: Document) -> list[QtGui.QAction]:
    """Return one new action for each meaning of an amplitude."""
    actions = []
    design = document.design
    for word in scalings_on(drive_unit_known=drive_unit_known(design.limb, design.limb_digest)):
        scale = partial(_scale, document, word.name)
        hint = tooltip(word.sentence)
        actions.append(choice_action(f"Scaling: {word.title}", hint, scale, None, there=True))
    return actions


def _analyse(
    document: Document, bring: Callable[[str], None], name: str, _checked: bool = False
) -> None:
    bring("analysis")
    document.look(with_settings(document.view, "analysis", AnalysisSettings(shown=name)))


def _scale(document: Document, scaling: str, _checked: bool = False) -> None:
    document.apply(edits.change_scaling(document.design, document.view, scaling))


def _play(document: Document, kind: str, _checked: bool = False) -> None:
    design, view = document.design, document.view
    document.apply(edits.change_kind(design, view, view.selected_inputs, kind))
