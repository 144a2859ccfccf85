"""Devices that can be recorded from."""

from collections.abc import Sequence
from dataclasses import dataclass

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
    is_default
        Whether it is what the system records from.
    """

    index: int
    name: str
    host_api: str
    n_inputs: int
    is_default: bool = False

    @property
    def title(self) -> str:
        """Words for it."""
        return f"{self.name} ({self.host_api}, {self.n_inputs} inputs)"


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
            is_default=one.is_default,
        )
        for one in listed("input")
    )


def input_device_of(name: str, played_on: Device, found: Sequence[InputDevice]) -> InputDevice:
    """Return the device that is recorded from while ``played_on`` plays.

    Parameters
    ----------
    name
        Of it; empty: the same device, or where that has no inputs, the default one beside it.

    Raises
    ------
    PlaybackError
        There is none at all, or not that one, or it cannot run together with the other.
    """
    if not found:
        raise PlaybackError(
            "No device to record from was found. Connect the sound card that the accelerometer is "
            "wired to, and measure again."
        )
    beside = [one for one in found if one.host_api == played_on.host_api]
    if not name:
        own = [one for one in beside if one.index == played_on.index]
        if not (own or beside):
            raise PlaybackError(
                f"{played_on.name} has no inputs, and no other device of {played_on.host_api} "
                "has. Choose a device with inputs."
            )
        return (own or beside)[0]
    named = [one for one in found if name in (one.name, one.title)]
    both = [one for one in named if one in beside]
    if named and not both:
        raise PlaybackError(
            f"{quoted(name)} is a device of {named[0].host_api}, and {played_on.name} of "
            f"{played_on.host_api}: they cannot run together. Choose two of one kind."
        )
    if not named:
        listed = ", ".join(one.name for one in found[:5])
        raise PlaybackError(
            f"The device {quoted(name)} has no inputs or is not there. Connect it, or choose "
            f"another; there {'is' if len(found) == 1 else 'are'} {listed}."
        )
    return both[0]


def check_inputs(device: InputDevice, *numbers: int) -> None:
    """Refuse a device that does not have all of these inputs.

    Raises
    ------
    PlaybackError
        It has too few.
    """
    if max(numbers) > device.n_inputs:
        raise PlaybackError(
            f"{device.name} has {device.n_inputs} input{'' if device.n_inputs == 1 else 's'}, and "
            f"input {max(numbers)} is to be recorded. Choose another input, or another device."
        )
