"""Devices to play on: which ones there are, which output drives which actuator, and their rate.

sounddevice and PortAudio are imported when devices are listed or used first.
"""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from types import ModuleType
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from skinsource.base.arguments import integer, real_number
from skinsource.base.conventions import MOST_LOCATIONS, Floats
from skinsource.base.errors import (
    InvalidInputError,
    MissingExtraError,
    NothingToPlayOnError,
    PlaybackError,
    counted,
    printable,
    quoted,
)
from skinsource.base.extras import extra_line, package_of_extra
from skinsource.design.design import Design
from skinsource.engine.stimulus import Stimulus
from skinsource.lab.playing.triggers import BITS
from skinsource.signals.resampling import resample

if TYPE_CHECKING:
    from skinsource.actuators.rigs import Rig


#: Rates that devices are checked for.
RATES_HZ = (8_000, 16_000, 32_000, 44_100, 48_000, 88_200, 96_000, 176_400, 192_000)
#: Outputs of the largest device that is supported.
MOST_OUTPUTS = 128
SHORTEST_LATENCY_S, LONGEST_LATENCY_S = 0.002, 0.5
LEAST_SHIFT_HZ, MOST_SHIFT_HZ = 50.0, 2000.0

_LOWEST_RATE_HZ, _HIGHEST_RATE_HZ = 4_000, 384_000
_LONGEST_NAME = 400


@dataclass(frozen=True, slots=True, kw_only=True)
class Output:
    """A device, and which of its outputs drives which input location.

    Attributes
    ----------
    device, host_api
        Names in the system; ``""`` for the default device.
    sample_rate_hz
        Requested rate.
    latency_s
        Requested delay; the device may need more.
    outputs
        Pairs of an input location and the output, from 1, that drives its actuator.  Other
        locations get the free outputs, in order.
    stand_in
        Whether the design is made audible on two channels, for people without actuators.
    shift_hz
        Shift of all frequencies in the stand-in.
    trigger_output, trigger_code
        Output, from 1, that tells recorders when a stimulus begins, and the code from 0 to 255
        that it tells (`skinsource.lab.playing.triggers`); output 0: none does.
    """

    device: str = ""
    host_api: str = ""
    sample_rate_hz: int = 48_000
    latency_s: float = 0.02
    outputs: tuple[tuple[int, int], ...] = ()
    stand_in: bool = False
    shift_hz: float = 300.0
    trigger_output: int = 0
    trigger_code: int = 1

    def __post_init__(self) -> None:
        for name, value in (("device", self.device), ("host_api", self.host_api)):
            if not isinstance(value, str) or len(value) > _LONGEST_NAME:
                raise InvalidInputError(f"{name} is {quoted(value)}, expected a name")
        integer("sample_rate_hz", self.sample_rate_hz, _LOWEST_RATE_HZ, _HIGHEST_RATE_HZ)
        least_s, most_s = SHORTEST_LATENCY_S, LONGEST_LATENCY_S
        real_number("latency_s", self.latency_s, least=least_s, most=most_s)
        real_number("shift_hz", self.shift_hz, least=LEAST_SHIFT_HZ, most=MOST_SHIFT_HZ)
        integer("trigger_output", self.trigger_output, 0, MOST_OUTPUTS)
        integer("trigger_code", self.trigger_code, 0, 2**BITS - 1)
        for place, output in self.outputs:
            integer("place", place, 1, MOST_LOCATIONS)
            integer("output", output, 1, MOST_OUTPUTS)
        for name, numbers in zip(
            ("place", "output"), zip(*self.outputs, strict=True), strict=False
        ):
            twice = next((number for number in numbers if numbers.count(number) > 1), None)
            if twice is not None:
                raise InvalidInputError(
                    f"{name} {twice} occurs twice in the channel map, expected once: each place "
                    "needs its own output"
                )

    def outputs_of(self, places: Iterable[int]) -> dict[int, int]:
        """Return the output of each of ``places``, from 1: that in the map, else the next free one.

        Pass all locations of a design, audible or not, so that outputs do not depend on muting.
        """
        unique = tuple(dict.fromkeys(places))
        output_of = {place: output for place, output in self.outputs if place in unique}
        used = {output for _, output in self.outputs}
        free = (output for output in range(1, MOST_OUTPUTS + 1 + len(unique)) if output not in used)
        for place in unique:
            if place not in output_of:
                output_of[place] = next(free)
        return output_of

    def to_text(self) -> str:
        """Return it as JSON text."""
        return json.dumps(asdict(self))


