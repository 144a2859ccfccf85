"""One design, checked: whether it is linear, and how well it agrees with its recording."""

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np

from skinsource.analysis.noise import QUIET_SHARE, quiet_rms
from skinsource.analysis.statistics import dominant_frequency
from skinsource.analysis_rules.noise_rules import place_noise
from skinsource.arrays import Floats
from skinsource.checking.report import Condition, NoiseOf
from skinsource.choice_words import AXES, word_of
from skinsource.comparing.snapshot import louder
from skinsource.design import Design, audible_inputs
from skinsource.errors import InvalidInputError, RecordingError
from skinsource.export.description import describe_played
from skinsource.files import named
from skinsource.job import Progress, Stop, never, silent
from skinsource.limb import N_AXES, N_OUTPUTS, Axes, Limb
from skinsource.own_limbs import facts_of
from skinsource.quantities import new_graph, sources
from skinsource.quoting import printable, quoted
from skinsource.recordings.reading_process import ReadingProcess
from skinsource.validation import (
    agreement,
    aligned,
    linear_fit,
    open_recorded,
    superposition_correlation,
)
from skinsource.validity import Findings
from skinsource.validity.finding import words_of
from skinsource.view import View

_LEVELS = (0.25, 0.5, 1.0, 2.0)
# A recording may start this much earlier or later than the prediction.
_MOST_SHIFT_S = 0.2
# More, 20 000 samples of a published limb, would take gigabytes: all channels are held, at several
# levels.
_MOST_VALUES = 20_000 * N_OUTPUTS * N_AXES


@dataclass(frozen=True, slots=True, kw_only=True)
class Recorded:
    """Where a recording is.

    Attributes
    ----------
    path
        A file of responses, see `skinsource.validation.open_recorded`.
    rate_hz
        Its rate, where the file says none; None: that of the limb.
    """

    path: Path
    rate_hz: float | None = None


