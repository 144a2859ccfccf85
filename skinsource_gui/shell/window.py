"""The main window."""

import logging
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QByteArray, QEventLoop, Qt
from PySide6.QtGui import QAction, QGuiApplication
from PySide6.QtWidgets import QAbstractButton, QApplication, QDockWidget, QMainWindow, QToolBar

from skinsource.design import Design
from skinsource.errors import SkinSourceError
from skinsource.quantities import new_graph
from skinsource.view import View
from skinsource_gui.files.file_actions import FileActions
from skinsource_gui.panel import Panel
from skinsource_gui.panels.hand.panel import HandPanel
from skinsource_gui.panels.inputs.panel import InputsPanel
from skinsource_gui.panels.inspector.panel import InspectorPanel
from skinsource_gui.panels.skin.panel import SkinPanel
from skinsource_gui.panels.spectra.panel import SpectraPanel
from skinsource_gui.panels.traces.panel import TracesPanel
from skinsource_gui.shell.arrangements import arrange_design
from skinsource_gui.shell.commands import Commands
from skinsource_gui.shell.focus_order import move_focus
from skinsource_gui.shell.menus import build_menus
from skinsource_gui.shell.notice_bar import NoticeBar
from skinsource_gui.shell.setup_bar import SetupBar
from skinsource_gui.state.conductor import Conductor
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Outcome
from skinsource_gui.state.installed_limbs import InstalledLimbs
from skinsource_gui.state.patient_engine import PatientEngine
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.status.accuracy import Accuracy
from skinsource_gui.status.limb_note import LimbNote
from skinsource_gui.status.status_line import StatusLine
from skinsource_gui.theme import THEMES, Theme, apply_theme

_log = logging.getLogger(__name__)
_REPORT_MS = 5000
_PREPARING = "Preparing…"
_DOCK_BUTTONS = {
    "qt_dockwidget_closebutton": "Hide this panel; View > Panels brings it back",
    "qt_dockwidget_floatbutton": "Take this panel out of the window, or back into it",
}