def output_from_text(text: str) -> Output:
    """Return the output of a text of `Output.to_text`.

    Raises
    ------
    InvalidInputError
        The text is something else.
    """
    try:
        values = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InvalidInputError(f"{quoted(text)} is no output, expected its JSON") from error
    if not isinstance(values, dict) or not set(values) <= set(Output.__slots__):
        raise InvalidInputError(f"{quoted(text)} is no output, expected its JSON")
    try:
        values["outputs"] = tuple((place, output) for place, output in values.get("outputs", ()))
        if not isinstance(values.get("stand_in", False), bool):
            raise TypeError("stand_in is no switch")
        return Output(**values)
    except (TypeError, ValueError) as error:
        raise InvalidInputError(
            f"{quoted(text)} is no output, expected its JSON: {error}"
        ) from error


_LIBRARY = (
    "PortAudio, which playback needs, is not installed. On Linux, install it with: sudo apt "
    "install libportaudio2 (Debian, Ubuntu), sudo dnf install portaudio (Fedora). Then start the "
    "studio again."
)


def sound_library() -> ModuleType:
    """Import sounddevice.

    Raises
    ------
    NothingToPlayOnError
        It or PortAudio is not installed, or does not start; the message says what to type.
    """
    try:
        return package_of_extra("sounddevice", "audio")
    except MissingExtraError as error:
        raise NothingToPlayOnError(
            f"To play, type: {extra_line('audio')} and start again ({printable(error.__cause__)})."
        ) from error
    except OSError as error:
        raise NothingToPlayOnError(f"{_LIBRARY} ({printable(error)})") from error


_NO_DEVICE = "No audio device was found. Connect one, then press Refresh or start again."


@dataclass(frozen=True, slots=True, kw_only=True)
class Device:
    """A device with outputs, as the system describes it.

    Attributes
    ----------
    index
        Number of the device, until devices are listed again.
    name, host_api
        Both together identify it.
    sample_rate_hz
        The rate that it prefers.
    is_default
        Whether the system plays on it by default.
    """

    index: int
    name: str
    host_api: str
    n_outputs: int
    sample_rate_hz: int
    is_default: bool

    @property
    def title(self) -> str:
        """Name, host and number of outputs."""
        return f"{self.name} ({self.host_api}, {counted(self.n_outputs, 'output')})"


def listed(direction: Literal["input", "output"]) -> list[dict[str, Any]]:
    """Return the fields of all devices with inputs, or with outputs, the default device first.

    Raises
    ------
    PlaybackError
        sounddevice or PortAudio is missing, or does not answer.
    """
    library = sound_library()
    try:
        apis, system_devices = library.query_hostapis(), library.query_devices()
        default = library.default.device[direction]
        if default < 0:
            default = next((api[f"default_{direction}_device"] for api in apis), -1)
    except library.PortAudioError as error:
        raise PlaybackError(f"The sound system does not respond: {printable(error)}.") from error
    devices_of_direction = [
        {
            "index": index,
            "name": device["name"],
            "host_api": apis[device["hostapi"]]["name"],
            f"n_{direction}s": device[f"max_{direction}_channels"],
            "sample_rate_hz": round(device["default_samplerate"]),
            "is_default": index == default,
        }
        for index, device in enumerate(system_devices)
        if device[f"max_{direction}_channels"] > 0
    ]
    return sorted(devices_of_direction, key=lambda device: not device["is_default"])


def devices() -> tuple[Device, ...]:
    """Return the devices to play on, the default device first; raises as `listed`."""
    return tuple(Device(**fields) for fields in listed("output"))


def refresh_devices() -> tuple[Device, ...]:
    """Look for devices again, and return those to play on; nothing may be playing."""
    library = sound_library()
    try:
        # PortAudio looks for devices when it starts; sounddevice has no public way to restart it.
        library._terminate()
        library._initialize()
    except library.PortAudioError as error:
        raise PlaybackError(f"The sound system does not respond: {printable(error)}.") from error
    return devices()


