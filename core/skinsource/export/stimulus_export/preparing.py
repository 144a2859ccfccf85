"""Prepares a stimulus for files: from a design to samples, losses and objections.

Samples are in parts of full scale; each file has one stimulus.  The sentences about an export are
the same on the export page, in a terminal and in the sidecars.
"""

import hashlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import scipy

from skinsource.actuators.actuation import Actuation, Model
from skinsource.actuators.equalising import Equaliser, RegularisedInverse, followed_band
from skinsource.actuators.rigs import Rig, calibration_words, known_model, rig_breaches
from skinsource.base.conventions import Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, counted, lowered
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.base.json_text import dumped
from skinsource.design.amplitudes import equaliser_of
from skinsource.design.design import Design, audible_inputs
from skinsource.engine.stimulus import (
    FULL_SCALE_UNIT,
    Stage,
    Stimulus,
    faded,
    for_rig,
    full_scale_factor,
    in_order,
    part_of_time,
    peaks,
    scaled,
    stimuli_of,
    through_actuators,
    with_silence,
    with_sync,
)
from skinsource.export.formats.format import ChannelOverview, StimulusFile, StimulusFormat
from skinsource.export.stimulus_export.options import Nothing, StimulusOptions
from skinsource.signals.resampling import half_transition, passed
from skinsource.specs import models
from skinsource.specs.codec import without_samples

#: An end of a stimulus.
Ends = Literal["begin", "end"]
#: Returns a sentence for each limit that the drives, in their own unit, pass.  Limits belong to a
#: rig, not to a design.
Limit = Callable[[Stimulus], Sequence[str]]

