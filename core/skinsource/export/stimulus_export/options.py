"""Options of an exported stimulus: its files and their names, its channels, its ends."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np

from skinsource.actuators.equalising import Equaliser
from skinsource.actuators.rigs import Rig, calibration_words, rig_breaches
from skinsource.base.arguments import one_of, real_number
from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.engine.stimulus import (
    Stimulus,
    added_delays_s,
    channel_of,
    in_order,
    peaks,
    scaled,
    with_sync,
)
from skinsource.export.formats.format import StimulusFormat
from skinsource.specs.models import specs_of


def marked(path: Path, format: StimulusFormat, mark: str) -> Path:
    """Return ``path`` with ``mark`` before the ending of ``format``."""
    suffix = format.suffix if path.name.endswith(format.suffix) else path.suffix
    stem = path.name[: len(path.name) - len(suffix)]
    return path.with_name(f"{stem}{mark}{suffix}")


def sidecar_path(path: Path) -> Path:
    """Return the path of the sidecar of a file or folder."""
    return path.with_name(f"{path.name}.json")


def written_files(
    path: Path, format: StimulusFormat, marks: Iterable[str]
) -> tuple[tuple[Path, ...], ...]:
    """Return each file that an export to ``path`` writes, with its sidecar and its companion.

    ``marks`` are those of `skinsource.export.stimulus_export.preparing.Overview`.
    """
    files = (marked(path, format, mark) for mark in marks)
    return tuple(
        (file, sidecar_path(file), *filter(None, (format.companion_path(file),))) for file in files
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class StimulusOptions:
    """How a stimulus is prepared for a file; by default nothing is added to it.

    Attributes
    ----------
    per
        ``"place"``: one channel for each place in use; ``"input"``: one for each input.
    one_file_per_input
        A file of one channel for each input, PATH with ``_input-2`` before its ending; all have
        the same full scale.
    inputs, clips
        Ids of the inputs, or clips, that take part; None: all that are audible.
    from_s, to_s
        Part of the time of the design; None: from its beginning, or to its end.
    fade_in_s, fade_out_s
        Fades at the ends of that part.
    lead_in_s
        Silence before it; where nothing is cut off or faded in, ringing before time 0 is kept.
    sync
        Whether a last channel marks time 0, or ``from_s``, with a pulse at full scale.
    channel_map
        For each output of the device the channel that it gets, 0 for none; (): in their order.
    full_scale
        Drive that full scale stands for, in its unit; None: the largest sample.
    dither_seed
        Seed of dither where whole numbers are written; None: no dither.
    accept_loss
        Whether it is written even though a channel loses more than 1 dB of its energy to the rate.
    choices
        Options of the format: ``{"samples": "pcm24"}``.
    """

    per: Literal["place", "input"] = "place"
    one_file_per_input: bool = False
    inputs: tuple[int, ...] | None = None
    clips: tuple[int, ...] | None = None
    from_s: float | None = None
    to_s: float | None = None
    fade_in_s: float = 0.0
    fade_out_s: float = 0.0
    lead_in_s: float = 0.0
    sync: bool = False
    channel_map: tuple[int, ...] = ()
    full_scale: float | None = None
    dither_seed: int | None = None
    accept_loss: bool = False
    choices: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        one_of("per", self.per, ("place", "input"))
        for name in ("inputs", "clips", "channel_map"):
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, tuple(value))
        if self.full_scale is not None:
            expected = "a positive number in the unit of the drive"
            least = 1e-30
            real_number("full_scale", self.full_scale, expected, least=least, most=1e30)
        if self.one_file_per_input and self.channel_map:
            raise InvalidInputError(
                "channel_map says what each output of one file gets, and each input shall have a "
                "file of its own. Leave one of them out."
            )


def stimuli_by_mark(
    drives: Stimulus, gain: float, format: StimulusFormat, options: StimulusOptions
) -> dict[str, Stimulus]:
    """Return the stimulus of each file by the mark in its name, scaled by ``gain``."""
    if options.one_file_per_input:
        by_mark = {
            f"_input-{channel.inputs[0]}": _single_channel(drives, row)
            for row, channel in enumerate(drives.channels)
        }
    else:
        by_mark = {"": drives}
    return {
        f"{mark}{own_mark}": own
        for mark, stimulus in by_mark.items()
        for own_mark, own in _split_channels(_with_sync(scaled(stimulus, gain), options), format)
    }


def _with_sync(stimulus: Stimulus, options: StimulusOptions) -> Stimulus:
    """Return the stimulus with a sync channel, which is not scaled, in the order of the outputs."""
    if options.sync:
        # Samples before it are the lead-in.
        stimulus = with_sync(stimulus, at_s=options.from_s or 0.0)
    return in_order(stimulus, options.channel_map) if options.channel_map else stimulus


def _split_channels(stimulus: Stimulus, format: StimulusFormat) -> list[tuple[str, Stimulus]]:
    """Return a stimulus for each file by its mark; the first channel has none."""
    if not format.one_channel_each:
        return [("", stimulus)]
    return [
        (f"_channel-{row + 1}" if row else "", _single_channel(stimulus, row))
        for row in range(len(stimulus.channels))
    ]


def _single_channel(stimulus: Stimulus, row: int) -> Stimulus:
    """Return one channel of ``stimulus``, as the first of a file."""
    channel = replace(stimulus.channels[row], number=1)
    return stimulus.with_samples(stimulus.samples[row : row + 1], channels=(channel,))


def passed_limits(stimulus: Stimulus, rig: Rig) -> tuple[str, ...]:
    """Return sentences on the limits of the rig that samples in parts of full scale pass."""
    rows = list(stimulus.driving)
    places = [place for row in rows if (place := stimulus.channels[row].place) is not None]
    rate_hz = round(stimulus.sample_rate_hz)
    breaches = rig_breaches(rig, places, stimulus.samples[rows], rate_hz)
    return tuple(f"{str(breach)[:1].upper()}{str(breach)[1:]}." for breach in breaches)


def about_rig(stimulus: Stimulus, rig: Rig | None) -> str:
    """Return a sentence on the calibration of the channels."""
    places = [channel.place for channel in stimulus.channels if channel.place is not None]
    return calibration_words(rig, places)


def about_channels(stimulus: Stimulus, rig: Rig) -> list[dict[str, Any]]:
    """Return the wiring of each channel; empty for channels that drive no actuator."""
    wiring: list[dict[str, Any]] = []
    added_s = added_delays_s(stimulus, rig)
    for row in range(len(stimulus.channels)):
        if stimulus.channels[row].place is None:
            wiring.append({})
            continue
        channel = channel_of(stimulus, row, rig)
        wiring.append(
            {
                "actuator": channel.actuator,
                "device": channel.device,
                "output": channel.output,
                "full_scale_v": channel.full_scale_v,
                "amplifier_gain": channel.amplifier_gain,
                "polarity": channel.polarity,
                "delay_s": channel.delay_s,
                "delay_added_s": added_s[row],
                "measured_on": channel.measured_on,
            }
        )
    return wiring


def about_equaliser(equaliser: Equaliser | None) -> dict[str, Any] | None:
    """Return kind and numbers of an equaliser."""
    if equaliser is None:
        return None
    values = {name: getattr(equaliser, name) for name in specs_of(equaliser)}
    return {"kind": type(equaliser).__name__, **values}


#: An end of a stimulus.
Ends = Literal["begin", "end"]
#: A larger first or last sample, in parts of the peak of its channel, is reported.
LARGEST_EDGE = 0.01
#: Ringing before and after a sound where the rate is changed lasts so long; see `resample`.
RINGING_S = 0.1


def cut_ends(options: StimulusOptions) -> tuple[Ends, ...]:
    """Return the ends at which a part is cut out; without ``from_s`` it begins at time 0."""
    if options.to_s is not None:
        return ("begin", "end")
    return () if options.from_s is None else ("begin",)


def edges_text(stimuli: Sequence[Stimulus], cut: Sequence[Ends] = ()) -> str:
    """Return sentences on channels whose first or last sample is above 1 % of their peak.

    Parameters
    ----------
    stimuli
        Stimuli of one export, all from the same time on; channels without actuator do not count.
    cut
        Ends at which a part of the design was cut out.
    """
    sentences = []
    resampled = any(stimulus.sample_rate_hz != stimulus.own_rate_hz for stimulus in stimuli)
    if text := _hard_channels_text(stimuli, 0, "begin"):
        if "begin" in cut:
            text += ": what lies before that part is cut off. A fade-in softens it."
        elif resampled and stimuli[0].start_s >= 0.0:
            text += f": what lies before time 0 is cut off. A lead-in of {RINGING_S:g} s keeps it."
        elif resampled:
            text += ": what rings before is cut off. A longer lead-in keeps it."
        else:
            text += ". A lead-in puts silence before it."
        sentences.append(text)
    if text := _hard_channels_text(stimuli, -1, "end"):
        reason = ": what follows is cut off." if resampled or "end" in cut else "."
        sentences.append(f"{text}{reason} A fade-out softens it.")
    return " ".join(sentences)


def _hard_channels_text(stimuli: Sequence[Stimulus], sample: int, verb: Ends) -> str:
    """Return which channels begin or end hard, and how hard, without a full stop; "": none."""
    hard = [
        (channel.number, part)
        for stimulus in stimuli
        for channel, part in zip(stimulus.channels, _edge_shares(stimulus, sample), strict=True)
        if channel.place is not None and part > LARGEST_EDGE
    ]
    if not hard:
        return ""
    percent = 100.0 * max(part for _, part in hard)
    shown = f"{percent:.0f}" if percent >= 9.95 else f"{percent:.1f}"
    if len(hard) == 1:
        return f"Channel {hard[0][0]} {verb}s at {shown} % of its peak"
    return f"{len(hard)} channels {verb} at up to {shown} % of their peaks"


def _edge_shares(stimulus: Stimulus, sample: int) -> Floats:
    """Return a sample of each channel in parts of its peak, (n_channels,); 0 for silence."""
    largest = peaks(stimulus.samples)
    edge = np.abs(stimulus.samples[:, sample])
    return np.divide(edge, largest, out=np.zeros_like(largest), where=largest > 0.0)
