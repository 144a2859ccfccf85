"""What a format is, and what it is given to write."""

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

#: Facts of one file that join its sidecar.
Facts = Mapping[str, Any]

SAMPLES = "samples"


def nothing_lost(_: Mapping[str, str]) -> str:
    """Nothing of the drive is missing."""
    return ""


def no_rounding(_: Mapping[str, str]) -> bool:
    """Nothing is rounded."""
    return False


def no_response(_: Design) -> int:
    """Nothing that is predicted is written."""
    return 0


def no_second_file(_: Path) -> None:
    """No other file belongs to it."""


def no_second_text(_: Facts) -> bytes:
    """Nothing is in the other file, as there is none."""
    return b""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Outgoing:
    """A stimulus on its way to a file.

    Attributes
    ----------
    stimulus
        Samples in parts of full scale, (n_channels, n_times).
    full_scale
        What 1 stands for, in the unit of the stimulus.
    design
        Those inputs and clips of the design that take part.
    name
        Name of the file, without its folder.
    digest
        Of the design.
    choices
        What was chosen of what the format offers.
    calibration
        Whether m/s² follow from the samples, in words.
    dither_seed
        Of whole numbers; None: no dither.
    progress, stop
        Told how far it is; asked now and then.
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
        """Its rate, as a whole number where it is one."""
        rate_hz = self.stimulus.sample_rate_hz
        return int(rate_hz) if rate_hz.is_integer() else rate_hz

    def whole_numbers(self, kind: str) -> tuple[Quantised, Facts]:
        """Samples as whole numbers, and what the sidecar says of them."""
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
        For scripts; for people; usual ending of files (of a folder: none).
    hint
        What it is good for, in a sentence.
    write
        Writes a file, or fills a folder that is there; gives what the sidecar says of it.
    bytes_of
        About how many bytes ``n_channels`` of ``n_times`` take, with such choices.
    response_bytes
        And how many what is predicted of a design, where that is written too.
    rate_hz
        Usual rate; None: that of the limb.
    fixed_rate
        Whether there is no other: what is asked for is then ignored.
    choices
        What can be chosen, by name; the first option of each is the usual one.
    most_channels
        None: any number.
    one_channel_each
        Whether each channel has a file of its own: the first one PATH, the others a number more.
    folder
        Whether it is a folder.
    to_device
        Whether full scale is all that a device can play: what lies beyond would be cut off.
    rounds
        Whether whole numbers are written, with such choices, so that dither can be asked for.
    beside, words_beside
        Where another small file belongs to it besides the sidecar, None: none does; what is in it.
    loses
        What of the drive is not in the file, in a sentence, for such choices; "": nothing.
    """

    name: str
    title: str
    suffix: str
    hint: str
    write: Callable[[Outgoing, Path], Facts]
    bytes_of: Callable[[int, int, Mapping[str, str]], int]
    response_bytes: Callable[[Design], int] = no_response
    rate_hz: int | None = 48_000
    fixed_rate: bool = False
    choices: Mapping[str, ChoiceSpec] = field(default_factory=dict)
    most_channels: int | None = None
    one_channel_each: bool = False
    folder: bool = False
    to_device: bool = True
    rounds: Callable[[Mapping[str, str]], bool] = no_rounding
    beside: Callable[[Path], Path | None] = no_second_file
    words_beside: Callable[[Facts], bytes] = no_second_text
    loses: Callable[[Mapping[str, str]], str] = nothing_lost

    def chosen(self, choices: Mapping[str, str]) -> dict[str, str]:
        """Return ``choices`` and the usual ones where nothing was chosen.

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


# What a file says of itself, where it has room for a few words.


def about(outgoing: Outgoing) -> dict[str, Any]:
    """Title, unit, full scale and what else a reader needs; the sidecar says more."""
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


# What the channels of a stimulus are called in tables and arrays.


def channel_names(stimulus: Stimulus) -> list[str]:
    """One name for each channel, of letters, figures and underscores: ``place_7``.

    Where several channels have one place, the input is named too; what drives no actuator has
    the number of its channel.
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
