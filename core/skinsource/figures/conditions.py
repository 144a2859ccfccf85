"""What a figure is computed on, and which conditions of the measurement it does not keep."""

from skinsource.choice_words import SCALINGS, limb_word, word_of
from skinsource.evaluation import evaluate
from skinsource.scenes import OpenedScene
from skinsource.validity import Findings
from skinsource.validity.finding import words_of


def setup_words(opened: OpenedScene) -> str:
    """Limbs and scaling, as a sentence or two."""
    scaling = word_of(SCALINGS, opened.design.scaling).title
    return (
        f"Limb: {', '.join(limb_word(one).title for one in limbs_of(opened))}. Scaling: {scaling}."
    )


def left_words(opened: OpenedScene) -> str:
    """Which conditions of the measurement are not kept; "" where all are."""
    found = [one for _, findings in _findings(opened) for one in findings]
    # That a limb is synthetic is said by itself, and larger.
    left = dict.fromkeys(one.name for one in found if one.state == "left" and one.name != "limb")
    words = "Conditions of the measurement that are not kept (see the table)"
    return f"{words}: {', '.join(left)}." if left else ""


def condition_lines(opened: OpenedScene) -> list[str]:
    """A line for each condition that a design does not keep, with the designs that do not."""
    by_line: dict[str, list[str]] = {}
    for label, findings in _findings(opened):
        for line in words_of(findings):
            by_line.setdefault(line, []).append(label)
    every = len(opened.conditions)
    return [
        line if len(labels) == every else f"{', '.join(labels)}: {line}"
        for line, labels in by_line.items()
    ]


def limbs_of(opened: OpenedScene) -> tuple[str, ...]:
    """Names of the limbs of a scene, each once."""
    return tuple(dict.fromkeys(one.design.limb for one in opened.conditions))


def _findings(opened: OpenedScene) -> list[tuple[str, Findings]]:
    return [
        (one.label, evaluate(one.design, "validity", view=opened.view)["validity"])
        for one in opened.conditions
    ]
