"""Files are read with a limit, and written whole or not at all."""

from skinsource.files.folders import replacing_folder
from skinsource.files.reading import is_file, is_folder, is_there, read_bytes
from skinsource.files.reasons import named
from skinsource.files.writing import make_folder, replacing, write_bytes

__all__ = [
    "is_file",
    "is_folder",
    "is_there",
    "make_folder",
    "named",
    "read_bytes",
    "replacing",
    "replacing_folder",
    "write_bytes",
]
