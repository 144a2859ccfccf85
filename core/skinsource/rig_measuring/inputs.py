"""Devices that can be recorded from."""

from collections.abc import Sequence
from dataclasses import dataclass

from skinsource.counting import counted
from skinsource.errors import PlaybackError
from skinsource.playing.devices import Device, listed
from skinsource.quoting import quoted


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
            index=one.index,
            name=one.name,
            host_api=one.host_api,
            n_inputs=one.n_channels,
            sample_rate_hz=one.sample_rate_hz,
            is_default=one.is_default,
        )
        for one in listed("input")
    )


def input_device_of(name: str, played_on: Device, found: Sequence[InputDevice]) -> InputDevice:
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
    if not found:
        raise PlaybackError(
            "No device to record from was found. Connect the sound card that the accelerometer is "
            "wired to, and measure again."
        )
    named = [one for one in found if name in ("", one.name, one.title)]
    if not named:
        listed = ", ".join(one.name for one in found[:5])
        raise PlaybackError(
            f"The device {quoted(name)} has no inputs or is not there. Connect it, or choose "
            f"another; there {'is' if len(found) == 1 else 'are'} {listed}."
        )
    same = [one for one in named if one.index == played_on.index]
    beside = [one for one in named if one.host_api == played_on.host_api]
    return (same or beside or named)[0]


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
