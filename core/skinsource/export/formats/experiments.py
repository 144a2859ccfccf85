"""Formats for experiments: BIDS for recordings of the brain, and a folder for PsychoPy."""

import csv
import gzip
import io
import json
from dataclasses import replace
from pathlib import Path
from typing import ClassVar

from skinsource.base.assets import data_folder
from skinsource.base.errors import cell_text
from skinsource.export.formats.audio import Wav
from skinsource.export.formats.format import SAMPLES, Choices, Facts, StimulusFile, StimulusFormat
from skinsource.export.formats.text import rows_text

_BLOCK = 4096
_TABLE_SUFFIX = ".tsv.gz"


class Bids(StimulusFormat):
    """A packed table without a header; the names are in the sidecar and the description."""

    name = "bids"
    title = "BIDS stimulus table"
    suffix = "_stim.tsv.gz"
    hint = "For EEG, MEG and fMRI data: a compressed table with its BIDS metadata"
    rate_hz = None
    to_device = False

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        stimulus, names = file.stimulus, file.channel_names
        # Without name and time of the file the same stimulus gives the same bytes.
        with path.open("wb") as raw, gzip.GzipFile("", "wb", 6, raw, mtime=0) as output:
            for times in file.blocks(_BLOCK):
                output.write(rows_text(stimulus.samples[:, times], "\t"))
        return {
            "samples": "float64",
            "SamplingFrequency": file.rate_hz,
            "StartTime": stimulus.start_s,
            "Columns": names,
            **{
                name: {
                    "Description": f"Drive at {channel.title}" if channel.place else channel.title,
                    "Units": "parts of full scale",
                }
                for name, channel in zip(names, stimulus.channels, strict=True)
            },
        }

    def n_bytes(self, n_channels: int, n_times: int, choices: Choices) -> int:
        """Return about how many bytes it takes."""
        return 10 * n_channels * n_times

    def companion_path(self, path: Path) -> Path | None:
        """Return the path of the description that BIDS requires; None: it has no BIDS name."""
        if not path.name.endswith(_TABLE_SUFFIX):
            return None
        return path.with_name(f"{path.name.removesuffix(_TABLE_SUFFIX)}.json")

    def companion_content(self, facts: Facts) -> bytes:
        """Return the facts that BIDS requires, as JSON."""
        keys = ("SamplingFrequency", "StartTime", "Columns", *facts["Columns"])
        content = json.dumps({key: facts[key] for key in keys}, ensure_ascii=False, indent=2)
        return f"{content}\n".encode()


_SOUNDS = "stimuli"
_COLUMNS = ("stimulus", "trigger_code", "title", "channels", "rate_hz", "duration_s")
_PLAYER_BYTES = 12_000


class PsychoPy(Wav):
    """A folder with ``stimuli``, ``conditions.csv`` and ``play.py``."""

    name = "psychopy"
    title = "PsychoPy folder"
    suffix = ""
    hint = (
        "A folder that PsychoPy runs: sound file, conditions, and a player for all channels with "
        "triggers, a log and a loopback test"
    )
    choices: ClassVar = {SAMPLES: Wav.choices[SAMPLES]}
    folder = True

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        (path / _SOUNDS).mkdir()
        sound = f"{_SOUNDS}/{Path(file.name).stem or 'stimulus'}.wav"
        facts = super().write(replace(file, choices=Wav().chosen(file.choices)), path / sound)
        stimulus, title = file.stimulus, cell_text(file.design.title)
        duration_s = f"{stimulus.duration_s:.17g}"
        table = io.StringIO()
        csv.writer(table, lineterminator="\n").writerows(
            (_COLUMNS, (sound, 1, title, len(stimulus.channels), file.rate_hz, duration_s))
        )
        (path / "conditions.csv").write_text(table.getvalue(), encoding="utf-8")
        (path / "play.py").write_bytes((data_folder() / "player" / "play.py").read_bytes())
        return {**facts, "player": "play.py", "conditions": "conditions.csv", "sounds": [sound]}

    def n_bytes(self, n_channels: int, n_times: int, choices: Choices) -> int:
        """Return about how many bytes it takes."""
        return _PLAYER_BYTES + super().n_bytes(n_channels, n_times, choices)
