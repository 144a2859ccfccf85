"""The table of impulse responses, checked row by row."""

import hashlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Floats
from skinsource.counting import counted
from skinsource.dataset.matfile import read_variable
from skinsource.dataset.pieces import WHAT_TO_DO
from skinsource.errors import DatasetError
from skinsource.job import Progress, Stop, stop_if
from skinsource.limb import N_AXES, N_INPUTS, N_OUTPUTS, N_TAPS

TABLE = "dataTable"
COLUMNS = ("Data", "Model", "Location")
N_LIMBS = 4
N_ROWS = N_LIMBS * N_INPUTS
SHAPE = (N_TAPS, N_OUTPUTS, N_AXES)

#: (limb, input location), both from 1, to impulse responses (72 outputs, 3 axes, 522 taps).
Responses = dict[tuple[int, int], Floats]


def read_responses(path: Path, progress: Progress, stop: Stop) -> Responses:
    """Read and check ``impulseResponses.mat``, in either MATLAB encoding.

    Returns
    -------
    dict
        (limb, input location) to views of shape (72 outputs, 3 axes, 522 taps), in m/s².

    Raises
    ------
    DatasetError
        The file or a row is not what it should be.
    """
    return check_table(read_variable(path, TABLE), path.name, progress, stop)


def check_table(table: Any, file_name: str, progress: Progress, stop: Stop) -> Responses:
    """Check every row of the table: numbers, shape, finiteness, and that each limb is complete."""
    absent = [column for column in COLUMNS if column not in getattr(table, "columns", ())]
    if absent:
        raise DatasetError(
            f"{file_name}: {TABLE} has no column {', '.join(absent)}; expected a table with the "
            f"columns {', '.join(COLUMNS)}. Is this the right file? {WHAT_TO_DO}"
        )
    responses: Responses = {}
    # Two measurements are never the same in every digit: one was put in place of the other.
    earlier: dict[bytes, str] = {}
    rows = zip(*(table[column] for column in COLUMNS), strict=True)
    for number, (data, model, location) in enumerate(rows, start=1):
        stop_if(stop, "Installing was stopped; nothing was changed.")
        where = f"{file_name}: row {number}"
        limb = _whole_number(model, N_LIMBS, f"{where} has Model")
        place = _whole_number(location, N_INPUTS, f"{where} has Location")
        where = f"{where} (model {limb}, location {place})"
        if (limb, place) in responses:
            raise DatasetError(
                f"{where} repeats an earlier row, expected each model and location once. "
                f"{WHAT_TO_DO}"
            )
        responses[limb, place] = response = _response(data, where)
        twin = earlier.setdefault(hashlib.sha256(response.tobytes()).digest(), where)
        if twin != where and response.any():
            raise DatasetError(
                f"{where} holds the values of {twin.removeprefix(f'{file_name}: ')}, expected its "
                f"own. {WHAT_TO_DO}"
            )
        progress(number, N_ROWS, f"Checking limb {limb}, input {place}")
    _refuse_gaps(responses, file_name)
    return responses


def _response(data: Any, where: str) -> Floats:
    array = np.asarray(data)
    if array.shape != SHAPE:
        raise DatasetError(
            f"{where} has shape {array.shape}, expected {SHAPE} (taps, outputs, axes). {WHAT_TO_DO}"
        )
    if array.dtype.kind != "f":
        raise DatasetError(
            f"{where} holds values of type {array.dtype}, expected double. {WHAT_TO_DO}"
        )
    finite = np.isfinite(array)
    if not finite.all():
        tap, output, axis = (int(k) + 1 for k in np.argwhere(~finite)[0])
        strange = counted(int(np.count_nonzero(~finite)), "value")
        raise DatasetError(
            f"{where} holds {strange} not finite, the first at "
            f"tap {tap}, output {output}, axis {axis}; expected finite numbers only. {WHAT_TO_DO}"
        )
    return _real(array).transpose(1, 2, 0)


def _real(array: NDArray[Any]) -> Floats:
    return array.astype(np.float64, copy=False)


def _whole_number(value: Any, highest: int, what: str) -> int:
    array = np.asarray(value)
    if array.size == 1 and array.dtype.kind in "fiu":
        number = array.item()
        if 1 <= number <= highest and number == int(number):
            return int(number)
    raise DatasetError(f"{what} {value!s}, expected a whole number 1 to {highest}. {WHAT_TO_DO}")


def _refuse_gaps(responses: Responses, file_name: str) -> None:
    expected = ((limb, place) for limb in range(1, 5) for place in range(1, N_INPUTS + 1))
    missing = [pair for pair in expected if pair not in responses]
    if missing:
        limb, place = missing[0]
        raise DatasetError(
            f"{file_name}: has {len(responses)} of {N_ROWS} rows, the first missing one is model "
            f"{limb}, location {place}; expected one row for each of the models 1 to {N_LIMBS} "
            f"and the locations 1 to {N_INPUTS}. {WHAT_TO_DO}"
        )
