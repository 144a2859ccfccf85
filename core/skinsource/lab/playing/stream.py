"""Playing a queue on a device, block by block, within full scale and the limits of a rig.

Samples are never made smaller, which would change the stimulus: instead playing ends with a reason.
"""

from collections.abc import Callable
from math import inf, log10
from threading import Event
from time import perf_counter
from typing import Any

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.errors import PlaybackError, counted
from skinsource.lab.playing.devices import Device, refusal_text, sound_library
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
    """Return whether the gain is more than the rig allows; sets the ending if so."""
    mix = queue.mix
    if mix is None or max(queue.gain.target, queue.gain.now) <= mix.most_gain:
        return False
    most_gain = mix.most_gain
    queue.ending = Ending(
        reason="rig", name=mix.limit, highest_db=20.0 * log10(most_gain) if most_gain else -inf
    )
    return True


def playable_samples(queue: PlayQueue, block: Floats) -> int:
    """Return the samples before the first that must not be played; sets the ending if any."""
    magnitude = queue.other[:, : block.shape[1]]
    np.abs(block, out=magnitude)
    # The maximum of samples with NaN is NaN, which fails the comparison.
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


def next_block(queue: PlayQueue, out: Frames) -> None:
    """Fill ``out`` with the samples that are played next, and advance the queue.

    It runs in the thread of the device: nothing in here waits or allocates much.  No sample passes
    full scale: before the first that would, all outputs fall to silence, and ``queue.ending`` tells
    why.

    Parameters
    ----------
    queue
        What to play.
    out : (n_frames, n_outputs)
        Samples for the device, any number of frames.
    """
    n = out.shape[0]
    for start in range(0, n, MOST_SAMPLES):
        end = min(start + MOST_SAMPLES, n)
        block = queue.work[:, : end - start]
        _fill(queue, block, first=start == 0)
        out[start:end] = block.T
        queue.meters.add(block, queue.scratch)
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
    """Begin to fade to the requested mix, unless another fade is not over yet."""
    swap = queue.swap
    if swap is None or queue.faded < queue.fade.size:
        return
    queue.swap = None
    queue.old, queue.old_position = queue.mix, queue.position
    queue.mix, queue.faded = swap.mix, 0
    if swap.mix is not None:
        queue.position = _position_in(swap.mix, swap, queue)
        queue.changed_s = perf_counter()
        queue.waited_s = queue.changed_s - swap.requested_s


def _position_in(mix: Mix, swap: MixChange, queue: PlayQueue) -> int:
    """Return the position at which a mix begins."""
    if swap.at is None and queue.old is not None:
        inside = mix.loop is None or queue.old_position < mix.loop[1]
        if inside:
            return queue.old_position
    first = mix.loop[0] if mix.loop is not None else 0
    position = first if swap.at is None else swap.at
    if mix.loop is not None and position >= mix.loop[1]:
        position = first
    # Samples before it are faded in, so that the first sample is played in full.
    return position - queue.fade.size


def _render(queue: PlayQueue, block: Floats) -> None:
    """Fill ``block`` with samples before the gain."""
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
    """Fill ``block`` with the fall from the last samples to silence."""
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


#: Duration of a block that a device requests.
BLOCK_S = 0.005
_GONE_AFTER_S = 2.0
_LONGEST_WAIT_S = 1.0


class Stream:
    """Plays a queue on a device until the queue ends or the stream is closed.

    Parameters
    ----------
    queue
        What to play.
    device
        Device that is opened, with as many outputs as the queue has.
    latency_s
        Requested delay.
    finished
        Called from another thread when playing has ended, for any reason.

    Attributes
    ----------
    underruns
        How often the device ran out of samples.
    closed
        Whether it was closed, so that ``finished`` need not be handled.

    Raises
    ------
    PlaybackError
        sounddevice is missing, or the device refuses rate, outputs or delay.
    """

    def __init__(
        self, queue: PlayQueue, device: Device, latency_s: float, finished: Callable[[], None]
    ) -> None:
        self._library = sound_library()
        self.queue, self.device = queue, device
        self.underruns, self.closed = 0, False
        self._silent, self._finished = Event(), finished
        self._position, self._clock = HeardPosition(queue.sample_rate_hz), DeviceClock()
        self._called_s = perf_counter()
        self._inside_s = 0.0
        self._changed_s = 0.0
        try:
            self._stream = self._library.OutputStream(
                samplerate=queue.sample_rate_hz,
                blocksize=round(BLOCK_S * queue.sample_rate_hz),
                device=device.index,
                channels=queue.n_outputs,
                dtype="float32",
                latency=latency_s,
                # Samples arrive unchanged; full scale is checked before.
                dither_off=True,
                clip_off=True,
                callback=self._fill,
                finished_callback=self._finish,
            )
        except self._library.PortAudioError as error:
            raise self._refusal(error) from error

    def start(self) -> None:
        """Start playing.

        Raises
        ------
        PlaybackError
            The device does not start.
        """
        self._called_s = perf_counter()
        try:
            self._stream.start()
        except self._library.PortAudioError as error:
            self.close()
            raise self._refusal(error) from error

    def close(self) -> None:
        """Fall silent, and close the device."""
        self.closed = True
        if self._stream.active:
            # Closing the stream at once would make a click.
            self.queue.stop_at_once()
            self._silent.wait(_LONGEST_WAIT_S)
        # Closing a device that was unplugged fails, and that does not matter.
        self._stream.close(ignore_errors=True)

    @property
    def unresponsive(self) -> bool:
        """Whether the device has not requested a block for two seconds."""
        return perf_counter() - self._called_s > _GONE_AFTER_S

    def position_s(self) -> float | None:
        """Return the time in the design that is heard now; None where nothing is."""
        return None if self.closed else self._position.at(self._clock.at(perf_counter()))

    def delay(self, render_s: float) -> Delay:
        """Return the delay from the last edit to the outputs, after rendering for ``render_s``."""
        return Delay(render_s=render_s, wait_s=self.queue.waited_s, device_s=self._inside_s)

    def _refusal(self, error: Any) -> PlaybackError:
        device, rate_hz = self.device, self.queue.sample_rate_hz
        channels = counted(self.queue.n_outputs, "output")
        text = refusal_text(error, device.name, device.sample_rate_hz, rate_hz, channels)
        return PlaybackError(text)

    def _finish(self) -> None:
        self._silent.set()
        self._finished()

    def _fill(self, out: Frames, frames: int, times: Any, status: Any) -> None:
        self._called_s = perf_counter()
        self._clock.note(times.currentTime, self._called_s)
        self.underruns += bool(status.output_underflow)
        queue = self.queue
        inside_s = times.outputBufferDacTime - times.currentTime
        if inside_s <= 0.0:
            # Some systems do not say when a block is heard.
            inside_s = self._stream.latency
        next_block(queue, out)
        heard_s = times.currentTime + inside_s
        self._position.note(heard_s, queue.began_at, queue.began_in)
        if queue.changed_s != self._changed_s:
            self._changed_s, self._inside_s = queue.changed_s, inside_s
        if queue.silent:
            raise self._library.CallbackStop
