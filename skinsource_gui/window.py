"""The main window."""

import logging
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QByteArray, QEventLoop, Qt
from PySide6.QtGui import QAction, QGuiApplication
from PySide6.QtWidgets import QApplication, QDockWidget, QLabel, QMainWindow, QToolBar

from skinsource.design import Design
from skinsource.errors import SkinSourceError
from skinsource.quantities import new_graph
from skinsource.view import View
from skinsource_gui.arrangements import arrange_design
from skinsource_gui.commands import Commands
from skinsource_gui.conductor import Conductor
from skinsource_gui.document import Document
from skinsource_gui.engine import Engine, Outcome
from skinsource_gui.file_actions import FileActions
from skinsource_gui.menus import build_menus
from skinsource_gui.notice_bar import NoticeBar
from skinsource_gui.panel import Panel
from skinsource_gui.panels.hand import HandPanel
from skinsource_gui.panels.inputs import InputsPanel
from skinsource_gui.panels.inspector import InspectorPanel
from skinsource_gui.panels.spectra import SpectraPanel
from skinsource_gui.panels.surface import SurfacePanel
from skinsource_gui.panels.traces import TracesPanel
from skinsource_gui.preferences import Preferences
from skinsource_gui.setup_bar import SetupBar
from skinsource_gui.theme import THEMES, Theme, apply_theme

_log = logging.getLogger(__name__)


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
        self.engine = Engine(new_graph(), self)
        self.hand, self.skin = HandPanel(), SurfacePanel()
        self.inputs, self.inspector = InputsPanel(), InspectorPanel()
        self.traces, self.spectra = TracesPanel(), SpectraPanel()
        self.panels: tuple[Panel, ...] = (
            self.hand,
            self.skin,
            self.inspector,
            self.inputs,
            self.traces,
            self.spectra,
        )
        self.docks = {panel.name: self._dock(panel) for panel in self.panels}
        self.files = FileActions(self.document, preferences, self, lambda: self.saveState().data())
        self.commands = Commands(self)
        self.actions_by_name: dict[str, QAction] = build_menus(self, self.commands)
        self.notice = NoticeBar()
        self._impossible = False
        self.setup_bar = SetupBar(tuple(available_limbs))
        self._build_bars()
        self.conductor = Conductor(self.document, self.engine, self.panels)
        self._connect()
        self.use_theme(preferences.theme_name)
        self._restore(preferences.geometry, preferences.layout)
        self._show_state()
        self._show_title()

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
        for panel in self.panels:
            panel.show_theme(self._theme)
        self._show_state()

    def restore_arrangement(self, layout: bytes) -> None:
        """Put the docks where ``layout`` (from `saveState`) has them."""
        if layout:
            self.restoreState(QByteArray(layout))

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
        return dock

    def _build_bars(self) -> None:
        notices = self._bar("Notices")
        notices.addWidget(self.notice)
        notices.hide()
        self.notice.shown.connect(notices.setVisible)
        self.addToolBarBreak()
        bar = self._bar("Setup")
        bar.addWidget(self.setup_bar)
        bar.addSeparator()
        for name in ("undo", "redo"):
            bar.addAction(self.actions_by_name[name])
        bar.addSeparator()
        bar.addAction(self.actions_by_name["find_action"])
        self._timing, self._limb_note = QLabel(), QLabel()
        self._timing.setObjectName("timing")
        self._limb_note.setObjectName("limb_note")
        self.statusBar().addWidget(self._timing)
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
        self.setup_bar.design_edited.connect(self.document.edit)
        self.setup_bar.view_changed.connect(self.document.look)
        self.files.failed.connect(self.complain)
        self.files.opened.connect(self.restore_arrangement)
        self.conductor.failed.connect(self._show_impossible)
        self.conductor.delivered.connect(self._show_outcome)
        self.engine.finished.connect(self._log_fault)

    def complain(self, reason: str) -> None:
        """Show what went wrong, where the user looks."""
        self.notice.say(reason, "error")

    def _show_impossible(self, reason: str) -> None:
        self._impossible = True
        self.complain(reason)

    def _show_state(self) -> None:
        design = self.document.design
        self.setup_bar.show_state(design, self.document.view)
        self.actions_by_name["remove_delay"].setChecked(self.document.view.delay_removed)
        for name in ("duplicate_input", "remove_input"):
            self.actions_by_name[name].setEnabled(self.document.view.selected_input is not None)
        self.actions_by_name["clear_inputs"].setEnabled(bool(design.inputs))
        synthetic = design.limb.startswith("synthetic")
        self._limb_note.setText(
            "SYNTHETIC LIMB · measured ones: Help > Get the measured limbs…" if synthetic else ""
        )
        self._limb_note.setStyleSheet(f"color: {self._theme.warning}; font-weight: 600;")

    def _show_title(self) -> None:
        path = self.document.path
        self.setWindowTitle(f"{path.stem if path else 'Untitled'}[*] – SkinSource studio")
        self.setWindowModified(self.document.modified)

    def _show_outcome(self, outcome: Outcome) -> None:
        if self._impossible:
            self._impossible = False
            self.notice.be_quiet()
        inputs = self.document.design.inputs
        heard = f"{len(inputs)} input{'' if len(inputs) == 1 else 's'}"
        self._timing.setText(f"{heard} · computed in {outcome.compute_s * 1e3:.1f} ms · float64")

    def _log_fault(self, outcome: Outcome) -> None:
        if outcome.error is not None and not isinstance(outcome.error, SkinSourceError):
            _log.error("an evaluation failed", exc_info=outcome.error)

    def _restore(self, geometry: QByteArray, layout: QByteArray) -> None:
        if geometry.isEmpty() or not self.restoreGeometry(geometry):
            screen = self.screen().availableSize()
            self.resize(min(1600, screen.width()), min(940, screen.height()))
        arrange_design(self, self.docks)
        if not layout.isEmpty():
            self.restoreState(layout)

    def dragEnterEvent(self, event) -> None:
        if any(url.isLocalFile() for url in event.mimeData().urls()):
            event.acceptProposedAction()

    def dropEvent(self, event) -> None:
        paths = [Path(url.toLocalFile()) for url in event.mimeData().urls() if url.isLocalFile()]
        self.files.open(paths[0])

    def closeEvent(self, event) -> None:
        if not self.files.may_lose_changes():
            event.ignore()
            return
        self.preferences.geometry = self.saveGeometry()
        self.preferences.layout = self.saveState()
        self.preferences.flush()
        self.engine.close()
        super().closeEvent(event)


def _name_step(action: QAction, step: str) -> None:
    word = action.objectName().capitalize()
    action.setText(f"{word} {step[:1].lower()}{step[1:]}" if step else word)
    action.setIconText(word)
