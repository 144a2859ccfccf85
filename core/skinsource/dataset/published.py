"""The published files: where they are and how to tell that they arrived whole."""

import hashlib
from dataclasses import dataclass
from pathlib import Path

from skinsource.dataset.downloaded_files import (
    MAP_FILES,
    MAP_FOLDER,
    RESPONSES_FILE,
    DownloadedFiles,
)
from skinsource.errors import DatasetError, StorageError

#: Record of the dataset, doi 10.5281/zenodo.10547601.
DATASET_URL = "https://zenodo.org/records/10547601/files"
#: The toolbox's map files at one fixed commit.
MAP_URL = (
    "https://raw.githubusercontent.com/neelitummala/skinsource/"
    "3d3ed8ae97b4854ede92ce9024fa41ca8e330d30/source/visualization"
)
_MAP = (
    (
        "adjacencyMatrix.mat",
        410_849,
        "74372e9291de93a66907f6c74a90ebad933e3b997e2da231981f1e77ab98d0c8",
    ),
    (
        "inputLocations.mat",
        2_232,
        "8bf6797f4ce5d9f7f678eb8cf30b68ee9a2bc88de3d6ae48b25565a50e1dfda6",
    ),
    ("mask1.mat", 1_373, "99a5c89d1051174b6e3190f6a62d1fa66913a1db3d029fdd2584e80c5ef554f8"),
    ("mask2.mat", 1_280, "58e6430af10d22781c1c7f9bd12787a6ea5e9a2b9021afa0795af3d125ccb79b"),
    ("mask3.mat", 1_491, "fba711deaca55fb8548ce2e5364e5296051361dd58e2f51b5526f3e96db5530d"),
    ("mask4.mat", 1_280, "c85efa2fdf7196b12938729c9c8556b7f08690b117ed548172d845e3fc3fb1a4"),
    (
        "outputLocations.mat",
        3_064,
        "1ce8e7e8219eb7289e65bfb7940027fa0ff9bfdc68b06db0359e25a24a0c6988",
    ),
    ("surface.mat", 22_427, "e1e9f22f5f747ce1004b8e935b7737df209a6a13b286f98d3d4abd8b12908e30"),
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
    responses = RemoteFile(
        name=RESPONSES_FILE,
        url=f"{dataset_url}/{RESPONSES_FILE}?download=1",
        size_bytes=69_367_862,
        checksum="md5:9226dcefe3f80809a06376fbaa42ae91",
    )
    maps = (
        RemoteFile(
            name=f"{MAP_FOLDER}/{name}",
            url=f"{map_url}/{name}",
            size_bytes=size,
            checksum=f"sha256:{sha256}",
        )
        for name, size, sha256 in _MAP
    )
    return (*maps, responses)


def checksum_of(path: Path, algorithm: str) -> str:
    """Checksum of a file, as in `RemoteFile.checksum`.

    Raises
    ------
    StorageError
        It cannot be read.
    """
    try:
        with path.open("rb") as opened:
            return f"{algorithm}:{hashlib.file_digest(opened, algorithm).hexdigest()}"
    except OSError as error:
        raise StorageError(
            f"{path}: cannot be read ({error.strerror or error}). Give the folder that holds the "
            "download."
        ) from error


def unpublished_files(found: DownloadedFiles) -> tuple[str, ...]:
    """Published names of those files in a download that are not the published ones."""
    strange = []
    for file in published_files():
        name = file.name.rpartition("/")[2]
        path = found.responses if name == RESPONSES_FILE else found.map_folder / name
        if checksum_of(path, file.checksum.partition(":")[0]) != file.checksum:
            strange.append(name)
    return tuple(strange)


def refuse_unpublished_maps(found: DownloadedFiles, unpublished: tuple[str, ...]) -> None:
    """Raise `DatasetError` if any of the ``unpublished`` files is one of the map's.

    A damaged one moves sensors, and nothing in it tells.
    """
    strange = [name for name in unpublished if name in MAP_FILES]
    if strange:
        raise DatasetError(
            f"{found.map_folder}: not the published content: {', '.join(strange)} (the checksum "
            "differs). The download may be damaged; run 'skinsource dataset fetch' again. If other "
            "files are meant, use 'skinsource dataset install PATH --unpublished'."
        )
