"""What makes the wavelets of a train alike."""

from collections.abc import Sequence
from dataclasses import replace
from math import isfinite

from skinsource.clips.clip import LABEL
from skinsource.design import Design
from skinsource.edits.edit import Edit, Refusal, changed, place_words
from skinsource.errors import InvalidInputError
from skinsource.quoting import sentence
from skinsource.view import View
from skinsource.waveforms import WaveletTrain
from skinsource.waveforms.wavelet_train import SOFTEST_DB

#: How the note in a label begins, so that the next one takes its place.
NOTED = "Equal on the skin: "
_BETWEEN = " · "


def equalise_on_skin(
    design: Design, view: View, clip_id: int, levels_db: Sequence[float], measure: str
) -> Edit | Refusal:
    """Give each wavelet of a train the gain with which all arrive alike.

    The softest one keeps its drive, and the others are lowered to it.  The label of the clip notes
    the limb, the place and the measure: elsewhere, and by other measures, they differ.

    Parameters
    ----------
    clip_id
        The clip, which plays a `WaveletTrain`.
    levels_db
        Level of each wavelet without its gain, see `skinsource.levelling.wavelet_levels_db`.
    measure
        What that is the level of, in words.
    """
    try:
        clip, track = design.clip(clip_id), design.track_of(clip_id)
    except InvalidInputError as error:
        return Refusal(sentence=sentence(str(error)))
    train = clip.waveform
    if not isinstance(train, WaveletTrain) or len(levels_db) != len(train.frequencies_hz):
        return Refusal(sentence="The clip does not play that wavelet train any more; try again.")
    softest_db = min(levels_db)
    if not all(map(isfinite, levels_db)) or max(levels_db) - softest_db > -SOFTEST_DB:
        worst_hz = train.frequencies_hz[list(levels_db).index(softest_db)]
        return Refusal(
            sentence=f"The wavelet of {worst_hz:g} Hz moves nothing on the skin, so none can be "
            "made like it; take it out, or choose another place."
        )
    # A hundredth of a dB is less than anything that can be felt or set; -0.0 would be odd.
    gains_db = tuple(round(softest_db - one, 2) + 0.0 for one in levels_db)
    note = f"{NOTED}{measure}, {design.limb}, {place_words(track.location, design.limb)}"
    kept = [words for words in clip.label.split(_BETWEEN) if words and not words.startswith(NOTED)]
    label = _BETWEEN.join((*kept, note))
    change = {
        "waveform": replace(train, gains_db=gains_db),
        "label": label if len(label) <= LABEL.longest else note[: LABEL.longest],
    }
    return changed(design, view, "Equalise wavelets of", {track.id: {}}, {clip_id: change})
