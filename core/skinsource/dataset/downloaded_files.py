"""Where things are in what a user downloaded."""

from dataclasses import dataclass
from pathlib import Path

from skinsource.errors import DatasetError, StorageError
from skinsource.files import is_file, is_folder
from skinsource.files.assets import user_folder

RESPONSES_FILE = "impulseResponses.mat"
MAP_FOLDER = "visualization"
MASK_FILES = ("mask1.mat", "mask2.mat", "mask3.mat", "mask4.mat")
MAP_FILES = (
    "adjacencyMatrix.mat",
    "inputLocations.mat",
    *MASK_FILES,
    "outputLocations.mat",
    "surface.mat",
)
# The toolbox keeps its map in source/visualization; archives add one more folder around it.
_FOLDERS = (
    "",
    "visualization",
    "source/visualization",
    "*/visualization",
    "*/source/visualization",
)
# What Python calls temporary files.
_TEMPORARY = "tmp" + "[a-z0-9_]" * 8
_RESPONSES_FOLDERS = ("", "*", "*/source")


@dataclass(frozen=True, slots=True, kw_only=True)
class DownloadedFiles:
    """A complete download.

    Attributes
    ----------
    responses
        File with the impulse responses.
    map_folder
        Folder with the eight map files.
    """

    responses: Path
    map_folder: Path


def download_folder() -> Path:
    """Where ``skinsource dataset fetch`` puts its files."""
    return user_folder() / "measured-download"


def leftovers(downloads: Path) -> tuple[Path, ...]:
    """Temporary files of the package pooch that killed downloads left in their folder."""
    folders = (folder for folder in (downloads, downloads / MAP_FOLDER) if is_folder(folder))
    return tuple(path for folder in folders for path in sorted(folder.glob(_TEMPORARY)))


def find_downloaded(path: Path) -> DownloadedFiles:
    """Find the files of the download in a folder, or beside ``impulseResponses.mat`` itself.

    Raises
    ------
    StorageError
        There is no such file or folder.
    DatasetError
        Files are missing; the message names them.
    """
    whole = is_folder(path)
    if not whole and not is_file(path):
        raise StorageError(
            f"{path}: no such file or folder. Give the folder that holds {RESPONSES_FILE} and the "
            "toolbox's folder 'visualization', or get both with 'skinsource dataset fetch'."
        )
    folder = path if whole else path.parent
    responses = _first(folder, _RESPONSES_FOLDERS, RESPONSES_FILE) if whole else path
    if responses is None:
        raise DatasetError(
            f"{path}: holds no {RESPONSES_FILE}. Give the folder that holds it and the toolbox's "
            "folder 'visualization', or get both with 'skinsource dataset fetch'."
        )
    surface = _first(folder, _FOLDERS, "surface.mat")
    map_folder = folder / MAP_FOLDER if surface is None else surface.parent
    missing = [name for name in MAP_FILES if not is_file(map_folder / name)]
    if missing:
        raise DatasetError(
            f"{map_folder}: missing {', '.join(missing)}. Put the toolbox's folder 'visualization' "
            f"with its {len(MAP_FILES)} map files beside {responses.name}, or get everything with "
            "'skinsource dataset fetch'."
        )
    return DownloadedFiles(responses=responses, map_folder=map_folder)


def _first(folder: Path, patterns: tuple[str, ...], name: str) -> Path | None:
    for pattern in patterns:
        found = sorted(folder.glob(f"{pattern}/{name}" if pattern else name))
        if found:
            return found[0]
    return None
