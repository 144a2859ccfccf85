"""BIDS: a stimulus beside recordings of the brain, as that standard lays it out."""

import gzip
import json
from collections.abc import Mapping
from pathlib import Path

from skinsource.job import stop_if
from skinsource.stimulus_formats.column_names import channel_names
from skinsource.stimulus_formats.csv_text import number
from skinsource.stimulus_formats.stimulus_format import Facts, Outgoing, StimulusFormat

_BLOCK = 4096
_ENDING = ".tsv.gz"


def write_bids(outgoing: Outgoing, path: Path) -> Facts:
    """Write the table, packed and without a header; the names are in the sidecar."""
    stimulus = outgoing.stimulus
    names = channel_names(stimulus)
    # Neither name nor time of the file: the same stimulus gives the same bytes.
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
                "Description": f"Drive at {one.title}" if one.place else one.title,
                "Units": "parts of full scale",
            }
            for name, one in zip(names, stimulus.channels, strict=True)
        },
    }


def _place_of_description(path: Path) -> Path | None:
    """Where BIDS looks for what it asks for; nowhere where ``path`` has no name of BIDS."""
    if not path.name.endswith(_ENDING):
        return None
    return path.with_name(f"{path.name.removesuffix(_ENDING)}.json")


def _description(facts: Facts) -> bytes:
    """What BIDS asks for."""
    keys = ("SamplingFrequency", "StartTime", "Columns", *facts["Columns"])
    content = json.dumps({key: facts[key] for key in keys}, ensure_ascii=False, indent=2)
    return f"{content}\n".encode()


def _bytes_of(n_channels: int, n_times: int, _: Mapping[str, str]) -> int:
    return 10 * n_channels * n_times


BIDS = StimulusFormat(
    name="bids",
    title="BIDS stimulus table",
    suffix="_stim.tsv.gz",
    hint="For data of EEG, MEG and fMRI: a packed table, and what BIDS wants to know of it",
    write=write_bids,
    bytes_of=_bytes_of,
    rate_hz=None,
    to_device=False,
    beside=_place_of_description,
    words_beside=_description,
)
