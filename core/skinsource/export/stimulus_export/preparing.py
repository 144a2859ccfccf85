"""Prepares a stimulus for files: from a design to samples, losses, objections and an overview.

Samples are in parts of full scale; each file has one stimulus.  The sentences about an export are
the same on the export page, in a terminal and in the sidecars.
"""

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

# Losses are reported up to the stop band of `skinsource.resample`.
_MOST_DB = 140.0


def with_losses(drives: Stimulus, own: Stimulus, options: StimulusOptions, stop: Stop) -> Stimulus:
    """Return ``drives`` with the energy that each channel loses to its rate, in dB.

    The loss is the energy of the exported part of the design over the energy that the filter
    leaves of it: what is cut off at an end of the part does not count.

    Parameters
    ----------
    drives, own
        The stimulus as written; the whole stimulus at the rate of the design, from time 0 on.
    """
    loss_db: dict[tuple[int, ...], float] = {}
    for row, channel in enumerate(own.channels):
        stop_if(stop)
        samples = own.samples[row]
        filtered = passed(samples, own.sample_rate_hz, drives.sample_rate_hz)
        ring = (filtered.size - samples.size) // 2
        both = own.with_samples(
            np.stack((np.pad(samples, ring), filtered)),
            channels=(channel, channel),
            start_s=-ring / own.sample_rate_hz,
        )
        loss_db[channel.inputs] = _loss_db(_exported_part(both, own.duration_s, options).samples)
    # A stage may have added channels, or left some out.
    channels = tuple(
        replace(channel, loss_db=loss_db.get(channel.inputs, 0.0)) for channel in drives.channels
    )
    return replace(drives, channels=channels)


def _exported_part(stimulus: Stimulus, end_s: float, options: StimulusOptions) -> Stimulus:
    """Return the part that is exported, with its fades; a whole stimulus keeps its ringing."""
    fades_s = options.fade_in_s, options.fade_out_s
    if (options.from_s, options.to_s, *fades_s) == (None, None, 0.0, 0.0):
        return stimulus
    from_s = options.from_s or 0.0
    to_s = end_s if options.to_s is None else options.to_s
    # The shortest part may lie between two samples of the design.
    part = part_of_time(stimulus, from_s, max(to_s, from_s + 1.0 / stimulus.sample_rate_hz))
    return faded(part, *(min(one_s, part.duration_s) for one_s in fades_s))


