"""Maps of one surface, one after the other in a PDF, each in its own colours."""

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter, QPdfWriter

from skinsource_gui.plots.colour_maps import colour_table
from skinsource_gui.plots.small_map import FieldImage
from tests.gui.pages_of_paper import Paper


def test_maps_that_share_a_surface_are_as_many_pictures_in_a_pdf(qapp, tmp_path):
    spacing = np.arange(5.0, 25.0)
    field = FieldImage(np.ones((20, 20), bool), spacing, spacing, px_per_mm=2.0)
    falling, rising = np.full((20, 20), 10.0), np.full((20, 20), 30.0)
    writer = QPdfWriter(str(tmp_path / "maps.pdf"))
    painter = QPainter(writer)
    table = colour_table()
    for rank, levels in enumerate((falling, rising, rising)):
        place = QRectF(200.0 * rank, 0.0, 150.0, 150.0)
        painter.drawImage(place, field.image(levels, (0.0, 40.0), table))
    painter.end()
    # What is drawn twice is kept once.
    assert len(Paper(tmp_path / "maps.pdf").images()) == 2
