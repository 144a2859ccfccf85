"""A scene as it was when it was presented, to tell whether it was changed meanwhile."""

from dataclasses import dataclass

from skinsource.design.design import Design
from skinsource_gui.state.document import Document


@dataclass(frozen=True, slots=True)
class WholeScene:
    """A design, and those of the snapshots beside it by their numbers: levels match by themselves.

    Attributes
    ----------
    design, snapshots
        As they were.
    title
        What scene or file is called.
    """

    design: Design
    snapshots: dict[int, Design]
    title: str

    @classmethod
    def of(cls, document: Document) -> "WholeScene":
        """What is open now."""
        snapshots = {one.number: one.design for one in document.view.snapshots}
        file = "" if document.path is None else document.path.stem
        return cls(document.design, snapshots, document.scene or file)

    def left(self, document: Document) -> str:
        """What is said as it is left, if it has changes that no file holds."""
        if not document.modified or self == WholeScene.of(document):
            return ""
        return f"; changes to {self.title.partition(' · ')[0]} are not kept"
