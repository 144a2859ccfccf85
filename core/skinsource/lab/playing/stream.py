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


def exceeds_the_rig(deck: PlayQueue) -> bool:
    """Whether the gain is more than the rig allows; nothing of it is played then."""
    mix = deck.mix
    if mix is None or max(deck.gain.wanted, deck.gain.now) <= mix.most_gain:
        return False
    most = mix.most_gain
    deck.ending = Ending(
        reason="rig", name=mix.limit, highest_db=20.0 * log10(most) if most else -inf
    )
    return True


def playable_samples(deck: PlayQueue, block: Floats) -> int:
    """Samples before the first that may not be played; sets the ending where there is one."""
    magnitude = deck.other[:, : block.shape[1]]
    np.abs(block, out=magnitude)
    # NaN is the maximum of whatever holds it, and not less than anything.
    if not magnitude.size or magnitude.max() <= 1.0:
        return block.shape[1]
    first = int(np.argmax(~(magnitude <= 1.0).all(axis=0)))
    output = int(np.argmax(~(magnitude[:, first] <= 1.0)))
    peak = float(magnitude[output, first])
    mixes = [one for one in (deck.mix, deck.old) if one is not None]
    names = mixes[0].names if mixes else ()
    largest = max((one.peak for one in mixes), default=peak)
    deck.ending = Ending(
        reason="limit" if np.isfinite(peak) else "broken",
        output=output + 1,
        name=names[output] if output < len(names) else "",
        peak=peak,
        highest_db=-20.0 * log10(largest) if 0.0 < largest < inf else 0.0,
    )
    return first


# The next block of samples: all that happens between a mix and the device.


def next_block(deck: PlayQueue, out: Frames) -> None:
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
        block = deck.work[:, : end - start]
        _fill(deck, block, first=start == 0)
        out[start:end] = block.T
        deck.meters.hear(block, deck.scratch)
    deck.played_samples += n


def _fill(deck: PlayQueue, block: Floats, *, first: bool) -> None:
    if deck.panic and deck.ending is None:
        deck.ending = Ending(reason="panic")
        deck.fallen = 0
    deck.panic = False
    if deck.ending is None:
        _take_what_is_wanted(deck)
        if exceeds_the_rig(deck):
            deck.fallen = 0
            _fall(deck, block)
            return
        if first:
            deck.began_at, deck.began_in = deck.position, deck.mix
        _render(deck, block)
        factors = deck.factors[: block.shape[1]]
        deck.gain.fill(factors)
        np.multiply(block, factors, out=block)
        sound = playable_samples(deck, block)
        if sound < block.shape[1]:
            deck.fallen = 0
            if sound:
                np.copyto(deck.last, block[:, sound - 1])
            _fall(deck, block[:, sound:])
            return
        np.copyto(deck.last, block[:, -1])
        _end_where_all_is_played(deck)
    else:
        _fall(deck, block)


def _take_what_is_wanted(deck: PlayQueue) -> None:
    """Begin to go over to the mix that is wanted, unless one is still on its way."""
    swap = deck.swap
    if swap is None or deck.faded < deck.fade.size:
        return
    deck.swap = None
    deck.old, deck.old_position = deck.mix, deck.position
    deck.mix, deck.faded = swap.mix, 0
    if swap.mix is not None:
        deck.position = _position_in(swap.mix, swap, deck)
        deck.taken_s = perf_counter()
        deck.waited_s = deck.taken_s - swap.handed_s


def _position_in(mix: Mix, swap: MixChange, deck: PlayQueue) -> int:
    """Where a mix goes on."""
    if swap.at is None and deck.old is not None:
        inside = mix.loop is None or deck.old_position < mix.loop[1]
        if inside:
            return deck.old_position
    first = mix.loop[0] if mix.loop is not None else 0
    wanted = first if swap.at is None else swap.at
    if mix.loop is not None and wanted >= mix.loop[1]:
        wanted = first
    # What stands before it is faded in, so that the first sample that counts is whole.
    return wanted - deck.fade.size


def _render(deck: PlayQueue, block: Floats) -> None:
    """Samples before the gain."""
    if deck.mix is None:
        block[:] = 0.0
    else:
        deck.position = deck.mix.read(deck.position, block[: deck.mix.n_outputs])
        block[deck.mix.n_outputs :] = 0.0
    n = min(deck.fade.size - deck.faded, block.shape[1])
    if n <= 0:
        return
    old = deck.other[:, :n]
    if deck.old is None:
        old[:] = 0.0
    else:
        deck.old_position = deck.old.read(deck.old_position, old[: deck.old.n_outputs])
        old[deck.old.n_outputs :] = 0.0
    passing = block[:, :n]
    passing -= old
    passing *= deck.fade[deck.faded : deck.faded + n]
    passing += old
    deck.faded += n
    if deck.faded == deck.fade.size:
        deck.old = None


def _fall(deck: PlayQueue, block: Floats) -> None:
    """Go on from the last samples to silence."""
    block[:] = 0.0
    if deck.fallen is None or deck.fallen >= deck.fall.size:
        return
    n = min(deck.fall.size - deck.fallen, block.shape[1])
    np.multiply(
        deck.last[:, np.newaxis], deck.fall[deck.fallen : deck.fallen + n], out=block[:, :n]
    )
    deck.fallen += n


def _end_where_all_is_played(deck: PlayQueue) -> None:
    if deck.faded < deck.fade.size or deck.swap is not None:
        return
    if deck.mix is None:
        deck.ending = Ending(reason="stopped")
    elif deck.mix.loop is None and deck.position >= deck.mix.n_times:
        deck.ending = Ending(reason="end")


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
        self, deck: PlayQueue, device: Device, latency_s: float, finished: Callable[[], None]
    ) -> None:
        self._library = sound_library()
        self.deck, self.device = deck, device
        self.underruns, self.closed = 0, False
        self._silent, self._finished = Event(), finished
        self._heard, self._clock = HeardPosition(deck.sample_rate_hz), DeviceClock()
        self._called_s = perf_counter()
        self._inside_s = 0.0
        self._taken_s = 0.0
        try:
            self._stream = self._library.OutputStream(
                samplerate=deck.sample_rate_hz,
                blocksize=round(BLOCK_S * deck.sample_rate_hz),
                device=device.index,
                channels=deck.n_outputs,
                dtype="float32",
                latency=latency_s,
                # What arrives is what was sent: nothing is added, and full scale is kept before.
                dither_off=True,
                clip_off=True,
                callback=self._fill,
                finished_callback=self._finish,
            )
        except self._library.PortAudioError as error:
            words = playing_error_text(error, device, deck.sample_rate_hz, deck.n_outputs)
            raise PlaybackError(words) from error

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
            words = playing_error_text(
                error, self.device, self.deck.sample_rate_hz, self.deck.n_outputs
            )
            raise PlaybackError(words) from error

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
        deck = self.deck
        inside_s = times.outputBufferDacTime - times.currentTime
        if inside_s <= 0.0:
            # Some systems do not say when a block is heard.
            inside_s = self._stream.latency
        next_block(deck, out)
        heard_s = times.currentTime + inside_s
        self._heard.note(heard_s, deck.began_at, deck.began_in)
        if deck.taken_s != self._taken_s:
            self._taken_s, self._inside_s = deck.taken_s, inside_s
        if deck.silent:
            raise self._library.CallbackStop
