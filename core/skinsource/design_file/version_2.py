"""Trees of version 2: what studios wrote on 22 November 2026.

An input was one waveform then, and an onset the nearest sample: it is read as the rounded one that
was meant, so that the numbers stay as they were.  All else was as it is now, or takes its default.
"""

from typing import Any

from skinsource.errors import FileFormatError
from skinsource.fields import Tree
from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.quoting import printable
from skinsource.signals import sample_count

VERSION = 2
_INPUT_FIELDS = frozenset(
    {"kind", "location", "waveform", "amplitude", "onset_s", "muted", "solo", "colour", "id"}
)
_LATEST_ONSET_S = 600.0


def as_now(tree: Tree) -> Tree:
    """Return the tree of a `DesignFile` of now for one of version 2.

    What is not as version 2 wrote it stays, for the codec to refuse.

    Raises
    ------
    FileFormatError
        An input holds what no input of version 2 held.
    """
    design = tree.get("design") if isinstance(tree, dict) else None
    if not isinstance(design, dict) or not isinstance(design.get("inputs"), list):
        return tree
    inputs = design["inputs"]
    # What new designs start in is another one now.
    after = {
        "scaling": "upstream",
        **design,
        "inputs": [_as_track(one, k) for k, one in enumerate(inputs)],
    }
    return {**tree, "design": after}


def meant_onset_s(onset_s: float) -> float:
    """The onset that was heard: that of the nearest sample of the limbs that there were."""
    return sample_count(onset_s) / SAMPLE_RATE_HZ


def _as_track(tree: Tree, index: int) -> Tree:
    if not isinstance(tree, dict):
        return tree
    unknown = sorted(set(tree) - _INPUT_FIELDS)
    if unknown:
        raise FileFormatError(
            f"design/inputs/{index} holds {printable(', '.join(unknown[:10]))}, which version "
            f"{VERSION} of the format did not know. The content is damaged; go back to an earlier "
            "copy."
        )
    track = dict(tree)
    clip: dict[str, Any] = {"kind": "Clip"}
    if "onset_s" in track:
        clip["onset_s"] = _meant(track.pop("onset_s"))
    if "waveform" in track:
        clip["waveform"] = track.pop("waveform")
    return {**track, "clips": [clip]}


def _meant(onset_s: Any) -> Any:
    is_number = isinstance(onset_s, int | float) and not isinstance(onset_s, bool)
    if not is_number or not 0.0 <= onset_s <= _LATEST_ONSET_S:
        return onset_s
    return meant_onset_s(float(onset_s))
