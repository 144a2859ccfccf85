"""A player for experiments: one stimulus, prepared, that begins when it is told to."""

from collections.abc import Callable
from dataclasses import replace
from math import inf
from queue import SimpleQueue
from threading import Event, Thread
from time import monotonic, perf_counter
from typing import Literal, Self

from skinsource.actuators.rigs import Rig
from skinsource.base.arguments import checking, integer, one_of, real_number
from skinsource.base.errors import PlaybackError, printable, sentence
from skinsource.design.design import Design
from skinsource.engine.stimulus import Stimulus
from skinsource.lab.playing.devices import Output, device_of, devices
from skinsource.lab.playing.session import Mixer, mix_for
from skinsource.lab.playing.stream import (
    BLOCK_S,
    FADE_S,
    START_DB,
    Due,
    Mix,
    PlayQueue,
    Stream,
    ahead_of_ours_s,
    refused,
    with_trigger,
)
from skinsource.lab.playing.triggers import BITS

# The device answers within this time, or does not at all.
_ANSWER_S = 5.0
_LOOK_S = 0.25
# Nobody waits longer: such a time is one of another clock.
_FARTHEST_S = 3600.0


class Playback:
    """One time that a stimulus is played; `Player.play` returns it.

    Attributes
    ----------
    mix
        What is played: samples, (n_outputs, n_times), before the gain, and names of outputs.
    code
        What the trigger tells.
    requested_s
        When its first sample was to leave the device, s of its clock; None: soon.
    latency_s
        From when the device asked for the first sample until it left the device, s; None before.
    loopback_s
        Delay behind the time that the device tells, as a loopback measured it, s; None: not
        measured.
    """

    def __init__(
        self,
        stream: Stream,
        mix: Mix,
        requested_s: float | None,
        code: int,
        loopback_s: float | None,
    ) -> None:
        self.mix, self.code, self.requested_s, self.loopback_s = mix, code, requested_s, loopback_s
        self.latency_s: float | None = None
        self._stream, self._ahead_s = stream, 0.0
        self._first_s: float | None = None
        self._problem = ""
        self._underruns = stream.underruns
        self._begun, self._over = Event(), Event()

    @property
    def first_sample_s(self) -> float | None:
        """When the device says that the first sample left it, s of its clock; None: not yet."""
        return self._first_s

    @property
    def first_sample_monotonic_s(self) -> float | None:
        """The same in the clock of `time.monotonic`, s."""
        return self.first_sample_at(monotonic)

    def first_sample_at(self, clock: Callable[[], float]) -> float | None:
        """The same in another clock of this machine, s."""
        first_s = self.first_sample_s
        return None if first_s is None else first_s - self._ahead_s + ahead_of_ours_s(clock)

    @property
    def onset_monotonic_s(self) -> float | None:
        """When sound left the output, s of `time.monotonic`; None: not yet.

        It is estimated from what the device tells, unless a loopback was measured.
        """
        return self.onset_at(monotonic)

    def onset_at(self, clock: Callable[[], float]) -> float | None:
        """The same in another clock of this machine, s."""
        first_s = self.first_sample_at(clock)
        return None if first_s is None else first_s + (self.loopback_s or 0.0)

    @property
    def onset_is(self) -> Literal["estimated", "measured"]:
        """Whether a loopback was measured."""
        return "estimated" if self.loopback_s is None else "measured"

    @property
    def late_s(self) -> float:
        """How much later than asked the first sample left the device, s; 0 where it is not late."""
        if self.requested_s is None or self.first_sample_s is None:
            return 0.0
        late_s = self.first_sample_s - self.requested_s
        return late_s if late_s > 1.0 / self._stream.queue.sample_rate_hz else 0.0

    @property
    def underruns(self) -> int:
        """How often the device ran out of samples since it was asked for."""
        return self._stream.underruns - self._underruns

    @property
    def over(self) -> bool:
        """Whether it has ended."""
        return self._over.is_set()

    def wait(self, longest_s: float | None = None) -> bool:
        """Wait until it has ended; return whether it has.

        Raises
        ------
        PlaybackError
            It ended early, since a limit would have been passed or the device is gone.
        """
        return self._wait(self._over, longest_s)

    def wait_begin(self, longest_s: float | None = None) -> bool:
        """Wait until the device has taken its first sample; return whether it has.

        Raises
        ------
        PlaybackError
            The device is gone.
        """
        return self._wait(self._begun, longest_s) and self._first_s is not None

    def _wait(self, event: Event, longest_s: float | None) -> bool:
        until_s = inf if longest_s is None else perf_counter() + longest_s
        while not event.wait(min(_LOOK_S, max(until_s - perf_counter(), 0.0))):
            if self._stream.unresponsive:
                self._end(gone(self._stream.device.name))
            elif perf_counter() >= until_s:
                break
        if self._problem:
            raise PlaybackError(self._problem)
        return event.is_set()

    def stop(self) -> None:
        """Fade out within 5 ms; what has not begun yet does not begin."""
        if not self.over:
            self._stream.queue.due = None
            self._stream.queue.stop()

    def _begin(self, first_s: float) -> None:
        """Note when its first sample leaves the device."""
        self._ahead_s = self._stream.ahead_s()
        self.latency_s = first_s - self._stream.block_s
        self._first_s = first_s
        self._begun.set()

    def _end(self, problem: str = "") -> None:
        """Note that it is over, and why where that is early."""
        self._problem = problem
        self._begun.set()
        self._over.set()


