"""All that belongs to a design in one file, and what to cite."""

from skinsource.packing.data_citation import citation, data_of
from skinsource.packing.design_pack import pack

__all__ = ["citation", "data_of", "pack"]
