"""What is predicted, as files: tables of numbers (CSV) and the whole field (NPZ).

Each file says what it is, how it was computed, and how wrong it can be; none holds the time it was
made, so that the same design gives the same bytes.  Nothing as long as a long response is held.
"""

from skinsource.export.map_files import export_map, export_map_picture
from skinsource.export.tables import export_levels, export_traces
from skinsource.export.whole_field import export_field
from skinsource.export.window_table import export_windows

__all__ = [
    "export_field",
    "export_levels",
    "export_map",
    "export_map_picture",
    "export_traces",
    "export_windows",
]
