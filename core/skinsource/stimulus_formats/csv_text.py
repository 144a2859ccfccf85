"""CSV: a table for people and programs, and layouts that waveform generators read."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from skinsource.arrays import Floats
from skinsource.counting import counted
from skinsource.errors import InvalidInputError
from skinsource.export.output_file import steadily_written
from skinsource.fields import ChoiceSpec
from skinsource.job import stop_if
from skinsource.stimulus_formats.column_names import channel_names
from skinsource.stimulus_formats.stimulus_format import Facts, Outgoing, StimulusFormat

LAYOUT = "layout"
_BLOCK = 4096
_MOST_KEYSIGHT = 4
# Layouts that begin with the times.
_TIMED = ("table", "pwl")
# Of seventeen digits, most below 1, and what parts it from the next; a zero has two.
_BYTES_OF_NUMBER = 21


def number(value: float) -> str:
    """Seventeen significant digits, which read back as the same number."""
    return f"{value:.17g}"


def write_csv(outgoing: Outgoing, path: Path) -> Facts:
    """Write the file."""
    layout = outgoing.choices[LAYOUT]
    n_channels = len(outgoing.stimulus.channels)
    most = {"keysight": _MOST_KEYSIGHT, "pwl": 1}.get(layout)
    if most is not None and n_channels > most:
        raise InvalidInputError(
            f"The layout {layout} holds at most {counted(most, 'channel')}, found "
            f"{n_channels}. Choose the layout table, or one file per input."
        )
    names = [f"{name}_of_full_scale" for name in channel_names(outgoing.stimulus)]
    columns = {
        "table": ["time_s", *names],
        "keysight": [f"Y{number}" for number in range(1, n_channels + 1)],
    }.get(layout, [])
    timed = layout in _TIMED
    with steadily_written(path) as file:
        if layout == "keysight":
            file.write(f"SampleRate = {outgoing.rate_hz}\n".encode())
        if columns:
            file.write((",".join(columns) + "\n").encode())
        for rows in _rows(outgoing, timed=timed):
            file.write(("\n".join(",".join(map(number, row)) for row in rows) + "\n").encode())
    return {"samples": "float64", "columns": columns}


def _rows(outgoing: Outgoing, *, timed: bool) -> Iterator[list[list[float]]]:
    """Yield rows, some thousand at a time: the time, if wanted, and a value for each channel."""
    stimulus = outgoing.stimulus
    for start in range(0, stimulus.n_times, _BLOCK):
        stop_if(outgoing.stop)
        part: Floats = stimulus.samples[:, start : start + _BLOCK]
        if timed:
            time_s = np.arange(start, start + part.shape[1]) / stimulus.sample_rate_hz
            part = np.vstack((time_s, part))
        yield part.T.tolist()
        outgoing.progress(start + part.shape[1], stimulus.n_times, "Writing")


def _bytes_of(n_channels: int, n_times: int, choices: Mapping[str, str]) -> int:
    n_columns = n_channels + (choices[LAYOUT] in _TIMED)
    return _BYTES_OF_NUMBER * n_columns * n_times


CSV = StimulusFormat(
    name="csv",
    title="CSV",
    suffix=".csv",
    hint="A table of times and channels, or what waveform generators read",
    write=write_csv,
    bytes_of=_bytes_of,
    rate_hz=None,
    to_device=False,
    choices={
        LAYOUT: ChoiceSpec(
            label="Layout",
            options=(
                ("table", "Table with times and names"),
                ("plain", "Numbers only, one column per channel"),
                ("keysight", "Keysight M8190 series"),
                ("pwl", "Time and value, one channel"),
            ),
            hint="A table says what its columns are; generators and simulators want less",
        )
    },
)
