"""How the files of an exported stimulus are called."""

from collections.abc import Iterable
from pathlib import Path

from skinsource.stimulus_formats import StimulusFormat


def marked(path: Path, format: StimulusFormat, mark: str) -> Path:
    """``path`` with ``mark`` before the ending of ``format``."""
    suffix = format.suffix if path.name.endswith(format.suffix) else path.suffix
    stem = path.name[: len(path.name) - len(suffix)]
    return path.with_name(f"{stem}{mark}{suffix}")


def sidecar_path(path: Path) -> Path:
    """Where the sidecar of a file or folder is."""
    return path.with_name(f"{path.name}.json")


def written_files(
    path: Path, format: StimulusFormat, marks: Iterable[str]
) -> tuple[tuple[Path, ...], ...]:
    """Each file that an export to ``path`` writes, its sidecar, and what else belongs to it.

    ``marks`` are those of `skinsource.stimulus_export.Overview`.
    """
    files = (marked(path, format, mark) for mark in marks)
    return tuple((one, sidecar_path(one), *_beside(one, format)) for one in files)


def _beside(path: Path, format: StimulusFormat) -> tuple[Path, ...]:
    other = format.beside(path)
    return () if other is None else (other,)
