"""A deck that is heard on a device."""

from collections.abc import Callable
from threading import Event
from time import perf_counter
from typing import Any

from skinsource.errors import PlaybackError
from skinsource.playing.block import next_block
from skinsource.playing.deck import Deck
from skinsource.playing.devices import Device
from skinsource.playing.mix import Frames
from skinsource.playing.portaudio import sound_library
from skinsource.playing.refusals import refusal
from skinsource.playing.timing import Delay, DeviceClock, HeardPosition

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
        self, deck: Deck, device: Device, latency_s: float, finished: Callable[[], None]
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
            words = refusal(error, device, deck.sample_rate_hz, deck.n_outputs)
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
            words = refusal(error, self.device, self.deck.sample_rate_hz, self.deck.n_outputs)
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
