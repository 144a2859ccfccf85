"""All that belongs to a design in one file, and what to cite."""

from skinsource.packing.citation import citation, data_of
from skinsource.packing.pack import pack

__all__ = ["citation", "data_of", "pack"]
