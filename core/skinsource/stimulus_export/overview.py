"""A stimulus as it will be, before it is written."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Floats
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.stimulus_export.notes import (
    calibration_of,
    edges_of,
    equalised_of,
    loses_of,
    refused_loss_of,
)
from skinsource.stimulus_export.preparing import Prepared, clipped_samples
from skinsource.stimulus_export.safety import Limit, objections

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
    ready: Prepared,
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
        for one, samples, count in zip(stimulus.channels, stimulus.samples, counts, strict=True):
            stop_if(stop)
            progress(len(channels), n_channels, "Computing")
            channels.append(
                ChannelOverview(
                    file=path.name,
                    number=one.number,
                    title=one.title,
                    place=one.place,
                    inputs=one.inputs,
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
        objections=tuple(filter(None, (refused_loss_of(ready), *objections(ready, limits)))),
    )


def extremes_of(samples: Floats, columns: int = COLUMNS) -> Floats:
    """Least and largest of each of ``columns`` stretches, (2, columns); fewer of short signals."""
    n = samples.size
    edges = np.arange(min(columns, n)) * n // min(columns, n)
    return np.stack((np.minimum.reduceat(samples, edges), np.maximum.reduceat(samples, edges)))
