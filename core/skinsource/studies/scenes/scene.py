"""What is known of a scene, and what it is once opened."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from skinsource.base.errors import InvalidInputError
from skinsource.base.published import axes_text
from skinsource.base.quoting import quoted, sentence
from skinsource.base.work import counted
from skinsource.design.amplitudes import ARBITRARY_UNIT, amplitude_unit
from skinsource.design.design import Design
from skinsource.design.edits.edit import Refusal
from skinsource.design.edits.setup import change_limb
from skinsource.design.view import View
from skinsource.limbs.dataset.store import NOT_INSTALLED
from skinsource.limbs.limb import LimbFacts
from skinsource.limbs.own_limbs import facts_of, own_map

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


# A scene on another limb than that of the paper, such as one that a lab has imported.
#
# Its places and outputs are not those of the published limbs: the scene is played at places that
# the limb has, and looked at from near to far.  What the paper says of it need not hold there.

# Units of what probes do, at the end of a label.
PROBE_UNITS = ("m/s²", "mm/s")


def reason_against(known: Scene, designs: tuple[Design, ...], view: View, limb: str) -> str:
    """Why a scene does not apply on a limb, in a sentence; empty if it does."""
    facts = facts_of(limb)
    if not facts.known:
        return f"The limb {quoted(limb)} is not here."
    people = len({design.limb for design in designs})
    if people > 1:
        return f"It compares {people} people, and this is one limb."
    if view.axes == "z" and "z" not in facts.axes:
        return f"It is about motion along z, and this limb measures along {axes_text(facts.axes)}."
    beside = dict(dict(view.panels).get("side_by_side", ()))
    if beside.get("of") == "axes" and len(facts.axes) < 2:
        return f"It compares axes, and this limb measures along {axes_text(facts.axes)} alone."
    needed, there = len(_places_of(designs)), len(_mapped_places(facts))
    if needed > there:
        return (
            f"It is played at {counted(needed, 'place')}, and this limb has "
            f"{counted(there, 'place')} on its map."
        )
    return _unplayable(designs, facts)


def opened_on(
    known: Scene, designs: tuple[Design, ...], design: Design, view: View, limb: str
) -> OpenedScene:
    """A scene on a limb.

    Parameters
    ----------
    known, designs
        The scene, and the designs that it compares.
    design, view
        What its file shows.
    limb
        Of any name.

    Raises
    ------
    InvalidInputError
        The scene does not apply there.
    """
    reason = reason_against(known, designs, view, limb)
    if reason:
        raise InvalidInputError(f"the scene {known.name} does not apply on {limb}. {reason}")
    facts = facts_of(limb)
    places = _places_on(_places_of(designs), _mapped_places(facts)) if facts.own else {}
    number = designs[0].limb.partition("-")[2]
    title = known.title.removesuffix(f", limb {number}")
    unit = amplitude_unit(replace(design, limb=limb, limb_digest=facts.digest))
    labels = tuple(
        _label(label, design, places, unit)
        for label, design in zip(known.labels, designs, strict=True)
    )
    inferred = tuple(words.replace("m/s²", unit) for words in known.inferred)
    scene = replace(known, title=title, labels=labels, inferred=inferred)
    note = _note(facts, places, unit)

    def put(design_of_file: Design) -> Design:
        changed = change_limb(design_of_file, view, limb)
        if isinstance(changed, Refusal):
            raise InvalidInputError(changed.sentence)
        inputs = tuple(
            replace(each, location=places.get(each.location, each.location))
            for each in design_of_file.inputs
        )
        label = labels[designs.index(design_of_file)]
        words = f"Fig. {known.name}: {title}{' · ' if label else ''}{label}"
        return replace(changed.design, inputs=inputs, title=words, notes=f"{scene.notes}\n{note}")

    seen = _view_on(view, design, facts, places)
    snapshots = tuple(replace(snapshot, design=put(snapshot.design)) for snapshot in view.snapshots)
    return OpenedScene(
        scene=scene,
        design=put(design),
        view=replace(seen, snapshots=snapshots),
        conditions=tuple(
            Condition(label=label, design=put(design))
            for label, design in zip(labels, designs, strict=True)
        ),
        synthetic=facts.synthetic,
        chosen=note,
    )


def _places_of(designs: tuple[Design, ...]) -> tuple[int, ...]:
    return tuple(dict.fromkeys(track.location for each in designs for track in each.inputs))


def _mapped_places(facts: LimbFacts) -> tuple[int, ...]:
    """Places of a limb that lie on its map."""
    drawn = own_map(facts.name)
    if drawn is None:
        return tuple(range(1, facts.n_inputs + 1))
    there = np.isfinite(drawn.input_positions).all(axis=1)
    return tuple(int(k) + 1 for k in np.flatnonzero(there))


def _places_on(places: tuple[int, ...], candidates: tuple[int, ...]) -> dict[int, int]:
    """Where each place goes: where it is, if there is such a place, else to the first free one."""
    kept = [place for place in places if place in candidates]
    free = iter(place for place in candidates if place not in kept)
    return {place: place if place in kept else next(free) for place in places}


def _unplayable(designs: tuple[Design, ...], facts: LimbFacts) -> str:
    """Why the limb is too slow for what is played; empty if it is not."""
    tried = dict.fromkeys(clip.waveform for design in designs for clip in design.clips)
    for waveform in tried:
        try:
            waveform.samples(facts.sample_rate_hz)
        except InvalidInputError:
            return (
                f"The limb has {facts.sample_rate_hz:g} Hz, which is too slow for what it plays: "
                f"{waveform.title.lower()}."
            )
    return ""


def _view_on(view: View, design: Design, facts: LimbFacts, places: Mapping[int, int]) -> View:
    """The view, at what the limb has: its axes, its delay, its outputs."""
    edit = change_limb(design, view, facts.name)
    view = view if isinstance(edit, Refusal) else edit.view
    if not facts.own:
        return view
    later_s = facts.pre_trigger_delay_s - facts_of(design.limb).pre_trigger_delay_s
    shown = view.time_range_s
    if shown is not None:
        shown = (max(round(shown[0] + later_s, 6), 0.0), round(shown[1] + later_s, 6))
    return replace(
        view,
        outputs=_from_near_to_far(facts, next(iter(places.values())), len(view.outputs)),
        time_range_s=shown,
        playhead_s=max(round(view.playhead_s + later_s, 6), 0.0),
    )


def _from_near_to_far(facts: LimbFacts, place: int, count: int) -> tuple[int, ...]:
    """So many outputs, evenly from the nearest one of a place to the farthest one."""
    drawn = own_map(facts.name)
    numbers = np.arange(1, facts.n_outputs + 1)
    if drawn is not None:
        away = np.linalg.norm(drawn.output_positions - drawn.input_positions[place - 1], axis=1)
        there = np.isfinite(away)
        numbers = numbers[there][np.argsort(away[there], kind="stable")] if there.any() else numbers
    rows = np.unique(np.linspace(0, numbers.size - 1, min(count, numbers.size)).round().astype(int))
    return tuple(int(number) for number in numbers[rows])


def _label(label: str, design: Design, places: Mapping[int, int], unit: str) -> str:
    """What tells a design from the others, with the place that it is played at here.

    No strength is told in m/s² or mm/s where it is not known how the probe moves.
    """
    if unit == ARBITRARY_UNIT and label.endswith(PROBE_UNITS):
        return f"{design.inputs[0].amplitude:.3g} {unit}"
    words, _, number = label.rpartition(" ")
    old = int(number) if words and number.isdecimal() else 0
    return f"Input {places[old]}" if old in places else label


def _note(facts: LimbFacts, places: Mapping[int, int], unit: str) -> str:
    said = f"This is {facts.title}, which need not do what the sentence says"
    if unit == ARBITRARY_UNIT:
        said += ", and in which unit its drive is measured is not known (a.u.)"
    if not facts.own:
        return f"{said}."
    names = [f"{new} in place of {old}" if new != old else f"{new}" for old, new in places.items()]
    word = "place" if len(names) == 1 else "places"
    return f"{said}: played at its {word} {', '.join(names)}; outputs from near to far."