def gone(name: str) -> str:
    """Return the sentence on a device that is lost."""
    return f"{name} is gone. Connect it, then play again."


class Player:
    """Plays one stimulus on a sound card, as often as it is told to.

    All is computed and the device is opened at once, and plays silence between.  Samples are those
    of an exported file, once: a loop of the design is not repeated.  The limiter refuses: where a
    peak would pass full scale, or a limit of the rig, nothing is played, as flattened peaks would
    be another stimulus.

    Parameters
    ----------
    stimulus
        A design, or channels (`skinsource.stimulus_of`).
    rig
        What the outputs are wired to; None: places get outputs in their order.
    device
        Name of the device, or an `Output` with rate, latency and wiring; None: that of the system.
    gain_db
        From -60 to 20 dB; 0 dB: 1 (1 V with an equaliser, full scale of a rig) is full scale.
    trigger_output
        Output, from 1, that tells the code of each time it is played; None: none.
    loopback_s
        Delay behind the time that the device tells, s: ``behind_s`` of
        `skinsource.rig_measuring.loopback`; None: onsets are called estimated.
    began
        Called with each `Playback` once its first sample is on its way, from a thread of its own,
        such as `Markers`.

    Raises
    ------
    PlaybackError
        There is no such device, it refuses, it has too few outputs, or a limit would be passed.
    InvalidInputError
        The stimulus cannot be played.

    Examples
    --------
    >>> import skinsource as ss
    >>> tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone),))
    >>> try:
    ...     player = ss.Player(design, device="No such card")
    ... except ss.SkinSourceError:
    ...     print("not here")
    not here
    """

    @checking
    def __init__(
        self,
        stimulus: Design | Stimulus,
        rig: Rig | None = None,
        device: str | Output | None = None,
        *,
        gain_db: float = START_DB,
        trigger_output: int | None = None,
        loopback_s: float | None = None,
        began: Callable[[Playback], None] | None = None,
    ) -> None:
        output = device if isinstance(device, Output) else Output(device=device or "")
        output = replace(output, trigger_output=trigger_output or output.trigger_output)
        #: The device that plays.
        self.device = device_of(output, devices())
        #: Delay behind the time that the device tells, s; None: not measured.
        self.loopback_s = (
            loopback_s if loopback_s is None else real_number("loopback_s", loopback_s)
        )
        if isinstance(stimulus, Design):
            stimulus = replace(stimulus, loop_s=None)
        #: What is played: names of outputs, samples, duration.
        self.mix = mix_for(Mixer(), self.device, stimulus, output, rig=rig)
        refusal = refused(self.mix, gain_db)
        if refusal is not None:
            raise PlaybackError(refusal.sentence)
        self._playback: Playback | None = None
        self._told: SimpleQueue[Playback | None] = SimpleQueue()
        self._teller: Thread | None = None
        self._untold: Exception | None = None
        self._queue = PlayQueue(self.mix.n_outputs, output.sample_rate_hz, gain_db, self._rest)
        self._stream = Stream(self._queue, self.device, output.latency_s, self._finish)
        self._stream.start()
        if not self._stream.answered.wait(_ANSWER_S):
            self.close()
            raise PlaybackError(
                f"{self.device.name} takes no samples. Reconnect it, or choose another."
            )
        if began is not None:
            self._teller = Thread(target=self._tell, args=(began,), daemon=True)
            self._teller.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def time_s(self) -> float:
        """The time now, s, in the clock of the stream."""
        return self._stream.time_s()

    @property
    def soonest_s(self) -> float:
        """How long before ``at`` `play` must be called, s: what the device holds, and a block."""
        return self._stream.inside_s + 2 * BLOCK_S + FADE_S

    def play(
        self,
        at: float | None = None,
        *,
        clock: Literal["stream", "monotonic"] = "stream",
        code: int = 1,
    ) -> Playback:
        """Begin to play, now or at a time, and return at once.

        Parameters
        ----------
        at
            When the first sample is to leave the device, s, in its clock (`time_s`) or in that of
            `time.monotonic`; None: as soon as the device can.  The sample is the nearest one.
            Sound comes ``loopback_s`` later.
        clock
            Whose time ``at`` is.
        code
            What the trigger and markers tell, 0 to 255.

        Raises
        ------
        PlaybackError
            It still plays, it is closed, ``at`` is past, too soon or more than an hour away, or
            ``began`` has failed.
        """
        if self._playback is not None and not self._playback.over:
            raise PlaybackError(
                "The player still plays. Call wait of the playback first, or stop and then wait."
            )
        if self._stream.closed or self._queue.ending is not None:
            raise PlaybackError("The player is closed. Make a new one.")
        self._check_told()
        one_of("clock", clock, ("stream", "monotonic"))
        code = integer("code", code, 0, 2**BITS - 1)
        at_s = None if at is None else real_number("at", at)
        if at_s is not None and clock == "monotonic":
            at_s += self._stream.ahead_s() - ahead_of_ours_s(monotonic)
        in_s = inf if at_s is None else at_s - self.time_s
        if in_s < self.soonest_s:
            raise PlaybackError(
                f"The device was asked to play in {in_s * 1e3:.1f} ms and needs "
                f"{self.soonest_s * 1e3:.1f} ms. Ask earlier."
            )
        if _FARTHEST_S < in_s < inf:
            raise PlaybackError(
                f"The device was asked to play in {in_s:.4g} s, expected at most "
                f"{_FARTHEST_S:g} s. Name the clock of at: stream or monotonic."
            )
        mix = self.mix
        if mix.trigger_output:
            mix = with_trigger(mix, mix.trigger_output, code)
        playback = Playback(self._stream, mix, at_s, code, self.loopback_s)
        self._playback = playback
        self._queue.begin(Due(mix, at_s, self._begin))
        return playback

    def stop(self) -> None:
        """Fade out what plays, see `Playback.stop`; where nothing plays, nothing happens."""
        if self._playback is not None:
            self._playback.stop()

    def close(self) -> None:
        """Fall silent and close the device.

        Raises
        ------
        PlaybackError
            ``began`` has failed.
        """
        self._stream.close()
        self._told.put(None)
        if self._teller is not None:
            self._teller.join()
        self._check_told()

    def _begin(self, first_s: float) -> None:
        """Note in the thread of the device that a playback begins."""
        playback = self._playback
        if playback is not None:
            playback._begin(first_s)
            self._told.put(playback)

    def _rest(self) -> None:
        if self._playback is not None:
            self._playback._end()

    def _finish(self) -> None:
        playback, ending = self._playback, self._queue.ending
        if playback is not None and not playback.over:
            problem = gone(self.device.name) if ending is None else ending.sentence
            # Closing the device falls silent at once: that is no problem.
            playback._end("" if self._stream.closed else problem)

    def _tell(self, began: Callable[[Playback], None]) -> None:
        while (playback := self._told.get()) is not None:
            try:
                began(playback)
            # Whatever it is, later playbacks are told.
            except Exception as error:  # noqa: BLE001  raised from close and play
                self._untold = error

    def _check_told(self) -> None:
        error, self._untold = self._untold, None
        if error is not None:
            raise PlaybackError(f"An onset was not told: {sentence(printable(error))}") from error
