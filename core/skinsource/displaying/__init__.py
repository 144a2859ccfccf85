"""What a design looks like in a notebook."""

from typing import TYPE_CHECKING

from skinsource.late import late_names

if TYPE_CHECKING:
    from skinsource.displaying.design_html import html_of
else:
    __getattr__, __dir__ = late_names(
        __name__,
        {
            "design_html": "html_of",
        },
    )

__all__ = ["html_of"]
