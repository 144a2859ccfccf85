"""Where playing goes on, and how fast: what is put elsewhere, paused, or slowed down."""

from PySide6.QtCore import QObject

from skinsource.design import edits
from skinsource_gui.state.document import Document
from skinsource_gui.state.playing.player import Player

#: What can be chosen: as fast as it happens, and so many times slower.
PACES = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0)


class Pace(QObject):
    """Pause, slower, faster; follows the playhead and the slow motion of the view.

    Parameters
    ----------
    document
        Whose view says how slowly.
    player
        Who plays.
    """

    def __init__(self, document: Document, player: Player, parent: QObject) -> None:
        super().__init__(parent)
        self._document, self._player = document, player
        self._slow_motion = document.view.slow_motion
        player.playhead.moved_away.connect(self._seek)
        document.changed.connect(self._follow)

    def pause(self) -> None:
        """Stop, and leave the playhead where it is; or play on from there."""
        if self._player.now is not None:
            self._player.playhead.stay()
            self._player.stop()
        else:
            self._player.play_or_stop()

    def slower(self) -> None:
        """Take the next slower pace."""
        self._take(next((one for one in PACES if one > self._now + 1e-9), PACES[-1]))

    def faster(self) -> None:
        """Take the next faster pace."""
        self._take(next((one for one in reversed(PACES) if one < self._now - 1e-9), PACES[0]))

    @property
    def _now(self) -> float:
        return self._document.view.slow_motion

    def _take(self, slow_motion: float) -> None:
        design, view = self._document.design, self._document.view
        self._document.apply(edits.play_slower(design, view, slow_motion))

    def _seek(self, time_s: float) -> None:
        if self._player.now is not None:
            self._player.now.seek(time_s)

    def _follow(self) -> None:
        before, self._slow_motion = self._slow_motion, self._now
        now = self._player.now
        if now is None or before == self._now:
            return
        if now.silent is not None and 1.0 not in (before, self._now):
            now.silent.run_at(self._now)
        else:
            # Only what runs as fast as it happens is heard.
            self._player.play()