def condition_of(
    design: Design,
    name: str,
    recorded: Recorded | None = None,
    *,
    axes: Axes | Literal[""] = "",
    process: ReadingProcess | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> Condition:
    """Check a design, alone and against a recording.

    Parameters
    ----------
    design, name
        The design, and what the report calls it.
    recorded
        What was measured of it; None: nothing was.
    axes
        Axes that are looked at, and recorded; empty: all of the limb.
    process
        Reads the recording; one of its own unless given.
    progress, stop
        As for all long work.

    Raises
    ------
    InvalidInputError
        The limb has no such axes, or the design is too long for all channels to be compared.
    RecordingError, StorageError
        The recording does not fit, is silent, or cannot be read.
    Stopped
        ``stop`` said so.
    """
    chosen = axes or facts_of(design.limb).axes
    seen = View(axes=chosen)
    progress(0, 3, f"Predicting {name}")
    # What is compared is the prediction through the graph of the studio, not one made for it.
    basis = _values(design, seen, stop, "limb_data", "response_samples", "stimulus_start_s")
    limb = basis["limb_data"]
    _refuse_too_much(name, limb, len(chosen), basis["response_samples"])
    every = replace(seen, outputs=tuple(range(1, limb.n_outputs + 1)))
    predicted = _values(design, every, stop, "axis_traces", "validity")
    field = predicted["axis_traces"]
    progress(1, 3, f"Checking {name}")
    linear, superposed = _checks(design, every, field, limb.sample_rate_hz, stop)
    main_hz = _main_frequency(field, limb.sample_rate_hz)
    details = _details(design, limb, chosen, recorded, predicted["validity"])
    found = Condition(
        name=name, frequency_hz=main_hz, linear=linear, superposed=superposed, details=details
    )
    if recorded is None:
        return found
    _refuse_silence(name, field)
    measured = _read(recorded, limb, len(chosen), process, progress, stop)
    shifted, shift = aligned(measured, field, round(_MOST_SHIFT_S * limb.sample_rate_hz))
    quiet = _quiet(measured, shift, basis["stimulus_start_s"], limb)
    noise, noise_of = _noise(quiet, design, limb, chosen)
    agrees = agreement(field, shifted, noise)
    return replace(found, agreement=agrees, shift_samples=shift, noise_of=noise_of)


def _refuse_silence(name: str, field: Floats) -> None:
    if not field.any():
        raise InvalidInputError(
            f"{name}: what is predicted of it is silent throughout, so there is nothing to compare "
            "a recording with. Let it play something, or check it without a recording."
        )


def _details(
    design: Design, limb: Limb, axes: str, recorded: Recorded | None, findings: Findings
) -> tuple[str, ...]:
    """What files say of a design, and which recording it was held against."""
    played = design.limb, limb.note, design.scaling, design.inputs, design.actuated
    return (
        f"recording: {'none' if recorded is None else printable(recorded.path.name)}",
        *describe_played(*played),
        f"axes: {word_of(AXES, axes).both}",
        *words_of(findings),
    )


def _read(
    recorded: Recorded,
    limb: Limb,
    n_axes: int,
    process: ReadingProcess | None,
    progress: Progress,
    stop: Stop,
) -> Floats:
    progress(2, 3, f"Reading {recorded.path.name}")
    size = limb.n_outputs, n_axes, limb.sample_rate_hz
    how: dict[str, Any] = {"rate_hz": recorded.rate_hz, "process": process, "stop": stop}
    measured = open_recorded(recorded.path, *size, **how)
    if not measured.any():
        # Here it is known which file of many it is.
        raise RecordingError(
            f"{named(Path(recorded.path.name))}: it is silent throughout, so there is nothing to "
            "compare. Choose another recording."
        )
    return measured


def _quiet(measured: Floats, shift: int, start_s: float, limb: Limb) -> Floats:
    """What a recording, brought onto the prediction by ``shift``, holds before its response."""
    until_s = start_s + QUIET_SHARE * limb.pre_trigger_delay_s
    return measured[..., : max(round(until_s * limb.sample_rate_hz) - shift, 0)]


def _noise(quiet: Floats, design: Design, limb: Limb, axes: str) -> tuple[Floats | float, NoiseOf]:
    """RMS of the noise of a recording, (n_outputs, n_axes), and what tells it; 0: nothing does.

    Where there is too little that is ``quiet`` in it, that with which the limb was measured.
    """
    rms = quiet_rms(quiet)
    if rms is not None:
        return rms, "recording"
    places = sorted({one.location for one in audible_inputs(design.inputs)})
    found = [one for one in (place_noise(limb, place) for place in places) if one is not None]
    if not found:
        return 0.0, "nothing"
    numbers = [limb.axes.index(axis) for axis in axes]
    noise: Floats = np.sqrt(np.mean(np.square(found), axis=0))[:, numbers]
    return noise, "limb"


def _refuse_too_much(name: str, limb: Limb, n_axes: int, n_times: int) -> None:
    most = _MOST_VALUES // (limb.n_outputs * n_axes)
    if n_times > most:
        raise InvalidInputError(
            f"{quoted(name)} is {n_times / limb.sample_rate_hz:.1f} s long, expected at most "
            f"{most / limb.sample_rate_hz:.1f} s: all channels are compared"
        )


def _checks(
    design: Design, view: View, field: Floats, rate: float, stop: Stop
) -> tuple[float, float]:
    """Smallest adjusted R² over levels, and smallest r between the sum of inputs and all."""
    if not field.any():
        return math.nan, math.nan
    at_levels = [
        _values(louder(design, k), view, stop, "axis_traces")["axis_traces"] for k in _LEVELS
    ]
    channels = np.stack(at_levels).reshape(len(_LEVELS), -1, field.shape[-1])
    fit = linear_fit(_LEVELS, channels, rate, facts_of(design.limb).band_hz)[1]
    heard = audible_inputs(design.inputs)
    if len(heard) < 2:
        return _least(fit), math.nan
    parts = []
    for one in heard:
        alone = tuple(replace(each, muted=each.id != one.id, solo=False) for each in design.inputs)
        trace = _values(replace(design, inputs=alone), view, stop, "axis_traces")["axis_traces"]
        whole = np.zeros(field.shape)
        whole[..., : trace.shape[-1]] = trace[..., : field.shape[-1]]
        parts.append(whole.reshape(-1, field.shape[-1]))
    r = superposition_correlation(np.stack(parts), field.reshape(-1, field.shape[-1]))
    return _least(fit), _least(r)


def _least(values: Floats) -> float:
    """The smallest of those that are known; NaN where none is, as of a response without a bin."""
    known = values[np.isfinite(values)]
    return float(known.min()) if known.size else math.nan


def _main_frequency(field: Floats, rate: float) -> float:
    """Frequency with the most power over all channels; NaN for silence."""
    power = np.sum(np.square(np.abs(np.fft.rfft(field, axis=-1))), axis=(0, 1))
    return float(dominant_frequency(power, rate / field.shape[-1]))


def _values(design: Design, view: View, stop: Stop, *names: str) -> dict[str, Any]:
    return new_graph().evaluate(names, sources(design, view), stop)
