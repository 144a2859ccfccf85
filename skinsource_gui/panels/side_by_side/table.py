"""The numbers of maps side by side, for a spreadsheet."""

import numpy as np

from skinsource_gui.panels.side_by_side.content import Cell, Content
from skinsource_gui.widgets.copied_numbers import copied_level


def tab_separated(content: Content) -> str:
    """A row for each output, a column for each map; empty where there is no level."""
    cells = [cell for cell in content.cells if cell.values_db is not None]
    titles = [f"{cell.heading} ({_unit(cell)})" for cell in cells]
    lines = ["\t".join(("output", *titles))]
    values = [np.asarray(cell.values_db) for cell in cells]
    for row in range(max((one.size for one in values), default=0)):
        texts = (copied_level(one[row]) if row < one.size else "" for one in values)
        lines.append("\t".join((str(row + 1), *texts)))
    return "\n".join(lines) + "\n"


def _unit(cell: Cell) -> str:
    if cell.maximum_db is not None:
        return f"dB re its maximum of {copied_level(cell.maximum_db)} dB re 1 m/s²"
    return "" if cell.scale is None else cell.scale.words
