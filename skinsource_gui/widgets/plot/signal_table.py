"""The numbers of a plot as a table."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from skinsource.base.decibels import in_tables
from skinsource.base.job import never
from skinsource.export.exported_design import output_file
from skinsource.export.tables import CsvTable
from skinsource_gui.widgets.plot.plot import Plot
from skinsource_gui.widgets.plot.ranges import Kind

_UNITS: dict[Kind, str] = {
    "amplitude": "m_per_s2",
    "level": "db_re_1_m_per_s2",
    "relative": "of_its_peak",
}


def save_table(path: Path, plot: Plot, title: str, lines: Sequence[str] = ()) -> None:
    """Write the curves of ``plot``: all samples, in SI, whatever is zoomed to.

    ``lines`` are what else is to be known of them; nothing is said twice.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    curves = plot.curves
    if curves is None:
        return
    unit = _UNITS[curves.kind]
    axis = plot.x_window.axis
    about = ["SkinSource studio", title, axis.titles[0]]
    about.extend(curves.about())
    if curves.peaks:
        pairs = zip(curves.names, curves.peaks, strict=True)
        about.append(
            f"peaks in m/s²: {', '.join(f'{one.number}: {peak!r}' for one, peak in pairs)}"
        )
    about.extend(line for line in lines if line not in about)
    if plot.words.synthetic:
        about.insert(1, "SYNTHETIC LIMB: computed responses, not measured ones")
    own = curves.columns or tuple(
        f"output_{name.number}{axis and f'_{axis}'}_{unit}"
        for name in curves.names
        for axis in curves.axes or ("",)
    )
    header = [axis.column, *own]
    y = in_tables(curves.y) if curves.kind == "level" else curves.y
    with output_file(path, never) as file:
        CsvTable(file, about, header, never).add(np.vstack((curves.x, y)).T)
