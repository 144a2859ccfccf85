"""The check of the wiring: what each output of a rig really does, beside what the rig says."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.arguments import checking
from skinsource.base.errors import InvalidInputError, printable
from skinsource.base.files import FilePath, write_bytes
from skinsource.export import plot
from skinsource.export.wiring import draw_table, new_page
from skinsource.lab.rig_measuring.loopback import Loopback
from skinsource.lab.rig_measuring.measurement import ChannelMeasurement, minus

#: Channels that differ by more do not focus as predicted: 1 ms costs 10 dB at 400 Hz.
LARGEST_DELAY_S = 1e-4
#: Where gains are told.
GAIN_AT_HZ = 100.0
_COLUMNS = ("Output", "Place", "Felt at", "Polarity", "Gain at 100 Hz", "Delay", "Jitter")
_OPEN = "not checked"
# In parts of the printed page: where sentences begin, height of each, and of all at most.
_TOP, _LINE, _MOST = 0.94, 0.012, 0.45


@dataclass(frozen=True, slots=True, kw_only=True)
class ChannelCheck:
    """What was found of a channel; None: not checked.

    Attributes
    ----------
    place, output
        Input place and output of the device, from 1, as the rig has them.
    reported_place
        Input place at which its buzz was felt.
    inverted
        Whether the skin moves against what the polarity of the rig says.
    gain
        Acceleration per volt at the actuator at 100 Hz, m/s² per V.
    delay_s
        How much later than the reference channel its output is, s; without a reference its round
        trip through device and cable.
    against
        Output of the reference channel; None: none.
    jitter_s
        Standard deviation of the delay, s.
    """

    place: int
    output: int
    reported_place: int | None = None
    inverted: bool | None = None
    gain: float | None = None
    delay_s: float | None = None
    against: int | None = None
    jitter_s: float | None = None

    @property
    def misplaced(self) -> bool:
        """Whether it was felt at another place than the rig says."""
        return self.reported_place not in (None, self.place)

    @property
    def cells(self) -> tuple[str, ...]:
        """The row of the printed table."""
        polarity = {None: _OPEN, False: "as the rig says", True: "opposite"}[self.inverted]
        against = "" if self.against is None else f" after output {self.against}"
        return (
            f"{self.output}",
            f"{self.place}",
            _OPEN if self.reported_place is None else f"{self.reported_place}",
            polarity,
            _OPEN if self.gain is None else f"{self.gain:.3g} m/s² per V",
            _OPEN if self.delay_s is None else minus(f"{self.delay_s * 1e3:z.3f} ms{against}"),
            _OPEN if self.jitter_s is None else f"{self.jitter_s * 1e3:.3f} ms",
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class WiringCheck:
    """What was found of all channels of a rig.

    `wiring_check` begins one; methods return what is known after another step.

    Attributes
    ----------
    title
        That of the rig.
    channels
        In the order of the rig.
    checked_on
        Date, ``"2026-11-29"``.
    """

    title: str
    channels: tuple[ChannelCheck, ...]
    checked_on: str

    def felt(self, output: int, place: int) -> WiringCheck:
        """Return it with the place at which the buzz of an output was felt."""
        return self._with(output, reported_place=place)

    def measured(self, output: int, measurement: ChannelMeasurement) -> WiringCheck:
        """Return it with polarity and gain as an accelerometer tells them."""
        gain = float(np.abs(measurement.response.response(np.array([GAIN_AT_HZ])))[0])
        return self._with(output, inverted=measurement.inverted, gain=gain)

    def looped(self, output: int, found: Loopback, against: int | None = None) -> WiringCheck:
        """Return it with delay and jitter of an output; ``against``: output of the reference."""
        delays_s = found.round_trips_s if found.later_s is None else found.later_s
        return self._with(
            output,
            delay_s=float(np.nanmedian(delays_s)),
            jitter_s=float(np.nanstd(delays_s)),
            against=against,
        )

    @property
    def sentences(self) -> tuple[str, ...]:
        """What is not as the rig says, and which channels are not within 0.1 ms of the others."""
        said = []
        for channel in self.channels:
            if channel.misplaced:
                said.append(
                    f"Output {channel.output} moves place {channel.reported_place}, and the rig "
                    f"says place {channel.place}."
                )
            if channel.inverted:
                said.append(
                    f"Output {channel.output} (place {channel.place}) moves against its polarity."
                )
            if channel.jitter_s is not None and channel.jitter_s > LARGEST_DELAY_S:
                said.append(
                    f"Output {channel.output} varies by {channel.jitter_s * 1e3:.2f} ms, and "
                    "focusing needs 0.1 ms: close other programs, or choose another card."
                )
        for against in dict.fromkeys(channel.against for channel in self.channels):
            said += _late(self._delays_s(against))
        return tuple(said)

    def _delays_s(self, against: int | None) -> dict[int, float]:
        """Return delays by output that were measured with this reference, or without any."""
        delays_s = {} if against is None else {against: 0.0}
        for channel in self.channels:
            if channel.delay_s is not None and channel.against == against:
                delays_s[channel.output] = channel.delay_s
        return delays_s

    @property
    def wrong(self) -> bool:
        """Whether places or polarities are not as the rig says."""
        return any(channel.misplaced or channel.inverted for channel in self.channels)

    def corrected(self, rig: Rig) -> Rig:
        """Return a rig whose places and polarities are those that were found.

        Raises
        ------
        InvalidInputError
            Two outputs would have one place.
        """
        found = {channel.output: channel for channel in self.channels}
        return replace(rig, channels=tuple(_corrected(each, found) for each in rig.channels))

    def opened(self, rig: Rig) -> WiringCheck:
        """Return it for the corrected rig: what that changed is to be checked again."""
        places = {channel.output: channel.place for channel in rig.channels}
        channels = (
            replace(
                each,
                place=places.get(each.output, each.place),
                reported_place=None if each.misplaced else each.reported_place,
                inverted=None if each.inverted else each.inverted,
            )
            for each in self.channels
        )
        return replace(self, channels=tuple(channels))

    def _with(self, output: int, **changes: object) -> WiringCheck:
        if output not in {channel.output for channel in self.channels}:
            raise InvalidInputError(f"output is {output}, expected one that the rig wires")
        channels = (
            replace(each, **changes) if each.output == output else each  # type: ignore[arg-type]
            for each in self.channels
        )
        return replace(self, channels=tuple(channels))


def _late(delays_s: Mapping[int, float]) -> list[str]:
    """Return a sentence for each output outside the largest group that is within 0.1 ms."""
    groups = [
        [other for other in delays_s.values() if 0.0 <= other - first <= LARGEST_DELAY_S]
        for first in delays_s.values()
    ]
    group = max(groups, key=len, default=[])
    said = []
    for output, delay_s in delays_s.items():
        if delay_s not in group:
            later_s = delay_s - float(np.median(group))
            said.append(
                f"Output {output} is {abs(later_s) * 1e3:.2f} ms "
                f"{'later' if later_s > 0.0 else 'earlier'} than the others, and focusing needs "
                "0.1 ms: set Delay in the rig."
            )
    return said


def _corrected(channel: RigChannel, found: Mapping[int, ChannelCheck]) -> RigChannel:
    check = found.get(channel.output)
    if check is None:
        return channel
    if check.inverted:
        channel = replace(
            channel, polarity="normal" if channel.polarity == "inverted" else "inverted"
        )
    return channel if check.reported_place is None else replace(channel, place=check.reported_place)


@checking
def wiring_check(rig: Rig) -> WiringCheck:
    """Return the check of a rig, of which nothing is known yet.

    Raises
    ------
    InvalidInputError
        The rig has no channel.

    Examples
    --------
    >>> import skinsource as ss
    >>> channels = [ss.rigs.RigChannel(place=7, output=1), ss.rigs.RigChannel(place=8, output=2)]
    >>> check = ss.rig_measuring.wiring_check(ss.rigs.Rig(channels=channels))
    >>> print(check.felt(1, 8).felt(2, 7).sentences[0])
    Output 1 moves place 8, and the rig says place 7.
    """
    if not rig.channels:
        raise InvalidInputError("The rig has no channel. Add channels to it first.")
    channels = (ChannelCheck(place=each.place, output=each.output) for each in rig.channels)
    today = datetime.now(UTC).date().isoformat()
    return WiringCheck(title=rig.title, channels=tuple(channels), checked_on=today)


@checking
def save_wiring_check(check: WiringCheck, path: FilePath) -> None:
    """Write a check: ``.json`` for programs, ``.pdf``, ``.svg`` or ``.png`` for the wall.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> rig = ss.rigs.Rig(channels=[ss.rigs.RigChannel(place=7, output=1)])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     check = ss.rig_measuring.wiring_check(rig)
    ...     ss.rig_measuring.save_wiring_check(check, Path(folder) / "wiring.json")
    ...     print([path.name for path in Path(folder).iterdir()])
    ['wiring.json']
    """
    kind = Path(path).suffix.lower()[1:]
    if kind == "json":
        content = {**asdict(check), "sentences": check.sentences}
        text = json.dumps(content, ensure_ascii=False, indent=2)
        write_bytes(Path(path), f"{text}\n".encode())
        return
    if kind not in plot.METADATA:
        raise InvalidInputError(
            f"{printable(Path(path).name)} is not the name of a page. Call it *.pdf, *.svg, *.png "
            "or *.json."
        )
    title = f"Wiring of {check.title}" if check.title else "Wiring"
    with plot.style():
        figure = new_page(f"{title}, checked on {check.checked_on}")
        known = any(set(channel.cells[2:]) != {_OPEN} for channel in check.channels)
        right = "All that was checked is as the rig says." if known else "Nothing is checked yet."
        said = check.sentences or (right,)
        line = min(_LINE, _MOST / len(said))
        size = 8.0 * line / _LINE
        figure.text(0.08, _TOP, "\n".join(said), fontsize=size, va="top", parse_math=False)
        rows = [channel.cells for channel in check.channels]
        below = _TOP - 0.02 - line * len(said)
        draw_table(figure.add_axes((0.08, 0.04, 0.84, below - 0.04)), _COLUMNS, rows)
        content_bytes = plot.figure_content(figure, kind)
    write_bytes(Path(path), content_bytes)
