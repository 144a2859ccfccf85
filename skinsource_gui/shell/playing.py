"""Playback in the window: transport, panic key, rigs, and the connection of player and panel."""

from functools import partial
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, cast

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QSize, Qt, QTimer, Signal

from skinsource import actuators
from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.actuators.equalising import PolePairReplacement, RegularisedInverse
from skinsource.base.errors import printable
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit
from skinsource.design.edits.setup import choose_actuation, choose_rig
from skinsource.design.panel_settings import STAGE
from skinsource_gui import pages
from skinsource_gui.fields.rig_field import RESPONSE_FILES
from skinsource_gui.pages.actions import MatchingActions
from skinsource_gui.qt.keys import shortcut_text
from skinsource_gui.qt.layouts import Policy, in_row, named, tooltip
from skinsource_gui.qt.questions import ask_open
from skinsource_gui.qt.theme import icon_of, set_tone
from skinsource_gui.shell.focus import KeyboardFilter
from skinsource_gui.shell.notices import Reports
from skinsource_gui.state.document import Document
from skinsource_gui.state.panel import Panel, PanelRegistry
from skinsource_gui.state.playing import (
    PlaybackPace,
    Played,
    Player,
    end_sound,
    played_by,
    sound_worker,
)
from skinsource_gui.state.preferences import Preferences

if TYPE_CHECKING:
    from skinsource.actuators.measured_response import MeasuredResponse
    from skinsource_gui.panels.compare.stage import StagePanel
    from skinsource_gui.panels.output.panel import OutputPanel


_WITHIN_S = 0.6


