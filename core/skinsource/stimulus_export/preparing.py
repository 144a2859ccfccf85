"""From a design to what is written: samples in parts of full scale, one stimulus per file."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from skinsource import codec
from skinsource.chain import Actuation
from skinsource.codec.json_text import dumped
from skinsource.codec.references import taken_out
from skinsource.counting import counted
from skinsource.design import Design, audible_inputs
from skinsource.equalising import Equaliser
from skinsource.errors import InvalidInputError
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.rigs import Rig
from skinsource.stimulus import (
    Stage,
    Stimulus,
    faded,
    full_scale_factor,
    part_of_time,
    stimulus_of,
    with_lead_in,
)
from skinsource.stimulus.wiring import FULL_SCALE_UNIT, for_rig, through_actuators
from skinsource.stimulus_export.edges import Ends, cut_ends
from skinsource.stimulus_export.losses import with_losses
from skinsource.stimulus_export.naming import marked
from skinsource.stimulus_export.options import StimulusOptions
from skinsource.stimulus_export.parts import parts
from skinsource.stimulus_export.rigged import about_rig
from skinsource.stimulus_formats import Outgoing, StimulusFormat


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Prepared:
    """What will be written, file by file.

    Attributes
    ----------
    format
        As what.
    gain
        The one factor between the drives and the samples.
    drives
        All channels before that factor, in the unit of the drive: what limits are about.
    files
        Path and content of each file.
    marks
        What stands before the ending in the name of each file, see `naming.marked`.
    cut
        At which ends a part of the design was cut out.
    actuation, rig, equaliser
        What it is made for, and what makes volts of accelerations; None: not known.
    """

    format: StimulusFormat
    gain: float
    drives: Stimulus
    files: tuple[tuple[Path, Outgoing], ...]
    marks: tuple[str, ...]
    cut: tuple[Ends, ...] = ()
    actuation: Actuation | None = None
    rig: Rig | None = None
    equaliser: Equaliser | None = None

    @property
    def n_bytes(self) -> int:
        """About how many bytes all files take together."""
        return sum(
            self.format.bytes_of(len(one.stimulus.channels), one.stimulus.n_times, one.choices)
            + self.format.response_bytes(one.design)
            for _, one in self.files
        )

    @property
    def clipped(self) -> int:
        """Samples beyond full scale, if that is all that a device can play."""
        if not self.format.to_device:
            return 0
        return sum(int(clipped_samples(one.stimulus).sum()) for _, one in self.files)


def clipped_samples(stimulus: Stimulus) -> np.ndarray:
    """How many samples of each channel lie beyond full scale, (n_channels,)."""
    samples = stimulus.samples
    return np.array([np.count_nonzero((row > 1.0) | (row < -1.0)) for row in samples], np.int64)


def prepared(
    design: Design,
    path: Path,
    format: StimulusFormat,
    rate_hz: int | None,
    options: StimulusOptions,
    *,
    stages: Sequence[Stage] = (),
    actuation: Actuation | None = None,
    rig: Rig | None = None,
    equaliser: Equaliser | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> Prepared:
    """Make a design ready for files.

    Parameters
    ----------
    design, path, format, options
        What goes where, as what, and how.
    rate_hz
        None: the usual one of the format, which is also taken where it knows no other.
    stages, actuation
        What is done at that rate; the actuators where no rig says them, None: those that the
        design is predicted through.
    rig, equaliser
        What the channels are wired to; what makes volts of accelerations: with a rig, full scale
        is then that of each channel, not the largest sample.
    progress, stop
        Told how many channels have that rate; as of a job.

    Raises
    ------
    InvalidInputError
        Nothing is heard, the format does not hold that many channels, or an option cannot be.
    """
    choices = format.chosen(options.choices)
    own_rate = format.fixed_rate or rate_hz is None
    rate_hz = format.rate_hz if own_rate else rate_hz
    cut, lead_in_s = cut_ends(options), 0.0
    if not cut and options.fade_in_s == 0.0:
        # What rings before time 0 is kept where nothing is cut off or faded in.
        lead_in_s, options = options.lead_in_s, replace(options, lead_in_s=0.0)
    made = _made(design, rate_hz, options, stages, lead_in_s, (progress, stop))
    stop_if(stop)
    actuation = design.actuated if actuation is None else actuation
    drives = _cut(_for_rig(made, rig, equaliser, options, actuation), options)
    if drives.sample_rate_hz != drives.own_rate_hz:
        own = _made(design, None, options, (), 0.0, (silent, stop))
        drives = with_losses(drives, own, options, stop)
    gain = 1.0 if drives.unit == FULL_SCALE_UNIT else _gain(drives, options)
    apart = parts(drives, gain, format, options)
    places = [marked(path, format, mark) for mark in apart]
    files = tuple(
        (place, _outgoing(own, design, place.name, format, choices, options, gain, rig))
        for place, own in zip(places, apart.values(), strict=True)
    )
    return Prepared(
        format=format,
        gain=gain,
        drives=drives,
        files=files,
        marks=tuple(apart),
        cut=cut,
        actuation=actuation,
        rig=rig,
        equaliser=equaliser,
    )


def _made(
    design: Design,
    rate_hz: int | None,
    options: StimulusOptions,
    stages: Sequence[Stage],
    lead_in_s: float,
    job: tuple[Progress, Stop],
) -> Stimulus:
    """What the design plays of what was chosen."""
    made = stimulus_of(
        design,
        rate_hz,
        per="input" if options.one_file_per_input else options.per,
        inputs=options.inputs,
        clips=options.clips,
        stages=stages,
        lead_in_s=lead_in_s,
        progress=job[0],
        stop=job[1],
    )
    if not made.channels:
        raise InvalidInputError(
            "Nothing is heard: there is no channel to export. Unmute an input, or choose others."
        )
    return made


def _gain(drives: Stimulus, options: StimulusOptions) -> float:
    own = options.full_scale
    return full_scale_factor(drives) if own is None else 1.0 / own


def _for_rig(
    made: Stimulus,
    rig: Rig | None,
    equaliser: Equaliser | None,
    options: StimulusOptions,
    actuation: Actuation | None,
) -> Stimulus:
    """The stimulus as the channels of ``rig`` want it."""
    own_scale = options.full_scale is not None
    if rig is not None:
        if equaliser is not None and options.full_scale is not None:
            raise InvalidInputError(
                f"full_scale is {options.full_scale:g}, and with an equaliser the rig says it. "
                "Leave one of them out."
            )
        return for_rig(made, rig, equaliser, scaled=own_scale)
    if equaliser is None:
        return made
    if actuation is None:
        raise InvalidInputError(
            "An equaliser needs to know what is at each place: choose a rig, or let the design be "
            "predicted through an actuator."
        )
    return through_actuators(made, actuation, equaliser)


def _cut(made: Stimulus, options: StimulusOptions) -> Stimulus:
    if options.from_s is not None or options.to_s is not None:
        from_s = 0.0 if options.from_s is None else options.from_s
        made = part_of_time(made, from_s, made.duration_s if options.to_s is None else options.to_s)
    return with_lead_in(faded(made, options.fade_in_s, options.fade_out_s), options.lead_in_s)


def _outgoing(
    stimulus: Stimulus,
    design: Design,
    name: str,
    format: StimulusFormat,
    choices: dict[str, str],
    options: StimulusOptions,
    gain: float,
    rig: Rig | None,
) -> Outgoing:
    n = len(stimulus.channels)
    if format.most_channels is not None and n > format.most_channels:
        raise InvalidInputError(
            f"The format {format.name} holds at most "
            f"{counted(format.most_channels, 'channel')}, found {n}. Choose WAV, fewer "
            "inputs, or one file per input."
        )
    return Outgoing(
        stimulus=stimulus,
        full_scale=1.0 / gain,
        design=_part_of(design, stimulus, options),
        name=name,
        digest=digest_of(design),
        choices=choices,
        calibration=about_rig(stimulus, rig),
        dither_seed=options.dither_seed,
    )


def _part_of(design: Design, stimulus: Stimulus, options: StimulusOptions) -> Design:
    """The design with those inputs and clips that are in ``stimulus``."""
    there = {id for one in stimulus.channels for id in one.inputs}
    inputs = [one for one in audible_inputs(design.inputs) if one.id in there]
    if options.clips is not None:
        chosen = set(options.clips)
        inputs = [
            replace(one, clips=tuple(clip for clip in one.clips if clip.id in chosen))
            for one in inputs
        ]
    return replace(design, inputs=tuple(inputs))


def digest_of(design: Design) -> str:
    """SHA-256 of all that a design says, in hexadecimal; samples take part by theirs."""
    return hashlib.sha256(dumped(taken_out(codec.encode(design))[0])).hexdigest()
