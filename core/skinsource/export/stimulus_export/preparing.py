"""How much of what is exported does not reach the rate at which it is written."""

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from skinsource.actuators.actuation import Actuation
from skinsource.actuators.equalising import Equaliser
from skinsource.actuators.rigs import Rig
from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.base.json_text import dumped
from skinsource.base.work import counted
from skinsource.design.design import Design, audible_inputs
from skinsource.engine.stimulus import (
    FULL_SCALE_UNIT,
    Stage,
    Stimulus,
    faded,
    for_rig,
    full_scale_factor,
    part_of_time,
    scaled,
    stimulus_of,
    through_actuators,
    with_lead_in,
)
from skinsource.export.formats.format import Outgoing, StimulusFormat
from skinsource.export.stimulus_export.options import (
    Ends,
    StimulusOptions,
    about_rig,
    cut_ends,
    edges_text,
    marked,
    passed_limits,
    stimuli_by_mark,
)
from skinsource.signals.resampling import half_transition, passed
from skinsource.specs import models
from skinsource.specs.codec import without_samples

# More is told of nothing: the stop band of `skinsource.resample`.
_MOST_DB = 140.0


def with_losses(drives: Stimulus, own: Stimulus, options: StimulusOptions, stop: Stop) -> Stimulus:
    """Return ``drives`` with the loss of each channel.

    It is the energy of the exported part of the design over what the filter leaves of it, so that
    what is cut off at an end of the part is not taken for lost.

    Parameters
    ----------
    drives, own
        As written; all of it at the rate of the design, from time 0 on.
    """
    loss_db: dict[tuple[int, ...], float] = {}
    for row, channel in enumerate(own.channels):
        stop_if(stop)
        samples = own.samples[row]
        left = passed(samples, own.sample_rate_hz, drives.sample_rate_hz)
        ring = (left.size - samples.size) // 2
        alone = own.with_samples(
            np.stack((np.pad(samples, ring), left)),
            channels=(channel, channel),
            start_s=-ring / own.sample_rate_hz,
        )
        loss_db[channel.inputs] = _loss_db(_exported_part(alone, own.duration_s, options).samples)
    # A stage may have added channels, or left some out.
    channels = tuple(
        replace(channel, loss_db=loss_db.get(channel.inputs, 0.0)) for channel in drives.channels
    )
    return replace(drives, channels=channels)


def _exported_part(stimulus: Stimulus, end_s: float, options: StimulusOptions) -> Stimulus:
    """The part that is exported, with its fades; all that rings where it is the whole."""
    fades_s = options.fade_in_s, options.fade_out_s
    if (options.from_s, options.to_s, *fades_s) == (None, None, 0.0, 0.0):
        return stimulus
    from_s = options.from_s or 0.0
    to_s = end_s if options.to_s is None else options.to_s
    # The shortest part may lie between two samples of the design.
    part = part_of_time(stimulus, from_s, max(to_s, from_s + 1.0 / stimulus.sample_rate_hz))
    return faded(part, *(min(one_s, part.duration_s) for one_s in fades_s))


def _loss_db(samples: Floats) -> float:
    """Energy of the first over that of the second, 0 dB or more."""
    before, after = np.sum(samples**2, axis=1)
    if after >= before:
        return 0.0
    return float(min(10.0 * np.log10(before / after), _MOST_DB)) if after else _MOST_DB


# From a design to what is written: samples in parts of full scale, one stimulus per file.


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PreparedStimulus:
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
            self.format.bytes_of(
                len(outgoing.stimulus.channels), outgoing.stimulus.n_times, outgoing.choices
            )
            + self.format.response_bytes(outgoing.design)
            for _, outgoing in self.files
        )

    @property
    def clipped(self) -> int:
        """Samples beyond full scale, if that is all that a device can play."""
        if not self.format.to_device:
            return 0
        return sum(int(clipped_samples(outgoing.stimulus).sum()) for _, outgoing in self.files)


def clipped_samples(stimulus: Stimulus) -> np.ndarray:
    """How many samples of each channel lie beyond full scale, (n_channels,)."""
    samples = stimulus.samples
    return np.array([np.count_nonzero((row > 1.0) | (row < -1.0)) for row in samples], np.int64)