#: A larger first or last sample, in parts of the peak of its channel, is reported.
LARGEST_EDGE = 0.01
#: A channel of less, in parts of the largest drive, is silent in a part of the time: 120 dB, more
#: than any converter has between its full scale and its noise.
LEAST_PART = 1e-6
#: Ringing before and after a sound where the rate is changed lasts so long; see `resample`.
RINGING_S = 0.1
#: Energy that a channel may lose to the rate without confirmation, in dB: about the smallest
#: difference in strength that people perceive.
MOST_LOSS_DB = 1.0
#: Smaller losses are not reported: ten times the error of `skinsource.resample` in its pass band.
LEAST_LOSS_DB = 0.01
#: Smaller losses to the equaliser are not reported.
LEAST_WEAKENED_DB = 1.0
#: A drive of fewer steps is lost in rounding.
LEAST_STEPS = 16
# Third octaves count within so many dB of the strongest, and of the stronger neighbour.
_WITHIN_DB, _FLANK_DB = 20.0, 6.0
# More is lost where an equaliser lets nothing through; how much more, rounding decides.
_NOTHING_LEFT_DB = 60.0
# Losses are reported up to the stop band of `skinsource.resample`.
_LARGEST_LOSS_DB = 140.0
# Names of samples that were not equalised, by the unit of the drive.
_RAW = {
    "m/s²": "raw accelerations",
    "V": "volts of the design",
    FULL_SCALE_UNIT: "volts of the design",
}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PreparedStimulus:
    """The content of all files of an export, for any path.

    Attributes
    ----------
    format
        Format of the files.
    design
        The design with those inputs and clips that take part.
    gain
        The one factor between the drives and the samples.
    drives
        All channels before that factor, in the unit of the drive, as limits need them.
    files
        Content of each file.
    n_bytes
        Estimated bytes of all files together.
    limits_passed
        Sentences on limits that the drives pass.
    cut
        Ends at which a part of the design was cut out.
    lead_in_s, tail_s
        Silence before and after the stimulus.
    actuation, rig, equaliser
        Actuators and wiring that it is made for, and the filter that makes volts; None: not known.
    weakened
        A sentence on what the equaliser takes from the drive; "": less than 1 dB.
    misfit
        Sentences on an actuator that the device does not drive; "": none is known.
    people
        Whether sidecars have the range between people.
    """

    format: StimulusFormat
    design: Design
    gain: float
    drives: Stimulus
    files: tuple[StimulusFile, ...]
    n_bytes: int
    limits_passed: tuple[str, ...] = ()
    cut: tuple[Ends, ...] = ()
    lead_in_s: float = 0.0
    tail_s: float = 0.0
    actuation: Actuation | None = None
    rig: Rig | None = None
    equaliser: Equaliser | None = None
    weakened: str = ""
    misfit: str = ""
    people: bool = False

    def named(self, path: Path) -> "PreparedStimulus":
        """Return it with the names that files have in an export to ``path``."""
        files = (
            replace(file, name=self.format.marked(path, file.mark).name) for file in self.files
        )
        return replace(self, files=tuple(files))

    @property
    def channels(self) -> tuple[ChannelOverview, ...]:
        """Channels of all files."""
        return tuple(channel for file in self.files for channel in file.channels)

    @property
    def peak(self) -> float:
        """Largest drive, in its unit."""
        return float(np.abs(self.drives.samples).max(initial=0.0))

    @property
    def edges(self) -> str:
        """Sentences on channels whose first or last sample is above 1 % of their peak."""
        sentences: list[str] = []
        if not self.format.plays_waveform:
            return ""
        first = self.files[0].stimulus
        resampled = first.sample_rate_hz != first.own_rate_hz
        if text := self._hard_channels(0, "begin"):
            if "begin" in self.cut:
                text += ": what lies before that part is cut off. A fade-in softens it."
            elif resampled and first.start_s >= 0.0:
                text += (
                    f": what lies before time 0 is cut off. A lead-in of {RINGING_S:g} s keeps it."
                )
            elif resampled:
                text += ": what rings before is cut off. A longer lead-in keeps it."
            else:
                text += ". A lead-in puts silence before it."
            sentences.append(text)
        if text := self._hard_channels(-1, "end"):
            if "end" in self.cut:
                text += ": what follows is cut off. A fade-out softens it."
            elif resampled:
                text += f": what follows is cut off. A tail of {RINGING_S:g} s keeps it."
            else:
                text += ". A fade-out softens it."
            sentences.append(text)
        return " ".join(sentences)

    def _hard_channels(self, sample: int, verb: Ends) -> str:
        """Return which channels begin or end hard, and how hard, without a full stop."""
        hard = [
            (overview.channel.number, abs(float(samples[sample])) / overview.peak)
            for file in self.files
            for overview, samples in zip(file.channels, file.stimulus.samples, strict=True)
            if overview.channel.place is not None
            and abs(samples[sample]) > LARGEST_EDGE * overview.peak
        ]
        if not hard:
            return ""
        percent = 100.0 * max(share for _, share in hard)
        shown = f"{percent:.0f}" if percent >= 9.95 else f"{percent:.1f}"
        if len(hard) == 1:
            return f"Channel {hard[0][0]} {verb}s at {shown} % of its peak"
        return f"{len(hard)} channels {verb} at up to {shown} % of their peaks"

    @property
    def lost_at_rate(self) -> str:
        """A sentence on the energy that channels lose to their rate; "": none does."""
        losing = [
            f"channel {channel.number} ({channel.title}) loses {channel.loss_db:.2g} dB of its "
            "energy" + (f" in {file.name}" if len(self.files) > 1 else "")
            for file in self.files
            for channel in file.stimulus.channels
            if channel.loss_db >= LEAST_LOSS_DB
        ]
        if not losing:
            return ""
        rate_hz, own_hz = self.drives.sample_rate_hz, self.drives.own_rate_hz
        lower_hz = min(rate_hz, own_hz)
        passed_hz = (1.0 - half_transition(lower_hz)) * 0.5 * lower_hz
        return (
            f"At {rate_hz:.10g} Hz, frequencies above {passed_hz:.0f} Hz are weakened or lost: "
            f"{', '.join(losing)}."
        )

    @property
    def loses(self) -> str:
        """Sentences on what of the drive reaches no actuator, or no file; "": all does."""
        by_format = self.format.loses(self.files[0].choices)
        lost = self.lost_at_rate, self.weakened
        return " ".join(filter(None, (self.misfit, self.misscaled, by_format, *lost)))

    @property
    def remedy_v(self) -> float:
        """Full scale of the device, where the files, in volts, have another one; else 0."""
        device_v = self._device_v
        return device_v if round(float(decibels(device_v * self.gain)), 1) else 0.0

    @property
    def _device_v(self) -> float:
        return self.format.device_v if self.drives.unit == "V" else 0.0

    @property
    def misscaled(self) -> str:
        """Sentences on a full scale that is not the device's, or leaves few or no steps; or ""."""
        most = self.format.steps(self.files[0].choices)
        sentences = [
            f"Channel {overview.channel.number} ({overview.channel.title}) is silent: its peak is "
            "below half a step. Raise its amplitude."
            for file in self.files
            for overview in file.channels
            if 0.0 < most * overview.peak <= 0.5 and file.dither_seed is None
        ]
        if volts := self.remedy_v:
            scale = self.format.scale_text(1.0 / self.gain)
            sentences.append(f"{scale}. Choose a full scale of {volts:g} V.")
        elif 0.0 < (steps := most * self.peak * self.gain) < LEAST_STEPS:
            # The full scale of a rig, or of the device, is as it is.
            fixed = self.drives.unit == FULL_SCALE_UNIT or self._device_v
            cure = "Raise" if fixed else "Choose a smaller full scale, or raise"
            largest = f"The largest sample is only {steps:.2g} of {most} steps."
            sentences.append(f"{largest} {cure} the amplitudes.")
        return " ".join(sentences)

    @property
    def advice_on_loss(self) -> str:
        """Advice where a channel loses more than `MOST_LOSS_DB` to the rate; "": none does."""
        if max(channel.loss_db for channel in self.drives.channels) <= MOST_LOSS_DB:
            return ""
        own_hz = self.drives.own_rate_hz
        rate = f"choose {own_hz:g} Hz, the rate of the design, or "
        return (
            f"More than {MOST_LOSS_DB:g} dB is lost: "
            f"{'' if self.format.fixed_rate else rate}lower the frequencies."
        )

    @property
    def equalised(self) -> str:
        """A sentence on the equaliser, and on the actuators that the samples are made for."""
        through = self.actuation if self.rig is None else self.rig
        title = "" if through is None else through.title or "the rig"
        if self.equaliser is not None:
            return f"Equalised for {title} ({self.equaliser.title.lower()})"
        raw = f"Not equalised ({_RAW.get(self.drives.unit, 'raw drives')})"
        return f"{raw}, for {title}" if title else raw

    @property
    def rate_text(self) -> str:
        """How many values a second are sent: "48 kHz"."""
        rate_hz = self.files[0].sent.sample_rate_hz
        if self.format.plays_waveform:
            return f"{rate_hz / 1000.0:.10g} kHz"
        return f"{rate_hz:g} amplitudes a second"

    @property
    def scale_text(self) -> str:
        """The drive that full scale stands for: "full scale = 1.5 m/s²"."""
        unit = self.files[0].stimulus.unit
        if unit == FULL_SCALE_UNIT:
            return "full scale = that of each channel"
        return f"full scale = {self.files[0].full_scale:.3g}{'' if unit == '1' else f' {unit}'}"

    @property
    def summary(self) -> str:
        """What is written, in a sentence: channels, rate, length, bytes, full scale, equaliser."""
        duration_s = self.files[0].sent.duration_s
        parts = [
            counted(len(self.channels), "channel"),
            "" if len(self.files) == 1 else counted(len(self.files), "file"),
            self.rate_text,
            f"{duration_s:.4g} s" if duration_s >= 1.0 else f"{1e3 * duration_s:.4g} ms",
            f"about {size_text(self.n_bytes)} of data",
            self.scale_text,
            lowered(self.equalised),
            *(
                f"{name} {length_s:.3g} s"
                for name, length_s in (("lead-in", self.lead_in_s), ("tail", self.tail_s))
                if length_s
            ),
        ]
        needed = self.equaliser is not None and self.lead_in_s == self.tail_s == RINGING_S
        why = ", as the equaliser needs" if needed else ""
        return f"{', '.join(filter(None, parts))}{why}"

    @property
    def calibration(self) -> str:
        """A sentence on whether m/s² follow from the samples."""
        if self.rig is None:
            return "uncalibrated: no rig says whether the device gives this full scale"
        places = [at.place for at in self.drives.channels if at.place is not None]
        return calibration_words(self.rig, places)

    @property
    def objections(self) -> tuple[str, ...]:
        """Sentences on clipping and on limits that are passed; they must be confirmed."""
        clipping = []
        for file in self.files:
            clipped = [
                f"channel {overview.channel.number} ({overview.channel.title}) {overview.clipped}"
                for overview in file.channels
                if overview.clipped
            ]
            if clipped:
                clipping.append(
                    f"{file.name}: samples lie beyond full scale, where a device cuts them off: "
                    f"{', '.join(clipped)}."
                )
        return (*clipping, *self.limits_passed)


