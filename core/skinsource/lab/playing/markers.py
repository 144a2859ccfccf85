"""Markers for Lab Streaming Layer: one for each onset, and what is played."""

import json
from typing import Any

import numpy as np

from skinsource.base.errors import InvalidInputError
from skinsource.base.extras import package_of_extra
from skinsource.lab.playing.player import Playback

# Recorders look for streams that begin anew by this name.
_SOURCE = "skinsource"


class Markers:
    """A stream of markers, for `Player`: ``ss.Player(design, began=Markers())``.

    A marker is text in JSON: ``code``, ``first_sample_s`` (clock of the device), ``latency_s``,
    ``loopback_s``, and ``onset``, which is "estimated" until a loopback was measured.  Its time is
    that at which the first sample is heard, as the device tells, plus the loopback's delay.

    Parameters
    ----------
    name
        Name of the stream; that of the drive is the same with " drive".
    drive
        Whether a second stream holds what is played, an output a channel, at the rate of the
        device; 1 is full scale at 0 dB.

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

    def __init__(self, name: str = "SkinSource", *, drive: bool = False) -> None:
        self._lsl: Any = package_of_extra("pylsl", "lsl")
        self.name, self._drive = name, drive
        info = self._lsl.StreamInfo(name, "Markers", 1, 0.0, "string", f"{_SOURCE}-{name}")
        self._markers = self._lsl.StreamOutlet(info)
        self._drives: Any = None

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
        if self._drive:
            self._push_drive(playback, at_s)

    def _push_drive(self, playback: Playback, at_s: float) -> None:
        mix = playback.mix
        rate_hz = mix.sample_rate_hz
        if self._drives is None:
            name = f"{self.name} drive"
            n, source = mix.n_outputs, f"{_SOURCE}-{name}"
            info = self._lsl.StreamInfo(name, "Stimulus", n, rate_hz, "float32", source)
            self._drives = self._lsl.StreamOutlet(info)
        # The time of a block is that of its last sample.
        end_s = at_s + (mix.n_times - 1) / rate_hz
        self._drives.push_chunk(np.ascontiguousarray(mix.samples.T), end_s)


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
