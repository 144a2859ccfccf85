"""The main window, what is dragged between its panels, and the choices of its palette."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, cast

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QEventLoop, QKeyCombination, QObject, QPoint, Qt

from skinsource.design import edits
from skinsource.design.design import Design, View
from skinsource.design.edits.clips import of_each
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.effects import effect_kinds
from skinsource.design.labels import scalings_on
from skinsource.design.panel_settings import brush_of, with_settings
from skinsource.design.waveforms import kinds
from skinsource.engine.quantities import graphs_that_share
from skinsource.limbs.dataset.store import NOT_INSTALLED
from skinsource.limbs.own_limbs import drive_unit_known
from skinsource.studies import scenes
from skinsource_gui.fields.number_field import end_typing
from skinsource_gui.pages.actions import FileDrops, ImportActions, LibraryActions, SceneActions
from skinsource_gui.pages.dataset import TITLE
from skinsource_gui.pages.files.exports import ExportActions
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.panels.analysis.settings import VIEWS, AnalysisSettings
from skinsource_gui.qt.buttons import tool_button
from skinsource_gui.qt.frames import DropPlace
from skinsource_gui.qt.keys import KEYS, MOUSE
from skinsource_gui.qt.layouts import tooltip
from skinsource_gui.qt.questions import show_title
from skinsource_gui.shell import docks
from skinsource_gui.shell.actions import ACTIONS
from skinsource_gui.shell.appearance import Appearance, WindowFrame
from skinsource_gui.shell.bars import HeadLine, SetupBar, StepsMenu, choice_action
from skinsource_gui.shell.calibrating import Calibrating
from skinsource_gui.shell.carrying import PanelPictures
from skinsource_gui.shell.conditions import Conditions
from skinsource_gui.shell.focus import ShortcutsInFields, move_focus
from skinsource_gui.shell.keeping import AutosaveAndRecovery
from skinsource_gui.shell.menus import KEYWORDS, ActionSet, RecentMenu, fill_menu_bar
from skinsource_gui.shell.notices import FirstHints, Installations, Notice, Reports, RunningJobs
from skinsource_gui.shell.pages import Pages
from skinsource_gui.shell.panels import PANELS
from skinsource_gui.shell.playing import Playback
from skinsource_gui.shell.presenting import Presenter
from skinsource_gui.shell.status import Accuracy, JobBar, MatchNote, StatusLine
from skinsource_gui.shell.workspaces import LAB, WORKSPACES, Workspaces
from skinsource_gui.state.aiming import Aiming
from skinsource_gui.state.comparison import Comparison
from skinsource_gui.state.conductor import Conductor, PanelController
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import FirstPaintEngine
from skinsource_gui.state.job_runner import JobRunner, Levelling
from skinsource_gui.state.panel import PREPARING, Panel, PanelRegistry
from skinsource_gui.state.preferences import InstalledLimbs, Preferences
from skinsource_gui.state.services import Services

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
    """Asks how long the last selected clip is to last, and stretches all by its factor."""

    def __init__(self, document: Document, window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self._document, self._window = document, window

    def ask(self) -> None:
        """Ask for the new length of the clip that was selected last; stretch all with it."""
        design, view = self._document.design, self._document.view
        if view.selected_clip is None:
            return
        last_s, n_clips = design.clip(view.selected_clip).duration_s, len(view.selected_clips)
        title, label = "Stretch clip", "Length, ms"
        if n_clips > 1:
            title = f"Stretch {n_clips} clips"
            label = "Length of the last clip, ms; the others stretch by the same factor"
        label += "\nFrequencies shift unless the effect leaves them unchanged"
        show_title(self._window)
        length_ms, sure = QtWidgets.QInputDialog.getDouble(
            self._window, title, label, 1e3 * last_s, 1.0, 600e3, 1
        )

        def stretch(design: Design, view: View, id: int) -> Edit | Refusal:
            clip = design.clip(id)
            # What lasts 0 s is refused.
            length_s = length_ms / 1e3 * (clip.duration_s / last_s if last_s else 1.0)
            return edits.stretch_clip(design, view, id, clip.onset_s, clip.onset_s + length_s)

        if sure:
            self._document.apply(of_each(stretch, design, view, view.selected_clips))


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


def gesture_choices(
    panels: PanelRegistry, enter: Callable[[str], None], tell: Callable[[str], None]
) -> Iterator[QtGui.QAction]:
    """Yield a new action for each gesture, which presses the key of a panel, or says what to do."""

    def press(panel: Panel, key: str) -> None:
        enter(panel.name)
        pressed: QKeyCombination = QtGui.QKeySequence(key)[0]  # type: ignore[index]  # as in keys.py
        event = QtGui.QKeyEvent(QEvent.Type.KeyPress, pressed.key(), pressed.keyboardModifiers())
        QtWidgets.QApplication.sendEvent(panel.focusProxy() or panel, event)

    for place, group in (*KEYS.items(), *MOUSE.items()):
        for gesture in group.gestures.values():
            where = f" {group.heading.lower()}" if gesture.keys else ""
            act = partial(tell, f"{gesture.shown}{where}: {gesture.effect}")
            if place in panels and gesture.keys and " " not in gesture.shown:
                act = partial(press, panels[place], gesture.keys[0])
            text = f"{gesture.effect[:1].upper()}{gesture.effect[1:]}\t{gesture.shown}{where}"
            yield choice_action(text, group.heading, act)


def scene_choices(show: Callable[[str], None]) -> Iterator[QtGui.QAction]:
    """Yield a new action for each scene of the paper, which opens it."""
    for scene in scenes.all_scenes():
        yield choice_action(f"Scene: {scene.heading}", scene.title, partial(show, scene.name))


def design_choices(document: Document) -> list[QtGui.QAction]:
    """Return new actions: for each meaning of an amplitude, kind of waveform, and effect."""
    design, view = document.design, document.view
    inputs, clips = view.selected_inputs, view.selected_clips

    def scale(scaling: str) -> None:
        document.apply(edits.change_scaling(document.design, document.view, scaling))

    def play(kind: str) -> None:
        document.apply(edits.change_kind(document.design, document.view, inputs, kind))

    def add(kind: str) -> None:
        document.apply(edits.add_effect(document.design, document.view, clips, kind))

    known = drive_unit_known(design.limb, design.limb_digest)
    scalings = [
        choice_action(f"Scaling: {word.title}", tooltip(word.sentence), partial(scale, word.name))
        for word in scalings_on(drive_unit_known=known)
    ]
    hint, missing = "Use for the selected inputs", "" if inputs else "Select an input"
    waveforms = [
        choice_action(f"Waveform: {kind.title}", hint, partial(play, kind.__name__), missing)
        for kind in kinds()
    ]
    hint, missing = "Add to the selected clips", "" if clips else "Select a clip"
    effects = [
        choice_action(f"Effect: {kind.title}", hint, partial(add, kind.__name__), missing)
        for kind in effect_kinds()
    ]
    return scalings + waveforms + effects


_LARGEST_AT_FIRST = (1600, 940)
# Above and below the letters of the status bar: 24 px in letters of the usual size.
_AROUND_STATUS_PX = 10


class MainWindow(QtWidgets.QMainWindow):
    """Connects document, engine, panels and actions; decides nothing else."""

    def __init__(
        self,
        design: Design,
        *,
        preferences: Preferences,
        available_limbs: Sequence[str],
        view: View | None = None,
    ):
        super().__init__()
        self.setObjectName("studio")
        self.resize(*_LARGEST_AT_FIRST)
        self.setDockNestingEnabled(True)
        # Panels have a menu each.
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.NoContextMenu)
        self.preferences = preferences
        self.appearance = Appearance(preferences, self)
        self.document = Document(design, view, self)
        self.engine = FirstPaintEngine(graphs_that_share(), self)
        self.runner = JobRunner(self)
        self.panels = PanelRegistry({spec.panel.name: spec.panel for spec in PANELS})
        titles = {spec.panel.name: spec.panel.title for spec in PANELS}
        self.docks = {name: docks.Dock(name, titles[name], self.panels, self) for name in titles}
        self.limbs = InstalledLimbs(tuple(available_limbs), self.document, self)
        self.notice = Notice(self)
        self.hints = FirstHints(preferences, self.notice, self.document)
        self.setup_bar = SetupBar(self.document)
        self._menus = QtWidgets.QMenuBar()
        self.status_line = StatusLine(self)
        self.job_bar = JobBar(self.runner)
        self.accuracy = Accuracy(self.engine, self)
        self.reports = Reports(
            self.document, self.notice, self.statusBar(), self.status_line, self.accuracy
        )
        services = Services(
            window=self,
            document=self.document,
            engine=self.engine,
            panels=self.panels,
            runner=self.runner,
            preferences=preferences,
            limbs=self.limbs,
        )
        self._make_capabilities(services)
        self.action_set = ActionSet(ACTIONS, self.document, self._capabilities(), self)
        self.actions_by_name = self.action_set.by_name
        ShortcutsInFields(self.actions_by_name.values(), self)
        self._build()
        self.conductor = Conductor(self.document, self.engine, self.panels)
        PanelController(self.document, self.panels)
        self.comparison.begin()
        self._connect()
        self.appearance.apply()
        self.panels.each(self._install)
        self.workspaces.restore()
        self._show_limbs()
        self._show_state()

    def panel(self, name: str) -> Panel:
        """Return the panel of that name, which is made now if it was not in sight before."""
        return self.panels[name]

    def do(self, name: str) -> None:
        """Trigger the action ``name``, if it is enabled."""
        self.actions_by_name[name].trigger()

    def close_unasked(self) -> None:
        """Close without a question; unsaved work is lost."""
        self.running_jobs.end()
        self.document.mark_saved(self.document.path)
        self.close()

    def catch_up(self) -> None:
        """Wait until the panels show the present design."""
        loop = QEventLoop()
        self.engine.rested.connect(loop.quit)
        while self.engine.busy:
            loop.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)

    def _make_capabilities(self, services: Services) -> None:
        self.workspaces = Workspaces(self, self.docks, self.preferences, self.appearance)
        self.dock_tabs = docks.DockTabs(self, self.docks)
        self.files = FileActions(self.document, self.preferences, self, self.workspaces.content)
        self._in_use = docks.PanelInUse(self, self.docks, self.panels, self.dock_tabs)
        self.pictures = PanelPictures(
            services, self.appearance, self.catch_up, self.docks, self._in_use
        )
        self.exports = ExportActions(services, self.files, self.pictures.picture_of)
        self.scenes = SceneActions(services, self.files, self.workspaces.show_scene)
        self.comparison = Comparison(self.document, self.engine, self.panels)
        self.keeping = AutosaveAndRecovery(services, self.files, self.workspaces)
        self.imports = ImportActions(services)
        self.library = LibraryActions(self.document, self)
        self.playback = Playback(self.document, self.preferences, self)
        self.running_jobs = RunningJobs(self.runner, self)
        self.levelling = Levelling(self.document, self.runner, self)
        self.aiming = Aiming(services, self.workspaces.bring)
        self.calibrating = Calibrating(
            services, self.playback.player, partial(self.workspaces.choose, LAB)
        )
        self.presenter = Presenter(
            services, self.files, self.workspaces, lambda: self.actions_by_name
        )
        self.pages = Pages(services, self._findable, self._in_use, self.status_line)

    def _capabilities(self) -> dict[str, QObject]:
        # By the names that the table of actions has for them.
        self._panel_focus = docks.PanelFocus(self.panels, self.docks, self)
        return {
            "files": self.files,
            "exports": self.exports,
            "imports": self.imports,
            "scenes": self.scenes,
            "library": self.library,
            "keeping": self.keeping,
            "comparison": self.comparison,
            "jobs": self.runner,
            "levelling": self.levelling,
            "aiming": self.aiming,
            "calibrating": self.calibrating,
            **self.playback.capabilities(),
            "steps": self.document.undo_stack,
            "workspaces": self.workspaces,
            "dock_tabs": self.dock_tabs,
            "panel_focus": self._panel_focus,
            "panel_in_use": self._in_use,
            "clip_stretching": ClipStretching(self.document, self),
            "appearance": self.appearance,
            "pages": self.pages,
            "frame": WindowFrame(self, self.document),
            "presenter": self.presenter,
            "hints": self.hints,
        }

    def _build(self) -> None:
        actions = self.actions_by_name
        recent = RecentMenu(self.preferences, self)
        recent.chosen.connect(self.files.open)
        panels = docks.menu_toggles(self.docks.values(), self)
        steps = StepsMenu(self.document, self)
        submenus = {"open_design": recent, "redo": steps}
        fill_menu_bar(self._menus, ACTIONS, actions, submenus, panels)
        self.addActions([actions[spec.name] for spec in ACTIONS if not spec.menu])
        choices = [actions[f"arrange_{workspace.name}"] for workspace in WORKSPACES]
        self._head = HeadLine(
            self._menus, actions, steps, self.playback.bar, choices, self.setup_bar
        )
        self.setMenuWidget(self._head)
        bar = self.statusBar()
        bar.setSizeGripEnabled(False)
        # Widgets that are not permanent would give way to messages, which the line shows.
        bar.addPermanentWidget(self.status_line, 1)
        self._match_note = MatchNote([actions["keep_match_gain"], actions["match_levels"]])
        for widget in (self._match_note, self.job_bar):
            bar.addPermanentWidget(widget)
        self.conditions = Conditions(self.document, self.engine, self.panels, bar)
        texts = f"{TITLE}…", NOT_INSTALLED
        self._get_limbs = tool_button(bar, "get_limbs", *texts, takes_keyboard=False)
        self._get_limbs.clicked.connect(self.pages.show_dataset)
        bar.addPermanentWidget(self._get_limbs)
        bar.addPermanentWidget(self.playback.button)

    def _install(self, panel: Panel) -> None:
        """Connect a panel that was just made, after all others have met it, and show it."""
        panel.action_requested.connect(self.do)
        panel.failed.connect(self.reports.complain)
        panel.done.connect(self.reports.report)
        panel.written.connect(self.files.note_written)
        self.files.folder_changed.connect(panel.show_folder)
        panel.show_folder(self.preferences.folder)
        if panel.needs:
            panel.show_problem(PREPARING)
        self.docks[panel.name].hold(panel)

    def _connect(self) -> None:
        document, reports = self.document, self.reports
        document.changed.connect(self._show_state)
        document.refused.connect(reports.refuse)
        self.action_set.edited.connect(document.apply)
        to_timeline = partial(self._panel_focus.enter, "timeline")
        self.actions_by_name["add_input"].triggered.connect(to_timeline)
        self.appearance.changed.connect(self._check_theme)
        self.appearance.changed.connect(self._fit_status_bar)
        self.workspaces.shown.connect(self._check_workspace)
        self.files.started_over.connect(self.workspaces.leave_scene)
        self.scenes.opened.connect(self.presenter.note_scene)
        self.files.show_wanted.connect(self.presenter.open_file)
        self.workspaces.shown.connect(lambda name: self.hints.put_away(name != "design"))
        self.presenter.presenting_changed.connect(self.notice.pass_now)
        for lab in (self.calibrating, self.playback.player.settings):
            lab.changed.connect(self._offer_lab)
        self._offer_lab()
        saving = self.files, self.scenes, self.library, self.presenter
        for fails in (*saving, self.exports, self.levelling):
            fails.failed.connect(reports.complain)
        for works in (*saving, self.imports, self.comparison, self.dock_tabs):
            works.done.connect(reports.report)
        self.imports.risk_ahead.connect(self.keeping.autosave.keep_now)
        pass_drops_on(self.panels)
        drops = FileDrops(self, self.panels)
        drops.design_dropped.connect(self.files.open)
        drops.recordings_dropped.connect(self.imports.open_pages)
        drops.failed.connect(reports.complain)
        drops.preset_dropped.connect(self.library.place_file)
        self.playback.connect_to(self.panels, reports)
        self.keeping.connect_to(self.conductor, reports)
        self.running_jobs.show_on(self.actions_by_name["cancel_job"])
        self.playback.button.clicked.connect(partial(self.do, "show_output"))
        self.conductor.failed.connect(reports.show_impossible)
        self.conductor.delivered.connect(reports.show_outcome)
        self.conductor.stale.connect(self.status_line.show_stale)
        self.accuracy.checked.connect(self.status_line.show_error)
        self.engine.finished.connect(reports.log_fault)
        Installations(self.runner, self.limbs, reports)
        # With other limbs, predictions that failed are tried again.
        for follow in (self._show_limbs, self.comparison.forget_problems, document.changed):
            self.limbs.changed.connect(follow)

    def _findable(self) -> list[QtGui.QAction]:
        others = [action for name, action in self.actions_by_name.items() if name != "find_action"]
        panels = docks.toggles(self.docks.values())
        fields = field_choices(self.panels, self.workspaces.bring)
        views = analysis_choices(self.document, self.workspaces.bring)
        choices = *self.setup_bar.choices(), *design_choices(self.document)
        figures = scene_choices(self.scenes.open)
        gestures = gesture_choices(self.panels, self._panel_focus.enter, self.reports.report)
        return [*fields, *others, *panels, *views, *choices, *figures, *gestures]

    def _show_state(self) -> None:
        design, view = self.document.design, self.document.view
        self.setup_bar.show_state()
        self.status_line.show_state(design, view)
        self._match_note.show_state(design, view)

    def _check_theme(self) -> None:
        name = self.preferences.theme_name
        known = f"use_{name}_theme" in self.actions_by_name
        self.actions_by_name[f"use_{name if known else 'system'}_theme"].setChecked(True)

    def _fit_status_bar(self) -> None:
        bar = self.statusBar()
        bar.setFixedHeight(bar.fontMetrics().height() + _AROUND_STATUS_PX)

    def _check_workspace(self, name: str) -> None:
        self.actions_by_name[f"arrange_{name}"].setChecked(True)

    def _offer_lab(self) -> None:
        self._head.workspaces.offer_last(
            bool(self.preferences.rig_path) or self.preferences.stand_in
        )

    def _show_limbs(self) -> None:
        self.setup_bar.show_available(self.limbs.names)
        self._get_limbs.setHidden(any(name.startswith("measured-") for name in self.limbs.names))

    def menuBar(self) -> QtWidgets.QMenuBar:
        # Qt would make another one in place of the line that holds it.
        return self._menus

    def focusNextPrevChild(self, forward: bool) -> bool:
        bars = self.notice.card, self.playback.bar, self._head
        regions = (*bars, *self.panels, self.statusBar())
        return move_focus(self, regions, forward=forward)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and brush_of(self.document.view):
            self.do("aim")
        else:
            super().keyPressEvent(event)

    def closeEvent(self, event: QtGui.QCloseEvent) -> None:
        end_typing()
        lossless = self.files.may_lose_changes() and self.calibrating.may_lose()
        if not (lossless and self.running_jobs.may_close()):
            event.ignore()
            return
        self.keeping.end()
        self.workspaces.close()
        self.engine.close()
        parts = self.playback, self.running_jobs, self.pages, self.imports, self.exports
        for part in (*parts, self.aiming):
            part.end()
        super().closeEvent(event)
