"""Brings what is played to those who show it, and what they want to the player."""

from typing import TYPE_CHECKING, cast

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QWidget

from skinsource_gui.made_panels import MadePanels
from skinsource_gui.matching_page.matching_actions import MatchingActions
from skinsource_gui.panel import Panel
from skinsource_gui.shell.playing.escape_twice import EscapeTwice
from skinsource_gui.shell.playing.rig_pages import RigPages
from skinsource_gui.shell.playing.transport import Transport
from skinsource_gui.shell.reports import Reports
from skinsource_gui.state.document import Document
from skinsource_gui.state.playing.pace import Pace
from skinsource_gui.state.playing.played_by import played_by
from skinsource_gui.state.playing.player import Player
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.status.preparing_note import PreparingNote

if TYPE_CHECKING:
    from skinsource_gui.panels.playback.panel import PlaybackPanel

_PANEL = "playback"
# How often levels are shown.
_STEP_MS = 50


class Playback(QObject):
    """The player of one window, its bar and its panel; costs nothing while nothing is played.

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
    player, pace, bar, note, matching
        Who plays; how fast; what asks for it above the panels; what says that it is prepared; who
        opens the matching page.
    """

    def __init__(self, document: Document, preferences: Preferences, window: QWidget) -> None:
        super().__init__(window)
        self._document = document
        self.player = Player(document, preferences, self)
        self.pace = Pace(document, self.player, self)
        self.bar, self.note = Transport(window), PreparingNote(window)
        self.matching = MatchingActions(document, preferences, self.player, window)
        self.rigs = RigPages(document, self.player.settings, window)
        self._panel: PlaybackPanel | None = None
        self._timer = QTimer(self, interval=_STEP_MS)
        self._timer.timeout.connect(self._show)
        self._escape = EscapeTwice(window)
        self._escape.pressed.connect(self.player.stop_at_once)

    def capabilities(self) -> dict[str, QObject]:
        """Who carries out its actions, by the names that their table has for them."""
        return {
            "player": self.player,
            "gain": self.player.gain,
            "pace": self.pace,
            "matching": self.matching,
            "rigs": self.rigs,
        }

    def end(self) -> None:
        """Stop for good, and let go of the device."""
        self.matching.end()
        self.rigs.end()
        self.player.end()

    def connect_to(self, panels: MadePanels, reports: Reports) -> None:
        """Show it in its panel, while that is visible, and say in ``reports`` what goes wrong."""
        player, bar = self.player, self.bar
        bar.play_wanted.connect(player.play_or_stop)
        bar.repeat_wanted.connect(player.toggle_loop)
        bar.gain_wanted.connect(player.gain.put)
        self.note.cancel_wanted.connect(player.stop)
        player.changed.connect(self._follow)
        player.failed.connect(reports.complain)
        self.rigs.failed.connect(reports.complain)
        # What went wrong with the file before is over.
        self.rigs.opened.connect(reports.report)
        player.told.connect(reports.explain)
        panels.each(self._meet)
        self._document.changed.connect(self._show_places)
        self._follow()

    def _meet(self, panel: Panel) -> None:
        if panel.name != _PANEL:
            return
        player = self.player
        self._panel = panel = cast("PlaybackPanel", panel)
        panel.output_wanted.connect(player.settings.choose)
        panel.devices_wanted.connect(player.settings.look)
        panel.rig_wanted.connect(player.settings.choose_rig)
        panel.tone_wanted.connect(player.play_tone)
        panel.visibility_changed.connect(self._look)

    def _follow(self) -> None:
        playing = self.player.playing
        self.note.show_preparing(self.player.preparing)
        self._escape.watch(playing)
        if playing and not self._timer.isActive():
            self._timer.start()
        elif not playing:
            self._timer.stop()
        self._show()

    def _show(self) -> None:
        played = played_by(self.player, self._document.design)
        self.bar.show_played(played)
        if self._panel is not None and self._panel.isVisible():
            self._panel.show_played(played)

    def _show_places(self) -> None:
        if self._panel is not None and self._panel.isVisible():
            self._show()

    def _look(self) -> None:
        """Find out what there is, when somebody first wants to know."""
        if self._panel is not None and self._panel.isVisible():
            self.player.settings.look_for_rig()
            self._show()
            if not self.player.settings.looked and not self.player.playing:
                self.player.settings.look()