class MainWindow(QMainWindow):
    """Puts document, engine, panels and menus together; decides nothing else."""

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
        self.resize(1366, 728)
        self.setDockNestingEnabled(True)
        self.setAcceptDrops(True)
        self.preferences = preferences
        self.document = Document(design, view, self)
        self.engine = PatientEngine(new_graph(), self)
        self.hand, self.skin = HandPanel(), SkinPanel()
        self.inputs, self.inspector = InputsPanel(), InspectorPanel()
        self.traces, self.spectra = TracesPanel(), SpectraPanel()
        # In the order in which the keyboard reaches them.
        self.panels: tuple[Panel, ...] = (
            self.hand,
            self.inputs,
            self.inspector,
            self.skin,
            self.traces,
            self.spectra,
        )
        self.docks = {panel.name: self._dock(panel) for panel in self.panels}
        self.files = FileActions(self.document, preferences, self, lambda: self.saveState().data())
        self.commands = Commands(self)
        self.actions_by_name: dict[str, QAction] = build_menus(self, self.commands)
        self.commands.exports.show_state()
        self.notice = NoticeBar()
        self._impossible = ""
        self._heights: dict[QDockWidget, int] = {}
        self.limbs = InstalledLimbs(tuple(available_limbs), self)
        self.setup_bar = SetupBar()
        self.status_line = StatusLine(self, self.engine)
        self.accuracy = Accuracy(self.engine, self)
        self._limb_note = LimbNote()
        self._notices = self._bar("Notices")
        self._build_bars()
        self.conductor = Conductor(self.document, self.engine, self.panels)
        self._connect()
        self.use_theme(preferences.theme_name)
        self._restore(preferences.geometry, preferences.layout)
        self._show_limbs()
        self._show_state()
        self._show_title()
        for panel in (self.skin, self.inspector, self.traces, self.spectra):
            panel.show_problem(_PREPARING)

    @property
    def theme(self) -> Theme:
        """The colours in use."""
        return self._theme

    def use_theme(self, name: str) -> None:
        """Take over ``"light"``, ``"dark"`` or ``"system"``, and remember it."""
        self.preferences.theme_name = name
        dark = QGuiApplication.styleHints().colorScheme() == Qt.ColorScheme.Dark
        self._theme = THEMES.get(name, THEMES["dark" if dark else "light"])
        application = QApplication.instance()
        if isinstance(application, QApplication):
            apply_theme(application, self._theme)
        self.notice.show_theme(self._theme)
        self._limb_note.show_theme(self._theme)
        self.status_line.show_theme(self._theme)
        self.actions_by_name[f"use_{name if name in THEMES else 'system'}_theme"].setChecked(True)
        for panel in self.panels:
            panel.show_theme(self._theme)
        self._show_state()

    def restore_arrangement(self, layout: bytes) -> None:
        """Put the docks where ``layout`` (from `saveState`) has them."""
        if layout:
            self.restoreState(QByteArray(layout))
        # What was saved may have been said then.
        self._notices.setVisible(bool(self.notice.text))

    def catch_up(self) -> None:
        """Wait until the panels show the present design."""
        loop = QEventLoop()
        self.engine.finished.connect(loop.quit)
        while self.engine.busy:
            loop.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)

    def _dock(self, panel: Panel) -> QDockWidget:
        dock = QDockWidget(panel.title, self)
        dock.setObjectName(panel.name)
        dock.setWidget(panel)
        for name, hint in _DOCK_BUTTONS.items():
            button = dock.findChild(QAbstractButton, name)
            button.setToolTip(hint)
        return dock

    def _build_bars(self) -> None:
        self._notices.addWidget(self.notice)
        self._notices.hide()
        self.notice.shown.connect(self._make_room_for_notice)
        self.addToolBarBreak()
        bar = self._bar("Setup")
        bar.addWidget(self.setup_bar)
        bar.addSeparator()
        for name in ("undo", "redo"):
            bar.addAction(self.actions_by_name[name])
        bar.addSeparator()
        bar.addAction(self.actions_by_name["find_action"])
        self.statusBar().addWidget(self.status_line, 1)
        self.statusBar().addPermanentWidget(self._limb_note)

    def _bar(self, title: str) -> QToolBar:
        bar = QToolBar(title, self)
        bar.setObjectName(title.lower())
        bar.setMovable(False)
        bar.toggleViewAction().setVisible(False)
        bar.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        self.addToolBar(bar)
        return bar

    def _connect(self) -> None:
        self.document.changed.connect(self._show_state)
        self.document.title_changed.connect(self._show_title)
        history = self.document.undo_stack
        for name, can_change, text_change in (
            ("undo", history.canUndoChanged, history.undoTextChanged),
            ("redo", history.canRedoChanged, history.redoTextChanged),
        ):
            action = self.actions_by_name[name]
            action.setEnabled(False)
            can_change.connect(action.setEnabled)
            text_change.connect(partial(_name_step, action))
        self.setup_bar.edited.connect(self.document.apply)
        self.document.refused.connect(self.complain)
        self.setup_bar.view_changed.connect(self.document.look)
        self.skin.picture_wanted.connect(self.commands.export_picture)
        self.files.failed.connect(self.complain)
        self.files.done.connect(self._report)
        self.files.opened.connect(self.restore_arrangement)
        self._limb_note.help_wanted.connect(self.commands.show_dataset_help)
        QGuiApplication.styleHints().colorSchemeChanged.connect(self._follow_desktop)
        self.conductor.failed.connect(self._show_impossible)
        self.conductor.delivered.connect(self._show_outcome)
        self.accuracy.checked.connect(self.status_line.show_error)
        self.engine.finished.connect(self._log_fault)
        self.limbs.changed.connect(self._show_limbs)
        # What could not be computed before is tried again.
        self.limbs.changed.connect(self.document.changed)

    def complain(self, reason: str) -> None:
        """Show what went wrong, where the user looks."""
        self.statusBar().clearMessage()
        self.notice.say(reason, "error")

    def _make_room_for_notice(self, shown: bool) -> None:
        docks = [one for one in self.docks.values() if one.isVisible() and not one.isFloating()]
        if shown and not self._notices.isVisible():
            self._heights = {dock: dock.height() for dock in docks}
        self._notices.setVisible(shown)
        if not shown:
            # Without this, docks would share the room anew.
            same = [dock for dock in docks if dock in self._heights]
            heights = [self._heights[dock] for dock in same]
            self.resizeDocks(same, heights, Qt.Orientation.Vertical)

    def _report(self, words: str) -> None:
        self.notice.be_quiet()
        self.statusBar().showMessage(words, _REPORT_MS)

    def _show_impossible(self, reason: str) -> None:
        self._impossible = reason
        self.status_line.show_no_outcome()
        self.complain(reason)

    def _follow_desktop(self) -> None:
        if self.preferences.theme_name == "system":
            self.use_theme("system")

    def _show_state(self) -> None:
        design, view, actions = self.document.design, self.document.view, self.actions_by_name
        self.setup_bar.show_state(design, view)
        self.status_line.show_design(design)
        self._limb_note.show_limb(design.limb)
        actions["remove_delay"].setChecked(view.delay_removed)
        selected = None if view.selected_input is None else design.input(view.selected_input)
        for name in ("duplicate_input", "remove_input", "mute_input", "solo_input"):
            actions[name].setEnabled(selected is not None)
        actions["mute_input"].setChecked(selected is not None and selected.muted)
        actions["solo_input"].setChecked(selected is not None and selected.solo)
        actions["clear_inputs"].setEnabled(bool(design.inputs))
        actions["select_no_outputs"].setEnabled(bool(view.outputs))

    def _show_limbs(self) -> None:
        self.setup_bar.show_available(self.limbs.names)
        self._limb_note.show_available(self.limbs.names)

    def _show_title(self) -> None:
        path = self.document.path
        self.setWindowTitle(f"{path.stem if path else 'Untitled'}[*] – SkinSource studio")
        self.setWindowModified(self.document.modified)

    def _show_outcome(self, outcome: Outcome) -> None:
        if self._impossible and self.notice.text == self._impossible:
            self.notice.be_quiet()
        self._impossible = ""
        self.status_line.show_outcome(outcome)
        self.accuracy.show_outcome(outcome)

    def _log_fault(self, outcome: Outcome) -> None:
        if outcome.error is not None and not isinstance(outcome.error, SkinSourceError):
            _log.error("an evaluation failed", exc_info=outcome.error)

    def _restore(self, geometry: QByteArray, layout: QByteArray) -> None:
        if geometry.isEmpty() or not self.restoreGeometry(geometry):
            screen = self.screen().availableSize()
            self.resize(min(1600, screen.width()), min(940, screen.height()))
        arrange_design(self, self.docks)
        self.restore_arrangement(layout.data())

    def focusNextPrevChild(self, forward: bool) -> bool:
        regions = (self._notices, self.setup_bar, *self.panels, self.statusBar())
        return move_focus(self, regions, forward=forward)

    def dragEnterEvent(self, event) -> None:
        if any(url.isLocalFile() for url in event.mimeData().urls()):
            event.acceptProposedAction()

    def dropEvent(self, event) -> None:
        paths = [Path(url.toLocalFile()) for url in event.mimeData().urls() if url.isLocalFile()]
        self.files.open(paths[0])

    def closeEvent(self, event) -> None:
        if not (self.files.may_lose_changes() and self.commands.exports.may_close()):
            event.ignore()
            return
        self.preferences.geometry = self.saveGeometry()
        self.preferences.layout = self.saveState()
        self.preferences.flush()
        self.engine.close()
        self.commands.end()
        super().closeEvent(event)


def _name_step(action: QAction, step: str) -> None:
    word = action.objectName().capitalize()
    action.setText(f"{word} {step[:1].lower()}{step[1:]}" if step else word)
    action.setIconText(word)
