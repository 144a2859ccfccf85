"""Playback of the open design: the player, its session and thread, its gain, playhead and device.

The session waits for devices in one thread of its own. The design is rendered anew at each edit,
and the playhead of the view runs in step with what the device plays.
"""

import threading
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache, partial
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from skinsource import lab
from skinsource.actuators import rigs
from skinsource.base.errors import InvalidInputError, SkinSourceError, quoted
from skinsource.design import edits
from skinsource.design.design import Design, View, louder
from skinsource.lab.playing.devices import Output, output_from_text, outputs_by_place
from skinsource.lab.playing.stream import HIGHEST_DB, LOWEST_DB, START_DB
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.state.worker import Worker

if TYPE_CHECKING:
    from skinsource.actuators.rigs import Rig
    from skinsource.lab.playing.devices import Device
    from skinsource.lab.playing.session import Peak, Playing, Session
    from skinsource.lab.playing.stream import Delay, Levels, Stream


@dataclass(frozen=True, slots=True, kw_only=True)
class Played:
    """The state of playback that is shown to the panels.

    Attributes
    ----------
    preparing
        Whether what is to be played is being rendered.
    searched
        Whether devices were looked for.
    missing
        Why nothing can be heard, and what to do; "" where it can.
    rates_hz
        Rates that the device takes; empty while they are not known.
    wired
        Pairs of a place of the design and the output that drives it.
    rig_title, calibration
        The rig that is played for, "" without one; whether the output is calibrated, as a text.
    levels, delay
        How loud each output is, and how late an edit is heard; None while nothing is heard.
    underruns
        How often the device ran out of samples since playing began.
    loops
        Whether a design without a loop is played again and again.
    peak
        The largest sample that would be sent; None: the actuators are not armed.
    on_actuators
        Whether actuators move, or are about to.
    """

    playing: bool = False
    preparing: bool = False
    searched: bool = False
    devices: "tuple[Device, ...]" = ()
    missing: str = ""
    output: Output = field(default_factory=Output)
    rates_hz: tuple[int, ...] = ()
    wired: tuple[tuple[int, int], ...] = ()
    rig_title: str = ""
    calibration: str = ""
    levels: "Levels | None" = None
    delay: "Delay | None" = None
    underruns: int = 0
    gain_db: float = START_DB
    loops: bool = False
    peak: "Peak | None" = None
    on_actuators: bool = False

    @property
    def actuators(self) -> str:
        """State of the actuators: ``"off"``, ``"armed"``, ``"preparing"`` or ``"playing"``."""
        if self.on_actuators:
            return "preparing" if self.preparing else "playing"
        return "off" if self.peak is None else "armed"


#: Digits behind the decimal point: nobody hears, or reads, more.
DECIMALS = 2


class GainSetting(QObject):
    """The gain of playback in dB: at 0 dB an amplitude of 1 is full scale.

    It is not stored, so that each session begins softly.
    """

    #: The new gain, dB.
    changed = Signal(float)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.gain_db = START_DB

    def put(self, gain_db: float) -> None:
        """Set the gain, clipped to the possible range and rounded to hundredths of a dB."""
        nearest_db = round(min(max(gain_db, LOWEST_DB), HIGHEST_DB), DECIMALS)
        if nearest_db != self.gain_db:
            self.gain_db = nearest_db
            self.changed.emit(nearest_db)

    def reset(self) -> None:
        """Set the gain to its first value."""
        self.put(START_DB)

    def turn(self, by_db: str) -> None:
        """Raise the gain, or lower it."""
        self.put(self.gain_db + float(by_db))


#: Returns the session, which is made with the first call: the studio starts without audio modules.
SessionOf = Callable[[], "Session"]


def played_of(document: Document) -> Design:
    """Return the design with the gain that matches snapshots, as the skin map shows it."""
    return louder(document.design, document.view.match_gain(document.design))


_NAME = "skinsource-sound"
#: How long `end_sound` waits for a device; a stuck device may never answer.
LONGEST_END_S = 3.0


def device_is_stuck() -> bool:
    """Return whether a sound thread still runs: after the end, its device is stuck."""
    return any(thread.name.startswith(_NAME) for thread in threading.enumerate())


def sound_worker(parent: QObject) -> Worker:
    """Return a worker for what asks sound devices; `end_sound` closes it."""
    return Worker(_NAME, parent)


def end_sound(worker: Worker, last: Callable[[], Any] | None = None) -> None:
    """Run ``last``, wait for it at most `LONGEST_END_S`, and deliver no more results."""
    worker.close(last, finish=True, longest_s=LONGEST_END_S)


