"""Phones and controllers: `.haptic` 1.0 (Meta), AHAP (Apple), envelopes for Android.

None of them plays a waveform: they hold the strength of the drive, and roughly its frequency.
None names a place either: each actuator has a file of its own.

References
----------
Meta, haptic file specification 1.0.  Apple, Representing haptic patterns in AHAP files.  Android,
`VibrationEffect.WaveformEnvelopeBuilder`.
"""

import json
from abc import abstractmethod
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.base.conventions import Floats
from skinsource.engine.stimulus import Stimulus
from skinsource.export.formats.chips import Envelope, envelope_of, strength_of
from skinsource.export.formats.format import Choices, Facts, StimulusFile, StimulusFormat
from skinsource.version import __version__

_RATE_HZ = 8000
#: Longest continuous event of AHAP.
_LONGEST_EVENT_S = 30.0


class _Phone(StimulusFormat):
    """The envelope of one actuator, as JSON.

    Attributes
    ----------
    step_s
        Time between two points of the envelope.
    bytes_per_s
        About how many bytes a second takes.
    band_hz
        Frequencies that 0 and 1 stand for; None: frequencies are in hertz.
    """

    rate_hz = _RATE_HZ
    fixed_rate = True
    one_channel_each = True
    plays_waveform = False
    numbers = "amplitudes"
    step_s = 0.01
    bytes_per_s: int
    band_hz: tuple[float, float] | None = None

    @abstractmethod
    def content(self, file: StimulusFile, envelope: Envelope) -> dict[str, Any]:
        """Return the content of the file, for JSON."""

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        stimulus = file.stimulus
        envelope = envelope_of(stimulus.samples[0], stimulus.sample_rate_hz, self.step_s)
        text = json.dumps(
            self.content(file, envelope), ensure_ascii=False, indent=1, allow_nan=False
        )
        path.write_text(f"{text}\n", encoding="utf-8")
        facts: Facts = {} if self.band_hz is None else {"frequency_hz": list(self.band_hz)}
        return {"samples": "envelope", **facts}

    def sent(self, stimulus: Stimulus, choices: Choices) -> Stimulus:
        """Return the amplitudes of its points."""
        return strength_of(stimulus, self.step_s)

    def n_bytes(self, n_channels: int, n_times: int, choices: Choices) -> int:
        """Return about how many bytes it takes."""
        return 600 + self.bytes_per_s * n_channels * n_times // _RATE_HZ

    def loses(self, choices: Choices) -> str:
        """Return a sentence on what is not in the file."""
        return (
            "Only the amplitude and roughly the frequency are sent, every 10 or 20 ms; what the "
            "device makes of both differs from model to model."
        )


def _share_of_band(envelope: Envelope, band_hz: tuple[float, float]) -> Floats:
    low_hz, high_hz = band_hz
    return np.clip((envelope.frequency_hz - low_hz) / (high_hz - low_hz), 0.0, 1.0)


def _points(time_s: list[float], values: Floats, names: tuple[str, str]) -> list[dict[str, float]]:
    return [
        dict(zip(names, point, strict=True)) for point in zip(time_s, values.tolist(), strict=True)
    ]


class Haptic(_Phone):
    """The file of Meta."""

    name = "haptic"
    title = "Meta .haptic"
    suffix = ".haptic"
    hint = "Controllers of Meta: a file for each actuator"
    bytes_per_s = 14_000
    band_hz: tuple[float, float] = (55.0, 200.0)

    def content(self, file: StimulusFile, envelope: Envelope) -> dict[str, Any]:
        """Return the content of the file, for JSON."""
        time_s, (low_hz, high_hz) = envelope.time_s.tolist(), self.band_hz
        amplitude = np.clip(envelope.amplitude, 0.0, 1.0)
        frequency = _share_of_band(envelope, self.band_hz)
        return {
            "version": {"major": 1, "minor": 0, "patch": 0},
            "metadata": {
                "editor": f"SkinSource studio {__version__}",
                "author": file.design.author,
                "source": file.name,
                "project": file.design.title,
                "tags": [],
                "description": f"{file.stimulus.channels[0].title}; frequency 0 is {low_hz:g} Hz, "
                f"1 is {high_hz:g} Hz; design SHA-256 {file.digest}",
            },
            "signals": {
                "continuous": {
                    "envelopes": {
                        "amplitude": _points(time_s, amplitude, ("time", "amplitude")),
                        "frequency": _points(time_s, frequency, ("time", "frequency")),
                    }
                }
            },
        }


