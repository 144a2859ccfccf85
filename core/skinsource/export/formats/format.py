"""What a format of stimulus files is, and the content that it is given to write."""

from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from skinsource.actuators.actuator import Actuator
from skinsource.base.conventions import Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.design.design import Design
from skinsource.engine.stimulus import Channel, Stimulus
from skinsource.signals.quantising import KINDS, Quantised, quantised
from skinsource.specs.spec import ChoiceSpec
from skinsource.version import __version__

#: Facts of one file that its sidecar holds too.
Facts = Mapping[str, Any]
#: Chosen options of a format, by name.
Choices = Mapping[str, str]

SAMPLES = "samples"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ChannelOverview:
    """What a channel of a file holds, in parts of full scale.

    Attributes
    ----------
    channel
        Its number, place and inputs.
    extremes : (2, n_columns)
        Least and largest sample of each stretch.
    peak, rms
        Of all samples.
    clipped
        Samples that would be cut off.
    """

    channel: Channel
    extremes: Floats
    peak: float
    rms: float
    clipped: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StimulusFile:
    """The content of one file.

    Attributes
    ----------
    mark
        Text before the ending in the name of the file.
    name
        Name of the file, without its folder.
    stimulus
        Samples in parts of full scale, (n_channels, n_times).
    sent
        What a device makes of them, see `StimulusFormat.sent`.
    channels
        Overviews of what is sent.
    full_scale
        Drive that a sample of 1 stands for, in the unit of the stimulus.
    design
        The design with those inputs and clips that take part.
    digest
        SHA-256 of the whole design.
    choices
        Options of the format, all of them.
    calibration
        Sentence on whether m/s² follow from the samples.
    dither_seed
        Seed of the dither of whole numbers; None: no dither.
    progress, stop
        As those of a job.
    """

    mark: str
    name: str
    stimulus: Stimulus
    sent: Stimulus
    channels: tuple[ChannelOverview, ...]
    full_scale: float
    design: Design
    digest: str
    choices: Choices
    calibration: str
    dither_seed: int | None = None
    progress: Progress = silent
    stop: Stop = never

    @property
    def rate_hz(self) -> int | float:
        """Values a second, as a whole number where it is one."""
        rate_hz = self.sent.sample_rate_hz
        return int(rate_hz) if rate_hz.is_integer() else rate_hz

    @property
    def channel_names(self) -> list[str]:
        """A name for each channel, of letters, digits and underscores: ``place_7``.

        Where several channels have one place, the input is named too; a channel that drives no
        actuator has its number.
        """
        counts = Counter(channel.place for channel in self.stimulus.channels)
        return [
            f"{channel.title.lower()}_{channel.number}"
            if channel.place is None
            else f"place_{channel.place}"
            if counts[channel.place] == 1
            else f"place_{channel.place}_input_{'_'.join(map(str, channel.inputs))}"
            for channel in self.stimulus.channels
        ]

    @property
    def about(self) -> dict[str, Any]:
        """Title, unit, full scale and more facts; the sidecar holds all, arrays hold these."""
        stimulus = self.stimulus
        return {
            "title": self.design.title,
            "channels": [channel.title for channel in stimulus.channels],
            "places": [channel.place for channel in stimulus.channels],
            "unit": stimulus.unit,
            "full_scale": self.full_scale,
            "rate_hz": self.rate_hz,
            "start_s": self.sent.start_s,
            "scaling": stimulus.scaling,
            "limb": stimulus.limb,
            "calibration": self.calibration,
            "software": f"SkinSource studio {__version__}",
            "design_digest": self.digest,
        }

    def integers(self, kind: str) -> tuple[Quantised, Facts]:
        """Return the samples as whole numbers, and the facts about them for the sidecar."""
        result = quantised(self.stimulus.samples, kind, dither_seed=self.dither_seed)
        return result, {
            "samples": kind,
            "integer_zero": result.kind.zero,
            "integer_full_scale": result.full_scale,
            "clipped_samples": [int(count) for count in result.clipped],
            "largest_rounding_error": result.largest_error,
            "dither_seed": self.dither_seed,
        }

    def blocks(self, n_times: int) -> Iterator[slice]:
        """Yield consecutive stretches of times; tell the progress after each, and heed ``stop``."""
        for start in range(0, self.stimulus.n_times, n_times):
            stop_if(self.stop)
            end = min(start + n_times, self.stimulus.n_times)
            yield slice(start, end)
            self.progress(end, self.stimulus.n_times, "Writing")


