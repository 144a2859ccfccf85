"""What is played of a document."""

from skinsource.design.comparing import louder
from skinsource.design.design import Design
from skinsource_gui.state.document import Document


def played_of(document: Document) -> Design:
    """The design, as loud as the skin is shown: with the gain by which snapshots match."""
    return louder(document.design, document.view.match_gain(document.design))
