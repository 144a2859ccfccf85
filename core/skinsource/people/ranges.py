"""Levels of a design on the hand of somebody who was not measured: a range between people."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from skinsource.base.arguments import checking
from skinsource.base.conventions import Floats, axes_of, axes_text
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.design.comparing import NO_RANGE, half_width_db, related_limbs
from skinsource.design.design import Design, Input, View, audible_inputs
from skinsource.engine.graph import Graph
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.limb import PUBLISHED, Limb
from skinsource.people.carrying import carried
from skinsource.people.others import check_same_places, hand_outputs, people_of
from skinsource.people.partial_limb import PartialLimb


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Range:
    """Levels to expect of somebody who was not measured, and those of the people who were.

    Attributes
    ----------
    names
        Of the people.
    people_db : (n_people, n_outputs)
        Their levels, dB re 1 m/s².
    mean_db, low_db, high_db : (n_outputs,)
        Mean, and ends of the range; the same where the person's own level is known.
    """

    names: tuple[str, ...]
    people_db: Floats
    mean_db: Floats
    low_db: Floats
    high_db: Floats

    def __repr__(self) -> str:
        return f"<Range between {', '.join(self.names)}: {len(self.mean_db)} outputs>"


@checking
def levels(
    design: Design,
    view: View | None = None,
    *,
    limbs: Sequence[Limb | str] | None = None,
    own: PartialLimb | None = None,
) -> Range:
    """Return the levels of a design on the hand of somebody who was not measured.

    The range is ``±1.645 s √(1 + 1/n)`` about the mean of n people; s² is the variance between
    them of this design, pooled over the hand.  It is no confidence band: `RANGE_BETWEEN_PEOPLE`.

    Parameters
    ----------
    design
        What plays; its limb does not matter.
    view
        Axes, method and span of the levels; by default ``View()``.
    limbs
        Limbs of the people, or their names, two or more; None: all measured ones, without the one
        that ``own`` was cut out of.
    own
        What was measured of the person: it draws the range in, on the hand.  Takes some seconds
        for each input.

    Raises
    ------
    InvalidInputError
        The people are too few or have other places; or ``own`` was given, and was not measured
        from a place that plays or along an axis of the view, or the scaling is "upstream", which
        needs all outputs of a person.
    DatasetMissingError
        The measured dataset is needed, and not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
    >>> found = ss.people.levels(design, limbs=["synthetic-1", "synthetic-2", "synthetic-3"])
    >>> found.people_db.shape
    (3, 72)
    """
    people = people_of(limbs, 2, but="" if own is None else own.person)
    return People(people, View() if view is None else view).range_of(design, own)


def people_like(limb: str) -> tuple[str, ...]:
    """Return the names of the people whose range a design on a limb has: those of its kind.

    Raises
    ------
    InvalidInputError
        The limb is no published one.
    """
    if limb not in PUBLISHED:
        raise InvalidInputError(f"{NO_RANGE} Leave it out, or choose another than {quoted(limb)}.")
    return related_limbs(limb)


class People:
    """Several people, of whom levels are computed again only where a design changes them."""

    def __init__(self, people: Sequence[Limb], view: View) -> None:
        self._players = [_Player(limb, view) for limb in people]

    def range_of(self, design: Design, own: PartialLimb | None = None) -> Range:
        """Return the range of a design, see `levels`."""
        people = [player.limb for player in self._players]
        people_db = np.stack([player.levels_db(design) for player in self._players])
        hand = np.array(hand_outputs(people[0])) - 1
        mean_db: Floats = people_db.mean(axis=0)
        half_db: Floats = np.full(people_db.shape[1], half_width_db(people_db[:, hand]))
        if own is not None:
            check_same_places(own.limb, people[0])
            mean_db, half_db = _drawn_in(design, own, self._players, mean_db, half_db)
        return Range(
            names=tuple(limb.name for limb in people),
            people_db=people_db,
            mean_db=mean_db,
            low_db=mean_db - half_db,
            high_db=mean_db + half_db,
        )


class _Player:
    """Plays designs on a limb."""

    def __init__(self, limb: Limb, view: View) -> None:
        self.limb, self.view = limb, view
        self.graph: Graph = new_graph()

    def levels_db(self, design: Design) -> Floats:
        """Return the levels of a design, (n_outputs,)."""
        there = replace(design, limb=self.limb.name, limb_digest="")
        given = {**sources(there, self.view), "limb_data": self.limb}
        values: Floats = self.graph.evaluate(("output_levels_db",), given)["output_levels_db"]
        return values

    def levels_from(self, design: Design, track: Input, places: Sequence[int]) -> Floats:
        """Return the levels of one input, were it at each of some places, (n_outputs, n_places)."""
        moved = [replace(design, inputs=(replace(track, location=place),)) for place in places]
        return np.stack([self.levels_db(each) for each in moved], axis=1)


def _drawn_in(
    design: Design, own: PartialLimb, players: Sequence[_Player], mean_db: Floats, half_db: Floats
) -> tuple[Floats, Floats]:
    """Return mean and half width, changed by what was measured of the person."""
    tracks, limb, view = audible_inputs(design.inputs), players[0].limb, players[0].view
    unmeasured = {track.location for track in tracks} - {*own.inputs}
    beyond = {*axes_of(limb.axes, view.axes)} - {*own.axes}
    if unmeasured or beyond or design.scaling == "upstream":
        cause = "The scaling 'upstream' needs all outputs of a person"
        if beyond:
            cause = f"{own.person} was measured along {axes_text(own.axes)} alone"
        if unmeasured:
            cause = f"{own.person} was not measured from place {min(unmeasured)}"
        raise InvalidInputError(f"{cause}. Change the design or its view, or leave own out.")
    player = _Player(own.limb, view)
    measured = np.array(own.outputs) - 1
    hand = np.array(sorted({*hand_outputs(limb), *own.outputs})) - 1
    rows = np.searchsorted(hand, measured).tolist()
    everywhere = range(1, limb.n_inputs + 1)
    columns = [place - 1 for place in own.inputs]
    energies, differences, remaining = [], [], []
    for track in tracks:
        theirs_db = np.stack([each.levels_from(design, track, everywhere) for each in players])
        own_db = player.levels_from(design, track, own.inputs)[measured]
        likeliest_db, remains = carried(theirs_db[:, hand], own_db, rows, columns)
        column = track.location - 1
        usual_db = theirs_db[:, hand, column].mean(axis=0)
        energies.append(10.0 ** (usual_db / 10.0))
        differences.append(likeliest_db[:, column] - usual_db)
        remaining.append(remains[:, column])
    shares = np.stack(energies) / np.sum(energies, axis=0)
    mean_db[hand] += (shares * differences).sum(axis=0)
    half_db[hand] *= (shares * remaining).sum(axis=0)
    mean_db[measured], half_db[measured] = player.levels_db(design)[measured], 0.0
    return mean_db, half_db