class StimulusFormat(ABC):
    """One kind of file that a stimulus is exported as.

    Attributes
    ----------
    name, title, suffix
        Name for scripts, name for people, and usual ending of files (of a folder: none).
    hint
        Sentence on its use.
    rate_hz
        Usual rate; None: that of the limb.
    fixed_rate
        Whether it has no other rate: a rate that is given is then ignored.
    choices
        Options by name; the first value of each is the usual one.
    most_channels
        Largest number of channels; None: any number.
    one_channel_each
        Whether each channel has a file of its own: the first one PATH, the others a number more.
    folder
        Whether it is a folder.
    to_device
        Whether full scale is the limit of a device, so that larger samples would be cut off.
    plays_waveform
        Whether the device plays the samples, not only how strong they are.
    numbers
        What its numbers are called where the sidecar says what they mean.
    driven
        The kind of actuator that the device drives, in a sentence; "": any.
    device_v, device_steps, device
        Volts of the device at full scale, steps up to it, and where it has that; 0: not known.
    """

    name: str
    title: str
    suffix: str
    hint: str
    rate_hz: int | None = 48_000
    fixed_rate: bool = False
    choices: ClassVar[Mapping[str, ChoiceSpec]] = {}
    most_channels: int | None = None
    one_channel_each: bool = False
    folder: bool = False
    to_device: bool = True
    plays_waveform: bool = True
    numbers: str = "samples"
    driven: str = ""
    device_v, device_steps, device = 0.0, 0, ""

    @abstractmethod
    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write a file, or fill an existing folder; return facts for the sidecar."""

    @abstractmethod
    def n_bytes(self, n_channels: int, n_times: int, choices: Choices) -> int:
        """Return about how many bytes ``n_channels`` of ``n_times`` take."""

    def response_bytes(self, design: Design) -> int:
        """Return how many bytes the predicted response takes, where that is written too."""
        return 0

    def sent(self, stimulus: Stimulus, choices: Choices) -> Stimulus:
        """Return what the device is told: the samples, or amplitudes at their own rate."""
        return stimulus

    def drives(self, model: Actuator) -> bool:
        """Return whether the device drives an actuator."""
        return True

    def misfit(self, actuator: str, model: Actuator | None, *, equalised: bool) -> str:
        """Return sentences where it does not drive an actuator, or not with an equaliser; or ""."""
        chip = self.title.partition(",")[0]
        if equalised and not self.plays_waveform:
            reason, cure = "sends only the amplitude, which no equaliser can shape", "no equaliser"
        elif model is None or self.drives(model):
            return ""
        else:
            reason, cure = f"drives {self.driven}, not {quoted(actuator)}", "another actuator"
        return f"{chip} {reason}. Choose {cure}, or WAV."

    def scale_text(self, full_scale_v: float) -> str:
        """Return what full scale is in a file and of the device, and what the difference does."""
        text = f"Full scale is {full_scale_v:.3g} V here, {self.device_v:g} V {self.device}"
        times = self.device_v / full_scale_v
        level_db = round(float(decibels(times)), 1)
        if not level_db:
            return text
        more, way = (times, "strong") if times > 1.0 else (1.0 / times, "weak")
        there = f"{float(f'{more:.3g}'):g} times ({abs(level_db):.1f} dB) too {way}"
        return f"{text}: the drive is {there} there"

    def rounds(self, choices: Choices) -> bool:
        """Return whether whole numbers are written, so that dither is possible."""
        return False

    def steps(self, choices: Choices) -> int:
        """Return the steps up to full scale; 0: so many that none is missed."""
        kind = KINDS.get(choices.get(SAMPLES, ""))
        return self.device_steps if kind is None else kind.most

    def loses(self, choices: Choices) -> str:
        """Return a sentence on the part of the drive that is not in the file; "": all is."""
        return ""

    def companion_path(self, path: Path) -> Path | None:
        """Return the path of a small file that belongs to it besides the sidecar; None: none."""
        return None

    def companion_content(self, facts: Facts) -> bytes:
        """Return the content of that file."""
        return b""

    def file_rate_hz(self, rate_hz: int | None) -> int | None:
        """Return the rate of files where ``rate_hz`` is asked for; None: that of the limb."""
        return self.rate_hz if self.fixed_rate or rate_hz is None else rate_hz

    def marked(self, path: Path, mark: str) -> Path:
        """Return ``path`` with ``mark`` before its ending."""
        suffix = self.suffix if path.name.endswith(self.suffix) else path.suffix
        return path.with_name(f"{path.name[: len(path.name) - len(suffix)]}{mark}{suffix}")

    def chosen(self, choices: Choices) -> dict[str, str]:
        """Return ``choices``, completed by the usual ones.

        Raises
        ------
        InvalidInputError
            The format does not offer that.
        """
        for name, value in choices.items():
            spec = self.choices.get(name)
            if spec is None:
                offered = ", ".join(self.choices) or "nothing"
                raise InvalidInputError(
                    f"{name} {quoted(value)} is not a choice of the format {self.name}; choose one "
                    f"of {offered}"
                )
            known = dict(spec.options)
            if value not in known:
                raise InvalidInputError(
                    f"{name} is {quoted(value)}, expected for the format {self.name} one of "
                    f"{', '.join(known)}"
                )
        usual = {name: spec.options[0][0] for name, spec in self.choices.items()}
        return {**usual, **choices}
