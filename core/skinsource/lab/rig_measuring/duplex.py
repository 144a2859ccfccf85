"""Devices that can be recorded from."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from threading import Event
from time import perf_counter, sleep
from typing import Any

import numpy as np

from skinsource.base.errors import PlaybackError, Stopped
from skinsource.base.job import Stop
from skinsource.base.quoting import quoted
from skinsource.base.work import counted
from skinsource.lab.playing.devices import (
    Device,
    listed,
    playing_error_text,
    recording_error_text,
    sound_library,
)
from skinsource.lab.playing.mix import Frames, PlayQueue
from skinsource.lab.playing.stream import next_block


@dataclass(frozen=True, slots=True, kw_only=True)
class InputDevice:
    """Something with inputs.

    Attributes
    ----------
    index
        Its number, until devices are looked for again.
    name, host_api
        As the system has them.
    n_inputs
        How many inputs it has, as it says.
    sample_rate_hz
        The rate that it prefers.
    is_default
        Whether it is what the system records from.
    """

    index: int
    name: str
    host_api: str
    n_inputs: int
    sample_rate_hz: int
    is_default: bool = False

    @property
    def title(self) -> str:
        """Words for it."""
        return f"{self.name} ({self.host_api}, {counted(self.n_inputs, 'input')})"


def input_devices() -> tuple[InputDevice, ...]:
    """Return what can be recorded from, the default device first.

    Raises
    ------
    PlaybackError
        sounddevice or PortAudio is missing, or does not answer.
    """
    return tuple(
        InputDevice(
            index=device.index,
            name=device.name,
            host_api=device.host_api,
            n_inputs=device.n_channels,
            sample_rate_hz=device.sample_rate_hz,
            is_default=device.is_default,
        )
        for device in listed("input")
    )


def input_device_of(name: str, played_on: Device, inputs: Sequence[InputDevice]) -> InputDevice:
    """Return the device that is recorded from while ``played_on`` plays.

    Parameters
    ----------
    name
        Of it; empty: the same device, or where that has no inputs, the first of its host, or else
        the one that the system records from.  A name that several hosts have is that of the same
        host, if it can be.

    Raises
    ------
    PlaybackError
        There is none at all, or not that one.
    """
    if not inputs:
        raise PlaybackError(
            "No device to record from was found. Connect the sound card that the accelerometer is "
            "wired to, and measure again."
        )
    named = [device for device in inputs if name in ("", device.name, device.title)]
    if not named:
        listed = ", ".join(device.name for device in inputs[:5])
        raise PlaybackError(
            f"The device {quoted(name)} has no inputs or is not there. Connect it, or choose "
            f"another; there {'is' if len(inputs) == 1 else 'are'} {listed}."
        )
    same = [device for device in named if device.index == played_on.index]
    same_host = [device for device in named if device.host_api == played_on.host_api]
    return (same or same_host or named)[0]


def check_inputs(device: InputDevice, *numbers: int) -> None:
    """Refuse a device that does not have all of these inputs.

    Raises
    ------
    PlaybackError
        It has too few.
    """
    if max(numbers) > device.n_inputs:
        raise PlaybackError(
            f"{device.name} has {counted(device.n_inputs, 'input')}, and "
            f"input {max(numbers)} is to be recorded. Choose another input, or another device."
        )


# A deck that is heard on a device while inputs are recorded.

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
        The same, or two: each has a clock of its own then.
    n_inputs
        Inputs that are recorded, from the first.
    latency_s
        Delay that it is asked for.
    """

    device: Device
    inputs: InputDevice
    n_inputs: int
    latency_s: float

    @property
    def two_clocks(self) -> bool:
        """Whether it is recorded from another device than the one that is played on."""
        return self.inputs.index != self.device.index


