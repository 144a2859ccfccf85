"""Stimulus sets: a file for each combination of values, and a table that says which is which."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.actuators.actuation import Actuation
from skinsource.actuators.equalising import Equaliser
from skinsource.actuators.rigs import Rig
from skinsource.base.arguments import checking, real_number
from skinsource.base.decibels import FLOOR_DB
from skinsource.base.errors import InvalidInputError, SkinSourceError, Stopped, counted, sentence
from skinsource.base.files import FilePath, replacing_folder
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.design.amplitudes import amplitude_unit
from skinsource.design.comparing import matching_gain
from skinsource.design.design import Design, louder
from skinsource.engine.evaluation import Evaluator
from skinsource.engine.levelling import output_level_db
from skinsource.engine.stimulus import FULL_SCALE_UNIT
from skinsource.export.formats import format_named
from skinsource.export.stimulus_export.export import write_prepared
from skinsource.export.stimulus_export.options import Nothing, StimulusOptions
from skinsource.export.stimulus_export.preparing import (
    PreparedStimulus,
    common_full_scale,
    prepare_stimulus,
)
from skinsource.specs.models import specs_of
from skinsource.studies.sweeps.plan import OF_INPUT, Plan, Value
from skinsource.studies.sweeps.running import Variables, variables_of
from skinsource.studies.sweeps.table import Cell, SweepTable, cell_of, write_csv

#: The table beside the files.
CONDITIONS = "conditions.csv"
#: Most files of a set.
MOST_CONDITIONS = 1000
# Units at the end of names of fields, as file names have them.
_ENDINGS = {"_hz_per_s": "Hzpers", "_hz": "Hz", "_rad": "rad", "_s": "s", "_db": "dB"}
# Units of amplitudes and peaks, as headings have them.
_HEADINGS = {"m/s²": "_m_per_s2", "V": "_v", FULL_SCALE_UNIT: "_of_full_scale"}
_LONGEST_VALUE = 40


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """One combination of values.

    Attributes
    ----------
    values
        Value of each variable, by its name.
    name
        Name of its file, or folder.
    gain_db
        Gain of its amplitudes that matches its level.
    level_db
        Level at the matched output, dB re 1 m/s²; NaN where none is matched.
    peak, unit
        Largest drive, in the unit of the drives.
    duration_s
        Length of its file.
    weakened
        A sentence on what the equaliser takes from it; "": less than 1 dB.
    refused
        Why it is not written; "": it is.
    design
        Its design, with the gain.
    """

    values: Mapping[str, Value]
    name: str
    gain_db: float = 0.0
    level_db: float = np.nan
    peak: float = 0.0
    unit: str = ""
    duration_s: float = np.nan
    weakened: str = ""
    refused: str = ""
    design: Design = field(repr=False)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StimulusSet:
    """The conditions of a set, ready to be written.

    Attributes
    ----------
    conditions
        All of them, also those that are refused.
    output
        The matched output; None: levels are those of the designs.
    options
        Options of each file; full scale is the same for all, unless the rig says it.
    prepare
        Prepares a design with options.
    confirmed
        Whether files are written even though samples clip or limits are passed.
    summary
        What is written, in sentences.
    """

    conditions: tuple[Condition, ...] = ()
    output: int | None
    options: StimulusOptions
    prepare: Callable[..., PreparedStimulus] = field(repr=False)
    confirmed: bool = False
    summary: str = ""

    @property
    def written(self) -> tuple[Condition, ...]:
        """The conditions that are not refused."""
        return tuple(condition for condition in self.conditions if not condition.refused)

    @property
    def refused(self) -> dict[int, str]:
        """Reasons why conditions are not written, by their numbers, from 1."""
        return {k: each.refused for k, each in enumerate(self.conditions, 1) if each.refused}

    def prepared(self, condition: Condition, stop: Stop = never) -> PreparedStimulus:
        """Return what the files of a condition hold."""
        ready = self.prepare(condition.design, options=self.options, stop=stop)
        return ready.named(Path(condition.name))

    def write(self, folder: FilePath, *, progress: Progress = silent, stop: Stop = never) -> None:
        """Write all files and `CONDITIONS` to a new folder, whole or not at all."""
        if not self.written:
            raise InvalidInputError(
                f"all conditions are refused, the first one because {self.conditions[0].refused}"
            )
        rows: list[dict[str, Cell]] = []
        # Files of other programs beside an older set, such as answers of people, are never lost.
        with replacing_folder(Path(folder), mark="") as temporary:
            for done, condition in enumerate(self.written):
                stop_if(stop)
                progress(done, len(self.written), f"Exporting {condition.name}")
                ready, path = self.prepared(condition, stop), temporary / condition.name
                exported = write_prepared(ready, path, confirmed=self.confirmed, stop=stop)
                rows += [self._row(condition, path.name) for path in exported.files]
            cells = tuple(tuple(row.values()) for row in rows)
            write_csv(SweepTable(tuple(rows[0]), cells), temporary / CONDITIONS)

    def _row(self, condition: Condition, file: str) -> dict[str, Cell]:
        unit = _HEADINGS.get(amplitude_unit(condition.design), "")
        row: dict[str, Cell] = {"file": file}
        for name, value in condition.values.items():
            row[f"{name}{unit}" if name.endswith("amplitude") else name] = cell_of(value)
        row["gain_db"] = condition.gain_db
        if self.output is not None:
            row[f"level_at_output_{self.output}_db"] = condition.level_db
        row[f"peak{_HEADINGS.get(condition.unit, '')}"] = condition.peak
        return row | {"duration_s": condition.duration_s}


@checking
def export_set(
    design: Design,
    vary: Variables,
    folder: FilePath | None,
    format: str = "wav",
    rate_hz: int | None = None,
    *,
    match_output: int | None = None,
    level_db: float | Iterable[float] | None = None,
    options: StimulusOptions | None = None,
    confirmed: bool = False,
    actuation: Actuation | Nothing | None = None,
    rig: Rig | Nothing | None = None,
    equaliser: Equaliser | Nothing | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> StimulusSet:
    """Write a stimulus for each combination of values, and ``conditions.csv``.

    Each file holds what `export_stimulus` writes for its design.  The largest drive of the set is
    full scale in all of them, so that their differences stay.  A combination that is not possible
    is left out, see ``refused`` of what is returned.  Nothing is left half written.

    Parameters
    ----------
    design, vary
        The design, and values by the name of the variable, as `skinsource.sweep` has them.
    folder
        A new folder; None: nothing is written until ``write`` of what is returned is called.
    format, rate_hz, options, confirmed, actuation, rig, equaliser
        As those of `export_stimulus`.
    match_output
        Output at which all levels are the same: the RMS of the loudest 100 ms over all axes.
    level_db
        That level, dB re 1 m/s²; None: that of ``design``.  Of several, each is written, as the
        variable ``level_db``.
    progress, stop
        As those of a job.

    Raises
    ------
    InvalidInputError
        The set is not possible.
    StorageError
        The folder exists and is not empty, or cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
    >>> vary = {"frequency_hz": [50, 200], "location": [7, 8]}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     exported = ss.export_set(design, vary, Path(folder) / "set", match_output=29)
    >>> print(exported.written[0].name)
    001_frequency-50Hz_location-7.wav
    """
    plan = Plan(designs=(("", design),), variables=variables_of(vary))
    evaluator, conditions = Evaluator(), []
    kind, options = format_named(format), options or StimulusOptions()
    levels_db = _targets_db(evaluator, plan, match_output, level_db, options)
    total = len(plan) * len(levels_db)
    if total > MOST_CONDITIONS:
        raise InvalidInputError(f"{total} files are more than {MOST_CONDITIONS}. Choose fewer.")
    made_for: dict[str, Any] = {"actuation": actuation, "rig": rig, "equaliser": equaliser}
    prepare = partial(prepare_stimulus, format=kind, rate_hz=rate_hz, **made_for)
    planned = StimulusSet(
        output=match_output, options=options, prepare=prepare, confirmed=confirmed
    )
    every = product(range(1, len(plan) + 1), levels_db)
    for number, (planned_number, target_db) in enumerate(every, start=1):
        stop_if(stop)
        progress(number - 1, total, f"Condition {number} of {total}")
        values = plan.values_of(planned_number)
        if len(levels_db) > 1 and target_db is not None:
            values["level_db"] = target_db
        name = f"{number:0{max(3, len(str(total)))}}{_values_text(values)}{kind.suffix}"
        condition = Condition(values=values, name=name, design=design)
        try:
            condition = replace(condition, design=plan.design_of(planned_number))
            condition = _matched(condition, evaluator, match_output, target_db)
            condition = _sized(condition, planned, stop)
        except Stopped:
            raise
        except SkinSourceError as error:
            condition = replace(condition, refused=sentence(str(error)))
        conditions.append(condition)
    if options.full_scale is None and all(each.unit != FULL_SCALE_UNIT for each in conditions):
        full_scale = common_full_scale(each.peak for each in conditions)
        planned = replace(planned, options=replace(options, full_scale=full_scale))
        # What passes a limit where its own peak is full scale may pass none now.
        conditions = [
            _sized(each, planned, stop) if each.unit and each.refused else each
            for each in conditions
        ]
    planned = replace(planned, conditions=tuple(conditions))
    summary = f"{counted(len(planned.written), 'stimulus', 'stimuli')} in a new folder"
    if planned.refused:
        summary += f", {len(planned.refused)} left out"
    if planned.written:
        summary += f"; the first one: {planned.prepared(planned.written[0], stop).summary}"
    summary += "".join(_evened(design, name, values) for name, values in plan.variables)
    planned = replace(planned, summary=summary)
    if folder is not None:
        planned.write(folder, progress=progress, stop=stop)
    return planned


def _evened(design: Design, name: str, values: tuple[Value, ...]) -> str:
    """Return a sentence where a variable makes unlike tracks or clips alike; "": it does not."""
    waveforms = (clip.waveform for clip in design.clips)
    parts = design.inputs if name in OF_INPUT else (*design.clips, *waveforms)
    found = [part for part in parts if name in specs_of(part)]
    # A list gives each track a place of its own.
    if isinstance(values[0], tuple) or len({str(getattr(part, name)) for part in found}) < 2:
        return ""
    where = "on all tracks" if len(design.inputs) > 1 else "in all clips"
    return f". {specs_of(found[0])[name].label} becomes the same {where}"


def _targets_db(
    evaluator: Evaluator,
    plan: Plan,
    output: int | None,
    level_db: float | Iterable[float] | None,
    options: StimulusOptions,
) -> list[float | None]:
    """Return the levels that are matched; None: nothing is.  Refuse what matching cancels."""
    if output is None:
        if level_db is not None:
            raise InvalidInputError("level_db needs an output. Choose match_output, too.")
        return [None]
    part = options.inputs, options.clips, options.from_s, options.to_s
    if any(each is not None for each in part):
        raise InvalidInputError("levels are those of whole designs. Export all tracks and times.")
    ((_, design),) = plan.designs
    for name, _ in plan.variables:
        of_one, _, varied = name.rpartition(".")
        if varied in ("amplitude", "gain") and (not of_one or len(design.inputs) == 1):
            raise InvalidInputError(
                f"matching makes {varied}s equal. Remove the {varied}, or match no levels."
            )
    if level_db is None:
        return [output_level_db(evaluator, design, output)]
    several = level_db if isinstance(level_db, Iterable) else (level_db,)
    levels: list[float | None] = [real_number("level_db", level) for level in several]
    if not levels:
        raise InvalidInputError("level_db has no values, expected at least one")
    return levels


def _matched(
    condition: Condition, evaluator: Evaluator, output: int | None, level_db: float | None
) -> Condition:
    """Return the condition with the gain that brings an output to a level."""
    if output is None or level_db is None:
        return condition
    own_db = output_level_db(evaluator, condition.design, output)
    if min(own_db, level_db) <= FLOOR_DB:
        silent_one = "It" if own_db <= FLOOR_DB else "What it should be matched to"
        raise InvalidInputError(f"{silent_one} is silent at output {output}. Match another one.")
    design = louder(condition.design, matching_gain(own_db, level_db))
    return replace(condition, design=design, gain_db=level_db - own_db, level_db=level_db)


def _sized(condition: Condition, planned: StimulusSet, stop: Stop) -> Condition:
    """Return the condition with its peak and length, refused where it clips or passes a limit."""
    ready = planned.prepared(condition, stop)
    if not planned.options.accept_loss and (advice := ready.advice_on_loss):
        raise InvalidInputError(f"{ready.lost_at_rate} {advice}")
    return replace(
        condition,
        peak=ready.peak,
        unit=ready.drives.unit,
        duration_s=ready.files[0].sent.duration_s,
        weakened=ready.weakened,
        refused="" if planned.confirmed else " ".join(ready.objections),
    )


def _values_text(values: Mapping[str, Value]) -> str:
    """Return the values for the name of a file: "_frequency-100Hz_amplitude-0p5"."""
    text = ""
    for name, value in values.items():
        ending = next((each for each in _ENDINGS if name.endswith(each)), "")
        key = re.sub(r"^(\d+)\.", r"track\1-", name.removesuffix(ending)).replace("_", "-")
        is_number = not isinstance(value, str | tuple)
        shown = f"{value:g}".replace("-", "minus") if is_number else str(cell_of(value))
        safe = re.sub(r"[^A-Za-z0-9]", "", shown.replace(".", "p").replace(" ", "and"))
        text += f"_{key}-{safe[:_LONGEST_VALUE]}{_ENDINGS.get(ending, '')}"
    return text
