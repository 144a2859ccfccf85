"""Plays the open design, and tells what happens."""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from skinsource.base.errors import SkinSourceError
from skinsource_gui.state.document import Document
from skinsource_gui.state.playing.gain_setting import GainSetting
from skinsource_gui.state.playing.late_session import LateSession
from skinsource_gui.state.playing.live_edits import LiveEdits
from skinsource_gui.state.playing.played_of import played_of
from skinsource_gui.state.playing.running_playhead import RunningPlayhead
from skinsource_gui.state.playing.sound_settings import SoundSettings
from skinsource_gui.state.playing.sound_thread import SoundThread
from skinsource_gui.state.preferences import Preferences

if TYPE_CHECKING:
    from skinsource.lab.playing.session import Playing
    from skinsource.lab.playing.stream import Stream

_GONE = (
    "The device does not ask for sound any more: it may have been unplugged. Connect it, look for "
    "devices again (View > Panels > Playback), and play."
)
# How often it is looked whether the device is still there.
_WATCH_MS = 250


class Player(QObject):
    """Space, loop, gain and panic.

    Parameters
    ----------
    document
        What is played.
    preferences
        Where it is kept what this machine plays on.

    Attributes
    ----------
    now, preparing
        What is being played, if anything; whether it is about to play: what is played is made, the
        device opened.
    settings
        What it is played on.
    edits
        What follows the edits.
    gain
        How loud.
    loops
        Whether a design without a loop is played again and again.
    playhead
        What runs while it plays.
    """

    #: Playing began or ended, or something else that can be told, but levels and times.
    changed = Signal()
    #: Why something is not played, or was stopped.
    failed = Signal(str)
    #: What else there is to say.
    told = Signal(str)
    _finished = Signal(object)  # from the thread of the device

    def __init__(self, document: Document, preferences: Preferences, parent: QObject) -> None:
        super().__init__(parent)
        self._document = document
        self._thread = SoundThread(self)
        self._session = LateSession(self._finished.emit)
        self.settings = SoundSettings(preferences, self._session, self._thread, self)
        self.edits = LiveEdits(document, self._session, self._thread, self)
        self.playhead = RunningPlayhead(document, self)
        self.now: Playing | None = None
        self.preparing = False
        # Another one each time that something is about to be played.
        self._start: object = None
        # A stream that was over before its thread had said that it plays.
        self._over_early: Stream | None = None
        self.gain, self.loops = GainSetting(self), False
        self._watcher = QTimer(self, interval=_WATCH_MS)
        self._watcher.timeout.connect(self._watch)
        self._finished.connect(self._end_of, Qt.ConnectionType.QueuedConnection)
        self.settings.changed.connect(self.changed)
        self.settings.refused.connect(self.failed)
        self.settings.output_changed.connect(self.stop)
        # What is loud enough for one device may be too much for another.
        self.settings.device_changed.connect(self.gain.start_anew)
        self.gain.changed.connect(self._pass_gain)
        self.edits.replaced.connect(self._replace)
        self.edits.failed.connect(self.failed)
        self.playhead.stepped.connect(self._watch)

    @property
    def playing(self) -> bool:
        """Whether it plays, or is about to."""
        return self.preparing or self.now is not None

    def play_or_stop(self) -> None:
        """Play from the playhead on; or fade out, or wait for the device no longer."""
        if self.playing:
            self.stop()
        else:
            self.play()

    def play(self) -> None:
        """Play from the playhead on, in place of what is played; as slowly as the view says."""
        if not self.settings.rig_is_read():
            return
        design, view = played_of(self._document), self._document.view
        output, loops, rig = self.settings.output, self.loops, self.settings.rig
        start = object()
        play = partial(
            self._session.made.play,
            design,
            output,
            loops=loops,
            at_s=view.playhead_s,
            gain_db=self.gain.gain_db,
            slow_motion=view.slow_motion,
            rig=rig,
            stop=lambda: self._start is not start,
        )

        def follow() -> None:
            self.playhead.run(self._position)
            self.edits.end()
            if self.now is not None:
                self.edits.begin(self.now, design, output, rig, loops=loops)

        self._begin(play, follow, start)

    def play_tone(self, number: int) -> None:
        """Play the test tone on one output, instead of all else."""
        if not self.preparing and self.settings.rig_is_read():
            self._leave()
            output, gain_db, rig = self.settings.output, self.gain.gain_db, self.settings.rig
            tone = partial(self._session.made.tone, number, output, gain_db, rig)
            self._begin(tone, None, object())

    def stop(self) -> None:
        """Fade out; what is about to be played is not."""
        self.preparing, self._start = False, None
        stream = None if self.now is None else self.now.stream
        if stream is None or stream.gone:
            self._leave()
        else:
            # The device tells when it has become silent.
            stream.deck.stop()

    def stop_at_once(self) -> None:
        """Be silent within a millisecond; the gain goes back to where it starts."""
        self.preparing, self._start = False, None
        if self.now is not None and self.now.stream is not None:
            self.now.stream.deck.stop_at_once()
        else:
            self._leave()
        self.gain.start_anew()

    def toggle_loop(self) -> None:
        """Play a design that has no loop again and again, or once."""
        self.loops = not self.loops
        self.edits.loop(loops=self.loops)
        self.changed.emit()

    def end(self) -> None:
        """Stop for good, and let go of the device."""
        self.preparing, self._start = False, None
        self._leave()
        self._thread.end(self._session.close)

    def _begin(
        self, play: "Callable[[], Playing]", follow: Callable[[], None] | None, start: object
    ) -> None:
        self.preparing, self._start = True, start

        def take(playing: "Playing | None", error: SkinSourceError | None) -> None:
            if self._start is not start:
                # It was stopped before it began; what is played next ends it by itself.
                if playing is not None and not self.preparing:
                    self._thread.do(self._session.close, _nothing_more)
            elif playing is None:
                self.preparing = False
                self.failed.emit(str(error))
            else:
                self.preparing, self.now = False, playing
                if playing.reason or playing.stream is not None:
                    self.settings.note_missing(playing.reason)
                if playing.reason:
                    self.told.emit(f"In silence: {playing.reason}")
                if follow is not None:
                    follow()
                # A device that goes while a tone is played tells nobody.
                self._watcher.start()
                if playing.stream is not None and playing.stream is self._over_early:
                    self._end_of(playing.stream)
            self._over_early = None
            self.changed.emit()

        self._thread.do(play, take)
        self.changed.emit()

    def _pass_gain(self, gain_db: float) -> None:
        if self.now is not None and self.now.stream is not None:
            self.now.stream.deck.set_gain(gain_db)
        self.changed.emit()

    def _position(self) -> float | None:
        return None if self.now is None else self.now.position_s()

    def _replace(self, playing: "Playing") -> None:
        self.now = playing
        self.changed.emit()

    def _watch(self) -> None:
        now = self.now
        if now is not None and now.over:
            self._leave()
            if now.stream is not None:
                self._thread.do(partial(self._session.made.let_go, now.stream), _nothing_more)
                self.failed.emit(_GONE)

    def _end_of(self, stream: "Stream") -> None:
        if stream.closed or self.now is None or self.now.stream is not stream:
            self._over_early = stream if self.preparing else None
            return
        ending = stream.deck.ending
        natural = ending is not None and ending.reason == "end"
        seen_on = self.now.seen_on(self._document.view.playhead_s) if natural else None
        if seen_on is None:
            self._leave()
        else:
            # The last waves are still on their way.
            self.now = seen_on
        self._thread.do(partial(self._session.made.let_go, stream), _nothing_more)
        if ending is None:
            self.failed.emit(_GONE)
        elif ending.reason == "panic":
            self.told.emit(ending.sentence)
        elif ending.sentence:
            self.failed.emit(ending.sentence)

    def _leave(self) -> None:
        self.edits.end()
        self.playhead.rest()
        if self.now is not None:
            self.now = None
        self.changed.emit()


def _nothing_more(_result: object, _error: SkinSourceError | None) -> None:
    """All there is to say was said."""
