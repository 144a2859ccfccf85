"""The stimuli of a sweep as files that actuators play."""

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from skinsource.arguments import whole_number
from skinsource.design import Design
from skinsource.files import is_there, make_folder
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.resampling import MAX_RATE_HZ
from skinsource.stimulus_export import StimulusOptions, export_stimulus, prepared
from skinsource.stimulus_export.naming import sidecar_path
from skinsource.stimulus_formats import format_named
from skinsource.sweeps.plan import Plan
from skinsource.sweeps.table import SweepTable

FOLDER = "stimuli"


@dataclass(frozen=True, slots=True, kw_only=True)
class StimulusFiles:
    """In which form stimuli are exported.

    Attributes
    ----------
    format
        One of `skinsource.export_formats`.
    rate_hz
        Sample rate; None: what the format usually has.
    """

    format: str = "wav"
    rate_hz: int | None = None

    def __post_init__(self) -> None:
        format_named(self.format, Path())
        if self.rate_hz is not None:
            whole_number("rate_hz", self.rate_hz, 1, MAX_RATE_HZ)

    def write(
        self,
        plan: Plan,
        table: SweepTable,
        out: Path,
        *,
        progress: Progress = silent,
        stop: Stop = never,
    ) -> None:
        """Export each stimulus that was measured; those that are there already are left alone.

        A file of another rate than is asked for is written anew.  The largest drive of all of
        them is full scale in every file, so that their differences stay.

        Raises
        ------
        StorageError
            The folder cannot be written.
        Stopped
            ``stop`` said so; what was written stays, and is not written again.
        """
        waiting = [
            (path, design)
            for path, design in self._files(plan, table, out / FOLDER)
            if not self._there(path)
        ]
        if not waiting:
            return
        make_folder(out / FOLDER)
        full_scale = self._full_scale(plan, table, out, progress=progress, stop=stop)
        options = StimulusOptions(full_scale=full_scale)
        for done, (path, design) in enumerate(waiting):
            stop_if(stop)
            progress(done, len(waiting), f"Exporting {path.name}")
            export_stimulus(design, path, self.format, self.rate_hz, options=options, stop=stop)

    def _there(self, path: Path) -> bool:
        """Whether a stimulus is exported in this form."""
        beside, kind = sidecar_path(path), format_named(self.format, Path())
        if not (is_there(path) and is_there(beside)):
            return False
        own_rate = kind.fixed_rate or self.rate_hz is None
        try:
            about = json.loads(beside.read_text(encoding="utf-8"))
            return bool(about["rate_hz"] == (kind.rate_hz if own_rate else self.rate_hz))
        except (OSError, ValueError, KeyError, TypeError):
            return False

    def _files(self, plan: Plan, table: SweepTable, folder: Path) -> Iterator[tuple[Path, Design]]:
        """Where each stimulus that was measured goes, and its design."""
        suffix = format_named(self.format, Path()).suffix
        failed, width = table.failed, len(str(len(plan)))
        for number, factor in zip(table.column("stimulus"), table.column("factor"), strict=True):
            if int(number) not in failed:
                path = folder / f"{int(number):0{width}}{suffix}"
                yield path, louder(plan.design_of(int(number)), float(factor))

    def _full_scale(
        self, plan: Plan, table: SweepTable, out: Path, *, progress: Progress, stop: Stop
    ) -> float:
        """The largest drive of any stimulus, at the rate of the files; 1 where all are silent."""
        kind, largest = format_named(self.format, Path()), 0.0
        for done, (path, design) in enumerate(self._files(plan, table, out / FOLDER)):
            stop_if(stop)
            progress(done, len(table), "Looking for the largest drive")
            found = prepared(design, path, kind, self.rate_hz, StimulusOptions(), stop=stop)
            largest = max(largest, float(np.abs(found.drives.samples).max(initial=0.0)))
        # A little more, so that rounding takes no sample beyond it.
        return largest * (1.0 + 2.0**-50) or 1.0


def louder(design: Design, factor: float) -> Design:
    """The design with all amplitudes times ``factor``."""
    if factor == 1.0 or math.isnan(factor):
        return design
    inputs = (replace(one, amplitude=one.amplitude * factor) for one in design.inputs)
    return replace(design, inputs=tuple(inputs))
