"""What a format of stimulus files is, and the stimulus that it is given to write."""

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.base.quoting import quoted
from skinsource.design.design import Design
from skinsource.engine.stimulus import Channel, Stimulus
from skinsource.signals.quantising import Quantised, quantised
from skinsource.specs.spec import ChoiceSpec
from skinsource.version import __version__

#: Facts of one file that its sidecar holds too.
Facts = Mapping[str, Any]

SAMPLES = "samples"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Outgoing:
    """A stimulus on its way to a file.

    Attributes
    ----------
    stimulus
        Samples in parts of full scale, (n_channels, n_times).
    full_scale
        Drive that a sample of 1 stands for, in the unit of the stimulus.
    design
        The design with those inputs and clips that take part.
    name
        Name of the file, without its folder.
    digest
        SHA-256 of the design.
    choices
        Options of the format, all of them.
    calibration
        Sentence on whether m/s² follow from the samples.
    dither_seed
        Seed of the dither of whole numbers; None: no dither.
    progress, stop
        As those of a job.
    """

    stimulus: Stimulus
    full_scale: float
    design: Design
    name: str
    digest: str
    choices: Mapping[str, str]
    calibration: str
    dither_seed: int | None = None
    progress: Progress = silent
    stop: Stop = never

    @property
    def rate_hz(self) -> int | float:
        """Sample rate, as a whole number where it is one."""
        rate_hz = self.stimulus.sample_rate_hz
        return int(rate_hz) if rate_hz.is_integer() else rate_hz

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


@dataclass(frozen=True, slots=True, kw_only=True)
class StimulusFormat:
    """One kind of file that a stimulus is exported as.

    Attributes
    ----------
    name, title, suffix
        Name for scripts, name for people, and usual ending of files (of a folder: none).
    hint
        Sentence on its use.
    write
        Writes a file, or fills an existing folder; returns facts for the sidecar.
    bytes_of
        Estimates the bytes that ``n_channels`` of ``n_times`` take, with such choices.
    response_bytes
        Estimates the bytes of the predicted response, where that is written too.
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
    rounds
        Whether whole numbers are written, with such choices, so that dither is possible.
    companion_path, companion_content
        Path of another small file that belongs to it besides the sidecar, None: there is none;
        and its content.
    loses
        Sentence on the part of the drive that is not in the file, for such choices; "": all is.
    """

    name: str
    title: str
    suffix: str
    hint: str
    write: Callable[[Outgoing, Path], Facts]
    bytes_of: Callable[[int, int, Mapping[str, str]], int]
    response_bytes: Callable[[Design], int] = lambda _: 0
    rate_hz: int | None = 48_000
    fixed_rate: bool = False
    choices: Mapping[str, ChoiceSpec] = field(default_factory=dict)
    most_channels: int | None = None
    one_channel_each: bool = False
    folder: bool = False
    to_device: bool = True
    rounds: Callable[[Mapping[str, str]], bool] = lambda _: False
    companion_path: Callable[[Path], Path | None] = lambda _: None
    companion_content: Callable[[Facts], bytes] = lambda _: b""
    loses: Callable[[Mapping[str, str]], str] = lambda _: ""

    def chosen(self, choices: Mapping[str, str]) -> dict[str, str]:
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
                    f"{name} {quoted(value)} cannot be chosen for the format {self.name}, which "
                    f"offers {offered}"
                )
            known = dict(spec.options)
            if value not in known:
                raise InvalidInputError(
                    f"{name} is {quoted(value)}, expected for the format {self.name} one of "
                    f"{', '.join(known)}"
                )
        usual = {name: spec.options[0][0] for name, spec in self.choices.items()}
        return {**usual, **choices}


def about(outgoing: Outgoing) -> dict[str, Any]:
    """Return title, unit, full scale and more facts for a file; the sidecar holds all."""
    stimulus = outgoing.stimulus
    return {
        "title": outgoing.design.title,
        "channels": [channel.title for channel in stimulus.channels],
        "places": [channel.place for channel in stimulus.channels],
        "unit": stimulus.unit,
        "full_scale": outgoing.full_scale,
        "rate_hz": outgoing.rate_hz,
        "start_s": stimulus.start_s,
        "scaling": stimulus.scaling,
        "limb": stimulus.limb,
        "calibration": outgoing.calibration,
        "software": f"SkinSource studio {__version__}",
        "design_digest": outgoing.digest,
    }


def channel_names(stimulus: Stimulus) -> list[str]:
    """Return a name for each channel, of letters, digits and underscores: ``place_7``.

    Where several channels have one place, the input is named too; a channel that drives no
    actuator has its number.
    """
    places = Counter(channel.place for channel in stimulus.channels)
    return [
        _channel_name(channel, alone=places[channel.place] == 1) for channel in stimulus.channels
    ]


def _channel_name(channel: Channel, *, alone: bool) -> str:
    if channel.place is None:
        return f"{channel.title.lower()}_{channel.number}"
    inputs = "_".join(str(id) for id in channel.inputs)
    return f"place_{channel.place}" if alone else f"place_{channel.place}_input_{inputs}"
