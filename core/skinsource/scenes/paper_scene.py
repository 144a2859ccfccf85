"""What is known of a scene, and what it is once opened."""

from dataclasses import dataclass

from skinsource.dataset.not_installed import NOT_INSTALLED
from skinsource.design import Design
from skinsource.quoting import sentence
from skinsource.view import View

#: What the figures of all scenes are taken from.
PAPER = "Tummala et al. (2024), SkinSource"


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """A panel of a figure of the paper that can be computed.

    Attributes
    ----------
    name
        Of the panel: ``"2F"``.
    title
        What it is called, in a few words.
    sentence
        What it shows.
    inferred
        Parts that the paper does not state and that are a choice of this studio, each in a few
        words; none: all is stated.
    labels
        Of the designs that it compares, in their order; one where it compares nothing.
    arrangement, panels
        Arrangement of the window that shows it, and the panels that are brought in sight there.
    """

    name: str
    title: str
    sentence: str
    inferred: tuple[str, ...] = ()
    labels: tuple[str, ...] = ("",)
    arrangement: str = "analysis"
    panels: tuple[str, ...] = ("skin",)

    @property
    def source(self) -> str:
        """Where it comes from: paper and figure."""
        return f"{PAPER}, Fig. {self.name}"

    @property
    def heading(self) -> str:
        """Name and title in one line."""
        return f"{self.name} · {self.title}"

    @property
    def notes(self) -> str:
        """Sentence, source, and what is inferred, as a design carries them."""
        lines = [self.sentence, f"Source: {self.source}."]
        if self.inferred:
            lines.append(sentence(f"Inferred: {'; '.join(self.inferred)}"))
        return "\n".join(lines)


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """One of the designs that a scene compares.

    Attributes
    ----------
    label
        What tells it from the others; empty where there are none.
    design
        What is played, and on which limb.
    """

    label: str
    design: Design


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenedScene:
    """A scene, on limbs that are there.

    Attributes
    ----------
    scene
        What is known of it.
    design, view
        As its file holds them, on the limbs that can be used: what a window opens.
    conditions
        Its designs, in the order of the figure.
    synthetic
        Whether synthetic limbs stand in for measured ones.
    chosen
        Of a limb that was chosen for it, what must be said; empty: it is on those of the paper.
    """

    scene: Scene
    design: Design
    view: View
    conditions: tuple[Condition, ...]
    synthetic: bool
    chosen: str = ""

    @property
    def note(self) -> str:
        """What must be said beside it; empty where the limbs are those of the paper."""
        if self.chosen or not self.synthetic:
            return self.chosen
        return (
            f"{NOT_INSTALLED} This is computed on a SYNTHETIC limb, which need not do what the "
            "sentence says."
        )