class EscapeTwice(KeyboardFilter):
    """Emits when Esc is pressed twice, whatever it means to the widget with the keyboard.

    Parameters
    ----------
    window
        It listens there if no widget has the keyboard; also the parent.
    """

    #: Esc was pressed twice within 0.6 s.
    pressed = Signal()

    def __init__(self, window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._on = False
        self._last_s = -_WITHIN_S

    def listen(self, on: bool) -> None:
        """Begin or stop to listen."""
        if on == self._on:
            return
        self._on, self._last_s = on, -_WITHIN_S
        self.follow(on)

    def wanted(self, focused: QtWidgets.QWidget | None) -> QtWidgets.QWidget | None:
        return focused or self._window

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # Each press sends one of these, wherever it goes then.
        if (
            event.type() == QEvent.Type.ShortcutOverride
            and isinstance(event, QtGui.QKeyEvent)
            and not event.isAutoRepeat()
        ):
            escape, now_s = event.key() == Qt.Key.Key_Escape, monotonic()
            twice = escape and now_s - self._last_s <= _WITHIN_S
            self._last_s = now_s if escape and not twice else -_WITHIN_S
            if twice:
                self.pressed.emit()
        return super().eventFilter(watched, event)


# The panel of all that is played on, and the longest title of an actuator.
_PANEL, _LONGEST_TITLE = "output", 100


class RigPages(QObject):
    """Opens the page of rigs, and measured responses of actuators."""

    #: Why a response was not opened.
    failed = Signal(str)
    #: A message on what was opened.
    opened = Signal(str)

    def __init__(self, document: Document, player: Player, window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self._document, self._player, self._window = document, player, window
        self._thread = sound_worker(self)

    def show(self) -> None:
        """Open the page."""
        pages.RigPage(self._document, self._player.settings, self._window).open()

    def check_wiring(self) -> None:
        """Open the page that checks the wiring."""
        pages.WiringPage(self._document, self._player, self._window).open()

    def open_response(self) -> None:
        """Ask for a measured response, and choose it as the actuator of the design."""
        path = ask_open(self._window, "Response of the actuator", RESPONSE_FILES)
        if path is not None:
            self._thread.run(
                partial(actuators.measuring.open_response, path), partial(self._look_at, path)
            )

    def end(self) -> None:
        """Open nothing more."""
        end_sound(self._thread)

    def _look_at(
        self, path: Path, response: "MeasuredResponse | None", error: Exception | None
    ) -> None:
        if response is None:
            self.failed.emit(str(error))
            return
        design, view = self._document.design, self._document.view
        actuator = ActuatorAt(actuator=path.stem[:_LONGEST_TITLE], model=response)
        known = design.actuation
        equaliser = RegularisedInverse() if known is None else known.equaliser
        if isinstance(equaliser, PolePairReplacement):
            equaliser = RegularisedInverse()
        actuation = Actuation(actuators=(actuator,), equaliser=equaliser)
        chosen = choose_actuation(design, view, actuation)
        self._document.apply(chosen)
        if isinstance(chosen, Edit):
            self.opened.emit(f"Opened {printable(path.name)}.")


_PLAY = "Animate or stop", "No actuator moves."
_REPEAT = "Repeat", "A loop on the ruler repeats what starts before its end."


class Transport(QtWidgets.QWidget):
    """Animate and repeat, in the bar above the panels."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("transport")
        self._playing = False
        self.play = self._button("play_button", "play", *_PLAY)
        self.repeat = self._button("repeat_button", "repeat", *_REPEAT)
        self.repeat.setCheckable(True)
        in_row(self.play, self.repeat, of=self, margins=0, gap_px=0)
        self.setSizePolicy(Policy.Fixed, Policy.Fixed)
        self._show_icons()

    def show_played(self, played: Played) -> None:
        """Take over the state of playback."""
        if played.playing != self._playing:
            self._playing = played.playing
            self._show_icons()
        self.repeat.setChecked(played.loops)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._show_icons()

    def _show_icons(self) -> None:
        self.play.setIcon(icon_of("stop" if self._playing else "play"))
        self.play.setAccessibleName("Stop" if self._playing else "Animate")
        self.repeat.setIcon(icon_of("repeat"))

    def _button(self, name: str, action: str, title: str, hint: str) -> QtWidgets.QToolButton:
        title = f"{title} ({shortcut_text(action)})"
        button = named(QtWidgets.QToolButton(self), name, title, tooltip(title, hint))
        button.setIconSize(QSize(16, 16))
        return button


_TITLE_EM = 28
_STATES = {
    "off": "Actuators off",
    "armed": "Actuators armed",
    "preparing": "Preparing…",
    "playing": "Actuators playing",
}


class OutputButton(QtWidgets.QToolButton):
    """Says in the status bar what lies between the design and the skin, and whether it moves."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("output_button")
        self.setAutoRaise(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setToolTip(f"Actuator, equaliser, rig and device ({shortcut_text('show_output')})")

    def show_state(self, design: Design, played: Played) -> None:
        """Show what is chosen, and the state of the actuators."""
        chosen = design.rig.title or "rig" if design.rig is not None else "none"
        if design.actuation is not None:
            chosen = design.actuation.title
        state = _STATES[played.actuators]
        metrics, elide = self.fontMetrics(), Qt.TextElideMode.ElideRight
        cut = metrics.elidedText(chosen, elide, _TITLE_EM * metrics.horizontalAdvance("m"))
        self.setText(f"Output: {cut} · {state}")
        self.setAccessibleName(f"Output: {chosen} · {state}")
        set_tone(self, "dim" if played.actuators == "off" else "warning")


# How often levels are shown.
_STEP_MS = 50


class Playback(QObject):
    """Connects the player of a window with its bar, its panel and the reports.

    Parameters
    ----------
    document
        What is played.
    preferences
        Where it is kept what this machine plays on.
    window
        The parent.

    Attributes
    ----------
    player, pace, bar, button, matching
        Who plays; how fast; what asks for it above the panels; what leads to the panel; who opens
        the matching page.
    """

    def __init__(
        self, document: Document, preferences: Preferences, window: QtWidgets.QWidget
    ) -> None:
        super().__init__(window)
        self._document = document
        self.player = Player(document, preferences, self)
        self.pace = PlaybackPace(document, self.player, self)
        self.bar, self.button = Transport(window), OutputButton()
        self.matching = MatchingActions(document, preferences, self.player, window)
        self.rigs = RigPages(document, self.player, window)
        self._panel: OutputPanel | None = None
        self._timer = QTimer(self, interval=_STEP_MS)
        self._timer.timeout.connect(self._show)
        self._escape = EscapeTwice(window)
        self._escape.pressed.connect(self.player.stop_at_once)

    def capabilities(self) -> dict[str, QObject]:
        """Return the objects that carry out its actions, by their names in the table of actions."""
        return {
            "player": self.player,
            "gain": self.player.gain,
            "pace": self.pace,
            "matching": self.matching,
            "rigs": self.rigs,
        }

    def end(self) -> None:
        """Stop for good, and release the device."""
        self.matching.end()
        self.rigs.end()
        self.player.end()

    def connect_to(self, panels: PanelRegistry, reports: Reports) -> None:
        """Connect the bar, the panel once it is made, and ``reports``."""
        player, bar = self.player, self.bar
        bar.play.clicked.connect(player.play_or_stop)
        bar.repeat.clicked.connect(player.toggle_loop)
        player.changed.connect(self._follow)
        player.failed.connect(reports.complain)
        self.rigs.failed.connect(reports.complain)
        # An error of the file before is over.
        self.rigs.opened.connect(reports.report)
        player.message.connect(reports.explain)
        panels.each(self._meet)
        self._document.changed.connect(self._show)
        self._follow()

    def _meet(self, panel: Panel) -> None:
        player = self.player
        player.playhead.running.connect(panel.show_running)
        if panel.name == STAGE:
            stage = cast("StagePanel", panel)
            self.pace.on_stage = lambda: stage.isVisible() * stage.moving.slow_motion
        if panel.name != _PANEL:
            return
        self._panel = panel = cast("OutputPanel", panel)
        for part in (panel.fields, panel.rows):
            part.output_requested.connect(player.settings.choose)
        panel.fields.rescan.clicked.connect(player.settings.look)
        panel.fields.rig.rig_chosen.connect(self._choose_rig)
        panel.fields.gain.edited.connect(lambda gain_db, _: player.gain.put(gain_db))
        panel.rows.tone_requested.connect(player.play_tone)
        panel.arm.clicked.connect(player.arm)
        panel.visibility_changed.connect(self._look)

    def _follow(self) -> None:
        playing = self.player.playing
        self._escape.listen(playing)
        if playing and not self._timer.isActive():
            self._timer.start()
        elif not playing:
            self._timer.stop()
        self._show()

    def _show(self) -> None:
        played = played_by(self.player, self._document.design)
        self.bar.show_played(played)
        self.button.show_state(self._document.design, played)
        if self._panel is not None and self._panel.isVisible():
            self._panel.show_played(played)

    def _choose_rig(self, path: Path | None) -> None:
        """Use the rig of a file, or none, for this machine and the design."""
        settings = self.player.settings
        if settings.choose_rig(path):
            design, view = self._document.design, self._document.view
            self._document.apply(choose_rig(design, view, settings.rig))

    def _look(self) -> None:
        """Look for rig and devices when the panel is first in sight."""
        if self._panel is not None and self._panel.isVisible():
            self.player.settings.look_for_rig()
            self._show()
            if not self.player.settings.searched and not self.player.playing:
                self.player.settings.look()