class LiveEdits(QObject):
    """Renders the design anew at each edit, in the sound thread; only the last edit counts.

    Parameters
    ----------
    document
        The document whose edits are heard.
    session, thread
        The session that renders, and the thread in which it does.

    Attributes
    ----------
    render_s
        How long rendering the last edit took; 0 before the first edit.
    """

    #: The `Playing` of the edited design.
    replaced = Signal(object)
    #: Why an edit is not heard; the design before it is played on.
    failed = Signal(str)

    def __init__(
        self, document: Document, session: SessionOf, thread: Worker, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._document, self._session, self._thread = document, session, thread
        self._playing: Playing | None = None
        self._rendered: tuple[Design, bool, View] | None = None
        self._output, self._loops = Output(), False
        self._rig: Rig | None = None
        self._busy = False
        self._edited_s = self.render_s = 0.0

    def begin(
        self, playing: "Playing", design: Design, output: Output, rig: "Rig | None", *, loops: bool
    ) -> None:
        """Follow the document, whose ``design`` is played now."""
        self._playing, self._output, self._loops, self._rig = playing, output, loops, rig
        self._rendered, self.render_s = (design, loops, self._pace), 0.0
        self._document.changed.connect(self._follow)
        self._follow()

    def end(self) -> None:
        """Stop following the document."""
        if self._playing is not None:
            self._playing = None
            self._document.changed.disconnect(self._follow)

    def loop(self, *, loops: bool) -> None:
        """Repeat a design without a loop, or play it once."""
        self._loops = loops
        if self._playing is not None:
            self._follow()

    @property
    def _pace(self) -> View:
        """A view that has but the speed, which actuators do not follow."""
        if self._playing is None or self._playing.silent is None:
            return View()
        view = self._document.view
        return View(slow_motion=view.slow_motion, delay_removed=view.delay_removed)

    def _follow(self) -> None:
        latest = played_of(self._document), self._loops, self._pace
        if self._playing is None or self._busy or self._rendered == latest:
            return
        self._busy, self._rendered = True, latest
        self._edited_s = perf_counter()
        change = partial(
            self._session().change,
            self._playing,
            latest[0],
            self._output,
            loops=latest[1],
            rig=self._rig,
            view=latest[2],
        )
        self._thread.run(lambda: (change(), perf_counter()), self._receive)

    def _receive(
        self, timed: "tuple[Playing | None, float] | None", error: Exception | None
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
        # Edits were perhaps made meanwhile.
        self._follow()


# Sixty times a second.
_STEP_MS = 16
# At least as long as the fade-in, which begins before the playhead.
_FADE_IN_S = 0.01


class RunningPlayhead(QObject):
    """Moves the playhead of a document while it plays, and back where it was at the end.

    Its moves are no steps of the history.
    """

    #: The user has moved the playhead to this time, s.
    moved_away = Signal(float)
    #: The playhead was moved along with the sound.
    stepped = Signal()
    #: Whether it moves along.
    running = Signal(bool)

    def __init__(self, document: Document, parent: QObject) -> None:
        super().__init__(parent)
        self._document = document
        self._position: Callable[[], float | None] | None = None
        self._from_s = self._put_s = 0.0
        self._timer = QTimer(self, interval=_STEP_MS, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._step)

    def run(self, position: Callable[[], float | None]) -> None:
        """Follow ``position``, which returns a time of the design in s, or None."""
        if self._position is None:
            self._from_s = self._put_s = self._document.view.playhead_s
            self._document.playhead_moved.connect(self._note_move)
            self._document.changed.connect(self._note_move)
            self.running.emit(True)
        self._position = position
        self._timer.start()

    def rest(self) -> None:
        """Put the playhead back where it started, so that the same can be played again."""
        if self._position is None:
            return
        self._timer.stop()
        self._position = None
        self._document.playhead_moved.disconnect(self._note_move)
        self._document.changed.disconnect(self._note_move)
        self._put(self._from_s)
        self.running.emit(False)

    def stay(self) -> None:
        """Make the present time the one to which `rest` returns."""
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

    def _note_move(self) -> None:
        time_s = self._document.view.playhead_s
        if time_s != self._put_s:
            self._from_s = self._put_s = time_s
            self.moved_away.emit(time_s)


class SoundSettings(QObject):
    """The device, its rate, the channel map and the rig of this machine.

    They are stored in the preferences, never in a design. Devices are looked up in the sound
    thread.

    Attributes
    ----------
    preferences
        Where they are stored, as the sensor of the page that measures actuators.
    looked, devices, rates_hz
        Whether devices were looked for; the devices, and the rates of the chosen one.
    missing
        Why there are no devices, or not the chosen one.
    rig, rig_problem
        The wiring of the device, None where it is not known; why the rig cannot be read.
    """

    #: Any of the attributes has changed.
    changed = Signal()
    #: Another output or rig was chosen.
    output_changed = Signal()
    #: Another device or rig was chosen: the gain of the one may be too high for the other.
    device_changed = Signal()
    #: Why a rig was not opened.
    refused = Signal(str)

    def __init__(
        self, preferences: Preferences, session: SessionOf, thread: Worker, parent: QObject
    ) -> None:
        super().__init__(parent)
        self.preferences, self._session, self._thread = preferences, session, thread
        self.output = _stored_output(preferences)
        self.searched = False
        self.devices: tuple[Device, ...] = ()
        self.rates_hz: tuple[int, ...] = ()
        self.missing = self._search_error = ""
        self.rig: Rig | None = None
        self.rig_title, self.rig_problem = "", ""
        self._rig_was_read = False

    @property
    def rig_path(self) -> Path | None:
        """The rig file of this machine; None without one."""
        path = self.preferences.rig_path
        return Path(path) if path else None

    def look_for_rig(self) -> None:
        """Read the rig of this machine, unless that was done before."""
        if self._rig_was_read:
            return
        self._rig_was_read = True
        if self.preferences.rig_path:
            try:
                self._open_rig(Path(self.preferences.rig_path))
            except SkinSourceError as error:
                self.rig_problem = f"The rig of this machine cannot be read: {error}"

    def rig_is_read(self, design: Design | None = None) -> bool:
        """Return whether the rig was read, or there is none, and is that of a design.

        Else emit `refused`: the rig of this machine says the limits of what is wired to it.
        """
        self.look_for_rig()
        own, wanted = self.rig, None if design is None else design.rig
        if self.rig_problem:
            self.refused.emit(f"{self.rig_problem} Choose another rig, or none.")
        elif own is not None and wanted is not None and own != wanted:
            self.refused.emit(
                f"The design is made for the rig {quoted(wanted.title)}, and this machine plays "
                f"for {quoted(self.rig_title)}, or an older one. Choose the rig again under Output."
            )
        else:
            return True
        return False

    def rig_for(self, design: Design) -> "Rig | None":
        """Return the rig that a design is played for: its own, or else that of this machine."""
        return design.rig if design.rig is not None else self.rig

    def choose_rig(self, path: Path | None) -> bool:
        """Use another rig from now on; None: no rig.  Return whether it was opened."""
        self._rig_was_read = True
        try:
            self._open_rig(path)
        except SkinSourceError as error:
            self.refused.emit(str(error))
            return False
        self.preferences.rig_path = "" if path is None else str(path)
        self.output_changed.emit()
        self.changed.emit()
        self.device_changed.emit()
        return True

    def _open_rig(self, path: Path | None) -> None:
        rig = None if path is None else rigs.open_rig(path)
        self.rig, self.rig_problem = rig, ""
        self.rig_title = "" if rig is None or path is None else rig.title or path.stem

    def choose(self, output: Output) -> None:
        """Use another output from now on."""
        before, self.output = self.output, output
        if before == output:
            return
        self.preferences.output_text = output.to_text()
        is_other_device = (before.device, before.host_api) != (output.device, output.host_api)
        # A problem of the output before is none of this one.
        self.missing = self._search_error
        self._look_up_device(rates=is_other_device)
        self.output_changed.emit()
        self.changed.emit()
        if is_other_device:
            self.device_changed.emit()

    def look(self) -> None:
        """Look for devices; playback ends."""
        self._thread.run(self._session().devices, self._receive_devices)

    def note_missing(self, reason: str) -> None:
        """Store why nothing was heard; "" where it was heard."""
        if reason != self.missing:
            self.missing = reason
            self.changed.emit()

    def _receive_devices(
        self, found_devices: "tuple[Device, ...] | None", error: Exception | None
    ) -> None:
        self.searched, self.devices, self.rates_hz = True, found_devices or (), ()
        self.missing = self._search_error = "" if error is None else str(error)
        self._look_up_device()
        self.changed.emit()

    def _look_up_device(self, *, rates: bool = True) -> None:
        """Note a device that is not there, or ask the device for its rates."""
        if not self.searched:
            return
        try:
            device = lab.playing.devices.device_of(self.output, self.devices)
        except SkinSourceError as error:
            self.missing = self.missing or str(error)
        else:
            if rates:
                rates_of = partial(lab.playing.devices.rates_of, device)
                self._thread.run(rates_of, self._receive_rates)

    def _receive_rates(self, rates_hz: tuple[int, ...] | None, error: Exception | None) -> None:
        self.rates_hz = rates_hz or ()
        self.changed.emit()


def _stored_output(preferences: Preferences) -> Output:
    try:
        return output_from_text(preferences.output_text)
    except InvalidInputError:
        # Nothing was stored yet, or another version of the studio stored it.
        return Output()


_DEVICE_LOST = (
    "The device stopped responding: it may have been unplugged. Connect it, press Refresh under "
    "Output, and play."
)
# How often the device is checked to be still there.
_WATCH_MS = 250


class Player(QObject):
    """Plays the open design, and stops it.

    Attributes
    ----------
    now
        What is being played; None where nothing is.
    preparing
        Whether the sound is being rendered and the device opened.
    peak
        The largest sample that would be sent; None: the actuators are not armed.
    on_actuators
        Whether actuators move, or are about to.
    loops
        Whether a design without a loop is played again and again.
    """

    #: Playback began or ended, or its settings changed; not emitted for levels and times.
    changed = Signal()
    #: Why nothing is played, or why it was stopped.
    failed = Signal(str)
    #: A message that is no error.
    message = Signal(str)
    _finished = Signal(object)  # from the thread of the device

    def __init__(self, document: Document, preferences: Preferences, parent: QObject) -> None:
        super().__init__(parent)
        self._document = document
        self._thread = sound_worker(self)
        self._session = cache(lambda: lab.playing.session.Session(self._finished.emit))
        self.settings = SoundSettings(preferences, self._session, self._thread, self)
        self.edits = LiveEdits(document, self._session, self._thread, self)
        self.playhead = RunningPlayhead(document, self)
        self.now: Playing | None = None
        self.preparing = False
        # A new object for each start, to tell whether it was stopped meanwhile.
        self._start: object = None
        # A stream that ended before the sound thread delivered it.
        self._over_early: Stream | None = None
        self.gain, self.loops = GainSetting(self), False
        self._watcher = QTimer(self, interval=_WATCH_MS)
        self._watcher.timeout.connect(self._watch)
        self._finished.connect(self._note_end, Qt.ConnectionType.QueuedConnection)
        self.settings.changed.connect(self.changed)
        self.settings.refused.connect(self.failed)
        self.settings.output_changed.connect(self.stop)
        self.settings.device_changed.connect(self.gain.reset)
        self.gain.changed.connect(self._pass_gain)
        self.peak: Peak | None = None
        self.on_actuators = False
        # What was armed, or is to be; and the rig that is played for.
        self._armed: Design | None = None
        self._played_rig: Rig | None = None
        document.changed.connect(self._follow)
        document.jumped.connect(self._note_jump)
        self.settings.output_changed.connect(partial(self.arm, False))
        self.edits.replaced.connect(self._replace)
        self.edits.failed.connect(self.failed)
        self.playhead.stepped.connect(self._watch)

    @property
    def playing(self) -> bool:
        """Whether it plays, or prepares to."""
        return self.preparing or self.now is not None

    def play_or_stop(self) -> None:
        """Animate the skin from the playhead, or stop; no actuator moves."""
        if self.playing:
            self.stop()
        else:
            self.animate()

    def animate(self) -> None:
        """Move the playhead through the design, again and again, in the slow motion of the view."""
        design, view = played_of(self._document), self._document.view
        animate = partial(self._session().animate, design, view, loops=True)
        self._begin(animate, partial(self._run, design, None))

    @property
    def _repeats(self) -> bool:
        # An animation always: one pass is too short to see anything.
        return self.loops or not self.on_actuators

    def arm(self, on: bool) -> None:
        """Look at what would be sent to the actuators, and allow to send it; or forbid it."""
        if not on:
            self._armed = self.peak = None
            if self.on_actuators:
                self.stop()
            self.changed.emit()
        elif self.settings.rig_is_read(self._document.design):
            self._look_at_peak()

    def play_on_actuators(self) -> None:
        """Play from the playhead on the armed actuators in real time, or stop."""
        if self.on_actuators:
            self.stop()
            return
        design = played_of(self._document)
        if not self._may_play():
            return
        self._played_rig = rig = self.settings.rig_for(design)
        start = object()
        play = partial(
            self._session().play,
            design,
            self.settings.output,
            loops=self.loops,
            at_s=self._document.view.playhead_s,
            gain_db=self.gain.gain_db,
            rig=rig,
            stop=lambda: self._start is not start,
        )
        self.on_actuators = True
        self._begin(play, partial(self._run, design, rig), start)

    def play_tone(self, number: int) -> None:
        """Play the test tone on one output, in place of what is played now."""
        if not self.preparing and self._may_play():
            self._end_playing()
            output, gain_db = self.settings.output, self.gain.gain_db
            self._played_rig = rig = self.settings.rig_for(self._document.design)
            self.on_actuators = True
            self._begin(partial(self._session().tone, number, output, gain_db, rig))

    def _may_play(self) -> bool:
        if self.peak is None:
            self.failed.emit("Nothing is sent to the actuators. Arm them under Output first.")
        return self.peak is not None and self.settings.rig_is_read(self._document.design)

    def _run(self, design: Design, rig: "Rig | None") -> None:
        """Have playhead and edits follow what began."""
        self.playhead.run(lambda: None if self.now is None else self.now.position_s())
        self.edits.end()
        if self.now is not None:
            self.edits.begin(self.now, design, self.settings.output, rig, loops=self._repeats)

    def _look_at_peak(self) -> None:
        self._armed = design = self._document.design
        peak = partial(
            self._session().peak,
            played_of(self._document),
            self.settings.output,
            rig=self.settings.rig_for(design),
        )
        self._thread.run_newest("peak", peak, partial(self._receive_peak, design))

    def _receive_peak(self, design: Design, peak: "Peak | None", error: Exception | None) -> None:
        if self._armed is not design:
            return
        self.peak = peak
        if error is not None:
            self._armed = None
            self.settings.note_missing(str(error))
            self.failed.emit(str(error))
        self.changed.emit()

    def _follow(self) -> None:
        """Look at an edited design that is armed; stop where it is for another rig now."""
        design = self._document.design
        if self._armed is None or self._armed is design:
            return
        self._look_at_peak()
        if self.on_actuators and self.settings.rig_for(design) != self._played_rig:
            self.stop()

    def _note_jump(self) -> None:
        """Disarm for another file; undone edits leave it armed."""
        if not self._document.undo_stack.count():
            self.arm(False)

    def stop(self) -> None:
        """Fade out, or give up preparing."""
        self.preparing, self._start = False, None
        stream = None if self.now is None else self.now.stream
        if stream is None or stream.unresponsive:
            self._end_playing()
        else:
            # `_finished` follows when the device is silent.
            stream.queue.stop()

    def stop_at_once(self) -> None:
        """Be silent within a millisecond, disarm the actuators, and reset the gain."""
        self.preparing, self._start = False, None
        self._armed = self.peak = None
        if self.now is not None and self.now.stream is not None:
            self.now.stream.queue.stop_at_once()
        else:
            self._end_playing()
        self.gain.reset()

    def toggle_loop(self) -> None:
        """Switch whether a design without a loop is repeated."""
        self.loops = not self.loops
        self.edits.loop(loops=self._repeats)
        self.changed.emit()

    def end(self) -> None:
        """Stop for good, and release the device."""
        self.preparing, self._start = False, None
        self._end_playing()
        used = self._session.cache_info().currsize
        end_sound(self._thread, self._session().close if used else None)

    def _begin(
        self,
        play: "Callable[[], Playing]",
        follow: Callable[[], None] | None = None,
        start: object = None,
    ) -> None:
        start = start or object()
        self.preparing, self._start = True, start

        def take(playing: "Playing | None", error: Exception | None) -> None:
            if self._start is not start:
                # It was stopped before it began. A start after that ends it by itself.
                if playing is not None and not self.preparing:
                    self._thread.run(self._session().close)
            elif playing is None:
                self.preparing = self.on_actuators = False
                self.failed.emit(str(error))
            else:
                self.preparing, self.now = False, playing
                if playing.reason or playing.stream is not None:
                    self.settings.note_missing(playing.reason)
                if playing.reason:
                    self.message.emit(f"No sound: {playing.reason}")
                if follow is not None:
                    follow()
                # A device that is unplugged during a tone emits nothing.
                self._watcher.start()
                if playing.stream is not None and playing.stream is self._over_early:
                    self._note_end(playing.stream)
            self._over_early = None
            self.changed.emit()

        self._thread.run(play, take)
        self.changed.emit()

    def _pass_gain(self, gain_db: float) -> None:
        if self.now is not None and self.now.stream is not None:
            self.now.stream.queue.set_gain(gain_db)
        self.changed.emit()

    def _replace(self, playing: "Playing") -> None:
        self.now = playing
        self.changed.emit()

    def _watch(self) -> None:
        now = self.now
        if now is not None and now.over:
            self._end_playing()
            if now.stream is not None:
                # That it cannot be closed either is nothing to report.
                close = partial(self._session().close_stream, now.stream)
                self._thread.run(close, lambda *_: None)
                self.failed.emit(_DEVICE_LOST)

    def _note_end(self, stream: "Stream") -> None:
        if stream.closed or self.now is None or self.now.stream is not stream:
            self._over_early = stream if self.preparing else None
            return
        ending = stream.queue.ending
        natural = ending is not None and ending.reason == "end"
        seen_on = self.now.visible_after(self._document.view.playhead_s) if natural else None
        if seen_on is None:
            self._end_playing()
        else:
            # The last waves are still on their way.
            self.now, self.on_actuators = seen_on, False
        self._thread.run(partial(self._session().close_stream, stream))
        if ending is None:
            self.failed.emit(_DEVICE_LOST)
        elif ending.reason == "panic":
            self.message.emit(ending.sentence)
        elif ending.sentence:
            self.failed.emit(ending.sentence)

    def _end_playing(self) -> None:
        self.edits.end()
        self.playhead.rest()
        self.now, self.on_actuators = None, False
        self.changed.emit()


#: Choices of slow motion: real time, and how many times slower.
PACES = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
# From here it goes on where the automatic one is not known: of a tone of 100 Hz.
_USUAL = 50.0


class PlaybackPace(QObject):
    """Pauses the player, has it follow the playhead, and chooses the slow motion of the view."""

    def __init__(self, document: Document, player: Player, parent: QObject) -> None:
        super().__init__(parent)
        self._document, self._player = document, player
        #: Returns how many times slower than it happens the stage in sight shows it; 0: none is.
        self.on_stage: Callable[[], float] = float
        player.playhead.moved_away.connect(self._seek)

    def pause(self) -> None:
        """Stop and leave the playhead where it is, or play on from there."""
        if self._player.now is not None:
            self._player.playhead.stay()
            self._player.stop()
        else:
            self._player.play_or_stop()

    def slow_down(self, steps: str) -> None:
        """Play at the next slower pace; "-1": at the next faster one."""
        design, view, now = self._document.design, self._document.view, self._player.now
        running = _USUAL if now is None or now.silent is None else now.silent.slow_motion
        pace = self.on_stage() or view.slow_motion or running
        slower = [each for each in PACES if each > pace + 1e-9] or PACES[-1:]
        # On the stage, real time stands for its own speed.
        paces = PACES[bool(self.on_stage()) :]
        faster = [each for each in paces if each < pace - 1e-9] or [pace]
        slow_motion = slower[0] if int(steps) > 0 else faster[-1]
        self._document.apply(edits.play_slower(design, view, slow_motion))

    def _seek(self, time_s: float) -> None:
        if self._player.now is not None:
            self._player.now.seek(time_s)


def _calibration(settings: SoundSettings, design: Design) -> str:
    """Return the text on whether m/s² follow from the output."""
    if settings.rig_problem:
        return settings.rig_problem
    rig = settings.rig_for(design)
    if rig is None:
        return ""
    places = tuple(dict.fromkeys(track.location for track in design.inputs))
    return rigs.calibration_words(rig, places)


def played_by(player: Player, design: Design) -> Played:
    """Return the state of playback for the panels."""
    settings, stream = player.settings, player.now.stream if player.now else None
    render_s, rig = player.edits.render_s, settings.rig_for(design)
    return Played(
        playing=player.playing,
        preparing=player.preparing,
        searched=settings.searched,
        devices=settings.devices,
        missing=settings.missing,
        output=settings.output,
        rates_hz=settings.rates_hz,
        wired=tuple(outputs_by_place(design, settings.output, rig).items()),
        rig_title=settings.rig_title if rig is settings.rig else rig.title or "Rig" if rig else "",
        calibration=_calibration(settings, design),
        levels=None if stream is None else stream.queue.levels(),
        delay=None if stream is None or not render_s else stream.delay(render_s),
        underruns=0 if stream is None else stream.underruns,
        gain_db=player.gain.gain_db,
        loops=player.loops,
        peak=player.peak,
        on_actuators=player.on_actuators,
    )
