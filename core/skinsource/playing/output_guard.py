"""What is never played: samples beyond full scale, and more gain than a rig allows.

Nothing is made smaller, which would change the stimulus: playing ends, and says why.
"""

from math import inf, log10

import numpy as np

from skinsource.arrays import Floats
from skinsource.playing.deck import Deck
from skinsource.playing.ending import Ending


def exceeds_the_rig(deck: Deck) -> bool:
    """Whether the gain is more than the rig allows; nothing of it is played then."""
    mix = deck.mix
    if mix is None or max(deck.gain.wanted, deck.gain.now) <= mix.most_gain:
        return False
    most = mix.most_gain
    deck.ending = Ending(
        reason="rig", name=mix.limit, highest_db=20.0 * log10(most) if most else -inf
    )
    return True


def playable_samples(deck: Deck, block: Floats) -> int:
    """Samples before the first that may not be played; sets the ending where there is one."""
    magnitude = deck.other[:, : block.shape[1]]
    np.abs(block, out=magnitude)
    # NaN is the maximum of whatever holds it, and not less than anything.
    if not magnitude.size or magnitude.max() <= 1.0:
        return block.shape[1]
    first = int(np.argmax(~(magnitude <= 1.0).all(axis=0)))
    output = int(np.argmax(~(magnitude[:, first] <= 1.0)))
    peak = float(magnitude[output, first])
    mixes = [one for one in (deck.mix, deck.old) if one is not None]
    names = mixes[0].names if mixes else ()
    largest = max((one.peak for one in mixes), default=peak)
    deck.ending = Ending(
        reason="limit" if np.isfinite(peak) else "broken",
        output=output + 1,
        name=names[output] if output < len(names) else "",
        peak=peak,
        highest_db=-20.0 * log10(largest) if 0.0 < largest < inf else 0.0,
    )
    return first
