"""What is never played: samples beyond full scale, and more gain than a rig allows.

Nothing is made smaller, which would change the stimulus: playing ends, and says why.
"""

from collections.abc import Callable
from math import inf, log10
from threading import Event
from time import perf_counter
from typing import Any

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.errors import PlaybackError
from skinsource.lab.playing.devices import Device, playing_error_text, sound_library
from skinsource.lab.playing.mix import (
    MOST_SAMPLES,
    Delay,
    DeviceClock,
    Ending,
    Frames,
    HeardPosition,
    Mix,
    MixChange,
    PlayQueue,
)


def exceeds_the_rig(queue: PlayQueue) -> bool:
    """Whether the gain is more than the rig allows; nothing of it is played then."""
    mix = queue.mix
    if mix is None or max(queue.gain.wanted, queue.gain.now) <= mix.most_gain:
        return False
    most_gain = mix.most_gain
    queue.ending = Ending(
        reason="rig", name=mix.limit, highest_db=20.0 * log10(most_gain) if most_gain else -inf
    )
    return True


def playable_samples(queue: PlayQueue, block: Floats) -> int:
    """Samples before the first that may not be played; sets the ending where there is one."""
    magnitude = queue.other[:, : block.shape[1]]
    np.abs(block, out=magnitude)
    # NaN is the maximum of whatever holds it, and not less than anything.
    if not magnitude.size or magnitude.max() <= 1.0:
        return block.shape[1]
    first = int(np.argmax(~(magnitude <= 1.0).all(axis=0)))
    output = int(np.argmax(~(magnitude[:, first] <= 1.0)))
    peak = float(magnitude[output, first])
    mixes = [mix for mix in (queue.mix, queue.old) if mix is not None]
    names = mixes[0].names if mixes else ()
    largest = max((mix.peak for mix in mixes), default=peak)
    queue.ending = Ending(
        reason="limit" if np.isfinite(peak) else "broken",
        output=output + 1,
        name=names[output] if output < len(names) else "",
        peak=peak,
        highest_db=-20.0 * log10(largest) if 0.0 < largest < inf else 0.0,
    )
    return first


# The next block of samples: all that happens between a mix and the device.


def next_block(queue: PlayQueue, out: Frames) -> None:
    """Fill ``out`` with what is played next, and move the deck on.

    Nothing in here waits, and nothing grows: it runs in the thread of the device.  A sample never
    passes full scale: the first that would is not played, and all outputs fall to silence from
    where they are.  Silent once ``deck.ending`` says why.

    Parameters
    ----------
    deck
        What to play.
    out : (n_frames, n_outputs)
        What the device gets, of any length.
    """
    n = out.shape[0]
    for start in range(0, n, MOST_SAMPLES):
        end = min(start + MOST_SAMPLES, n)
        block = queue.work[:, : end - start]
        _fill(queue, block, first=start == 0)
        out[start:end] = block.T
        queue.meters.hear(block, queue.scratch)
    queue.played_samples += n


def _fill(queue: PlayQueue, block: Floats, *, first: bool) -> None:
    if queue.panic and queue.ending is None:
        queue.ending = Ending(reason="panic")
        queue.fallen = 0
    queue.panic = False
    if queue.ending is None:
        _begin_mix_change(queue)
        if exceeds_the_rig(queue):
            queue.fallen = 0
            _fall(queue, block)
            return
        if first:
            queue.began_at, queue.began_in = queue.position, queue.mix
        _render(queue, block)
        factors = queue.factors[: block.shape[1]]
        queue.gain.fill(factors)
        np.multiply(block, factors, out=block)
        sound = playable_samples(queue, block)
        if sound < block.shape[1]:
            queue.fallen = 0
            if sound:
                np.copyto(queue.last, block[:, sound - 1])
            _fall(queue, block[:, sound:])
            return
        np.copyto(queue.last, block[:, -1])
        _end_after_last_sample(queue)
    else:
        _fall(queue, block)


def _begin_mix_change(queue: PlayQueue) -> None:
    """Begin to go over to the mix that is wanted, unless one is still on its way."""
    swap = queue.swap
    if swap is None or queue.faded < queue.fade.size:
        return
    queue.swap = None
    queue.old, queue.old_position = queue.mix, queue.position
    queue.mix, queue.faded = swap.mix, 0
    if swap.mix is not None:
        queue.position = _position_in(swap.mix, swap, queue)
        queue.taken_s = perf_counter()
        queue.waited_s = queue.taken_s - swap.handed_s


def _position_in(mix: Mix, swap: MixChange, queue: PlayQueue) -> int:
    """Where a mix goes on."""
    if swap.at is None and queue.old is not None:
        inside = mix.loop is None or queue.old_position < mix.loop[1]
        if inside:
            return queue.old_position
    first = mix.loop[0] if mix.loop is not None else 0
    position = first if swap.at is None else swap.at
    if mix.loop is not None and position >= mix.loop[1]:
        position = first
    # What stands before it is faded in, so that the first sample that counts is whole.
    return position - queue.fade.size


