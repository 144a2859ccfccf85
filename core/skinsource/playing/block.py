"""The next block of samples: all that happens between a mix and the device."""

from time import perf_counter

import numpy as np

from skinsource.arrays import Floats
from skinsource.playing.deck import MOST_SAMPLES, Deck, Swap
from skinsource.playing.ending import Ending
from skinsource.playing.mix import Frames, Mix
from skinsource.playing.output_guard import exceeds_the_rig, playable_samples


def next_block(deck: Deck, out: Frames) -> None:
    """Fill ``out`` with what is played next, and move the deck on.

    Nothing in here waits, and nothing grows: it runs in the thread of the device.  A sample never
    passes full scale: the first that would is not played, and all outputs fall to silence from
    where they are.  Silent once ``deck.ending`` says why.

    Parameters
    ----------
    deck
        What to play.
    out : (n_frames, n_outputs)
        What the device gets, of any length.
    """
    n = out.shape[0]
    for start in range(0, n, MOST_SAMPLES):
        end = min(start + MOST_SAMPLES, n)
        block = deck.work[:, : end - start]
        _fill(deck, block, first=start == 0)
        out[start:end] = block.T
        deck.meters.hear(block, deck.scratch)
    deck.played_samples += n


def _fill(deck: Deck, block: Floats, *, first: bool) -> None:
    if deck.panic and deck.ending is None:
        deck.ending = Ending(reason="panic")
        deck.fallen = 0
    deck.panic = False
    if deck.ending is None:
        _take_what_is_wanted(deck)
        if exceeds_the_rig(deck):
            deck.fallen = 0
            _fall(deck, block)
            return
        if first:
            deck.began_at, deck.began_in = deck.position, deck.mix
        _render(deck, block)
        factors = deck.factors[: block.shape[1]]
        deck.gain.fill(factors)
        np.multiply(block, factors, out=block)
        sound = playable_samples(deck, block)
        if sound < block.shape[1]:
            deck.fallen = 0
            if sound:
                np.copyto(deck.last, block[:, sound - 1])
            _fall(deck, block[:, sound:])
            return
        np.copyto(deck.last, block[:, -1])
        _end_where_all_is_played(deck)
    else:
        _fall(deck, block)


def _take_what_is_wanted(deck: Deck) -> None:
    """Begin to go over to the mix that is wanted, unless one is still on its way."""
    swap = deck.swap
    if swap is None or deck.faded < deck.fade.size:
        return
    deck.swap = None
    deck.old, deck.old_position = deck.mix, deck.position
    deck.mix, deck.faded = swap.mix, 0
    if swap.mix is not None:
        deck.position = _position_in(swap.mix, swap, deck)
        deck.taken_s = perf_counter()
        deck.waited_s = deck.taken_s - swap.handed_s


def _position_in(mix: Mix, swap: Swap, deck: Deck) -> int:
    """Where a mix goes on."""
    if swap.at is None and deck.old is not None:
        inside = mix.loop is None or deck.old_position < mix.loop[1]
        if inside:
            return deck.old_position
    first = mix.loop[0] if mix.loop is not None else 0
    wanted = first if swap.at is None else swap.at
    if mix.loop is not None and wanted >= mix.loop[1]:
        wanted = first
    # What stands before it is faded in, so that the first sample that counts is whole.
    return wanted - deck.fade.size


def _render(deck: Deck, block: Floats) -> None:
    """Samples before the gain."""
    if deck.mix is None:
        block[:] = 0.0
    else:
        deck.position = deck.mix.read(deck.position, block[: deck.mix.n_outputs])
        block[deck.mix.n_outputs :] = 0.0
    n = min(deck.fade.size - deck.faded, block.shape[1])
    if n <= 0:
        return
    old = deck.other[:, :n]
    if deck.old is None:
        old[:] = 0.0
    else:
        deck.old_position = deck.old.read(deck.old_position, old[: deck.old.n_outputs])
        old[deck.old.n_outputs :] = 0.0
    passing = block[:, :n]
    passing -= old
    passing *= deck.fade[deck.faded : deck.faded + n]
    passing += old
    deck.faded += n
    if deck.faded == deck.fade.size:
        deck.old = None


def _fall(deck: Deck, block: Floats) -> None:
    """Go on from the last samples to silence."""
    block[:] = 0.0
    if deck.fallen is None or deck.fallen >= deck.fall.size:
        return
    n = min(deck.fall.size - deck.fallen, block.shape[1])
    np.multiply(
        deck.last[:, np.newaxis], deck.fall[deck.fallen : deck.fallen + n], out=block[:, :n]
    )
    deck.fallen += n


def _end_where_all_is_played(deck: Deck) -> None:
    if deck.faded < deck.fade.size or deck.swap is not None:
        return
    if deck.mix is None:
        deck.ending = Ending(reason="stopped")
    elif deck.mix.loop is None and deck.position >= deck.mix.n_times:
        deck.ending = Ending(reason="end")
