"""What a figure is computed on, and which conditions of the measurement it does not keep."""

from skinsource.choice_words import SCALINGS, limb_word, word_of
from skinsource.evaluation import evaluate
from skinsource.scenes import OpenedScene
from skinsource.validity.judged import Judged, in_full


def setup_words(opened: OpenedScene) -> str:
    """Limbs and scaling, as a sentence or two."""
    scaling = word_of(SCALINGS, opened.design.scaling).title
    return (
        f"Limb: {', '.join(limb_word(one).title for one in limbs_of(opened))}. Scaling: {scaling}."
    )


def left_words(opened: OpenedScene, *, maps: bool) -> str:
    """Which conditions of the measurement are not kept; "" where all are.

    ``maps``: whether the figure shows some.  What lies between outputs matters to nothing else.
    """
    found = [one for judged in _judged(opened, maps=maps) for one in judged.findings or ()]
    # That a limb is synthetic is said by itself, and larger.
    left = dict.fromkeys(one.name for one in found if one.state == "left" and one.name != "limb")
    words = "Conditions of the measurement that are not kept (see the table)"
    return f"{words}: {', '.join(left)}." if left else ""


def condition_lines(opened: OpenedScene, *, maps: bool) -> tuple[str, ...]:
    """A line for each condition that a design does not keep, with the designs that do not."""
    return in_full(_judged(opened, maps=maps))


def limbs_of(opened: OpenedScene) -> tuple[str, ...]:
    """Names of the limbs of a scene, each once."""
    return tuple(dict.fromkeys(one.design.limb for one in opened.conditions))


def _judged(opened: OpenedScene, *, maps: bool) -> list[Judged]:
    found = [
        Judged(
            label=one.label,
            findings=evaluate(one.design, "validity", view=opened.view)["validity"],
        )
        for one in opened.conditions
    ]
    return found if maps else [one.without_maps() for one in found]
