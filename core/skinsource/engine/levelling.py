"""Predicted levels of single tracks, and of the single wavelets of a train."""

from collections.abc import Iterable
from dataclasses import replace

from skinsource.base.arguments import integer
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.design.design import Design, View
from skinsource.design.waveforms.wavelet_train import SOFTEST_DB, WaveletTrain
from skinsource.engine.evaluation import Evaluator
from skinsource.signals.loudest_window import LOUDEST_WINDOW_S

#: Label of the predicted level.
MEASURE = f"magnitude of all axes, loudest {LOUDEST_WINDOW_S * 1000:g} ms of any output"
_VIEW = View(axes="xyz", method="mag", span="loudest")


def wavelet_levels_db(
    design: Design, clip_id: int, *, progress: Progress = silent, stop: Stop = never
) -> tuple[float, ...]:
    """Return the level of each wavelet of a train where it is strongest on the skin.

    Each wavelet is predicted alone, on the limb and at the location of its track, through the
    effects of its clip.  Its level is that of the output and the 100 ms with the highest RMS of the
    length of the acceleration vector.

    Parameters
    ----------
    design
        Design with the clip.
    clip_id
        The clip, which plays a `WaveletTrain`.
    progress, stop
        ``progress`` is called after each wavelet, ``stop`` before each.

    Returns
    -------
    One level for each frequency, dB; minus infinity for a wavelet that moves nothing.  Only
    differences between levels count: amplitudes, gains and any factor that is common to all
    frequencies are left out.

    Raises
    ------
    InvalidInputError
        The clip plays no wavelet train, or there is no such clip.
    DatasetMissingError
        The limb is a measured one, and the measured dataset is not installed.
    Stopped
        ``stop`` returned True.
    """
    clip, track = design.clip(clip_id), design.track_of(clip_id)
    train = clip.waveform
    if not isinstance(train, WaveletTrain):
        raise InvalidInputError(
            f"clip {clip_id} plays a {type(train).__name__}, expected a WaveletTrain"
        )
    # Upstream's scaling would give each wavelet the same peak.
    scaling = "relative" if design.scaling == "upstream" else design.scaling
    evaluator, levels_db = Evaluator(), []
    count = len(train.frequencies_hz)
    for j in range(count):
        stop_if(stop)
        gains_db = tuple(0.0 if k == j else SOFTEST_DB for k in range(count))
        alone = replace(clip, gain=1.0, muted=False, waveform=replace(train, gains_db=gains_db))
        player = replace(track, clips=(alone,), amplitude=1.0, muted=False, solo=False)
        played = replace(design, inputs=(player,), scaling=scaling)
        levels_db.append(_loudest_db(evaluator, played))
        progress(j + 1, count, f"Wavelet {j + 1} of {count}")
    return tuple(levels_db)


def track_levels_db(
    design: Design, ids: Iterable[int], *, progress: Progress = silent, stop: Stop = never
) -> dict[int, float]:
    """Return the level of each track alone where it is strongest on the skin, dB, by its id.

    The level is that of `wavelet_levels_db`, with amplitude and scaling as the design has them;
    a track counts whether it is muted or not.

    Raises
    ------
    InvalidInputError
        A track cannot be played, or there is none of that id.
    DatasetMissingError
        The limb is a measured one, and the measured dataset is not installed.
    Stopped
        ``stop`` returned True.
    """
    evaluator, tracks, levels_db = Evaluator(), [design.input(id) for id in ids], {}
    for done, track in enumerate(tracks, 1):
        stop_if(stop)
        alone = replace(track, muted=False, solo=False)
        levels_db[track.id] = _loudest_db(evaluator, replace(design, inputs=(alone,)))
        progress(done, len(tracks), f"Input {done} of {len(tracks)}")
    return levels_db


def output_level_db(evaluator: Evaluator, design: Design, output: int) -> float:
    """Return the level of an output, from 1: the RMS of its loudest 100 ms over all axes, in dB."""
    levels_db = evaluator.evaluate(design, ("output_levels_db",), _VIEW)["output_levels_db"]
    integer("output", output, 1, levels_db.size)
    return float(levels_db[output - 1])


def _loudest_db(evaluator: Evaluator, design: Design) -> float:
    values = evaluator.evaluate(design, ("output_levels_db",), _VIEW)
    return float(values["output_levels_db"].max())
