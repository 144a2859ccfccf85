"""Phones and controllers: `.haptic` 1.0 (Meta), AHAP (Apple), envelopes for Android.

None of them plays a waveform: they hold the strength of the drive, and roughly its frequency.
None names a place either: each actuator has a file of its own.

References
----------
Meta, haptic file specification 1.0.  Apple, Representing haptic patterns in AHAP files.  Android,
`VibrationEffect.WaveformEnvelopeBuilder`.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.export.formats.chips import Envelope, envelope_of
from skinsource.export.formats.format import Facts, Outgoing, StimulusFormat
from skinsource.version import __version__

_RATE_HZ = 8000
_STEP_S = 0.01
#: Frequencies that 0 and 1 stand for: for the controllers of Meta, and the sharpness of Apple.
_HAPTIC_HZ = (55.0, 200.0)
_AHAP_HZ = (65.0, 300.0)
#: Longest continuous event of AHAP.
_LONGEST_EVENT_S = 30.0
#: Shortest step that phones with Android take.
_ANDROID_STEP_S = 0.02


def write_haptic(outgoing: Outgoing, path: Path) -> Facts:
    """Write the file of Meta."""
    envelope = _envelope(outgoing, _STEP_S)
    time_s = envelope.time_s.tolist()
    amplitude = np.clip(envelope.amplitude, 0.0, 1.0).tolist()
    frequency = _share_of_band(envelope.frequency_hz, _HAPTIC_HZ).tolist()
    channel = outgoing.stimulus.channels[0]
    content = {
        "version": {"major": 1, "minor": 0, "patch": 0},
        "metadata": {
            "editor": f"SkinSource studio {__version__}",
            "author": outgoing.design.author,
            "source": outgoing.name,
            "project": outgoing.design.title,
            "tags": [],
            "description": f"{channel.title}; frequency 0 is {_HAPTIC_HZ[0]:g} Hz, 1 is "
            f"{_HAPTIC_HZ[1]:g} Hz; design SHA-256 {outgoing.digest}",
        },
        "signals": {
            "continuous": {
                "envelopes": {
                    "amplitude": [
                        {"time": at, "amplitude": value}
                        for at, value in zip(time_s, amplitude, strict=True)
                    ],
                    "frequency": [
                        {"time": at, "frequency": value}
                        for at, value in zip(time_s, frequency, strict=True)
                    ],
                }
            }
        },
    }
    return _write_json(path, content, {"frequency_hz": list(_HAPTIC_HZ)})


def write_ahap(outgoing: Outgoing, path: Path) -> Facts:
    """Write the file of Apple: continuous events of at most 30 s, each with two curves."""
    envelope = _envelope(outgoing, _STEP_S)
    # Perceived intensity is quadratic there.
    intensity = np.sqrt(np.clip(envelope.amplitude, 0.0, 1.0))
    sharpness = _share_of_band(envelope.frequency_hz, _AHAP_HZ)
    end_s = float(envelope.time_s[-1])
    pattern: list[dict[str, Any]] = []
    for number in range(max(int(np.ceil(end_s / _LONGEST_EVENT_S - 1e-9)), 1)):
        begin_s = number * _LONGEST_EVENT_S
        last_s = min(begin_s + _LONGEST_EVENT_S, end_s)
        inside = (envelope.time_s >= begin_s - 1e-9) & (envelope.time_s <= last_s + 1e-9)
        # Times of control points count from the begin of their curve.
        time_s = (envelope.time_s[inside] - begin_s).tolist()
        pattern.append(_ahap_event(begin_s, last_s - begin_s))
        for name, values in (
            ("HapticIntensityControl", intensity),
            ("HapticSharpnessControl", sharpness),
        ):
            pattern.append(_ahap_curve(name, begin_s, time_s, values[inside].tolist()))
    content = {
        "Version": 1.0,
        "Metadata": {
            "Project": outgoing.design.title or "SkinSource studio",
            "Description": f"{outgoing.stimulus.channels[0].title}; sharpness 0 is "
            f"{_AHAP_HZ[0]:g} Hz, 1 is {_AHAP_HZ[1]:g} Hz; design SHA-256 {outgoing.digest}",
        },
        "Pattern": pattern,
    }
    return _write_json(path, content, {"frequency_hz": list(_AHAP_HZ)})


def _ahap_event(begin_s: float, duration_s: float) -> dict[str, Any]:
    return {
        "Event": {
            "Time": begin_s,
            "EventType": "HapticContinuous",
            "EventDuration": duration_s,
            "EventParameters": [
                {"ParameterID": "HapticIntensity", "ParameterValue": 1.0},
                {"ParameterID": "HapticSharpness", "ParameterValue": 0.0},
            ],
        }
    }


def _ahap_curve(
    name: str, begin_s: float, time_s: list[float], values: list[float]
) -> dict[str, Any]:
    return {
        "ParameterCurve": {
            "ParameterID": name,
            "Time": begin_s,
            "ParameterCurveControlPoints": [
                {"Time": at, "ParameterValue": value}
                for at, value in zip(time_s, values, strict=True)
            ],
        }
    }


def write_pwle(outgoing: Outgoing, path: Path) -> Facts:
    """Write control points for Android, as its builder takes them one after the other."""
    envelope = _envelope(outgoing, _ANDROID_STEP_S)
    steps_ms = np.diff(np.round(envelope.time_s * 1000.0)).astype(int)
    content = {
        "format": "Android WaveformEnvelopeBuilder",
        "initialFrequencyHz": float(envelope.frequency_hz[0]),
        "controlPoints": [
            {"amplitude": amplitude, "frequencyHz": frequency_hz, "durationMillis": duration_ms}
            for amplitude, frequency_hz, duration_ms in zip(
                np.clip(envelope.amplitude, 0.0, 1.0)[1:].tolist(),
                envelope.frequency_hz[1:].tolist(),
                steps_ms.tolist(),
                strict=True,
            )
            if duration_ms > 0
        ],
        "design": outgoing.digest,
    }
    return _write_json(path, content, {})


def _envelope(outgoing: Outgoing, step_s: float) -> Envelope:
    stimulus = outgoing.stimulus
    return envelope_of(stimulus.samples[0], stimulus.sample_rate_hz, step_s)


def _share_of_band(frequency_hz: np.ndarray, band_hz: tuple[float, float]) -> np.ndarray:
    low_hz, high_hz = band_hz
    return np.clip((frequency_hz - low_hz) / (high_hz - low_hz), 0.0, 1.0)


def _write_json(path: Path, content: dict[str, Any], facts: dict[str, Any]) -> Facts:
    text = json.dumps(content, ensure_ascii=False, indent=1, allow_nan=False)
    path.write_text(f"{text}\n", encoding="utf-8")
    return {"samples": "envelope", **facts}


def _loses(_: Mapping[str, str]) -> str:
    return (
        "The waveform: only how strong it is and roughly at which frequency, every 10 or 20 ms; "
        "what the device makes of both differs from model to model."
    )


def _phone_format(
    name: str, title: str, suffix: str, hint: str, write: Any, each: int
) -> StimulusFormat:
    return StimulusFormat(
        name=name,
        title=title,
        suffix=suffix,
        hint=hint,
        write=write,
        bytes_of=lambda n_channels, n_times, _: 600 + each * n_channels * n_times // _RATE_HZ,
        rate_hz=_RATE_HZ,
        fixed_rate=True,
        one_channel_each=True,
        loses=_loses,
    )


HAPTIC = _phone_format(
    "haptic",
    "Meta .haptic",
    ".haptic",
    "Controllers of Meta: a file for each actuator",
    write_haptic,
    14_000,
)
AHAP = _phone_format(
    "ahap", "Apple AHAP", ".ahap", "iPhones: a file for each actuator", write_ahap, 18_000
)
PWLE = _phone_format(
    "pwle",
    "Android envelope",
    ".pwle.json",
    "Phones with Android: control points, a file for each actuator",
    write_pwle,
    6000,
)
