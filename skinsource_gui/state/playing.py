"""What panels are told of what is played."""

import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from skinsource.actuators import rigs
from skinsource.base.errors import InvalidInputError, SkinSourceError
from skinsource.design import edits
from skinsource.design.comparing import louder
from skinsource.design.design import Design
from skinsource.lab.playing import devices, session
from skinsource.lab.playing.devices import Output, output_from_text, outputs_by_place
from skinsource.lab.playing.mix import HIGHEST_DB, LOWEST_DB, START_DB
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import Preferences

if TYPE_CHECKING:
    from skinsource.actuators.rigs import Rig
    from skinsource.lab.playing.devices import Device
    from skinsource.lab.playing.mix import Delay, Levels
    from skinsource.lab.playing.session import Playing, Session
    from skinsource.lab.playing.stream import Stream


@dataclass(frozen=True, slots=True, kw_only=True)
class Played:
    """What is played, on what, and how.

    Attributes
    ----------
    playing
        Whether anything is.
    looked
        Whether devices were looked for.
    devices
        What can be played on.
    missing
        Why nothing can be heard, and what to do; "" where it can.
    output
        What this machine plays on.
    rates_hz
        Rates that its device takes; none while that is not known.
    wired
        Pairs of a place of the design and the output that drives it.
    rig_title, calibration
        The rig of this machine, "" without one; whether what is played is calibrated, in words.
    names
        Words for what each output plays now, "" where it is silent.
    levels, delay
        How loud each output is, and how late an edit comes; None while nothing is heard.
    underruns
        How often the device ran out of samples since playing began.
    gain_db, loops
        The gain; whether a design without a loop is played again and again.
    """

    playing: bool = False
    looked: bool = False
    devices: "tuple[Device, ...]" = ()
    missing: str = ""
    output: Output = field(default_factory=Output)
    rates_hz: tuple[int, ...] = ()
    wired: tuple[tuple[int, int], ...] = ()
    rig_title: str = ""
    calibration: str = ""
    names: tuple[str, ...] = ()
    levels: "Levels | None" = None
    delay: "Delay | None" = None
    underruns: int = 0
    gain_db: float = START_DB
    loops: bool = False


# How loud it is played; kept by nobody, so that each studio begins softly.

#: Digits behind the point: nobody hears, or reads, more.
DECIMALS = 2
_STEP_DB = 1.0


class GainSetting(QObject):
    """A gain, in dB: at 0 dB an amplitude of 1 is full scale.

    Attributes
    ----------
    gain_db
        The gain.
    """

    #: The new gain, dB.
    changed = Signal(float)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.gain_db = START_DB

    def put(self, gain_db: float) -> None:
        """Choose a gain; the nearest that can be, in hundredths of a dB."""
        wanted_db = round(min(max(gain_db, LOWEST_DB), HIGHEST_DB), DECIMALS)
        if wanted_db != self.gain_db:
            self.gain_db = wanted_db
            self.changed.emit(wanted_db)

    def start_anew(self) -> None:
        """Go back to where it starts."""
        self.put(START_DB)

    def turn_up(self) -> None:
        """Make it louder by 1 dB."""
        self.put(self.gain_db + _STEP_DB)

    def turn_down(self) -> None:
        """Make it softer by 1 dB."""
        self.put(self.gain_db - _STEP_DB)


# The session of a player, once it plays.


class LazySession:
    """Makes the session when it is first asked for: the studio starts without what plays.

    Parameters
    ----------
    finished
        What the session tells of a stream that plays no more.
    """

    def __init__(self, finished: "Callable[[Stream], None]") -> None:
        self._finished = finished
        self._session: Session | None = None

    @property
    def made(self) -> "Session":
        """The session."""
        if self._session is None:
            self._session = session.Session(self._finished)
        return self._session

    def close(self) -> None:
        """End what is played, if anything ever was."""
        if self._session is not None:
            self._session.close()


# What is played of a document.


def played_of(document: Document) -> Design:
    """The design, as loud as the skin is shown: with the gain by which snapshots match."""
    return louder(document.design, document.view.match_gain(document.design))


# One thread for all that may wait for a device.

_NAME = "skinsource-sound"
#: How long the end waits for a device; one that is stuck may never answer.
LONGEST_END_S = 3.0
#: Told the result, or the error where there is none.
Then = Callable[[Any, SkinSourceError | None], None]


