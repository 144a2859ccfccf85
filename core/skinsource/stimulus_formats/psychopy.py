"""A folder that runs: the stimulus, conditions as PsychoPy reads them, and a player for them."""

import csv
import io
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from skinsource.files.assets import data_folder
from skinsource.stimulus_formats.stimulus_format import SAMPLES, Facts, Outgoing, StimulusFormat
from skinsource.stimulus_formats.wav import WAV, write_wav

_PLAYER = ("player", "play.py")
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
    title = outgoing.design.title
    # A spreadsheet would take a title that begins like this for a formula.
    title = f"'{title}" if title[:1] in ("=", "+", "-", "@", "\t") else title
    writer.writerow(
        (sound, 1, title, len(stimulus.channels), outgoing.rate_hz, f"{stimulus.duration_s:.17g}")
    )
    (folder / "conditions.csv").write_text(table.getvalue(), encoding="utf-8")
    (folder / "play.py").write_bytes(data_folder().joinpath(*_PLAYER).read_bytes())
    return {**facts, "player": "play.py", "conditions": "conditions.csv", "sounds": [sound]}


def _bytes_of(n_channels: int, n_times: int, choices: Mapping[str, str]) -> int:
    return _PLAYER_BYTES + WAV.bytes_of(n_channels, n_times, choices)


PSYCHOPY = StimulusFormat(
    name="psychopy",
    title="PsychoPy folder",
    suffix="",
    hint="A folder that runs: sound file, conditions, and a player for all channels with triggers, "
    "a log and a loopback test",
    write=write_psychopy,
    bytes_of=_bytes_of,
    choices={SAMPLES: WAV.choices[SAMPLES]},
    folder=True,
    rounds=WAV.rounds,
    loses=WAV.loses,
)
