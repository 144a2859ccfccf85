"""The layout of the store ``measured.npz``, and the published files that it is made from.

The store is a ZIP archive of arrays as NumPy writes them, not compressed; the archive has a
checksum (CRC-32) of each::

    about.json                   format, format_version, installed_at, source_name,
                                 source_sha256, source_bytes, unpublished
    responses/1-1.npy … 4-20     of limb and input, (72 outputs, 3 axes, 522 taps) float64
    map/outline.npy …            float64
    masks/1.npy … 4.npy          (rows, columns) uint8
"""

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path

from skinsource.base.assets import data_folder, user_folder
from skinsource.base.conventions import N_AXES, N_INPUTS, N_OUTPUTS, N_TAPS
from skinsource.base.errors import DatasetError, StorageError
from skinsource.base.files import is_file, is_folder, storage_errors_of

FILE_NAME = "measured.npz"
FORMAT = "skinsource measured dataset"
FORMAT_VERSION = 3
ABOUT = "about.json"
LIMBS = (1, 2, 3, 4)
N_VERTICES = 1505
#: (rows, columns) of 1 mm each, for the hand lengths of limbs 1 to 4.
MASK_SHAPES = ((464, 174), (437, 164), (490, 184), (437, 164))
MAP_SHAPES = {
    "outline": (N_VERTICES, 2),
    "output_positions": (N_OUTPUTS, 2),
    "input_positions": (N_INPUTS, 2),
    "visibility": (N_VERTICES, N_OUTPUTS),
}


def map_name(part: str) -> str:
    """Return the name of a part of the map in the store."""
    return f"map/{part}"


def response_name(limb: int, location: int) -> str:
    """Return the name of the responses of one limb to one input in the store."""
    return f"responses/{limb}-{location}"


def mask_name(limb: int) -> str:
    """Return the name of the mask of one limb in the store."""
    return f"masks/{limb}"


#: Shape and type of each array in the store.
ARRAYS = {
    **{map_name(part): (shape, "<f8") for part, shape in MAP_SHAPES.items()},
    **{mask_name(limb): (MASK_SHAPES[limb - 1], "|u1") for limb in LIMBS},
    **{
        response_name(limb, location): ((N_OUTPUTS, N_AXES, N_TAPS), "<f8")
        for limb in LIMBS
        for location in range(1, N_INPUTS + 1)
    },
}


RESPONSES_FILE = "impulseResponses.mat"
#: Where a file of the download cannot be read.
ADVICE = "Give the folder that holds the download."
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
    """Return the folder of the files that ``skinsource dataset fetch`` downloads."""
    return user_folder() / "measured-download"


def find_downloaded(path: Path) -> DownloadedFiles:
    """Find the files of the download in a folder, or beside ``impulseResponses.mat`` itself.

    Raises
    ------
    StorageError
        There is no such file or folder.
    DatasetError
        Files are missing; the message names them.
    """
    given_folder = is_folder(path)
    if not given_folder and not is_file(path):
        raise StorageError(
            f"{path}: no such file or folder. Give the folder that holds {RESPONSES_FILE} and the "
            "toolbox's folder 'visualization', or get both with 'skinsource dataset fetch'."
        )
    folder = path if given_folder else path.parent
    responses = _first(folder, _RESPONSES_FOLDERS, RESPONSES_FILE) if given_folder else path
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
        paths = sorted(folder.glob(f"{pattern}/{name}" if pattern else name))
        if paths:
            return paths[0]
    return None


#: Record of the dataset, doi 10.5281/zenodo.10547601.
DATASET_URL = "https://zenodo.org/records/10547601/files"
#: The toolbox's map files at one fixed commit.
MAP_URL = (
    "https://raw.githubusercontent.com/neelitummala/skinsource/"
    "3d3ed8ae97b4854ede92ce9024fa41ca8e330d30/source/visualization"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class RemoteFile:
    """One file to download.

    Attributes
    ----------
    name
        Path inside the download folder, with ``/``.
    url
    size_bytes
    checksum
        ``"md5:…"`` or ``"sha256:…"``.
    """

    name: str
    url: str
    size_bytes: int
    checksum: str


def published_files(
    dataset_url: str = DATASET_URL, map_url: str = MAP_URL
) -> tuple[RemoteFile, ...]:
    """List the files to download, from the given addresses or mirrors of them."""
    listed = json.loads((data_folder() / "published-dataset.json").read_text(encoding="utf-8"))
    urls = {f"{MAP_FOLDER}/{name}": f"{map_url}/{name}" for name in MAP_FILES}
    urls[RESPONSES_FILE] = f"{dataset_url}/{RESPONSES_FILE}?download=1"
    return tuple(RemoteFile(url=urls[file["name"]], **file) for file in listed)


def checksum_of(path: Path, algorithm: str) -> str:
    """Return the checksum of a file, as in `RemoteFile.checksum`.

    Raises
    ------
    StorageError
        It cannot be read.
    """
    with storage_errors_of(path, reading=ADVICE), path.open("rb") as opened:
        return f"{algorithm}:{hashlib.file_digest(opened, algorithm).hexdigest()}"


def unpublished_files(downloaded: DownloadedFiles) -> tuple[str, ...]:
    """Return the names of the files in a download whose content is not the published one."""
    changed = []
    for file in published_files():
        name = file.name.rpartition("/")[2]
        path = downloaded.responses if name == RESPONSES_FILE else downloaded.map_folder / name
        if checksum_of(path, file.checksum.partition(":")[0]) != file.checksum:
            changed.append(name)
    return tuple(changed)


def check_map_files(files: DownloadedFiles, unpublished: tuple[str, ...]) -> None:
    """Raise `DatasetError` if any of the ``unpublished`` files is one of the map's.

    A damaged one moves sensors, and nothing in it tells.
    """
    changed = [name for name in unpublished if name in MAP_FILES]
    if changed:
        raise DatasetError(
            f"{files.map_folder}: not the published content: {', '.join(changed)} (the checksum "
            "differs). Run 'skinsource dataset fetch' again, or, to use other files, 'skinsource "
            "dataset install PATH --unpublished'."
        )
