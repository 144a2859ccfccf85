"""Devices to record from, and playing a queue while inputs are recorded."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from threading import Event
from time import perf_counter, sleep
from typing import Any

import numpy as np

from skinsource.base.errors import PlaybackError, Stopped, counted, quoted
from skinsource.base.job import Stop
from skinsource.lab.playing.devices import Device, listed, refusal_text, sound_library
from skinsource.lab.playing.stream import Frames, PlayQueue, next_block


@dataclass(frozen=True, slots=True, kw_only=True)
class InputDevice:
    """A device with inputs, as the system describes it.

    Attributes
    ----------
    index
        Number of the device, until devices are listed again.
    sample_rate_hz
        The rate that it prefers.
    is_default
        Whether the system records from it by default.
    """

    index: int
    name: str
    host_api: str
    n_inputs: int
    sample_rate_hz: int
    is_default: bool = False

    @property
    def title(self) -> str:
        """Name, host and number of inputs."""
        return f"{self.name} ({self.host_api}, {counted(self.n_inputs, 'input')})"


def input_devices() -> tuple[InputDevice, ...]:
    """Return the devices to record from, the default device first.

    Raises
    ------
    PlaybackError
        sounddevice or PortAudio is missing, or does not answer.
    """
    return tuple(InputDevice(**fields) for fields in listed("input"))


def input_device_of(name: str, played_on: Device, inputs: Sequence[InputDevice]) -> InputDevice:
    """Return the device that is recorded from while ``played_on`` plays.

    Parameters
    ----------
    name
        Name of the device.  Where it is empty: the same device, else the first of the same host,
        else the default device of the system.  Where several hosts have a device of that name, that
        of the same host is preferred.

    Raises
    ------
    PlaybackError
        There is no device with inputs, or none of that name.
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
    """Check that a device has all of these inputs.

    Raises
    ------
    PlaybackError
        It has too few inputs.
    """
    if max(numbers) > device.n_inputs:
        raise PlaybackError(
            f"{device.name} has {counted(device.n_inputs, 'input')}, and "
            f"input {max(numbers)} is to be recorded. Choose another input, or another device."
        )


_BLOCK_S = 0.01
_GONE_AFTER_S = 5.0
_POLL_S = 0.02
_LONGEST_WAIT_S = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Card:
    """The devices to play on and to record from.

    Attributes
    ----------
    device, inputs
        The same device, or two, each with a clock of its own.
    n_inputs
        Inputs that are recorded, from the first.
    latency_s
        Requested delay.
    """

    device: Device
    inputs: InputDevice
    n_inputs: int
    latency_s: float

    @property
    def two_clocks(self) -> bool:
        """Whether one device plays and another one records."""
        return self.inputs.index != self.device.index


