"""Limbs of a lab's own: from its files to one that the studio knows.

Foreign files are read by the child process of `skinsource.recordings`; what becomes of the numbers
is decided here.
"""

from skinsource.limb_import.importing import LimbSource, import_limb, prepared, read_points
from skinsource.limb_import.layout import export_limb

__all__ = ["LimbSource", "export_limb", "import_limb", "prepared", "read_points"]
