"""A deck that is heard on a device while inputs are recorded."""

from collections.abc import Callable
from dataclasses import dataclass
from threading import Event
from time import perf_counter
from typing import Any

import numpy as np

from skinsource.errors import PlaybackError, Stopped
from skinsource.job import Stop
from skinsource.playing.block import next_block
from skinsource.playing.deck import Deck
from skinsource.playing.devices import Device
from skinsource.playing.mix import Frames
from skinsource.playing.portaudio import sound_library
from skinsource.playing.refusals import refusal
from skinsource.rig_measuring.inputs import InputDevice

_BLOCK_S = 0.01
_GONE_AFTER_S = 5.0
_LOOK_S = 0.02
_LONGEST_WAIT_S = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Card:
    """What is played on and recorded from.

    Attributes
    ----------
    device, inputs
        The same sound card, or two of one kind.
    n_inputs
        Inputs that are recorded, from the first.
    latency_s
        Delay that it is asked for.
    """

    device: Device
    inputs: InputDevice
    n_inputs: int
    latency_s: float


class Duplex:
    """Plays a deck to its end, and records meanwhile.

    Parameters
    ----------
    deck
        What to play; something is wanted of it already.
    card
        Where.
    n_samples
        So many are recorded, from the first that is played on.

    Attributes
    ----------
    recorded : (n_inputs, n_samples)
        What came in.
    n_recorded
        How much of it there is.
    n_lost
        How often samples were lost, on one way or the other, since recording began.

    Raises
    ------
    PlaybackError
        sounddevice is missing, or the device does not take what it is asked for.
    """

    def __init__(self, deck: Deck, card: Card, n_samples: int) -> None:
        self._library = sound_library()
        self._deck, self._card = deck, card
        self.recorded: Frames = np.zeros((card.n_inputs, n_samples), np.float32)
        self.n_recorded = self.n_lost = 0
        self._finished, self._called_s = Event(), perf_counter()
        try:
            self._stream = self._library.Stream(
                samplerate=deck.sample_rate_hz,
                blocksize=round(_BLOCK_S * deck.sample_rate_hz),
                device=(card.inputs.index, card.device.index),
                channels=(card.n_inputs, deck.n_outputs),
                dtype="float32",
                latency=card.latency_s,
                # What arrives is what was sent: nothing is added, and full scale is kept before.
                dither_off=True,
                clip_off=True,
                callback=self._pass,
                finished_callback=self._finished.set,
            )
        except self._library.PortAudioError as error:
            raise PlaybackError(self._refusal(error)) from error

    def run(self, stop: Stop, told: Callable[[int], None]) -> None:
        """Play and record until the deck ends; ``told`` hears how much is recorded.

        Raises
        ------
        Stopped
            ``stop`` said so; all is silent.
        PlaybackError
            The device does not begin, or is gone before the end.
        """
        self._called_s = perf_counter()
        try:
            self._stream.start()
            while not self._finished.wait(_LOOK_S):
                told(self.n_recorded)
                if stop():
                    raise Stopped("Stopped; nothing was measured.")
                if perf_counter() - self._called_s > _GONE_AFTER_S:
                    break
            ended = self._deck.ending is not None
        except self._library.PortAudioError as error:
            raise PlaybackError(self._refusal(error)) from error
        finally:
            self._fall_silent()
        if not ended:
            raise PlaybackError(
                f"{self._card.device.name} stopped answering while it was measured with. Connect "
                "it again, and measure again."
            )

    def _fall_silent(self) -> None:
        if self._stream.active:
            # To close it at once would be a click.
            self._deck.stop_at_once()
            self._finished.wait(_LONGEST_WAIT_S)
        # A device that is gone cannot be closed in order, and need not be.
        self._stream.close(ignore_errors=True)

    def _pass(self, came: Frames, out: Frames, frames: int, times: Any, status: Any) -> None:
        """In the thread of the device: nothing waits, nothing grows."""
        self._called_s = perf_counter()
        if self.n_recorded:
            self.n_lost += bool(status.output_underflow or status.input_overflow)
        end = min(self.n_recorded + frames, self.recorded.shape[1])
        self.recorded[:, self.n_recorded : end] = came[: end - self.n_recorded].T
        self.n_recorded = end
        next_block(self._deck, out)
        if self._deck.silent:
            raise self._library.CallbackStop

    def _refusal(self, error: Any) -> str:
        deck, card = self._deck, self._card
        words = refusal(error, card.device, deck.sample_rate_hz, deck.n_outputs)
        if card.inputs.index != card.device.index:
            words += f" It was to record from {card.inputs.name} at the same time."
        return words