def one_is_stuck() -> bool:
    """Whether a thread still waits for its device, though nobody plays any more."""
    return any(thread.name.startswith(_NAME) for thread in threading.enumerate())


class SoundThread(QObject):
    """Carries out what it is given, in order, and tells in the GUI thread what came of it."""

    _landed = Signal(object, object, object)  # from the thread

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        # No thread before there is something to do.
        self._worker: ThreadPoolExecutor | None = None
        self._ended = False
        self._landed.connect(self._land, Qt.ConnectionType.QueuedConnection)

    def do(self, work: Callable[[], Any], then: Then) -> None:
        """Carry out ``work``, then tell ``then``; nothing any more once it has ended."""
        if self._ended:
            return
        if self._worker is None:
            self._worker = ThreadPoolExecutor(1, thread_name_prefix=_NAME)
        self._worker.submit(self._work, work, then)

    def end(self, last: Callable[[], Any]) -> None:
        """Carry out ``last``, wait for it unless the device is stuck, and tell nobody any more."""
        if self._ended:
            return
        self._ended = True
        self._landed.disconnect(self._land)
        if self._worker is not None:
            ended = wait([self._worker.submit(last)], LONGEST_END_S).done
            self._worker.shutdown(wait=bool(ended))
            self._worker = None

    def _work(self, work: Callable[[], Any], then: Then) -> None:
        try:
            self._landed.emit(then, work(), None)
        except SkinSourceError as error:
            self._landed.emit(then, None, error)

    def _land(self, then: Then, result: Any, error: SkinSourceError | None) -> None:
        then(result, error)


# What is played follows what is edited.