class Duplex:
    """Plays a deck to its end, and records meanwhile.

    One device gets one stream both ways: what is recorded stays as late as it is.  Two devices get
    a stream each: the inputs begin first, and what they hear before the first sample is played is
    left out, so that it is known to within a few blocks where the recording begins.

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

    def __init__(self, queue: PlayQueue, card: Card, n_samples: int) -> None:
        self._library = sound_library()
        self._deck, self._card = queue, card
        self.recorded: Frames = np.zeros((card.n_inputs, n_samples), np.float32)
        self.n_recorded = self.n_lost = 0
        self._finished, self._begun = Event(), False
        self._played_s = self._heard_s = perf_counter()
        # In the order in which they begin.
        self._streams: list[Any] = []
        self._asks_inputs = False
        try:
            self._open_two() if card.two_clocks else self._open_one()
        except PlaybackError:
            self._close()
            raise

    def run(self, stop: Stop, progress: Callable[[int], None]) -> None:
        """Play and record until the deck ends; ``told`` hears how much is recorded.

        Raises
        ------
        Stopped
            ``stop`` said so; all is silent.
        PlaybackError
            The device does not begin, or is gone before the end.
        """
        self._played_s = self._heard_s = perf_counter()
        unresponsive = ""
        try:
            for stream in self._streams:
                self._asks_inputs = stream is not self._streams[-1]
                stream.start()
            while self._goes_on and not (unresponsive := self._gone):
                sleep(_LOOK_S)
                progress(self.n_recorded)
                if stop():
                    raise Stopped("Stopped; nothing was measured.")
        except self._library.PortAudioError as error:
            raise PlaybackError(self._refusal(error)) from error
        finally:
            self._fall_silent()
        ending = self._deck.ending
        if ending is None or (ending.reason == "end" and self._missing):
            raise PlaybackError(
                f"{unresponsive or self._card.device.name} stopped answering while it was measured "
                "with. Connect it again, and measure again."
            )

    def _open_one(self) -> None:
        card, queue = self._card, self._deck
        self._open(
            self._library.Stream,
            device=(card.inputs.index, card.device.index),
            channels=(card.n_inputs, queue.n_outputs),
            callback=self._pass,
            finished_callback=self._finished.set,
        )

    def _open_two(self) -> None:
        card, queue = self._card, self._deck
        self._asks_inputs = True
        self._open(
            self._library.InputStream,
            device=card.inputs.index,
            channels=card.n_inputs,
            callback=self._hear,
        )
        self._asks_inputs = False
        self._open(
            self._library.OutputStream,
            device=card.device.index,
            channels=queue.n_outputs,
            callback=self._play,
            finished_callback=self._finished.set,
        )

    def _open(self, kind: Callable[..., Any], **options: Any) -> None:
        """Open a stream of the library's ``kind``."""
        rate_hz = self._deck.sample_rate_hz
        try:
            stream = kind(
                samplerate=rate_hz,
                blocksize=round(_BLOCK_S * rate_hz),
                dtype="float32",
                latency=self._card.latency_s,
                # What arrives is what was sent: nothing is added, and full scale is kept before.
                dither_off=True,
                clip_off=True,
                **options,
            )
        except self._library.PortAudioError as error:
            raise PlaybackError(self._refusal(error)) from error
        self._streams.append(stream)

    @property
    def _goes_on(self) -> bool:
        """Whether something plays, or, with two streams, what played last is on its way in."""
        if not self._finished.is_set():
            return True
        return self._missing and self._deck.ending is not None and self._deck.ending.reason == "end"

    @property
    def _missing(self) -> bool:
        """Whether less was recorded than is wanted."""
        return self.n_recorded < self.recorded.shape[1]

    @property
    def _gone(self) -> str:
        """The device that has not answered for a while, or ""."""
        last = min(self._played_s, self._heard_s)
        if self._finished.is_set():
            last = self._heard_s
        if perf_counter() - last <= _GONE_AFTER_S:
            return ""
        card = self._card
        return card.inputs.name if last == self._heard_s else card.device.name

    def _fall_silent(self) -> None:
        if self._streams[-1].active:
            # To close it at once would be a click.
            self._deck.stop_at_once()
            self._finished.wait(_LONGEST_WAIT_S)
        self._close()

    def _close(self) -> None:
        for stream in self._streams:
            # A device that is gone cannot be closed in order, and need not be.
            stream.close(ignore_errors=True)

    # In the threads of the devices: nothing waits, nothing grows.

    def _pass(self, recorded: Frames, out: Frames, frames: int, times: Any, status: Any) -> None:
        self._begun = True
        self._hear(recorded, frames, times, status)
        self._play(out, frames, times, None)

    def _hear(self, recorded: Frames, frames: int, _times: Any, status: Any) -> None:
        self._heard_s = perf_counter()
        if not self._begun:
            return
        if self.n_recorded:
            # A stream both ways says of both what was lost.
            self.n_lost += bool(status.input_overflow or status.output_underflow)
        end = min(self.n_recorded + frames, self.recorded.shape[1])
        self.recorded[:, self.n_recorded : end] = recorded[: end - self.n_recorded].T
        self.n_recorded = end

    def _play(self, out: Frames, _frames: int, _times: Any, status: Any) -> None:
        self._played_s = perf_counter()
        if status is not None and self._begun:
            self.n_lost += bool(status.output_underflow)
        self._begun = True
        next_block(self._deck, out)
        if self._deck.silent:
            raise self._library.CallbackStop

    def _refusal(self, error: Any) -> str:
        queue, card, rate_hz = self._deck, self._card, self._deck.sample_rate_hz
        if self._asks_inputs:
            name, prefers_hz = card.inputs.name, card.inputs.sample_rate_hz
            return recording_error_text(error, name, prefers_hz, rate_hz, card.n_inputs)
        return playing_error_text(error, card.device, rate_hz, queue.n_outputs)