def _render(queue: PlayQueue, block: Floats) -> None:
    """Samples before the gain."""
    if queue.mix is None:
        block[:] = 0.0
    else:
        queue.position = queue.mix.read(queue.position, block[: queue.mix.n_outputs])
        block[queue.mix.n_outputs :] = 0.0
    n = min(queue.fade.size - queue.faded, block.shape[1])
    if n <= 0:
        return
    old = queue.other[:, :n]
    if queue.old is None:
        old[:] = 0.0
    else:
        queue.old_position = queue.old.read(queue.old_position, old[: queue.old.n_outputs])
        old[queue.old.n_outputs :] = 0.0
    passing = block[:, :n]
    passing -= old
    passing *= queue.fade[queue.faded : queue.faded + n]
    passing += old
    queue.faded += n
    if queue.faded == queue.fade.size:
        queue.old = None


def _fall(queue: PlayQueue, block: Floats) -> None:
    """Go on from the last samples to silence."""
    block[:] = 0.0
    if queue.fallen is None or queue.fallen >= queue.fall.size:
        return
    n = min(queue.fall.size - queue.fallen, block.shape[1])
    np.multiply(
        queue.last[:, np.newaxis], queue.fall[queue.fallen : queue.fallen + n], out=block[:, :n]
    )
    queue.fallen += n


def _end_after_last_sample(queue: PlayQueue) -> None:
    if queue.faded < queue.fade.size or queue.swap is not None:
        return
    if queue.mix is None:
        queue.ending = Ending(reason="stopped")
    elif queue.mix.loop is None and queue.position >= queue.mix.n_times:
        queue.ending = Ending(reason="end")


# A deck that is heard on a device.

#: What a device asks for at once.
BLOCK_S = 0.005
_GONE_AFTER_S = 2.0
_LONGEST_WAIT_S = 1.0


class Stream:
    """Plays a deck from when it is opened until the deck ends, or is closed.

    Parameters
    ----------
    deck
        What to play.
    device
        Where; it is asked for as many outputs as the deck has.
    latency_s
        Delay that is asked for.
    finished
        Called from another thread when nothing is played any more, for whatever reason.

    Attributes
    ----------
    underruns
        How often the device ran out of samples.
    closed
        Whether it was closed: nobody need be told that it has finished.

    Raises
    ------
    PlaybackError
        sounddevice is missing, or the device does not take what it is asked for.
    """

    def __init__(
        self, queue: PlayQueue, device: Device, latency_s: float, finished: Callable[[], None]
    ) -> None:
        self._library = sound_library()
        self.deck, self.device = queue, device
        self.underruns, self.closed = 0, False
        self._silent, self._finished = Event(), finished
        self._heard, self._clock = HeardPosition(queue.sample_rate_hz), DeviceClock()
        self._called_s = perf_counter()
        self._inside_s = 0.0
        self._taken_s = 0.0
        try:
            self._stream = self._library.OutputStream(
                samplerate=queue.sample_rate_hz,
                blocksize=round(BLOCK_S * queue.sample_rate_hz),
                device=device.index,
                channels=queue.n_outputs,
                dtype="float32",
                latency=latency_s,
                # What arrives is what was sent: nothing is added, and full scale is kept before.
                dither_off=True,
                clip_off=True,
                callback=self._fill,
                finished_callback=self._finish,
            )
        except self._library.PortAudioError as error:
            text = playing_error_text(error, device, queue.sample_rate_hz, queue.n_outputs)
            raise PlaybackError(text) from error

    def start(self) -> None:
        """Begin.

        Raises
        ------
        PlaybackError
            The device does not begin.
        """
        self._called_s = perf_counter()
        try:
            self._stream.start()
        except self._library.PortAudioError as error:
            self.close()
            text = playing_error_text(
                error, self.device, self.deck.sample_rate_hz, self.deck.n_outputs
            )
            raise PlaybackError(text) from error

    def close(self) -> None:
        """Fall silent, and let go of the device."""
        self.closed = True
        if self._stream.active:
            # To close it at once would be a click.
            self.deck.stop_at_once()
            self._silent.wait(_LONGEST_WAIT_S)
        # A device that is gone cannot be closed in order, and need not be.
        self._stream.close(ignore_errors=True)

    @property
    def gone(self) -> bool:
        """Whether the device has not asked for anything for two seconds."""
        return perf_counter() - self._called_s > _GONE_AFTER_S

    def position_s(self) -> float | None:
        """Time in the design of what is heard now; None: nothing is yet, or any more."""
        return None if self.closed else self._heard.at(self._clock.at(perf_counter()))

    def delay(self, render_s: float) -> Delay:
        """From the last edit to the outputs; ``render_s`` is what came before the deck."""
        return Delay(render_s=render_s, wait_s=self.deck.waited_s, device_s=self._inside_s)

    def _finish(self) -> None:
        self._silent.set()
        self._finished()

    def _fill(self, out: Frames, frames: int, times: Any, status: Any) -> None:
        self._called_s = perf_counter()
        self._clock.note(times.currentTime, self._called_s)
        self.underruns += bool(status.output_underflow)
        queue = self.deck
        inside_s = times.outputBufferDacTime - times.currentTime
        if inside_s <= 0.0:
            # Some systems do not say when a block is heard.
            inside_s = self._stream.latency
        next_block(queue, out)
        heard_s = times.currentTime + inside_s
        self._heard.note(heard_s, queue.began_at, queue.began_in)
        if queue.taken_s != self._taken_s:
            self._taken_s, self._inside_s = queue.taken_s, inside_s
        if queue.silent:
            raise self._library.CallbackStop
