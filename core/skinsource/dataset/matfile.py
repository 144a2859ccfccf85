"""MATLAB files, in either encoding (v7 and v7.3)."""

from pathlib import Path
from typing import Any

from skinsource.dataset.pieces import WHAT_TO_DO, refuse_scattered
from skinsource.errors import DatasetError, StorageError
from skinsource.extras import package_of_extra
from skinsource.quoting import printable


def read_variable(path: Path, name: str) -> Any:
    """Give the variable ``name`` of a MATLAB file: an array, a table (`DataFrame`), an object.

    Raises
    ------
    MissingExtraError
        mat-io is not installed.
    StorageError
        The file cannot be opened.
    DatasetError
        It is no MATLAB file, is cut off or damaged, or does not hold the variable.
    """
    matio = package_of_extra("matio", "dataset")
    try:
        with path.open("rb") as opened:
            opened.read(1)
    except OSError as error:
        raise StorageError(
            f"{path}: cannot be read ({error.strerror or error}). Give the folder that holds the "
            "download."
        ) from error
    try:
        refuse_scattered(path)
        variables = matio.load_from_mat(str(path))
    except DatasetError:
        raise
    except Exception as error:  # on a damaged file the parser may fail in any way
        reason = printable(error) or type(error).__name__
        raise DatasetError(
            f"{path.name}: cannot be read as a MATLAB file ({reason}), expected MAT v7 or v7.3. "
            f"{WHAT_TO_DO}"
        ) from error
    if name not in variables:
        found = ", ".join(sorted(variables)) or "nothing"
        raise DatasetError(
            f"{path.name}: holds {found}, expected a variable '{name}'. Is this the right file? "
            f"{WHAT_TO_DO}"
        )
    return variables[name]
