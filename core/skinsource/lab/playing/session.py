"""Playing designs on a device, one after the other, with changes while they play.

Where there is no device, and in animations, a clock moves the playhead in silence.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np
import scipy

from skinsource.actuators.rigs import Margin, Rig, RigChannel, highest_gain
from skinsource.base.conventions import Complexes, Floats
from skinsource.base.errors import (
    InvalidInputError,
    NothingToPlayOnError,
    PlaybackError,
    SkinSourceError,
    counted,
    quoted,
)
from skinsource.base.job import Stop, never, stop_if
from skinsource.design.amplitudes import equaliser_of
from skinsource.design.design import Design, View
from skinsource.engine.evaluation import evaluate
from skinsource.engine.loops import animation_of
from skinsource.engine.stimulus import Stimulus, for_rig, stimulus_of, through_actuators
from skinsource.lab.playing.devices import (
    Device,
    DeviceRows,
    Output,
    check_outputs,
    device_of,
    devices,
    outputs_by_place,
    refresh_devices,
)
from skinsource.lab.playing.stream import (
    SHORTEST_LOOP_S,
    Mix,
    PlayQueue,
    Stream,
    mix_of,
    tone_of,
    with_trigger,
)
from skinsource.limbs.catalog import load_limb
from skinsource.limbs.limb import Limb

Loop = tuple[float, float] | None


class SilentRun:
    """Tells the position of silent playing from a clock.

    Parameters
    ----------
    duration_s
        Time at which it ends, unless it loops.
    loop_s
        Begin and end of the repeated part.
    at_s
        Time at which it begins.
    clock
        Returns seconds.
    slow_motion
        How many times slower than the clock it runs.

    Attributes
    ----------
    slow_motion
        The same.
    """

    def __init__(
        self,
        duration_s: float,
        loop_s: Loop,
        at_s: float,
        clock: Callable[[], float] = perf_counter,
        slow_motion: float = 1.0,
    ) -> None:
        self._clock, self.slow_motion = clock, slow_motion
        self._duration_s, self._loop_s = duration_s, loop_s
        self._at_s, self._since_s = at_s, clock()

    def position_s(self) -> float:
        """Return the time in the design, s."""
        later_s = self._at_s + (self._clock() - self._since_s) / self.slow_motion
        if self._loop_s is None or not self._at_s < self._loop_s[1] <= later_s:
            return later_s
        first_s, end_s = self._loop_s
        return first_s + (later_s - first_s) % (end_s - first_s)

    @property
    def over(self) -> bool:
        """Whether the end has passed."""
        loops = self._loop_s is not None and self._at_s < self._loop_s[1]
        return not loops and self.position_s() >= self._duration_s

    def seek(self, at_s: float) -> None:
        """Continue at another time."""
        self._at_s, self._since_s = at_s, self._clock()

    def change(self, duration_s: float, loop_s: Loop, slow_motion: float = 1.0) -> None:
        """Continue in another design, or at another speed; outside a new loop at its beginning."""
        here_s, stays = self.position_s(), loop_s in (None, self._loop_s)
        self._duration_s, self._loop_s, self.slow_motion = duration_s, loop_s, slow_motion
        self.seek(here_s if stays else _begin(here_s, duration_s, loop_s))


#: Outputs that are opened at least: a device of two may play a single channel on both.
_FEWEST = 2
_REAL_TIME = View()


@dataclass(frozen=True, slots=True, kw_only=True)
class Playing:
    """What is being played.

    Attributes
    ----------
    stream
        The stream of the device; None where it plays in silence.
    silent
        The silent playhead, where there is no stream.
    reason
        Why there is no sound, and what to do.
    visible_s
        When the response ends, which is after the last sound.
    """

    stream: Stream | None = None
    silent: SilentRun | None = None
    reason: str = ""
    visible_s: float = 0.0

    def visible_after(self, from_s: float) -> "Playing | None":
        """Return the rest of the response, in silence, from a time on; None after its end."""
        if from_s >= self.visible_s:
            return None
        return Playing(silent=SilentRun(self.visible_s, None, from_s), visible_s=self.visible_s)

    def position_s(self) -> float | None:
        """Return the time in the design that is heard now; None before the first sound."""
        if self.stream is not None:
            return self.stream.position_s()
        return None if self.silent is None else self.silent.position_s()

    def seek(self, at_s: float) -> None:
        """Continue at another time."""
        if self.silent is not None:
            self.silent.seek(at_s)
        elif self.stream is not None:
            queue = self.stream.queue
            queue.seek(round(at_s * queue.sample_rate_hz))

    @property
    def over(self) -> bool:
        """Whether it has ended unnoticed: in silence, or because the device is gone."""
        if self.stream is not None:
            return self.stream.unresponsive
        return self.silent is not None and self.silent.over


@dataclass(frozen=True, slots=True, kw_only=True)
class Peak:
    """The largest sample of a design for a device, before the gain.

    Attributes
    ----------
    full_scale
        In parts of full scale.
    volts
        At the actuators; None where no rig says it.
    device
        Name of the device.
    """

    full_scale: float
    volts: float | None
    device: str


class Session:
    """Renders and plays designs, for one thread, which may wait for the device.

    Parameters
    ----------
    finished
        Called from the thread of the device, with its stream, when playing has ended.
    """

    def __init__(self, finished: Callable[[Stream], None]) -> None:
        self._finished = finished
        self._mixer = Mixer()
        self._stream: Stream | None = None

    def devices(self) -> tuple[Device, ...]:
        """Stop playing, look for devices again, and return those to play on."""
        self.close()
        return refresh_devices()

    def animate(self, design: Design, view: View, *, loops: bool) -> Playing:
        """Begin to move the playhead through a design; no device is opened.

        Parameters
        ----------
        view
            How slowly, and where it begins, as in `play`; without a loop, inside what is repeated.
        loops
            Whether all that moves is repeated where the design has no loop.
        """
        self._start_over()
        duration_s, loop_s, slow_motion = self._animation(design, view, loops=loops)
        begin_s = _begin(view.playhead_s, duration_s, loop_s, own=design.loop_s is not None)
        silent = SilentRun(duration_s, loop_s, begin_s, slow_motion=slow_motion)
        return Playing(silent=silent, visible_s=duration_s)

    def _animation(self, design: Design, view: View, *, loops: bool) -> tuple[float, Loop, float]:
        """Return when the skin is at rest, what is repeated, and how many times slower it runs."""
        duration_s = response_end_s(design, self._mixer.stimulus(design).duration_s)
        if not loops:
            return duration_s, design.loop_s, view.slow_motion
        begin_s, end_s, slow_motion = animation_of(design, view)
        return duration_s, design.loop_s or (begin_s, end_s), slow_motion

    def peak(self, design: Design, output: Output, *, rig: Rig | None = None) -> Peak:
        """Return the largest sample that `play` would send, before the gain; none is sent.

        Raises
        ------
        SkinSourceError
            As for `play`.
        """
        device = device_of(output, devices())
        mix = self._mix(design, output, device, loops=False, rig=rig)
        peaks = np.abs(mix.samples).max(axis=1, initial=0.0)
        volts = [
            abs(channel.volts_at_full_scale) * float(peaks[channel.output - 1])
            for channel in (rig.channels if rig is not None and not output.stand_in else ())
            if channel.volts_at_full_scale is not None and mix.plays_on(channel.output)
        ]
        return Peak(full_scale=mix.peak, volts=max(volts, default=None), device=device.name)

    def play(
        self,
        design: Design,
        output: Output,
        *,
        loops: bool,
        at_s: float,
        gain_db: float,
        rig: Rig | None = None,
        stop: Stop = never,
    ) -> Playing:
        """Begin to play a design on a device; where there is none, in silence.

        Parameters
        ----------
        loops
            Whether the whole design is repeated where it has no loop.
        at_s
            Time to begin at, after the end the beginning; what begins behind the loop ends at the
            end of the design.
        rig
            What is wired to the device; None where it is not known.
        stop
            Called after rendering, which may take long, and before the device is opened.

        Raises
        ------
        SkinSourceError
            The design cannot be played, or the device refuses it; nothing is played then.
        Stopped
            ``stop`` returned True.
        """
        self._start_over()
        try:
            device = device_of(output, devices())
        except NothingToPlayOnError as missing:
            silent = self.animate(design, View(playhead_s=at_s), loops=loops)
            return replace(silent, reason=str(missing))
        mix = self._mix(design, output, device, loops=loops, rig=rig)
        stop_if(stop)
        loop_s, own = loop_of(design, mix.duration_s, loops=loops), design.loop_s is not None
        begin_s = _begin(at_s, mix.duration_s, loop_s, own=own)
        stream = self._open(mix, device, output, begin_s, gain_db)
        return Playing(stream=stream, visible_s=response_end_s(design, mix.duration_s))

    def _start_over(self) -> None:
        self.close()
        # The name of a limb may mean other data by now.
        self._mixer = Mixer()

    def change(
        self,
        playing: Playing,
        design: Design,
        output: Output,
        *,
        loops: bool,
        rig: Rig | None = None,
        view: View = _REAL_TIME,
    ) -> Playing | None:
        """Change to an edited design at the present position; None where playing has ended."""
        if playing.silent is not None:
            playing.silent.change(*self._animation(design, view, loops=loops))
            return playing
        stream = playing.stream
        if stream is None or stream is not self._stream or stream.queue.ending is not None:
            return None
        queue = stream.queue
        mix = self._mix(design, output, stream.device, loops=loops, rig=rig)
        visible_s = response_end_s(design, mix.duration_s)
        if mix.n_outputs <= queue.n_outputs:
            queue.play(mix)
            return (
                playing if visible_s == playing.visible_s else replace(playing, visible_s=visible_s)
            )
        # The mix needs more outputs than the device was opened with.
        at_s, gain_db = stream.position_s() or 0.0, queue.gain_db
        self.close()
        opened = self._open(mix, stream.device, output, at_s, gain_db)
        return Playing(stream=opened, visible_s=visible_s)

    def tone(self, number: int, output: Output, gain_db: float, rig: Rig | None = None) -> Playing:
        """Play the test tone on one output; no louder than ``rig`` allows.

        Raises
        ------
        SkinSourceError
            There is no device, or it refuses.
        """
        self.close()
        device = device_of(output, devices())
        check_outputs(device, {0: number})
        n_outputs = max(number, min(_FEWEST, device.n_outputs))
        _check_rig_device(rig, device)
        tone = tone_of(number, n_outputs, output.sample_rate_hz)
        places = (
            [channel.place for channel in rig.channels if channel.output == number] if rig else []
        )
        if rig is not None and places:
            row = tone.samples[number - 1 : number].astype(np.float64)
            margin = highest_gain(rig, places[:1], row, output.sample_rate_hz)
            tone = replace(tone, most_gain=margin.factor, limit=margin.words)
        return Playing(stream=self._open(tone, device, output, 0.0, gain_db))

    def close_stream(self, stream: Stream) -> None:
        """Close ``stream``, if it is the present one."""
        if stream is self._stream:
            self.close()

    def close(self) -> None:
        """Stop playing and close the device."""
        if self._stream is not None:
            self._stream.close()
            self._stream = None

    def _open(
        self, mix: Mix, device: Device, output: Output, at_s: float, gain_db: float
    ) -> Stream:
        queue = PlayQueue(mix.n_outputs, mix.sample_rate_hz, gain_db)
        queue.play(mix, round(at_s * mix.sample_rate_hz))
        opened: list[Stream] = []
        stream = Stream(queue, device, output.latency_s, lambda: self._finished(opened[0]))
        opened.append(stream)
        self._stream = stream
        stream.start()
        return stream

    def _mix(
        self, design: Design, output: Output, device: Device, *, loops: bool, rig: Rig | None
    ) -> Mix:
        return mix_for(self._mixer, device, design, output, loops=loops, rig=rig)


def mix_for(
    mixer: "Mixer",
    device: Device,
    played: Design | Stimulus,
    output: Output,
    *,
    loops: bool = False,
    rig: Rig | None = None,
) -> Mix:
    """Return what a device plays; an error where it has too few outputs or is not that of a rig."""
    _check_rig_device(rig, device)
    least = min(_FEWEST, device.n_outputs)
    mix = mixer.mix(played, output, loops=loops, least_outputs=least, rig=rig)
    if not output.stand_in:
        wired = outputs_by_place(played, output, rig)
        audible = {place: number for place, number in wired.items() if mix.plays_on(number)}
        check_outputs(device, audible)
    if mix.trigger_output > device.n_outputs:
        raise PlaybackError(
            f"{device.name} has {counted(device.n_outputs, 'output')}, and the trigger is on "
            f"output {output.trigger_output}. Choose another output or device."
        )
    return mix


def response_end_s(design: Design, duration_s: float) -> float:
    """Return when the skin comes to rest after a stimulus of ``duration_s``: one response later.

    Where the limb is not installed, or its actuators cannot be predicted through, there is no
    response, and it is the end of the stimulus.
    """
    try:
        limb = evaluate(design, "driven_limb")["driven_limb"]
    except SkinSourceError:
        return duration_s
    return duration_s + (limb.n_taps - limb.lead_samples) / float(limb.sample_rate_hz)


def _check_rig_device(rig: Rig | None, device: Device) -> None:
    """Raise where a rig, whose volts hold for its own device alone, is wired to another device."""
    for channel in rig.channels if rig is not None else ():
        if channel.device and channel.device not in (device.name, device.title):
            raise PlaybackError(
                f"The rig is wired to {quoted(channel.device)}, but {device.name} is chosen. "
                "Choose that device, another rig, or none."
            )


def _begin(at_s: float, duration_s: float, loop_s: Loop, *, own: bool = False) -> float:
    """Return ``at_s`` where it is inside the played part, else the beginning of that.

    Before and behind a loop of its ``own``, a design is played as well.
    """
    first_s, end_s = loop_s or (0.0, duration_s)
    from_s, to_s = (0.0, max(end_s, duration_s)) if own else (first_s, end_s)
    return at_s if from_s <= at_s < to_s else first_s


def analytic(rows: Floats) -> Complexes:
    """Return ``rows``, (n_channels, n_times), without their negative frequencies.

    The real part is ``rows``.  Ringing beyond the ends is cut off.
    """
    n = rows.shape[1]
    # Padding, so that ringing at one end does not wrap round to the other.
    length = scipy.fft.next_fast_len(2 * n + 1)
    return scipy.signal.hilbert(rows, length, axis=1)[:, :n]


def turned_up(parts: Floats, sample_rate_hz: int, shift_hz: float) -> Floats:
    """Return signals with all frequencies ``shift_hz`` higher.

    Parameters
    ----------
    parts : (2 n_channels, n_times)
        Real parts of all analytic signals, then their imaginary parts.
    sample_rate_hz
        Their rate, high enough for the shifted frequencies.
    shift_hz
        The shift.

    Returns
    -------
    (n_channels, n_times)
    """
    n = parts.shape[0] // 2
    # Whole turns are subtracted first, so that long designs lose no accuracy.
    turns = (np.arange(parts.shape[1]) * (shift_hz / sample_rate_hz)) % 1.0
    angle = 2.0 * np.pi * turns
    return parts[:n] * np.cos(angle) - parts[n:] * np.sin(angle)


def on_two_ears(rows: Floats) -> Floats:
    """Return left and right, (2, n_times), of channels spread from left to right in their order.

    The two shares of a channel add up to 1; a single channel is in the middle.
    """
    n = rows.shape[0]
    to_right = (np.arange(n) + 0.5) / max(n, 1)
    return np.stack((1.0 - to_right, to_right)) @ rows


#: Samples of all outputs together: one gigabyte.
MOST_SAMPLES = 2**28
_EARS = {1: "left", 2: "right"}


class Mixer:
    """Makes mixes; unchanged rows and margins of the last mix are used again.

    An amplitude of 1, or 1 V, is full scale before the gain where no rig says otherwise, so that
    the level of a track does not depend on other tracks.
    """

    def __init__(self) -> None:
        self.rows = DeviceRows()
        self._limb: tuple[str, Limb] | None = None
        self._margins: dict[tuple[int, RigChannel | None, bool, bytes], Margin] = {}

    def stimulus(self, design: Design) -> Stimulus:
        """Return the channels of a design, at the rate of its limb."""
        if self._limb is None or self._limb[0] != design.limb:
            self._limb = design.limb, load_limb(design.limb)
        return stimulus_of(design, limb=self._limb[1])

    def mix(
        self,
        played: Design | Stimulus,
        output: Output,
        *,
        loops: bool = False,
        least_outputs: int = 1,
        rig: Rig | None = None,
    ) -> Mix:
        """Return what ``output`` plays, from time 0 on.

        Parameters
        ----------
        played
            A design, or the channels of one.
        loops
            Whether the whole design is repeated where it has no loop.
        least_outputs
            Outputs of the mix at least; further ones are silent.
        rig
            What the outputs are wired to: locations, volts, polarity and limits.  The equaliser of
            a design makes the volts for it; without a rig, for the actuators of the design.

        Raises
        ------
        InvalidInputError
            The design cannot be played: an input cannot be sampled, or the design is too long, or
            its loop too short, or its trigger is on an output that plays.
        DatasetMissingError
            Its limb is a measured one, and no measured dataset is installed.
        """
        design = None if isinstance(played, Stimulus) else played
        stimulus = played if isinstance(played, Stimulus) else self.stimulus(played)
        rate_hz = output.sample_rate_hz
        own_hz = _whole_hertz(stimulus.sample_rate_hz)
        _check_length(stimulus, rate_hz)
        if output.stand_in:
            whole = analytic(stimulus.samples)
            parts = self.rows.at(np.concatenate((whole.real, whole.imag)), own_hz, rate_hz)
            rows = on_two_ears(turned_up(parts, rate_hz, output.shift_hz))
            outputs, titles = list(_EARS), list(_EARS.values())
        else:
            sent, equaliser = stimulus, None if design is None else equaliser_of(design)
            if rig is not None:
                sent = for_rig(stimulus, rig, equaliser)
            elif equaliser is not None and design is not None and design.actuation is not None:
                sent = through_actuators(stimulus, design.actuation, equaliser)
            rows = self.rows.at(sent.samples, own_hz, rate_hz)
            wired = outputs_by_place(played, output, rig)
            places = [channel.place for channel in stimulus.channels if channel.place is not None]
            outputs = [wired[place] for place in places]
            titles = [f"place {place}" for place in places]
        # For ears there is no recorder.
        triggers = 0 if output.stand_in else output.trigger_output
        loop_s = None if design is None else loop_of(design, stimulus.duration_s, loops=loops)
        mix = mix_of(
            rows,
            rate_hz,
            outputs=outputs,
            titles=titles,
            n_outputs=max([1, least_outputs, triggers, *outputs]),
            loop_s=loop_s,
        )
        if triggers:
            mix = with_trigger(mix, triggers, output.trigger_code)
        if rig is None or output.stand_in:
            return mix
        margin = self._margin(rig, places, sent.samples, own_hz, repeated=loop_s is not None)
        return replace(mix, most_gain=margin.factor, limit=margin.words)

    def _margin(
        self, rig: Rig, places: list[int], rows: Floats, rate_hz: int, *, repeated: bool
    ) -> Margin:
        """Return the highest gain of all rows; margins of unchanged rows are not computed again."""
        known, self._margins = self._margins, {}
        for place, row in zip(places, rows, strict=True):
            key = place, rig.channel_of(place), repeated, row.tobytes()
            margin = known.get(key)
            if margin is None:
                margin = highest_gain(rig, [place], row[np.newaxis], rate_hz, repeated=repeated)
            self._margins[key] = margin
        return min([Margin(), *self._margins.values()], key=lambda margin: margin.factor)


def loop_of(design: Design, duration_s: float, *, loops: bool) -> tuple[float, float] | None:
    """Return begin and end of the repeated part, s; None where nothing is repeated."""
    if design.loop_s is not None:
        return design.loop_s
    return (0.0, max(duration_s, SHORTEST_LOOP_S)) if loops else None


def _whole_hertz(rate_hz: float) -> int:
    if not float(rate_hz).is_integer():
        raise InvalidInputError(
            f"The limb is sampled at {rate_hz:g} Hz, expected a whole number of hertz to play"
        )
    return int(rate_hz)


def _check_length(stimulus: Stimulus, rate_hz: int) -> None:
    samples = len(stimulus.channels) * stimulus.duration_s * rate_hz
    if samples > MOST_SAMPLES:
        raise InvalidInputError(
            f"The design lasts {stimulus.duration_s:.4g} s on {len(stimulus.channels)} outputs, "
            f"which does not fit into memory at {rate_hz} Hz. Choose a lower rate, or mute inputs."
        )
