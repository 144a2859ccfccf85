"""What a foreign file holds, as far as it says so itself."""

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Series:
    """One signal of a file: a channel, a column, a dataset or a column of one.

    Attributes
    ----------
    key
        How the reader finds it again; unique in its file.
    name
        What a user calls it: "channel 1", "acc_x", "tap/acceleration, column 2".
    n_samples
        How many numbers there are.
    dtype
        How the file keeps them, in numpy's words: "int16", "float64"; "text" in tables.
    shape
        That of the dataset it is part of.
    unit
        One of `skinsource.recordings.units.UNITS`; empty where the file does not say.
    rate_hz
        Samples a second; None where the file does not say.
    is_time
        Whether its name is one of time.
    time_unit_s
        What one of it means in seconds, where it is time.
    """

    key: str
    name: str
    n_samples: int
    dtype: str
    shape: tuple[int, ...] = ()
    unit: str = ""
    rate_hz: float | None = None
    is_time: bool = False
    time_unit_s: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """All that a file offers.

    Attributes
    ----------
    format
        Its format: "WAV".
    series
        Its signals, in its order; at least one.
    rate_hz
        Samples a second, where the file says it for all.
    rate_from
        Where it says so: "the header", "'fs'".
    notes
        What was left out or looks odd, in sentences.
    """

    format: str
    series: tuple[Series, ...]
    rate_hz: float | None = None
    rate_from: str = ""
    notes: tuple[str, ...] = ()

    def signals(self) -> tuple[Series, ...]:
        """What can be felt: all that is not time, or all if nothing else is there."""
        return tuple(one for one in self.series if not one.is_time) or self.series

    def one(self, key: str) -> Series | None:
        """The series of that key."""
        return next((one for one in self.series if one.key == key), None)

    def rate_of(self, series: Series) -> float | None:
        """Samples a second of a series; None where the file does not say."""
        return series.rate_hz or self.rate_hz

    def time_of(self, series: Series) -> Series | None:
        """The time stamps of a series: as many as it has samples, from the same group if any."""
        stamps = [
            one
            for one in self.series
            if one.is_time and one.n_samples == series.n_samples and one.key != series.key
        ]
        group = series.key.rpartition("/")[0]
        return next(
            (one for one in stamps if one.key.rpartition("/")[0] == group),
            stamps[0] if stamps else None,
        )


def to_tree(found: Found) -> dict[str, Any]:
    """Return ``found`` as JSON carries it."""
    return asdict(found)


def from_tree(tree: Mapping[str, Any]) -> Found:
    """Return what `to_tree` made; raise `TypeError` or `KeyError` on anything else."""
    series = tuple(
        Series(**{**one, "shape": tuple(int(n) for n in one["shape"])}) for one in tree["series"]
    )
    return Found(**{**tree, "series": series, "notes": tuple(map(str, _list(tree["notes"])))})


def _list(value: Iterable[object]) -> Iterable[object]:
    if isinstance(value, str):
        raise TypeError("expected a list")
    return value