class Duplex:
    """Plays a queue to its end, and records at the same time.

    One device gets one stream in both directions, with a constant delay.  Two devices get a stream
    each: the inputs start first, and samples before the first played sample are left out, so that
    the start of the recording is known to within a few blocks.

    Parameters
    ----------
    queue
        What to play; a mix is requested already.
    card
        The devices.
    n_samples
        Samples to record, from the first played sample on.

    Attributes
    ----------
    recorded : (n_inputs, n_samples)
        Recorded samples.
    n_recorded
        How many of them are recorded so far.
    n_lost
        How often samples were lost, in either direction, since recording began.
    shift_s
        Time of the first recorded sample minus that of the first played one, both as one device
        tells them; None: it does not.

    Raises
    ------
    PlaybackError
        sounddevice is missing, or the device refuses rate, channels or delay.
    """

    def __init__(self, queue: PlayQueue, card: Card, n_samples: int) -> None:
        self._library = sound_library()
        self._deck, self._card = queue, card
        self.recorded: Frames = np.zeros((card.n_inputs, n_samples), np.float32)
        self.n_recorded = self.n_lost = 0
        self.shift_s: float | None = None
        self._finished, self._started = Event(), False
        self._played_s = self._recorded_s = perf_counter()
        # In the order in which they start.
        self._streams: list[Any] = []
        self._opens_inputs = False
        try:
            self._open_two() if card.two_clocks else self._open_one()
        except PlaybackError:
            self._close()
            raise

    def run(self, stop: Stop, progress: Callable[[int], None]) -> None:
        """Play and record until the queue ends; ``progress`` gets the number of recorded samples.

        Raises
        ------
        Stopped
            ``stop`` returned True; all is silent.
        PlaybackError
            The device does not start, or stops answering before the end.
        """
        self._played_s = self._recorded_s = perf_counter()
        unresponsive = ""
        try:
            for stream in self._streams:
                self._opens_inputs = stream is not self._streams[-1]
                stream.start()
            while self._is_running and not (unresponsive := self._unresponsive):
                sleep(_POLL_S)
                progress(self.n_recorded)
                if stop():
                    raise Stopped("Stopped; nothing was measured.")
        except self._library.PortAudioError as error:
            raise PlaybackError(self._refusal(error)) from error
        finally:
            if self._streams[-1].active:
                # Closing the stream at once would make a click.
                self._deck.stop_at_once()
                self._finished.wait(_LONGEST_WAIT_S)
            self._close()
        ending = self._deck.ending
        if ending is None or (ending.reason == "end" and self._incomplete):
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
            callback=self._play_and_record,
            finished_callback=self._finished.set,
        )

    def _open_two(self) -> None:
        card, queue = self._card, self._deck
        self._opens_inputs = True
        self._open(
            self._library.InputStream,
            device=card.inputs.index,
            channels=card.n_inputs,
            callback=self._record,
        )
        self._opens_inputs = False
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
                # Samples arrive unchanged; full scale is checked before.
                dither_off=True,
                clip_off=True,
                **options,
            )
        except self._library.PortAudioError as error:
            raise PlaybackError(self._refusal(error)) from error
        self._streams.append(stream)

    @property
    def _is_running(self) -> bool:
        """Whether something plays, or the last played samples are still to be recorded."""
        if not self._finished.is_set():
            return True
        return (
            self._incomplete and self._deck.ending is not None and self._deck.ending.reason == "end"
        )

    @property
    def _incomplete(self) -> bool:
        """Whether samples are still to be recorded."""
        return self.n_recorded < self.recorded.shape[1]

    @property
    def _unresponsive(self) -> str:
        """Name of a device that has not answered for a while, or ""."""
        last = min(self._played_s, self._recorded_s)
        if self._finished.is_set():
            last = self._recorded_s
        if perf_counter() - last <= _GONE_AFTER_S:
            return ""
        card = self._card
        return card.inputs.name if last == self._recorded_s else card.device.name

    def _close(self) -> None:
        for stream in self._streams:
            # Closing a device that was unplugged fails, and that does not matter.
            stream.close(ignore_errors=True)

    # The following run in the threads of the devices: nothing may wait or allocate much.

    def _play_and_record(
        self, recorded: Frames, out: Frames, frames: int, times: Any, status: Any
    ) -> None:
        if not self._started and times.inputBufferAdcTime and times.outputBufferDacTime:
            self.shift_s = times.inputBufferAdcTime - times.outputBufferDacTime
        self._started = True
        self._record(recorded, frames, times, status)
        self._play(out, frames, times, None)

    def _record(self, recorded: Frames, frames: int, _times: Any, status: Any) -> None:
        self._recorded_s = perf_counter()
        if not self._started:
            return
        if self.n_recorded:
            # The status of a stream in both directions tells of losses in both.
            self.n_lost += bool(status.input_overflow or status.output_underflow)
        end = min(self.n_recorded + frames, self.recorded.shape[1])
        self.recorded[:, self.n_recorded : end] = recorded[: end - self.n_recorded].T
        self.n_recorded = end

    def _play(self, out: Frames, _frames: int, _times: Any, status: Any) -> None:
        self._played_s = perf_counter()
        if status is not None and self._started:
            self.n_lost += bool(status.output_underflow)
        self._started = True
        next_block(self._deck, out)
        if self._deck.silent:
            raise self._library.CallbackStop

    def _refusal(self, error: Any) -> str:
        device: Device | InputDevice = self._card.device
        channels = counted(self._deck.n_outputs, "output")
        if self._opens_inputs:
            device, channels = self._card.inputs, counted(self._card.n_inputs, "input")
        rate_hz = self._deck.sample_rate_hz
        return refusal_text(error, device.name, device.sample_rate_hz, rate_hz, channels)
