"""What is checked, and the job that does it."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from skinsource.base.errors import SkinSourceError, Stopped
from skinsource.base.job import Progress, Stop
from skinsource.base.published import Axes
from skinsource.design.design import Design
from skinsource.readers.reading_process import ReadingProcess
from skinsource.studies.checking import Condition, Recorded, condition_of

TITLE = "Check against a recording"
CHECKING = "Checking against recordings"
# Steps of one design: predicted, checked, read.
_STEPS = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """A design, and what was recorded of it.

    Attributes
    ----------
    name
        What the report calls it.
    design
        As it was when it was put here.
    recording
        A file of responses; None: none was chosen.
    result
        What was found, or why nothing was; None: not checked yet.
    """

    name: str
    design: Design
    recording: Path | None = None
    result: Condition | str | None = None


def check_rows(
    rows: Sequence[Row],
    axes: str,
    rate_hz: float,
    *,
    progress: Progress,
    stop: Stop,
) -> tuple[Condition | str, ...]:
    """Check each row; return what was found of it, or why nothing was.

    Parameters
    ----------
    rows
        The designs.
    axes
        Axes that were recorded; empty: all of the limb.
    rate_hz
        Rate of recordings that say none themselves.
    progress, stop
        As for all long work.
    """
    found: list[Condition | str] = []
    with ReadingProcess() as process:
        for number, row in enumerate(rows):

            def tell(done: int, total: int, text: str, before: int = number) -> None:
                del total
                progress(before * _STEPS + done, len(rows) * _STEPS, text)

            recorded = (
                None if row.recording is None else Recorded(path=row.recording, rate_hz=rate_hz)
            )
            try:
                found.append(
                    condition_of(
                        row.design,
                        row.name,
                        recorded,
                        axes=cast(Axes, axes),
                        process=process,
                        progress=tell,
                        stop=stop,
                    )
                )
            except Stopped:
                raise
            except SkinSourceError as error:
                found.append(str(error))
    return tuple(found)
