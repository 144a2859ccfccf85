"""The report of a check as a file."""

from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from pathlib import Path

from skinsource.choice_words import limb_word
from skinsource.export.output_file import output_file
from skinsource.job import never
from skinsource.validation.report import Condition, report_html
from skinsource.version import __version__


def html_of(conditions: Sequence[Condition], limbs: Iterable[str]) -> str:
    """Return the report on some designs on these limbs, as one HTML page."""
    titles = ", ".join(limb_word(limb).title for limb in sorted(set(limbs)))
    written = f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC"
    about = f"skinsource {__version__}; limb: {titles}; written on {written}"
    return report_html(conditions, (about,))


def write_report(path: Path, conditions: Sequence[Condition], limbs: Iterable[str]) -> None:
    """Write the report; a file that is there is replaced once all of it is written.

    Raises
    ------
    StorageError
        It cannot be written.
    """
    with output_file(path, never) as file:
        file.write(html_of(conditions, limbs).encode())
