"""All that belongs to a design in one file, and what to cite."""

from typing import TYPE_CHECKING

from skinsource.late import late_names

if TYPE_CHECKING:
    from skinsource.packing.data_citation import citation, data_of
    from skinsource.packing.design_pack import pack
else:
    __getattr__, __dir__ = late_names(
        __name__,
        {
            "data_citation": "citation data_of",
            "design_pack": "pack",
        },
    )

__all__ = ["citation", "data_of", "pack"]
