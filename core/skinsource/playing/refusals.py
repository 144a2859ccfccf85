"""What a device does not take, in plain words."""

from typing import Any

from skinsource.playing.devices import Device
from skinsource.quoting import printable

# What PortAudio calls them.
_WRONG_RATE, _TOO_MANY_CHANNELS, _UNAVAILABLE = -9997, -9998, -9985


def refusal(error: Any, device: Device, sample_rate_hz: int, n_outputs: int) -> str:
    """Say what a device does not take, and what to do."""
    code = error.args[1] if len(error.args) > 1 else 0
    if code == _WRONG_RATE:
        return (
            f"{device.name} does not take {sample_rate_hz} Hz; it prefers "
            f"{device.sample_rate_hz} Hz. Choose another rate."
        )
    if code == _TOO_MANY_CHANNELS:
        return (
            f"{device.name} does not take {n_outputs} outputs. Mute what has no actuator, "
            "give it another output, or choose another device."
        )
    if code == _UNAVAILABLE:
        return (
            f"{device.name} is not free: another program uses it, or it was taken away. Close that "
            "program, or choose another device."
        )
    reason = printable(error.args[0] if error.args else error)
    return f"{device.name} cannot be played on: {reason}. Choose another device."
