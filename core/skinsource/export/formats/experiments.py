"""Formats for experiments: BIDS for recordings of the brain, and a folder for PsychoPy."""

import csv
import gzip
import io
import json
from dataclasses import replace
from pathlib import Path

from skinsource.base.assets import data_folder
from skinsource.base.job import stop_if
from skinsource.base.quoting import cell_text
from skinsource.export.formats.audio import WAV, write_wav
from skinsource.export.formats.format import SAMPLES, Facts, Outgoing, StimulusFormat, channel_names
from skinsource.export.formats.text import number

_BLOCK = 4096
_TABLE_SUFFIX = ".tsv.gz"


def write_bids(outgoing: Outgoing, path: Path) -> Facts:
    """Write the table, packed and without a header; the names are in the sidecar."""
    stimulus = outgoing.stimulus
    names = channel_names(stimulus)
    # Without name and time of the file the same stimulus gives the same bytes.
    with path.open("wb") as raw, gzip.GzipFile("", "wb", 6, raw, mtime=0) as file:
        for start in range(0, stimulus.n_times, _BLOCK):
            stop_if(outgoing.stop)
            rows = stimulus.samples[:, start : start + _BLOCK].T.tolist()
            file.write(("\n".join("\t".join(map(number, row)) for row in rows) + "\n").encode())
            outgoing.progress(min(start + _BLOCK, stimulus.n_times), stimulus.n_times, "Writing")
    return {
        "samples": "float64",
        "SamplingFrequency": outgoing.rate_hz,
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


def _description_path(path: Path) -> Path | None:
    """Return the path of the description that BIDS requires; None: ``path`` is no BIDS name."""
    if not path.name.endswith(_TABLE_SUFFIX):
        return None
    return path.with_name(f"{path.name.removesuffix(_TABLE_SUFFIX)}.json")


def _description(facts: Facts) -> bytes:
    """Return the facts that BIDS requires, as JSON."""
    keys = ("SamplingFrequency", "StartTime", "Columns", *facts["Columns"])
    content = json.dumps({key: facts[key] for key in keys}, ensure_ascii=False, indent=2)
    return f"{content}\n".encode()


BIDS = StimulusFormat(
    name="bids",
    title="BIDS stimulus table",
    suffix="_stim.tsv.gz",
    hint="For data of EEG, MEG and fMRI: a packed table, and what BIDS wants to know of it",
    write=write_bids,
    bytes_of=lambda n_channels, n_times, _: 10 * n_channels * n_times,
    rate_hz=None,
    to_device=False,
    companion_path=_description_path,
    companion_content=_description,
)


_SOUNDS = "stimuli"
_COLUMNS = ("stimulus", "trigger_code", "title", "channels", "rate_hz", "duration_s")
_PLAYER_BYTES = 12_000


def write_psychopy(outgoing: Outgoing, folder: Path) -> Facts:
    """Fill the folder: ``stimuli``, ``conditions.csv`` and ``play.py``."""
    (folder / _SOUNDS).mkdir()
    sound = f"{_SOUNDS}/{Path(outgoing.name).stem or 'stimulus'}.wav"
    as_sound = replace(outgoing, choices=WAV.chosen({SAMPLES: outgoing.choices[SAMPLES]}))
    facts = write_wav(as_sound, folder / sound)
    stimulus = outgoing.stimulus
    table = io.StringIO()
    writer = csv.writer(table, lineterminator="\n")
    writer.writerow(_COLUMNS)
    title = cell_text(outgoing.design.title)
    writer.writerow(
        (sound, 1, title, len(stimulus.channels), outgoing.rate_hz, f"{stimulus.duration_s:.17g}")
    )
    (folder / "conditions.csv").write_text(table.getvalue(), encoding="utf-8")
    player = data_folder() / "player" / "play.py"
    (folder / "play.py").write_bytes(player.read_bytes())
    return {**facts, "player": "play.py", "conditions": "conditions.csv", "sounds": [sound]}


PSYCHOPY = StimulusFormat(
    name="psychopy",
    title="PsychoPy folder",
    suffix="",
    hint="A folder that runs: sound file, conditions, and a player for all channels with triggers, "
    "a log and a loopback test",
    write=write_psychopy,
    bytes_of=lambda n_channels, n_times, choices: (
        _PLAYER_BYTES + WAV.bytes_of(n_channels, n_times, choices)
    ),
    choices={SAMPLES: WAV.choices[SAMPLES]},
    folder=True,
    rounds=WAV.rounds,
    loses=WAV.loses,
)
