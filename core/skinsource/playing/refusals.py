"""What a device does not take, in plain words."""

from typing import Any

from skinsource.counting import counted
from skinsource.playing.devices import Device
from skinsource.quoting import printable

# What PortAudio calls them.
_WRONG_RATE, _TOO_MANY_CHANNELS, _UNAVAILABLE = -9997, -9998, -9985


def refusal(error: Any, device: Device, sample_rate_hz: int, n_outputs: int) -> str:
    """Say what a device does not play, and what to do."""
    channels = (
        f"{counted(n_outputs, 'output')}. Mute what has no actuator, give it another output, or "
        "choose another device."
    )
    return _words(error, device.name, device.sample_rate_hz, sample_rate_hz, channels, "played on")


def refusal_to_record(
    error: Any, name: str, prefers_hz: int, sample_rate_hz: int, n_inputs: int
) -> str:
    """Say what a device does not record, and what to do."""
    channels = f"{counted(n_inputs, 'input')}. Choose another input, or another device."
    return _words(error, name, prefers_hz, sample_rate_hz, channels, "recorded from")


def _words(
    error: Any, name: str, prefers_hz: int, sample_rate_hz: int, channels: str, what: str
) -> str:
    code = error.args[1] if len(error.args) > 1 else 0
    if code == _WRONG_RATE:
        return (
            f"{name} does not take {sample_rate_hz} Hz; it prefers {prefers_hz} Hz. "
            "Choose another rate."
        )
    if code == _TOO_MANY_CHANNELS:
        return f"{name} does not take {channels}"
    if code == _UNAVAILABLE:
        return (
            f"{name} is not free: another program uses it, or it was taken away. Close that "
            "program, or choose another device."
        )
    reason = printable(error.args[0] if error.args else error)
    return f"{name} cannot be {what}: {reason}. Choose another device."