def prepare_stimulus(
    design: Design,
    format: StimulusFormat,
    rate_hz: int | None,
    options: StimulusOptions,
    *,
    stages: Sequence[Stage] = (),
    limits: Sequence[Limit] = (),
    actuation: Actuation | Nothing | None = None,
    rig: Rig | Nothing | None = None,
    equaliser: Equaliser | Nothing | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> PreparedStimulus:
    """Prepare the files of a design.

    Parameters
    ----------
    design, format, options
        The design, the format, and the options.
    rate_hz
        Rate of the files; None, or a format with a fixed rate: the usual one of the format.
    stages, actuation
        Processing at that rate; the actuators where no rig names them, None: those of the design,
        ``"none"``: none.
    limits
        Limits of the drives.
    rig, equaliser
        The wiring of the channels; the filter that makes volts of accelerations: with a rig, full
        scale is then that of each channel, not the largest sample.  None: those of the design;
        ``"none"``: no wiring, or no filter.
    progress, stop
        Called with the number of channels that have that rate; as those of a job.

    Raises
    ------
    InvalidInputError
        Nothing is audible, the format does not hold that many channels, or an option is not
        possible.
    """
    choices = format.chosen(options.choices)
    rig, at_places = wiring_of(design, rig, actuation)
    equaliser = equaliser_of(design) if equaliser is None else equaliser
    equaliser = None if equaliser == "none" else equaliser
    # Without ``from_s`` a part that is cut out begins at time 0.
    cut: tuple[Ends, ...] = () if options.from_s is None else ("begin",)
    if options.to_s is not None:
        cut = ("begin", "end")
    # Ringing before time 0, and after the end, is kept where nothing is cut off or faded.
    rings_before = not cut and options.fade_in_s == 0.0
    rings_after = options.to_s is None and options.fade_out_s == 0.0
    needed_s = 0.0 if equaliser is None else RINGING_S
    lead_in_s, tail_s = options.lead_in_s, options.tail_s
    if lead_in_s is None:
        lead_in_s = needed_s if rings_before else 0.0
    if tail_s is None:
        tail_s = needed_s if rings_after else 0.0
    own, drives = stimuli_of(
        design,
        format.file_rate_hz(rate_hz),
        per="input" if options.one_file_per_input else options.per,
        inputs=options.inputs,
        clips=options.clips,
        lead_in_s=lead_in_s if rings_before else 0.0,
        tail_s=tail_s if rings_after else 0.0,
        progress=progress,
        stop=stop,
    )
    if not drives.channels:
        raise InvalidInputError(
            "No input is active: there is no channel to export. Unmute an input, or choose others."
        )
    for stage in stages:
        stop_if(stop)
        drives = stage(drives)
    stop_if(stop)
    misfit, equalised = "", equaliser is not None
    for place in filter(None, (channel.place for channel in drives.channels)):
        misfit = misfit or format.misfit(*actuator_at(place, rig, at_places), equalised=equalised)
    if misfit and equalised:
        raise InvalidInputError(misfit)
    wanted = _exported_part(drives, drives.duration_s, options)
    drives = _for_rig(drives, rig, equaliser, options, at_places, stop)
    if options.from_s is not None or options.to_s is not None:
        to_s = drives.duration_s if options.to_s is None else options.to_s
        least = LEAST_PART * peaks(drives.samples).max(initial=0.0)
        drives = part_of_time(drives, options.from_s or 0.0, to_s)
        # What the equaliser leaves of clips outside the part is no stimulus.
        drives = drives.with_samples(
            np.where(peaks(drives.samples)[:, np.newaxis] < least, 0.0, drives.samples)
        )
    drives = faded(drives, options.fade_in_s, options.fade_out_s)
    drives = with_silence(
        drives, 0.0 if rings_before else lead_in_s, 0.0 if rings_after else tail_s
    )
    if drives.sample_rate_hz != drives.own_rate_hz:
        drives = with_losses(drives, own, options, stop)
    if drives.unit == FULL_SCALE_UNIT:
        gain = 1.0
    elif options.full_scale is None:
        gain = full_scale_factor(drives)
    else:
        gain = 1.0 / options.full_scale
    digest = digest_of(design)
    files = []
    for mark, stimulus in _stimuli_of_files(drives, gain, format, options):
        _check_channels(stimulus, format)
        sent = format.sent(stimulus, choices)
        places = [channel.place for channel in stimulus.channels if channel.place is not None]
        files.append(
            StimulusFile(
                mark=mark,
                name=format.marked(Path(f"stimulus{format.suffix}"), mark).name,
                stimulus=stimulus,
                sent=sent,
                channels=_overviews(stimulus, sent, stop, to_device=format.to_device),
                full_scale=1.0 / gain,
                design=_exported_design(design, stimulus, options),
                digest=digest,
                choices=choices,
                calibration=calibration_words(rig, places),
                dither_seed=options.dither_seed,
            )
        )
    return PreparedStimulus(
        format=format,
        design=_exported_design(design, drives, options),
        gain=gain,
        drives=drives,
        files=tuple(files),
        n_bytes=sum(
            format.n_bytes(len(file.channels), file.stimulus.n_times, choices)
            + format.response_bytes(file.design)
            for file in files
        ),
        limits_passed=(
            *_passed_limits(drives, gain, rig),
            *(text for limit in limits for text in limit(drives)),
        ),
        cut=cut,
        lead_in_s=lead_in_s,
        tail_s=tail_s,
        actuation=at_places,
        rig=rig,
        equaliser=equaliser,
        weakened="" if equaliser is None else weakened_by(equaliser, wanted, rig, at_places, stop),
        misfit=misfit,
        people=options.people,
    )


def wiring_of(
    design: Design,
    rig: Rig | Nothing | None,
    actuation: Actuation | Nothing | None,
) -> tuple[Rig | None, Actuation | None]:
    """Return rig and actuators: those of the design where no others are asked for."""
    if rig is None and actuation is None:
        rig = design.rig
    actuation = design.actuation if actuation is None else actuation
    return None if rig == "none" else rig, None if actuation == "none" else actuation


def actuator_at(
    place: int, rig: Rig | None, actuation: Actuation | None
) -> tuple[str, Model | None]:
    """Return name and model of the actuator at a place, as a rig or else ``actuation`` says.

    The name is "" where it is not known, the model None.
    """
    if rig is not None:
        channel = rig.channel_of(place)
        return ("", None) if channel is None else (channel.actuator, known_model(channel))
    with suppress(InvalidInputError):
        if actuation is not None:
            actuator = actuation.at(place)
            return actuator.actuator or actuator.model.title, actuator.model
    return "", None


def _for_rig(
    stimulus: Stimulus,
    rig: Rig | None,
    equaliser: Equaliser | None,
    options: StimulusOptions,
    actuation: Actuation | None,
    stop: Stop,
) -> Stimulus:
    """Return the drives of the channels of ``rig``, or of the actuators where there is no rig."""
    if rig is not None:
        if equaliser is not None and options.full_scale is not None:
            raise InvalidInputError(
                f"full_scale is {options.full_scale:g}, but with an equaliser the rig sets it. "
                "Remove one of them."
            )
        scaled = options.full_scale is not None
        return for_rig(stimulus, rig, equaliser, scaled=scaled, stop=stop)
    if equaliser is None:
        return stimulus
    if actuation is None:
        raise InvalidInputError(
            "An equaliser needs the actuator at each place. Choose a rig, or an actuator for the "
            "design."
        )
    return through_actuators(stimulus, actuation, equaliser, stop)


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


def weakened_by(
    equaliser: Equaliser,
    wanted: Stimulus,
    rig: Rig | None,
    actuation: Actuation | None,
    stop: Stop,
) -> str:
    """Return where the wanted accelerations are weakened most; "": nowhere much.

    Compared is the energy in third octaves, before and after equaliser and actuator.
    """
    rate_hz = wanted.sample_rate_hz
    band_hz = followed_band(wanted.limb_band_hz, min(rate_hz, wanted.own_rate_hz))
    # Of a short stimulus, too, there are frequencies in each band.
    length = scipy.fft.next_fast_len(max(wanted.n_times, int(rate_hz)), real=True)
    frequency_hz = scipy.fft.rfftfreq(length, 1.0 / rate_hz)
    held = slice(1, int(np.searchsorted(frequency_hz, 0.5 * wanted.own_rate_hz)))
    frequency_hz = frequency_hz[held]
    band = np.rint(10.0 * np.log10(frequency_hz) + 10.0).clip(0.0).astype(int)
    losses = []
    for row in wanted.driving:
        stop_if(stop)
        place = wanted.channels[row].place or 0
        model: Any = actuator_at(place, rig, actuation)[1]
        gain = model.response(frequency_hz) * equaliser.filter(model, frequency_hz, band_hz)
        energy = np.abs(scipy.fft.rfft(wanted.samples[row], length)[held]) ** 2
        before = np.bincount(band, energy)
        after = np.bincount(band, energy * np.abs(gain) ** 2)
        level_db = decibels(np.sqrt(before))
        neighbours_db = scipy.ndimage.maximum_filter1d(level_db, 3)
        dominant = np.maximum(neighbours_db - _FLANK_DB, level_db.max() - _WITHIN_DB) <= level_db
        attenuation_db = np.where(dominant, level_db - decibels(np.sqrt(after)), 0.0)
        weighted_hz = np.bincount(band, energy * frequency_hz)
        losses += [
            (float(attenuation_db[at]), place, weighted_hz[at] / before[at])
            for at in np.flatnonzero(attenuation_db >= LEAST_WEAKENED_DB)
        ]
    if not losses:
        return ""
    limit = "the resonance of the actuator"
    if isinstance(equaliser, RegularisedInverse):
        limit = f"{equaliser.boost_db:g} dB, from {band_hz[0]:.4g} to {band_hz[1]:.4g} Hz"
    left = [each for each in losses if each[0] < _NOTHING_LEFT_DB]
    told = []
    if left:
        loss, place, middle_hz = max(left)
        told.append(
            f"the skin loses most at place {place}, at {middle_hz:.0f} Hz, where it gets "
            f"{loss:.1f} dB less"
        )
    if len(left) < len(losses):
        _, place, middle_hz = max(losses)
        told.append(f"next to nothing is left of what place {place} has at {middle_hz:.0f} Hz")
    return f"The equaliser is limited to {limit}: {'; '.join(told)}."


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
    loss_db = 10.0 * np.log10(before / after) if after else np.inf
    return float(min(loss_db, _LARGEST_LOSS_DB))


def _stimuli_of_files(
    drives: Stimulus, gain: float, format: StimulusFormat, options: StimulusOptions
) -> Iterator[tuple[str, Stimulus]]:
    """Yield the stimulus of each file with the mark in its name, scaled by ``gain``."""
    by_mark = {"": drives}
    if options.one_file_per_input:
        by_mark = {
            f"_input-{channel.inputs[0]}": _single_channel(drives, row)
            for row, channel in enumerate(drives.channels)
        }
    for mark, part in by_mark.items():
        stimulus = scaled(part, gain)
        if options.sync:
            # Samples before it are the lead-in.
            stimulus = with_sync(stimulus, at_s=options.from_s or 0.0)
        if options.channel_map:
            stimulus = in_order(stimulus, options.channel_map)
        if not format.one_channel_each:
            yield mark, stimulus
            continue
        for row in range(len(stimulus.channels)):
            # The first channel has no mark.
            own_mark = f"_channel-{row + 1}" if row else ""
            yield f"{mark}{own_mark}", _single_channel(stimulus, row)


def _single_channel(stimulus: Stimulus, row: int) -> Stimulus:
    """Return one channel of ``stimulus``, as the first of a file."""
    channel = replace(stimulus.channels[row], number=1)
    return stimulus.with_samples(stimulus.samples[row : row + 1], channels=(channel,))


def _check_channels(stimulus: Stimulus, format: StimulusFormat) -> None:
    n = len(stimulus.channels)
    if format.most_channels is not None and n > format.most_channels:
        raise InvalidInputError(
            f"The format {format.name} holds at most "
            f"{counted(format.most_channels, 'channel')}, found {n}. Choose WAV, fewer "
            "inputs, or one file per input."
        )


#: Stretches in the picture of a channel.
COLUMNS = 600


def _overviews(
    stimulus: Stimulus, sent: Stimulus, stop: Stop, *, to_device: bool
) -> tuple[ChannelOverview, ...]:
    overviews = []
    n = sent.n_times
    edges = np.arange(min(COLUMNS, n)) * n // min(COLUMNS, n)
    for channel, samples, row in zip(
        stimulus.channels, stimulus.samples, sent.samples, strict=True
    ):
        stop_if(stop)
        extremes = np.stack((np.minimum.reduceat(row, edges), np.maximum.reduceat(row, edges)))
        overviews.append(
            ChannelOverview(
                channel=channel,
                extremes=extremes,
                peak=float(np.abs(extremes).max()),
                rms=float(np.sqrt(np.mean(row**2))),
                clipped=int(np.count_nonzero(abs(samples) > 1.0)) if to_device else 0,
            )
        )
    return tuple(overviews)


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


def common_full_scale(peaks: Iterable[float]) -> float:
    """Return the full scale of several stimuli: the largest drive of all; 1 for silence."""
    # A little more, so that no sample is rounded beyond it.
    return max(peaks) * (1.0 + 2.0**-50) or 1.0


def size_text(n_bytes: int) -> str:
    """Return a number of bytes as text."""
    for factor, unit in ((1e9, "GB"), (1e6, "MB"), (1e3, "kB")):
        if n_bytes >= factor:
            return f"{n_bytes / factor:.3g} {unit}"
    return f"{n_bytes} bytes"


def _passed_limits(drives: Stimulus, gain: float, rig: Rig | None) -> list[str]:
    """Return sentences on the limits of the rig that the samples pass."""
    if rig is None:
        return []
    rows = list(drives.driving)
    places = [place for row in rows if (place := drives.channels[row].place) is not None]
    samples = scaled(drives, gain).samples[rows]
    breaches = rig_breaches(rig, places, samples, round(drives.sample_rate_hz))
    return [f"{str(breach)[:1].upper()}{str(breach)[1:]}." for breach in breaches]