def prepare_stimulus(
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
) -> PreparedStimulus:
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
    made = _played_stimulus(design, rate_hz, options, stages, lead_in_s, (progress, stop))
    stop_if(stop)
    actuation = design.actuated if actuation is None else actuation
    drives = _cut_and_faded(_for_rig(made, rig, equaliser, options, actuation), options)
    if drives.sample_rate_hz != drives.own_rate_hz:
        own = _played_stimulus(design, None, options, (), 0.0, (silent, stop))
        drives = with_losses(drives, own, options, stop)
    gain = 1.0 if drives.unit == FULL_SCALE_UNIT else _gain(drives, options)
    apart = stimuli_by_mark(drives, gain, format, options)
    places = [marked(path, format, mark) for mark in apart]
    files = tuple(
        (place, _outgoing(own, design, place.name, format, choices, options, gain, rig))
        for place, own in zip(places, apart.values(), strict=True)
    )
    return PreparedStimulus(
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


def _played_stimulus(
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


def _cut_and_faded(made: Stimulus, options: StimulusOptions) -> Stimulus:
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
        design=_exported_design(design, stimulus, options),
        name=name,
        digest=digest_of(design),
        choices=choices,
        calibration=about_rig(stimulus, rig),
        dither_seed=options.dither_seed,
    )


def _exported_design(design: Design, stimulus: Stimulus, options: StimulusOptions) -> Design:
    """The design with those inputs and clips that are in ``stimulus``."""
    there = {id for channel in stimulus.channels for id in channel.inputs}
    inputs = [track for track in audible_inputs(design.inputs) if track.id in there]
    if options.clips is not None:
        chosen = set(options.clips)
        inputs = [
            replace(track, clips=tuple(clip for clip in track.clips if clip.id in chosen))
            for track in inputs
        ]
    return replace(design, inputs=tuple(inputs))


def digest_of(design: Design) -> str:
    """SHA-256 of all that a design says, in hexadecimal; samples take part by theirs."""
    return hashlib.sha256(dumped(without_samples(models.encode(design))[0])).hexdigest()


# What is said of an export beside its numbers: on the sheet, in a terminal, in the sidecars.

#: Energy that a channel may lose to the rate unasked, in dB: about the smallest difference in
#: strength that is felt.
MOST_LOSS_DB = 1.0
#: What is less is not said: ten times what `skinsource.resample` promises within its pass band.
LEAST_LOSS_DB = 0.01
# What samples are that were not equalised, by the unit of the drive.
_RAW = {
    "m/s²": "raw accelerations",
    "V": "volts of the design",
    FULL_SCALE_UNIT: "volts of the design",
}


def edges_of(ready: PreparedStimulus) -> str:
    """Which channels begin or end hard, in words; "": none."""
    return edges_text([outgoing.stimulus for _, outgoing in ready.files], ready.cut)


def loses_of(ready: PreparedStimulus, only: Outgoing | None = None) -> str:
    """What of the drive is not in the files, or not in one of them, in words; "": nothing."""
    files = [outgoing for _, outgoing in ready.files] if only is None else [only]
    return " ".join(filter(None, (ready.format.loses(files[0].choices), lost_at_rate(files))))


def lost_at_rate(files: Sequence[Outgoing]) -> str:
    """How much of which channels their rate does not hold, in words; "": nothing."""
    losing = [
        f"channel {channel.number} ({channel.title}) loses {channel.loss_db:.2g} dB of its energy"
        + (f" in {file.name}" if len(files) > 1 else "")
        for file in files
        for channel in file.stimulus.channels
        if channel.loss_db >= LEAST_LOSS_DB
    ]
    if not losing:
        return ""
    stimulus = files[0].stimulus
    lower_hz = min(stimulus.sample_rate_hz, stimulus.own_rate_hz)
    passed_hz = (1.0 - half_transition(lower_hz)) * 0.5 * lower_hz
    return (
        f"At {stimulus.sample_rate_hz:.10g} Hz what lies above {passed_hz:.0f} Hz is weakened or "
        f"lost: {', '.join(losing)}."
    )


def advice_on_loss(ready: PreparedStimulus) -> str:
    """What to do where a channel loses more to the rate than it may unasked; "": none does."""
    if max(channel.loss_db for channel in ready.drives.channels) <= MOST_LOSS_DB:
        return ""
    own_hz = ready.drives.own_rate_hz
    rate = "" if ready.format.fixed_rate else f"choose {own_hz:g} Hz, the rate of the design, or "
    return f"More than {MOST_LOSS_DB:g} dB is lost: {rate}lower the frequencies."


def equalised_of(ready: PreparedStimulus) -> str:
    """What the samples are equalised for, and by which equaliser, in words."""
    if ready.equaliser is None:
        return f"Not equalised ({_RAW.get(ready.drives.unit, 'raw drives')})"
    through = ready.actuation if ready.rig is None else ready.rig
    title = through.title if through is not None and through.title else "the rig"
    return f"Equalised for {title} ({ready.equaliser.title.lower()})"


def calibration_of(ready: PreparedStimulus) -> str:
    """Whether m/s² follow from the samples, in words."""
    return ready.files[0][1].calibration


# What must be confirmed before it is written.

#: Looks at the drives, in their own unit, and says in a sentence each which limits they pass.
#: Limits belong to a rig, not to a design.
Limit = Callable[[Stimulus], Sequence[str]]


def objections(ready: PreparedStimulus, limits: Sequence[Limit] = ()) -> tuple[str, ...]:
    """Sentences on what clips and on which limits are passed; none: it can be written."""
    sentences = []
    if ready.clipped:
        for path, outgoing in ready.files:
            counts = clipped_samples(outgoing.stimulus)
            words = [
                f"channel {channel.number} ({channel.title}) {count}"
                for channel, count in zip(outgoing.stimulus.channels, counts.tolist(), strict=True)
                if count
            ]
            if words:
                sentences.append(
                    f"{path.name}: samples lie beyond full scale, where a device cuts them off: "
                    f"{', '.join(words)}."
                )
    if ready.rig is not None:
        sent = scaled(ready.drives, ready.gain)
        sentences.extend(passed_limits(sent, ready.rig))
    for limit in limits:
        sentences.extend(limit(ready.drives))
    return tuple(sentences)


# A stimulus as it will be, before it is written.

#: Stretches of the picture of a channel.
COLUMNS = 600


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ChannelOverview:
    """One channel.

    Attributes
    ----------
    file, number, title, place, inputs
        Name of its file; its number there; words; place of the actuator, None without one; ids of
        the inputs that it plays.
    extremes : (2, n_columns)
        Least and largest sample of each stretch, in parts of full scale.
    peak, rms
        In parts of full scale.
    clipped
        Samples that would be cut off.
    """

    file: str
    number: int
    title: str
    place: int | None
    inputs: tuple[int, ...]
    extremes: Floats
    peak: float
    rms: float
    clipped: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Overview:
    """All that will be written.

    Attributes
    ----------
    channels
        Of all files.
    marks
        What stands before the ending in the name of each file: `written_files` needs it.
    n_bytes
        About how many bytes all files take together.
    rate_hz, duration_s
        Of each.
    full_scale, unit
        What full scale stands for.
    edges
        Which channels begin or end hard, in words; "": none.
    loses
        What of the drive is not in the files; "": nothing.
    calibration, equalised
        Whether m/s² follow from the samples; what they are equalised for: in words.
    objections
        What must be confirmed, or accepted.
    """

    channels: tuple[ChannelOverview, ...]
    marks: tuple[str, ...]
    n_bytes: int
    rate_hz: float
    duration_s: float
    full_scale: float
    unit: str
    edges: str
    loses: str
    calibration: str
    equalised: str
    objections: tuple[str, ...]

    @property
    def n_files(self) -> int:
        """How many files there are."""
        return len(self.marks)


def overview_of(
    ready: PreparedStimulus,
    limits: Sequence[Limit] = (),
    *,
    progress: Progress = silent,
    stop: Stop = never,
) -> Overview:
    """Look at what is ready to be written; ``progress`` and ``stop`` are those of a job."""
    channels: list[ChannelOverview] = []
    n_channels = sum(len(outgoing.stimulus.channels) for _, outgoing in ready.files)
    for path, outgoing in ready.files:
        stimulus = outgoing.stimulus
        counts = (
            clipped_samples(stimulus)
            if ready.format.to_device
            else np.zeros(len(stimulus.channels))
        )
        for channel, samples, count in zip(
            stimulus.channels, stimulus.samples, counts, strict=True
        ):
            stop_if(stop)
            progress(len(channels), n_channels, "Computing")
            channels.append(
                ChannelOverview(
                    file=path.name,
                    number=channel.number,
                    title=channel.title,
                    place=channel.place,
                    inputs=channel.inputs,
                    extremes=extremes_of(samples),
                    peak=float(np.abs(samples).max(initial=0.0)),
                    rms=float(np.sqrt(np.mean(samples**2))),
                    clipped=int(count),
                )
            )
    first = ready.files[0][1]
    return Overview(
        channels=tuple(channels),
        marks=ready.marks,
        n_bytes=ready.n_bytes,
        rate_hz=first.stimulus.sample_rate_hz,
        duration_s=first.stimulus.duration_s,
        full_scale=first.full_scale,
        unit=first.stimulus.unit,
        edges=edges_of(ready),
        loses=loses_of(ready),
        calibration=calibration_of(ready),
        equalised=equalised_of(ready),
        objections=tuple(filter(None, (advice_on_loss(ready), *objections(ready, limits)))),
    )


def extremes_of(samples: Floats, columns: int = COLUMNS) -> Floats:
    """Least and largest of each of ``columns`` stretches, (2, columns); fewer of short signals."""
    n = samples.size
    edges = np.arange(min(columns, n)) * n // min(columns, n)
    return np.stack((np.minimum.reduceat(samples, edges), np.maximum.reduceat(samples, edges)))