def device_of(output: Output, known_devices: Sequence[Device]) -> Device:
    """Return the device that ``output`` names.

    Raises
    ------
    PlaybackError
        There is no device, or none of that name.
    """
    if not known_devices:
        raise NothingToPlayOnError(_NO_DEVICE)
    if not output.device:
        return known_devices[0]
    for device in known_devices:
        if device.name == output.device and output.host_api in ("", device.host_api):
            return device
    raise PlaybackError(
        f"The device {quoted(output.device)} was not found. Connect it, then press "
        "Refresh or start again, or choose another; there "
        f"{'is' if len(known_devices) == 1 else 'are'} "
        f"{', '.join(device.name for device in known_devices[:5])}."
    )


def check_outputs(device: Device, outputs: Mapping[int, int]) -> None:
    """Check that a device has all ``outputs``, by location.

    Raises
    ------
    PlaybackError
        It has too few; the message names the location without an output.
    """
    place, output = max(outputs.items(), key=lambda pair: pair[1], default=(0, 0))
    if output > device.n_outputs:
        raise PlaybackError(
            f"{device.name} has {counted(device.n_outputs, 'output')}, and place {place} is "
            f"assigned to output {output}. Mute what has no actuator, give it another output, or "
            "choose another device."
        )


def rates_of(device: Device) -> tuple[int, ...]:
    """Return the rates that a device accepts, Hz; it takes a while, as each rate is tried."""
    library = sound_library()
    rates = sorted({*RATES_HZ, device.sample_rate_hz})
    return tuple(rate for rate in rates if _accepts_rate(library, device, rate))


def _accepts_rate(library: object, device: Device, rate_hz: int) -> bool:
    channels = min(device.n_outputs, 2)
    try:
        library.check_output_settings(  # type: ignore[attr-defined]
            device=device.index, channels=channels, dtype="float32", samplerate=rate_hz
        )
    except library.PortAudioError:  # type: ignore[attr-defined]
        return False
    return True


# Error codes of PortAudio.
_WRONG_RATE, _TOO_MANY_CHANNELS, _UNAVAILABLE = -9997, -9998, -9985


def refusal_text(error: Any, name: str, prefers_hz: int, sample_rate_hz: int, channels: str) -> str:
    """Return why a device cannot be opened, and what to do.

    Parameters
    ----------
    error
        Of PortAudio.
    name, prefers_hz
        Name of the device, and the rate that it prefers.
    sample_rate_hz
        The requested rate.
    channels
        Number of the requested channels as text: ``"3 outputs"``.
    """
    code = error.args[1] if len(error.args) > 1 else 0
    if code == _WRONG_RATE:
        return (
            f"{name} does not take {sample_rate_hz} Hz; it prefers {prefers_hz} Hz. "
            "Choose another rate."
        )
    if code == _TOO_MANY_CHANNELS:
        return (
            f"{name} does not take {channels}. Mute what has no actuator, choose other channels, "
            "or choose another device."
        )
    if code == _UNAVAILABLE:
        return (
            f"{name} is not free: another program uses it, or it was taken away. Close that "
            "program, or choose another device."
        )
    reason = printable(error.args[0] if error.args else error)
    return f"{name} cannot be used for {channels}: {reason}. Choose another device."


class DeviceRows:
    """Resamples channels; channels that have not changed since the last call are used again."""

    def __init__(self) -> None:
        self._known: dict[tuple[int, int, bytes], Floats] = {}

    def at(self, rows: Floats, from_hz: int, to_hz: int) -> Floats:
        """Return `skinsource.resample` of ``rows``, (n_channels, n_times), to the last bit."""
        known, self._known = self._known, {}
        resampled = np.zeros((rows.shape[0], -(-rows.shape[1] * to_hz // from_hz)))
        for out, row in zip(resampled, rows, strict=True):
            key = from_hz, to_hz, row.tobytes()
            if key not in known:
                known[key] = resample(row, from_hz, to_hz)
            out[:] = self._known[key] = known[key]
        return resampled


def outputs_by_place(
    played: Design | Stimulus, output: Output, rig: "Rig | None" = None
) -> dict[int, int]:
    """Return the output of each place that the rig wires; of a design, audible or not."""
    if isinstance(played, Stimulus):
        places = tuple(each.place for each in played.channels if each.place is not None)
    else:
        places = tuple(dict.fromkeys(track.location for track in played.inputs))
    if rig is None or output.stand_in:
        return output.outputs_of(places)
    channels = (rig.channel_of(place) for place in places)
    return {channel.place: channel.output for channel in channels if channel is not None}