def _loss_db(samples: Floats) -> float:
    """Return the energy of the first over that of the second row, 0 dB or more."""
    before, after = np.sum(samples**2, axis=1)
    if after >= before:
        return 0.0
    return float(min(10.0 * np.log10(before / after), _MOST_DB)) if after else _MOST_DB


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PreparedStimulus:
    """The content of all files of an export.

    Attributes
    ----------
    format
        Format of the files.
    gain
        The one factor between the drives and the samples.
    drives
        All channels before that factor, in the unit of the drive, as limits need them.
    files
        Path and content of each file.
    marks
        Text before the ending in the name of each file, see `options.marked`.
    cut
        Ends at which a part of the design was cut out.
    actuation, rig, equaliser
        Actuators and wiring that it is made for, and the filter that makes volts; None: not known.
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
        """Estimated bytes of all files together."""
        return sum(
            self.format.bytes_of(
                len(outgoing.stimulus.channels), outgoing.stimulus.n_times, outgoing.choices
            )
            + self.format.response_bytes(outgoing.design)
            for _, outgoing in self.files
        )

    @property
    def clipped(self) -> int:
        """Samples beyond full scale, if that is the limit of a device."""
        if not self.format.to_device:
            return 0
        return sum(int(clipped_samples(outgoing.stimulus).sum()) for _, outgoing in self.files)


def clipped_samples(stimulus: Stimulus) -> np.ndarray:
    """Return the number of samples beyond full scale in each channel, (n_channels,)."""
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
    """Prepare the files of a design.

    Parameters
    ----------
    design, path, format, options
        The design, its file or folder, the format, and the options.
    rate_hz
        Rate of the files; None, or a format with a fixed rate: the usual one of the format.
    stages, actuation
        Processing at that rate; the actuators where no rig names them, None: those that the
        design is predicted through.
    rig, equaliser
        The wiring of the channels; the filter that makes volts of accelerations: with a rig, full
        scale is then that of each channel, not the largest sample.
    progress, stop
        Called with the number of channels that have that rate; as those of a job.

    Raises
    ------
    InvalidInputError
        Nothing is audible, the format does not hold that many channels, or an option is not
        possible.
    """
    choices = format.chosen(options.choices)
    own_rate = format.fixed_rate or rate_hz is None
    rate_hz = format.rate_hz if own_rate else rate_hz
    cut, lead_in_s = cut_ends(options), 0.0
    if not cut and options.fade_in_s == 0.0:
        # Ringing before time 0 is kept where nothing is cut off or faded in.
        lead_in_s, options = options.lead_in_s, replace(options, lead_in_s=0.0)
    played = _played_stimulus(design, rate_hz, options, stages, lead_in_s, progress, stop)
    stop_if(stop)
    actuation = design.actuated if actuation is None else actuation
    drives = _cut_and_faded(_for_rig(played, rig, equaliser, options, actuation), options)
    if drives.sample_rate_hz != drives.own_rate_hz:
        own = _played_stimulus(design, None, options, (), 0.0, silent, stop)
        drives = with_losses(drives, own, options, stop)
    if drives.unit == FULL_SCALE_UNIT:
        gain = 1.0
    elif options.full_scale is None:
        gain = full_scale_factor(drives)
    else:
        gain = 1.0 / options.full_scale
    by_mark = stimuli_by_mark(drives, gain, format, options)
    paths = [marked(path, format, mark) for mark in by_mark]
    files = tuple(
        (path, _outgoing(stimulus, design, path.name, format, choices, options, gain, rig))
        for path, stimulus in zip(paths, by_mark.values(), strict=True)
    )
    return PreparedStimulus(
        format=format,
        gain=gain,
        drives=drives,
        files=files,
        marks=tuple(by_mark),
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
    progress: Progress,
    stop: Stop,
) -> Stimulus:
    """Return the stimulus of the chosen inputs and clips of a design."""
    stimulus = stimulus_of(
        design,
        rate_hz,
        per="input" if options.one_file_per_input else options.per,
        inputs=options.inputs,
        clips=options.clips,
        stages=stages,
        lead_in_s=lead_in_s,
        progress=progress,
        stop=stop,
    )
    if not stimulus.channels:
        raise InvalidInputError(
            "Nothing is heard: there is no channel to export. Unmute an input, or choose others."
        )
    return stimulus


def _for_rig(
    stimulus: Stimulus,
    rig: Rig | None,
    equaliser: Equaliser | None,
    options: StimulusOptions,
    actuation: Actuation | None,
) -> Stimulus:
    """Return the drives of the channels of ``rig``, or of the actuators where there is no rig."""
    if rig is not None:
        if equaliser is not None and options.full_scale is not None:
            raise InvalidInputError(
                f"full_scale is {options.full_scale:g}, and with an equaliser the rig says it. "
                "Leave one of them out."
            )
        return for_rig(stimulus, rig, equaliser, scaled=options.full_scale is not None)
    if equaliser is None:
        return stimulus
    if actuation is None:
        raise InvalidInputError(
            "An equaliser needs to know what is at each place: choose a rig, or let the design be "
            "predicted through an actuator."
        )
    return through_actuators(stimulus, actuation, equaliser)


def _cut_and_faded(stimulus: Stimulus, options: StimulusOptions) -> Stimulus:
    if options.from_s is not None or options.to_s is not None:
        to_s = stimulus.duration_s if options.to_s is None else options.to_s
        stimulus = part_of_time(stimulus, options.from_s or 0.0, to_s)
    return with_lead_in(faded(stimulus, options.fade_in_s, options.fade_out_s), options.lead_in_s)


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
    """Return the design with those inputs and clips that are in ``stimulus``."""
    ids = {id for channel in stimulus.channels for id in channel.inputs}
    inputs = [track for track in audible_inputs(design.inputs) if track.id in ids]
    if options.clips is not None:
        chosen = set(options.clips)
        inputs = [
            replace(track, clips=tuple(clip for clip in track.clips if clip.id in chosen))
            for track in inputs
        ]
    return replace(design, inputs=tuple(inputs))


def digest_of(design: Design) -> str:
    """Return the SHA-256 of a design in hexadecimal; recordings are represented by theirs."""
    return hashlib.sha256(dumped(without_samples(models.encode(design))[0])).hexdigest()


#: Energy that a channel may lose to the rate without confirmation, in dB: about the smallest
#: difference in strength that people perceive.
MOST_LOSS_DB = 1.0
#: Smaller losses are not reported: ten times the error of `skinsource.resample` in its pass band.
LEAST_LOSS_DB = 0.01
# Names of samples that were not equalised, by the unit of the drive.
_RAW = {
    "m/s²": "raw accelerations",
    "V": "volts of the design",
    FULL_SCALE_UNIT: "volts of the design",
}


def edges_of(ready: PreparedStimulus) -> str:
    """Return sentences on channels that begin or end hard; "": none does."""
    return edges_text([outgoing.stimulus for _, outgoing in ready.files], ready.cut)


def loses_of(ready: PreparedStimulus, only: Outgoing | None = None) -> str:
    """Return sentences on the part of the drive that is not in the files; "": all is.

    ``only``: one file instead of all.
    """
    files = [outgoing for _, outgoing in ready.files] if only is None else [only]
    return " ".join(filter(None, (ready.format.loses(files[0].choices), lost_at_rate(files))))


def lost_at_rate(files: Sequence[Outgoing]) -> str:
    """Return a sentence on the energy that channels lose to their rate; "": none does."""
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
    """Return advice where a channel loses more than `MOST_LOSS_DB` to the rate; "": none does."""
    if max(channel.loss_db for channel in ready.drives.channels) <= MOST_LOSS_DB:
        return ""
    own_hz = ready.drives.own_rate_hz
    rate = "" if ready.format.fixed_rate else f"choose {own_hz:g} Hz, the rate of the design, or "
    return f"More than {MOST_LOSS_DB:g} dB is lost: {rate}lower the frequencies."


def equalised_of(ready: PreparedStimulus) -> str:
    """Return a sentence on the equaliser, and what the samples are equalised for."""
    if ready.equaliser is None:
        return f"Not equalised ({_RAW.get(ready.drives.unit, 'raw drives')})"
    through = ready.actuation if ready.rig is None else ready.rig
    title = through.title if through is not None and through.title else "the rig"
    return f"Equalised for {title} ({ready.equaliser.title.lower()})"


def calibration_of(ready: PreparedStimulus) -> str:
    """Return a sentence on whether m/s² follow from the samples."""
    return ready.files[0][1].calibration


#: Returns a sentence for each limit that the drives, in their own unit, pass.  Limits belong to a
#: rig, not to a design.
Limit = Callable[[Stimulus], Sequence[str]]


def objections(ready: PreparedStimulus, limits: Sequence[Limit] = ()) -> tuple[str, ...]:
    """Return sentences on clipping and on limits that are passed; they must be confirmed."""
    sentences = []
    if ready.clipped:
        for path, outgoing in ready.files:
            counts = clipped_samples(outgoing.stimulus)
            clipping = [
                f"channel {channel.number} ({channel.title}) {count}"
                for channel, count in zip(outgoing.stimulus.channels, counts.tolist(), strict=True)
                if count
            ]
            if clipping:
                sentences.append(
                    f"{path.name}: samples lie beyond full scale, where a device cuts them off: "
                    f"{', '.join(clipping)}."
                )
    if ready.rig is not None:
        sent = scaled(ready.drives, ready.gain)
        sentences.extend(passed_limits(sent, ready.rig))
    for limit in limits:
        sentences.extend(limit(ready.drives))
    return tuple(sentences)


#: Stretches in the picture of a channel.
COLUMNS = 600


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ChannelOverview:
    """One channel of a file.

    Attributes
    ----------
    file, number, title, place, inputs
        Name of its file; its number there; its label; place of the actuator, None without one; ids
        of the inputs that it plays.
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
    """Overview of all files of an export.

    Attributes
    ----------
    channels
        Channels of all files.
    marks
        Text before the ending in the name of each file: `written_files` needs it.
    n_bytes
        Estimated bytes of all files together.
    rate_hz, duration_s
        Of each file.
    full_scale, unit
        Drive that full scale stands for.
    edges, loses, calibration, equalised
        Sentences, see `Exported`.
    objections
        Sentences that must be confirmed, or accepted.
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
        """Number of files."""
        return len(self.marks)


def overview_of(
    ready: PreparedStimulus,
    limits: Sequence[Limit] = (),
    *,
    progress: Progress = silent,
    stop: Stop = never,
) -> Overview:
    """Return an overview of a prepared export; ``progress`` and ``stop`` are those of a job."""
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
    """Return minimum and maximum of ``columns`` stretches, (2, columns); fewer of short signals."""
    n = samples.size
    edges = np.arange(min(columns, n)) * n // min(columns, n)
    return np.stack((np.minimum.reduceat(samples, edges), np.maximum.reduceat(samples, edges)))