class Ahap(_Phone):
    """The file of Apple: continuous events of at most 30 s, each with two curves."""

    name = "ahap"
    title = "Apple AHAP"
    suffix = ".ahap"
    hint = "iPhones: a file for each actuator"
    numbers = "squares of intensities"
    bytes_per_s = 18_000
    band_hz: tuple[float, float] = (65.0, 300.0)

    def content(self, file: StimulusFile, envelope: Envelope) -> dict[str, Any]:
        """Return the content of the file, for JSON."""
        curves = {
            # Perceived intensity is quadratic there.
            "HapticIntensityControl": np.sqrt(np.clip(envelope.amplitude, 0.0, 1.0)),
            "HapticSharpnessControl": _share_of_band(envelope, self.band_hz),
        }
        end_s, (low_hz, high_hz) = float(envelope.time_s[-1]), self.band_hz
        pattern: list[dict[str, Any]] = []
        for number in range(max(int(np.ceil(end_s / _LONGEST_EVENT_S - 1e-9)), 1)):
            begin_s = number * _LONGEST_EVENT_S
            last_s = min(begin_s + _LONGEST_EVENT_S, end_s)
            inside = (envelope.time_s >= begin_s - 1e-9) & (envelope.time_s <= last_s + 1e-9)
            # Times of control points count from the begin of their curve.
            time_s = (envelope.time_s[inside] - begin_s).tolist()
            pattern.append(_ahap_event(begin_s, last_s - begin_s))
            pattern += [
                {
                    "ParameterCurve": {
                        "ParameterID": name,
                        "Time": begin_s,
                        "ParameterCurveControlPoints": _points(
                            time_s, values[inside], ("Time", "ParameterValue")
                        ),
                    }
                }
                for name, values in curves.items()
            ]
        return {
            "Version": 1.0,
            "Metadata": {
                "Project": file.design.title or "SkinSource studio",
                "Description": f"{file.stimulus.channels[0].title}; sharpness 0 is {low_hz:g} Hz, "
                f"1 is {high_hz:g} Hz; design SHA-256 {file.digest}",
            },
            "Pattern": pattern,
        }


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


class Pwle(_Phone):
    """Control points for Android, as its builder takes them one after the other."""

    name = "pwle"
    title = "Android envelope"
    suffix = ".pwle.json"
    hint = "Phones with Android: control points, a file for each actuator"
    bytes_per_s = 6000
    # Phones take no shorter one.
    step_s = 0.02

    def content(self, file: StimulusFile, envelope: Envelope) -> dict[str, Any]:
        """Return the content of the file, for JSON."""
        points = zip(
            np.clip(envelope.amplitude, 0.0, 1.0)[1:].tolist(),
            envelope.frequency_hz[1:].tolist(),
            np.diff(np.round(envelope.time_s * 1000.0)).astype(int).tolist(),
            strict=True,
        )
        return {
            "format": "Android WaveformEnvelopeBuilder",
            "initialFrequencyHz": float(envelope.frequency_hz[0]),
            "controlPoints": [
                {"amplitude": amplitude, "frequencyHz": frequency_hz, "durationMillis": step_ms}
                for amplitude, frequency_hz, step_ms in points
                if step_ms > 0
            ],
            "design": file.digest,
        }
