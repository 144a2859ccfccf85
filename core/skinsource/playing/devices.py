"""Devices that can be played on."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from skinsource.counting import counted
from skinsource.errors import NothingToPlayOnError, PlaybackError
from skinsource.playing.output import RATES_HZ, Output
from skinsource.playing.portaudio import sound_library
from skinsource.quoting import printable, quoted

_NONE = "No device to play on was found. Connect one and look again."


@dataclass(frozen=True, slots=True, kw_only=True)
class Device:
    """Something with outputs.

    Attributes
    ----------
    index
        Its number, until devices are looked for again.
    name, host_api
        As the system has them; both together tell it from the others.
    n_outputs
        How many outputs it has, as it says.
    sample_rate_hz
        The rate that it prefers.
    is_default
        Whether it is what the system plays on.
    """

    index: int
    name: str
    host_api: str
    n_outputs: int
    sample_rate_hz: int
    is_default: bool

    @property
    def title(self) -> str:
        """Words for it."""
        return f"{self.name} ({self.host_api}, {counted(self.n_outputs, 'output')})"


@dataclass(frozen=True, slots=True, kw_only=True)
class Listed:
    """What the system says of a device."""

    index: int
    name: str
    host_api: str
    n_channels: int
    sample_rate_hz: int
    is_default: bool


def listed(direction: Literal["input", "output"]) -> list[Listed]:
    """Return what has inputs, or outputs, the default device first.

    Raises
    ------
    PlaybackError
        sounddevice or PortAudio is missing, or does not answer.
    """
    library = sound_library()
    try:
        apis, known = library.query_hostapis(), library.query_devices()
        default = library.default.device[direction]
        if default < 0:
            default = next((one[f"default_{direction}_device"] for one in apis), -1)
    except library.PortAudioError as error:
        raise PlaybackError(f"The sound system does not answer: {printable(error)}.") from error
    found = [
        Listed(
            index=index,
            name=one["name"],
            host_api=apis[one["hostapi"]]["name"],
            n_channels=one[f"max_{direction}_channels"],
            sample_rate_hz=round(one["default_samplerate"]),
            is_default=index == default,
        )
        for index, one in enumerate(known)
        if one[f"max_{direction}_channels"] > 0
    ]
    return sorted(found, key=lambda one: not one.is_default)


def devices() -> tuple[Device, ...]:
    """Return what can be played on, the default device first.

    Raises
    ------
    PlaybackError
        sounddevice or PortAudio is missing, or does not answer.
    """
    return tuple(
        Device(
            index=one.index,
            name=one.name,
            host_api=one.host_api,
            n_outputs=one.n_channels,
            sample_rate_hz=one.sample_rate_hz,
            is_default=one.is_default,
        )
        for one in listed("output")
    )


def look_again() -> tuple[Device, ...]:
    """Return what can be played on now, with what was connected since; nothing may be playing."""
    library = sound_library()
    try:
        # PortAudio looks once, when it starts; sounddevice offers no other door to that.
        library._terminate()
        library._initialize()
    except library.PortAudioError as error:
        raise PlaybackError(f"The sound system does not answer: {printable(error)}.") from error
    return devices()


def device_of(output: Output, found: Sequence[Device]) -> Device:
    """Return the device that ``output`` names.

    Raises
    ------
    PlaybackError
        There is none at all, or not that one.
    """
    if not found:
        raise NothingToPlayOnError(_NONE)
    if not output.device:
        return found[0]
    for one in found:
        if one.name == output.device and output.host_api in ("", one.host_api):
            return one
    raise PlaybackError(
        f"The device {quoted(output.device)} is not there. Connect it and look again, or choose "
        f"another; there {'is' if len(found) == 1 else 'are'} "
        f"{', '.join(one.name for one in found[:5])}."
    )


def check_outputs(device: Device, outputs: Mapping[int, int]) -> None:
    """Refuse a device that does not have all ``outputs``, by place.

    Raises
    ------
    PlaybackError
        It has too few; the message says which place has none.
    """
    place, output = max(outputs.items(), key=lambda one: one[1], default=(0, 0))
    if output > device.n_outputs:
        raise PlaybackError(
            f"{device.name} has {counted(device.n_outputs, 'output')}, "
            f"and place {place} is to play on output "
            f"{output}. Mute what has no actuator, give it another output, or choose another "
            "device."
        )


def rates_of(device: Device) -> tuple[int, ...]:
    """Rates, in Hz, that a device takes; asked one by one, so that it takes a while."""
    library = sound_library()
    rates = sorted({*RATES_HZ, device.sample_rate_hz})
    return tuple(rate for rate in rates if _takes(library, device, rate))


def _takes(library: object, device: Device, rate_hz: int) -> bool:
    channels = min(device.n_outputs, 2)
    try:
        library.check_output_settings(  # type: ignore[attr-defined]
            device=device.index, channels=channels, dtype="float32", samplerate=rate_hz
        )
    except library.PortAudioError:  # type: ignore[attr-defined]
        return False
    return True
