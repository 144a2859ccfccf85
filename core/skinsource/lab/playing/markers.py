"""Markers for Lab Streaming Layer: one for each onset, and what is played."""

import json
from typing import Any

import numpy as np

from skinsource.base.arguments import checking, integer
from skinsource.base.errors import InvalidInputError, counted
from skinsource.base.extras import package_of_extra
from skinsource.lab.playing.devices import MOST_OUTPUTS
from skinsource.lab.playing.player import Playback
from skinsource.signals.resampling import MAX_RATE_HZ

# Recorders look for streams that begin anew by this name.
_SOURCE = "skinsource"


class Markers:
    """A stream of markers, for `Player`: ``ss.Player(design, began=Markers())``.

    A marker is text in JSON: ``code``, ``first_sample_s`` (clock of the device), ``latency_s``,
    ``loopback_s``, and ``onset``, which is "estimated" until a loopback was measured.  Its time is
    that at which the first sample leaves the device, plus the loopback's delay.

    Parameters
    ----------
    name
        Name of the stream; that of the drive is the same with " drive".
    drive_outputs
        Outputs of a second stream, which holds the drive, an output a channel; 1 is full scale at
        0 dB.  The trigger is not in it.  0: no such stream.
    drive_rate_hz
        Rate of the device, and of that stream.

    Raises
    ------
    MissingExtraError
        The extra ``lsl`` is not installed.

    Examples
    --------
    >>> from skinsource.lab.playing.markers import marker_text
    >>> text = marker_text(code=5, first_sample_s=1.25, latency_s=0.02, loopback_s=None)
    >>> print(text[text.index("onset") :])
    onset": "estimated"}
    """

    @checking
    def __init__(
        self, name: str = "SkinSource", *, drive_outputs: int = 0, drive_rate_hz: int = 48_000
    ) -> None:
        self._lsl: Any = package_of_extra("pylsl", "lsl")
        self._n = integer("drive_outputs", drive_outputs, 0, MOST_OUTPUTS)
        self._rate_hz = integer("drive_rate_hz", drive_rate_hz, 1, MAX_RATE_HZ)
        self._markers = self._outlet(name, "Markers", 1, 0.0, "string")
        self._drive: Any = None
        if self._n:
            # Before anything is played, so that recorders find it.
            drive_name, rate_hz = f"{name} drive", float(self._rate_hz)
            self._drive = self._outlet(drive_name, "Stimulus", self._n, rate_hz, "float32")

    def _outlet(self, name: str, kind: str, n: int, rate_hz: float, form: str) -> Any:
        info = self._lsl.StreamInfo(name, kind, n, rate_hz, form, f"{_SOURCE}-{name}")
        return self._lsl.StreamOutlet(info)

    def __call__(self, playback: Playback) -> None:
        """Send the marker of a playback that has begun, and its drive."""
        at_s, first_s = playback.onset_at(self._lsl.local_clock), playback.first_sample_s
        if at_s is None or first_s is None:
            raise InvalidInputError("The playback has not begun. Call wait_begin first.")
        text = marker_text(
            code=playback.code,
            first_sample_s=first_s,
            latency_s=playback.latency_s,
            loopback_s=playback.loopback_s,
        )
        self._markers.push_sample([text], at_s)
        if self._drive is not None:
            self._push_drive(playback, at_s)

    def _push_drive(self, playback: Playback, at_s: float) -> None:
        mix = playback.mix
        if mix.n_outputs > self._n or mix.sample_rate_hz != self._rate_hz:
            raise InvalidInputError(
                f"{counted(mix.n_outputs, 'output')} play at {mix.sample_rate_hz} Hz, and the "
                f"stream has {self._n} at {self._rate_hz} Hz. Make Markers with that many outputs."
            )
        samples = np.zeros((mix.n_times, self._n), np.float32)
        samples[:, : mix.n_outputs] = mix.samples.T
        # The time of a block is that of its last sample.
        end_s = at_s + (mix.n_times - 1) / self._rate_hz
        self._drive.push_chunk(samples, end_s)


def marker_text(
    *, code: int, first_sample_s: float, latency_s: float | None, loopback_s: float | None
) -> str:
    """Return the text of a marker, see `Markers`."""
    onset = "estimated" if loopback_s is None else "measured"
    facts = {
        "code": code,
        "first_sample_s": first_sample_s,
        "latency_s": latency_s,
        "loopback_s": loopback_s,
        "onset": onset,
    }
    return json.dumps(facts)
