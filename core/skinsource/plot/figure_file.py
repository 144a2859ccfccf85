"""Figures as the content of files: the same drawing gives the same bytes."""

from io import BytesIO
from typing import Any

#: Of pixels; what journals ask for.
DOTS_PER_INCH = 300
#: By kind, what the file says of itself: no clock has a part in it.
METADATA = {
    "png": {"Software": None},
    "svg": {"Date": None, "Creator": "SkinSource studio"},
    "pdf": {"CreationDate": None, "ModDate": None, "Creator": "SkinSource studio"},
}


def figure_content(figure: Any, kind: str) -> bytes:
    """Bytes of a file that holds a figure of this package.

    Parameters
    ----------
    figure
        What `skinsource.plot.map` and the others return.
    kind
        ``"png"``, ``"svg"`` or ``"pdf"``.
    """
    content = BytesIO()
    figure.savefig(content, format=kind, dpi=DOTS_PER_INCH, metadata=METADATA[kind])
    return content.getvalue()
