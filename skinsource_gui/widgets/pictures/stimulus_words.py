"""What is played, in the words that stand below a picture."""

import re
from collections.abc import Sequence

from skinsource.base.work import counted
from skinsource.design.amplitudes import amplitude_text
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, audible_inputs
from skinsource.design.effects import Effect, Envelope, Stretch
from skinsource.design.effects.level import UNCHANGED
from skinsource_gui.widgets.inputs.input_words import duration_text, told_text

# Clips of one input, and inputs, that are told apart; more are counted.
_MOST_CLIPS, _MOST_INPUTS = 3, 6
#: Where a line may end: a number stays with its unit, and a unit is not broken at its slash.
BREAKS = re.compile(r"(?<!\d) | (?![^\W\d]|°)")
# What stands behind a number, or behind a word: a unit, and what parts it from what follows.
_BEHIND = re.compile(r"(?<=\d)(?:\s[^\d]*|[^\w.]*)$|[,;:.()]*$")

#: A design, and what it is called where it is shown.
Named = tuple[str, Design]


def stimulus_words(design: Design) -> str:
    """What is heard, where, how strong."""
    heard = audible_inputs(design.inputs)
    said = [_input_words(one, design) for one in heard[:_MOST_INPUTS]]
    if len(heard) > _MOST_INPUTS:
        said.append(f"and {counted(len(heard) - _MOST_INPUTS, 'more input')}")
    return "; ".join(said) or "Silent: nothing is driven"


def stimuli_words(named: Sequence[Named]) -> str:
    """The stimuli of designs side by side: what they have in common once, what differs of each.

    Where they are made alike, numbers that differ stand beside each other, ``"Tone 50/100 Hz"``,
    in the order of their names; else each is told by itself.
    """
    told = [stimulus_words(design) for _, design in named]
    if len(named) == 1:
        return told[0]
    names = [name for name, _ in named]
    words = [BREAKS.split(one) for one in told]
    if len({len(one) for one in words}) == 1:
        together = " ".join(_beside(column) for column in zip(*words, strict=True))
        return f"{_listed(names)}: {together}"
    return ". ".join(f"{name}: {one}" for name, one in zip(names, told, strict=True))


def common_title(titles: Sequence[str]) -> str:
    """What titles have in common, of their parts between middle dots; empty where it is nothing."""
    parts = [one.split(" · ") for one in titles]
    alike: list[str] = []
    for column in zip(*parts, strict=False):
        if len(set(column)) > 1:
            break
        alike.append(column[0])
    return " · ".join(alike)


def _listed(names: Sequence[str]) -> str:
    """``"Edited, Snapshots 1, 2"``: what the last names begin with is said once."""
    first = names[-1].partition(" ")[0]
    numbers = [one.removeprefix(f"{first} ") for one in names if one.startswith(f"{first} ")]
    before = names[: len(names) - len(numbers)]
    if len(numbers) < 2 or any(one.startswith(f"{first} ") for one in before):
        return ", ".join(names)
    return ", ".join((*before, f"{first}s {', '.join(numbers)}"))


def _beside(words: Sequence[str]) -> str:
    """``"50/100 Hz,"`` of ``"50 Hz,"`` and ``"100 Hz,"``."""
    if len(set(words)) == 1:
        return words[0]
    behind = {_behind(one) for one in words}
    if len(behind) > 1:
        return "/".join(words)
    [last] = behind
    return "/".join(one.removesuffix(last) for one in words) + last


def _behind(word: str) -> str:
    found = _BEHIND.search(word)
    return found[0] if found else ""


def _input_words(one: Input, design: Design) -> str:
    clips = [clip for clip in one.clips if not clip.muted]
    said = [_clip_words(clip) for clip in clips[:_MOST_CLIPS]]
    if len(clips) > _MOST_CLIPS:
        said.append(counted(len(clips) - _MOST_CLIPS, "more clip"))
    curve = f", with a gain curve {_points(one.gain_curve)}" if one.gain_curve else ""
    strength = amplitude_text(design, one)
    return f"Place {one.location}, {strength}{curve}: {', '.join(said) or 'no clips'}"


def _clip_words(clip: Clip) -> str:
    parts = told_text(clip.waveform), duration_text(clip.duration_s)
    onset = f"at {clip.onset_s * 1e3:g} ms" if clip.onset_s else ""
    gain = f"gain {clip.gain:g}" if clip.gain != 1.0 else ""
    effects = _effects_words(clip)
    through = f"through {', '.join(effects)}" if effects else ""
    return " ".join(part for part in (", ".join(parts), onset, gain, through) if part)


def _effects_words(clip: Clip) -> list[str]:
    """What a clip goes through, each in words, in their order."""
    said, lasts_s = [], clip.waveform.duration_s
    for one in clip.effects:
        if one.on and _changes(one):
            said.append(_effect_words(one, lasts_s))
        lasts_s = one.length(lasts_s) if one.on else lasts_s
    return said


def _effect_words(effect: Effect, lasts_s: float) -> str:
    """``"fade"``, ``"an envelope of 12 points"``, ``"stretch ×2"`` of what lasts so long."""
    if isinstance(effect, Envelope):
        return f"an envelope {_points(effect.points)}"
    if isinstance(effect, Stretch):
        kept = " that keeps frequencies" if effect.pitch == "stays" else ""
        return f"stretch ×{effect.factor_of(lasts_s):.3g}{kept}"
    return effect.title.lower()


def _changes(effect: Effect) -> bool:
    return not (isinstance(effect, Envelope) and effect.points == UNCHANGED)


def _points(curve: Sequence[object]) -> str:
    return f"of {counted(len(curve), 'point')}"
