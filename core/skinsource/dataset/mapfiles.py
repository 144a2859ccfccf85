"""The toolbox's map files, checked."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Floats
from skinsource.dataset.downloaded_files import MASK_FILES
from skinsource.dataset.layout import MASK_SHAPES, N_VERTICES
from skinsource.dataset.matfile import read_variable
from skinsource.dataset.pieces import WHAT_TO_DO
from skinsource.errors import DatasetError
from skinsource.limb import N_INPUTS, N_OUTPUTS, VOLAR_OUTPUTS


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MapFiles:
    """What the eight map files hold; coordinates are outline pixels, y up.

    Attributes
    ----------
    outline : (1505, 2)
        Closed polygon.
    output_positions : (72, 2)
        NaN for the six volar outputs.
    input_positions : (20, 2)
    visibility : (1505, 72)
        Distance from outline vertex to output where the one sees the other, else NaN.
    masks
        One per limb, (rows, columns) of 1 mm, row and column 0 at the lowest y and x:
        1 on the skin, 0 elsewhere.
    """

    outline: Floats
    output_positions: Floats
    input_positions: Floats
    visibility: Floats
    masks: tuple[NDArray[np.uint8], ...]


def read_map_files(folder: Path) -> MapFiles:
    """Read and check the map files.

    Raises
    ------
    DatasetError
        A file is not what it should be.
    """
    return MapFiles(
        outline=_outline(folder / "surface.mat"),
        output_positions=_output_positions(folder / "outputLocations.mat"),
        input_positions=_finite(
            folder / "inputLocations.mat", "inputLocations", (N_INPUTS, 2), "inputs, x and y"
        ),
        visibility=_visibility(folder / "adjacencyMatrix.mat"),
        masks=tuple(
            _mask(folder / name, shape) for name, shape in zip(MASK_FILES, MASK_SHAPES, strict=True)
        ),
    )


def _outline(path: Path) -> Floats:
    surface = read_variable(path, "surface")
    try:
        vertices = surface.properties["any"][0, 0]["Vertices"]
    except (AttributeError, KeyError, IndexError, TypeError, ValueError) as error:
        raise DatasetError(
            f"{path.name}: 'surface' is no polyshape with Vertices. Is this the right file? "
            f"{WHAT_TO_DO}"
        ) from error
    outline = _numbers(path, vertices, (N_VERTICES, 2), "vertices, x and y")
    return _refuse_not_finite(path, outline)


def _output_positions(path: Path) -> Floats:
    positions = _numbers(
        path, read_variable(path, "outputLocations"), (N_OUTPUTS, 2), "outputs, x and y"
    )
    volar = np.isin(np.arange(1, N_OUTPUTS + 1), VOLAR_OUTPUTS)
    _refuse_not_finite(path, positions[~volar])
    if not np.isnan(positions[volar]).all():
        raise DatasetError(
            f"{path.name}: gives places to the outputs {VOLAR_OUTPUTS[0]} to {VOLAR_OUTPUTS[-1]}, "
            f"expected NaN: they lie on the other side of the hand. {WHAT_TO_DO}"
        )
    return positions


def _visibility(path: Path) -> Floats:
    distance = _numbers(
        path,
        read_variable(path, "adjacencyMatrix"),
        (N_VERTICES, N_OUTPUTS),
        "vertices, outputs",
    )
    seen = ~np.isnan(distance)
    if np.isinf(distance).any() or (distance[seen] < 0).any() or not seen.any(axis=1).all():
        raise DatasetError(
            f"{path.name}: expected distances of 0 px or more, NaN where a vertex does not see an "
            f"output, and at least one output seen from each vertex. {WHAT_TO_DO}"
        )
    return distance


def _mask(path: Path, shape: tuple[int, int]) -> NDArray[np.uint8]:
    mask = _numbers(path, read_variable(path, "mask"), shape, "rows, columns of 1 mm")
    if not np.isin(mask, (0.0, 1.0)).all():
        raise DatasetError(
            f"{path.name}: expected a mask of zeros and ones, found other values. {WHAT_TO_DO}"
        )
    return mask.astype(np.uint8)


def _finite(path: Path, name: str, shape: tuple[int, ...], axes: str) -> Floats:
    return _refuse_not_finite(path, _numbers(path, read_variable(path, name), shape, axes))


def _numbers(path: Path, value: Any, shape: tuple[int, ...], axes: str) -> Floats:
    array = np.asarray(value)
    if array.shape != shape or array.dtype.kind not in "fiub":
        raise DatasetError(
            f"{path.name}: has shape {array.shape} of {array.dtype}, expected {shape} of double "
            f"({axes}). {WHAT_TO_DO}"
        )
    return np.ascontiguousarray(array, dtype=np.float64)


def _refuse_not_finite(path: Path, array: Floats) -> Floats:
    if not np.isfinite(array).all():
        raise DatasetError(f"{path.name}: expected finite coordinates, found NaN. {WHAT_TO_DO}")
    return array