class LiveEdits(QObject):
    """Renders the design anew at each edit, away from the GUI thread; the last one counts.

    Parameters
    ----------
    document
        What is followed.
    session, thread
        Who renders, and where.

    Attributes
    ----------
    render_s
        How long the last edit took until the device could have it; 0: there was none.
    """

    #: What plays the edited design.
    replaced = Signal(object)
    #: Why an edit is not heard: what was played before goes on.
    failed = Signal(str)

    def __init__(
        self, document: Document, session: LazySession, thread: SoundThread, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._document, self._session, self._thread = document, session, thread
        self._playing: Playing | None = None
        self._rendered: tuple[Design, bool] | None = None
        self._output, self._loops = Output(), False
        self._rig: Rig | None = None
        self._busy = False
        self._edited_s = self.render_s = 0.0
        # When the first edit was made that waits for the one before it.
        self._waiting_s: float | None = None

    def begin(
        self, playing: "Playing", design: Design, output: Output, rig: "Rig | None", *, loops: bool
    ) -> None:
        """Follow the document, of which ``design`` is what is played."""
        self._playing, self._output, self._loops, self._rig = playing, output, loops, rig
        self._rendered, self.render_s, self._waiting_s = (design, loops), 0.0, None
        self._document.changed.connect(self._follow)
        self._follow()

    def end(self) -> None:
        """Follow no longer."""
        if self._playing is not None:
            self._playing = None
            self._document.changed.disconnect(self._follow)

    def loop(self, *, loops: bool) -> None:
        """Play a design without a loop again and again, or once."""
        self._loops = loops
        if self._playing is not None:
            self._follow()

    def _follow(self) -> None:
        latest = played_of(self._document), self._loops
        if self._playing is None or self._rendered == latest:
            self._waiting_s = None if self._rendered == latest else self._waiting_s
            return
        since_s = perf_counter() if self._waiting_s is None else self._waiting_s
        if self._busy:
            # Its delay begins now, not when its turn comes.
            self._waiting_s = since_s
            return
        self._busy, self._rendered = True, latest
        self._edited_s, self._waiting_s = since_s, None
        change = partial(
            self._session.made.change,
            self._playing,
            latest[0],
            self._output,
            loops=latest[1],
            rig=self._rig,
        )
        self._thread.do(partial(_timed, change), self._take)

    def _take(
        self, timed: "tuple[Playing | None, float] | None", error: SkinSourceError | None
    ) -> None:
        self._busy = False
        if self._playing is None:
            return
        if timed is None:
            self.failed.emit(f"Not heard yet: {error}")
        elif timed[0] is not None:
            self.render_s = timed[1] - self._edited_s
            self._playing = timed[0]
            self.replaced.emit(timed[0])
        # What was edited meanwhile.
        self._follow()


def _timed(change: "partial[Playing | None]") -> "tuple[Playing | None, float]":
    """What ``change`` returns, and when."""
    return change(), perf_counter()


# The playhead while it runs: in step with what is heard, and back where it began at the end.

# Sixty times a second.
_STEP_MS = 16
# At least as long as what fades in before the place where it begins.
_FADE_IN_S = 0.01


class RunningPlayhead(QObject):
    """Puts the playhead where playing is; makes no steps of the history.

    Parameters
    ----------
    document
        Whose playhead it is.
    """

    #: The user has put it elsewhere, s.
    moved_away = Signal(float)
    #: It has moved by itself.
    stepped = Signal()

    def __init__(self, document: Document, parent: QObject) -> None:
        super().__init__(parent)
        self._document = document
        self._position: Callable[[], float | None] | None = None
        self._from_s = self._put_s = 0.0
        self._timer = QTimer(self, interval=_STEP_MS, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._step)

    def run(self, position: Callable[[], float | None]) -> None:
        """Follow ``position``, which tells a time of the design in s, or None."""
        if self._position is None:
            self._from_s = self._put_s = self._document.view.playhead_s
            self._document.playhead_moved.connect(self._look)
            self._document.changed.connect(self._look)
        self._position = position
        self._timer.start()

    def rest(self) -> None:
        """Go back to where it ran from; the same can then be played once more."""
        if self._position is None:
            return
        self._timer.stop()
        self._position = None
        self._document.playhead_moved.disconnect(self._look)
        self._document.changed.disconnect(self._look)
        self._put(self._from_s)

    def stay(self) -> None:
        """Come to rest where it is now, not where it ran from."""
        self._from_s = self._put_s

    def _step(self) -> None:
        time_s = None if self._position is None else self._position()
        if time_s is not None:
            fades_in = 0.0 < self._from_s - time_s < _FADE_IN_S
            self._put(self._from_s if fades_in else time_s)
        self.stepped.emit()

    def _put(self, time_s: float) -> None:
        self._put_s = time_s
        view = self._document.view
        if view.playhead_s != time_s:
            self._document.look(replace(view, playhead_s=time_s))

    def _look(self) -> None:
        time_s = self._document.view.playhead_s
        if time_s != self._put_s:
            self._from_s = self._put_s = time_s
            self.moved_away.emit(time_s)


# What this machine plays on: chosen once, kept, and never part of a design.


class SoundSettings(QObject):
    """The device, its rate and the channel map of this machine.

    Parameters
    ----------
    preferences
        Where they are kept.
    session, thread
        Who knows devices, and the thread that may ask it.

    Attributes
    ----------
    output
        What is played on.
    looked, devices, rates_hz
        Whether devices were looked for; those that were found, and the rates of the chosen one.
    missing
        Why there are none, or not the chosen one.
    rig, rig_problem
        What is wired to the device, None: not known; why the rig of this machine cannot be read.
    """

    #: Something else is known, or chosen.
    changed = Signal()
    #: What is played on was chosen anew.
    output_changed = Signal()
    #: Another device: what was loud enough for one may be too much for the other.
    device_changed = Signal()
    #: Why a rig was not taken.
    refused = Signal(str)

    def __init__(
        self, preferences: Preferences, session: LazySession, thread: SoundThread, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._preferences, self._session, self._thread = preferences, session, thread
        self.output = _kept(preferences)
        self.looked = False
        self.devices: tuple[Device, ...] = ()
        self.rates_hz: tuple[int, ...] = ()
        self.missing = self._not_found = ""
        self.rig: Rig | None = None
        self.rig_title, self.rig_problem = "", ""
        self._rig_looked = False

    @property
    def rig_path(self) -> Path | None:
        """Where the rig of this machine is; None: there is none."""
        path = self._preferences.rig_path
        return Path(path) if path else None

    @property
    def sensor_text(self) -> str:
        """What actuators are measured with on this machine, as the page of that wrote it."""
        return self._preferences.sensor_text

    @sensor_text.setter
    def sensor_text(self, text: str) -> None:
        self._preferences.sensor_text = text

    def look_for_rig(self) -> None:
        """Read the rig of this machine, when somebody first wants to know."""
        if self._rig_looked:
            return
        self._rig_looked = True
        if self._preferences.rig_path:
            try:
                self._take_rig(Path(self._preferences.rig_path))
            except SkinSourceError as error:
                self.rig_problem = f"The rig of this machine cannot be read: {error}"

    def rig_is_read(self) -> bool:
        """Whether what is wired is known, or nothing shall be; else it says why not."""
        self.look_for_rig()
        if self.rig_problem:
            self.refused.emit(f"{self.rig_problem} Choose another rig, or none.")
        return not self.rig_problem

    def choose_rig(self, path: Path | None) -> None:
        """Play for another rig from now on; None: nothing is known of what is wired."""
        self._rig_looked = True
        try:
            self._take_rig(path)
        except SkinSourceError as error:
            self.refused.emit(str(error))
            return
        self._preferences.rig_path = "" if path is None else str(path)
        self.output_changed.emit()
        self.changed.emit()
        # What is loud enough for one may be too much for another.
        self.device_changed.emit()

    def _take_rig(self, path: Path | None) -> None:
        rig = None if path is None else rigs.open_rig(path)
        self.rig, self.rig_problem = rig, ""
        self.rig_title = "" if rig is None or path is None else rig.title or path.stem

    def choose(self, output: Output) -> None:
        """Play on something else from now on."""
        before, self.output = self.output, output
        if before == output:
            return
        self._preferences.output_text = output.to_text()
        other = (before.device, before.host_api) != (output.device, output.host_api)
        if other:
            # What was wrong with the one before is nothing to this one.
            self.missing = self._not_found
            self._ask_rates()
        self.output_changed.emit()
        self.changed.emit()
        if other:
            self.device_changed.emit()

    def look(self) -> None:
        """Look for devices; what is played ends."""
        self._thread.do(self._session.made.devices, self._take_devices)

    def note_missing(self, reason: str) -> None:
        """Take over why nothing was heard; "": it was."""
        if reason != self.missing:
            self.missing = reason
            self.changed.emit()

    def _take_devices(
        self, found_devices: "tuple[Device, ...] | None", error: SkinSourceError | None
    ) -> None:
        self.looked, self.devices, self.rates_hz = True, found_devices or (), ()
        self.missing = self._not_found = "" if error is None else str(error)
        self._ask_rates()
        self.changed.emit()

    def _ask_rates(self) -> None:
        if not self.looked:
            return
        try:
            device = devices.device_of(self.output, self.devices)
        except SkinSourceError as error:
            self.missing = self.missing or str(error)
            return
        self._thread.do(partial(devices.rates_of, device), self._take_rates)

    def _take_rates(self, rates_hz: tuple[int, ...] | None, error: SkinSourceError | None) -> None:
        self.rates_hz = rates_hz or ()
        self.changed.emit()


def _kept(preferences: Preferences) -> Output:
    try:
        return output_from_text(preferences.output_text)
    except InvalidInputError:
        # Nothing is kept yet, or by another version of the studio.
        return Output()


# Plays the open design, and tells what happens.

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
        self._session = LazySession(self._finished.emit)
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


# Where playing goes on, and how fast: what is put elsewhere, paused, or slowed down.

#: What can be chosen: as fast as it happens, and so many times slower.
PACES = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0)


class PlaybackPace(QObject):
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
        self._take(next((pace for pace in PACES if pace > self._now + 1e-9), PACES[-1]))

    def faster(self) -> None:
        """Take the next faster pace."""
        self._take(next((pace for pace in reversed(PACES) if pace < self._now - 1e-9), PACES[0]))

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


# What can be told of a player.


def _calibration(settings: SoundSettings, design: Design) -> str:
    """Whether m/s² follow from what is played, in words."""
    if settings.rig_problem:
        return settings.rig_problem
    if settings.rig is None:
        return ""
    places = tuple(dict.fromkeys(track.location for track in design.inputs))
    return rigs.calibration_words(settings.rig, places)


def played_by(player: Player, design: Design) -> Played:
    """What is played now, on what, and how loud."""
    settings, stream = player.settings, player.now.stream if player.now else None
    mix = None if stream is None else stream.deck.mix
    render_s = player.edits.render_s
    return Played(
        playing=player.playing,
        looked=settings.looked,
        devices=settings.devices,
        missing=settings.missing,
        output=settings.output,
        rates_hz=settings.rates_hz,
        wired=tuple(outputs_by_place(design, settings.output, settings.rig).items()),
        rig_title=settings.rig_title,
        calibration=_calibration(settings, design),
        names=() if mix is None else mix.names,
        levels=None if stream is None else stream.deck.levels(),
        delay=None if stream is None or not render_s else stream.delay(render_s),
        underruns=0 if stream is None else stream.underruns,
        gain_db=player.gain.gain_db,
        loops=player.loops,
    )
