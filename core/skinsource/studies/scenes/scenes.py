"""Scenes: their catalog and files, how they are opened, and what they show on the open limb.

A limb that a lab has imported has other places and outputs than the published ones: the scene is
played at places that the limb has, and shown at outputs from near to far.  The sentence of the
paper need not hold there, so that one with numbers that are computed there follows it.
"""

import re
import tomllib
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from skinsource.base.arguments import checking
from skinsource.base.assets import data_folder
from skinsource.base.conventions import Floats, axes_text
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, SkinSourceError, counted, quoted, sentence
from skinsource.design.amplitudes import ARBITRARY_UNIT, amplitude_unit
from skinsource.design.design import Design, MotionGroup, View
from skinsource.design.design_file import SUFFIX, DesignFile, open_design
from skinsource.design.edits.edit import Refusal
from skinsource.design.edits.setup import change_limb
from skinsource.design.target import target_in
from skinsource.engine.evaluation import evaluate
from skinsource.limbs.catalog import available_limbs
from skinsource.limbs.dataset.store import NOT_INSTALLED
from skinsource.limbs.limb import PUBLISHED, LimbFacts
from skinsource.limbs.own_limbs import facts_of, own_map
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.signals.analysis.wave_speed import arrivals
from skinsource.studies.checking import straightness, superposition
from skinsource.studies.scenes.wanted import WANTED, Wanted

#: Source of the figures of the paper, and of the scenes that are none.
PAPER, INVERSE = "Tummala et al. (2024), SkinSource", "SkinSource studio, inverse design"


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """A panel of a figure of the paper that can be computed, or what inverse design does.

    Attributes
    ----------
    name
        Name of the panel: ``"2F"``; of several of one panel with a number: ``"5B-2"``; of inverse
        design: ``"I1"``.
    title
        Title of a few words.
    sentence
        Sentence on what it shows.
    inferred
        Parts that the paper does not state and that this studio chose, each in a few words; empty:
        all is stated.
    labels
        Labels of the designs that it compares, in their order; one where it compares nothing.
    arrangement, panels
        The workspace in which it opens, and the panels that show it there.
    measured
        What the paper measured, beside which the prediction is to be seen; may be empty.
    to_try
        What to try with it.
    of_paper
        Whether it is a panel of the paper; else its drives are found on the limb where it opens.
    """

    name: str
    title: str
    sentence: str
    inferred: tuple[str, ...] = ()
    labels: tuple[str, ...] = ("",)
    arrangement: str = "presentation"
    panels: tuple[str, ...] = ("stage",)
    measured: str = ""
    to_try: str = ""
    of_paper: bool = True

    @property
    def source(self) -> str:
        """Paper and figure, or that it is of inverse design."""
        return f"{PAPER}, Fig. {self.name.partition('-')[0]}" if self.of_paper else INVERSE

    @property
    def full_title(self) -> str:
        """Title of its designs, before their labels."""
        return f"{'Fig.' if self.of_paper else 'Scene'} {self.name}: {self.title}"

    @property
    def heading(self) -> str:
        """Name and title in one line."""
        return f"{self.name} · {self.title}"

    @property
    def notes(self) -> str:
        """Words beside it, source and inferred parts, as the notes of a design."""
        words = " ".join(filter(None, (self.sentence, self.measured, self.to_try)))
        lines = [words, f"Source: {self.source}."]
        if self.inferred:
            lines.append(sentence(f"Inferred: {'; '.join(self.inferred)}"))
        return "\n".join(lines)


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """One of the designs that a scene compares.

    Attributes
    ----------
    label
        Difference to the others; empty where there are none.
    design
        The design, with its limb.
    """

    label: str
    design: Design


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenedScene:
    """A scene on limbs that are available.

    Attributes
    ----------
    scene
        Its description.
    design, view
        Design and view of its file, on limbs that are available: the content of a window.
    conditions
        Its designs, in the order of the figure.
    synthetic
        Whether synthetic limbs replace measured ones.
    chosen
        Note on a limb that was chosen for it; empty: it is on the limbs of the paper.
    """

    scene: Scene
    design: Design
    view: View
    conditions: tuple[Condition, ...]
    synthetic: bool
    chosen: str = ""

    @property
    def note(self) -> str:
        """Note for its readers; empty where the limbs are those of the paper."""
        if self.chosen or not self.synthetic:
            return self.chosen
        return (
            f"{NOT_INSTALLED} This is computed on a SYNTHETIC limb, which may not show what the "
            "sentence says."
        )


def with_designs(opened: OpenedScene, change: Callable[[Design], Design]) -> OpenedScene:
    """Return a scene with each of its designs changed."""
    snapshots = (replace(each, design=change(each.design)) for each in opened.view.snapshots)
    return replace(
        opened,
        design=change(opened.design),
        view=replace(opened.view, snapshots=tuple(snapshots)),
        conditions=tuple(replace(each, design=change(each.design)) for each in opened.conditions),
    )


# Units of the motion of probes, at the end of a label.
PROBE_UNITS = ("m/s²", "mm/s")


def reason_against(designs: tuple[Design, ...], view: View, limb: str) -> str:
    """Return why a scene with these designs does not apply on a limb; empty if it does."""
    facts = facts_of(limb)
    if not facts.known:
        return f"The limb {quoted(limb)} is not here."
    people = len({design.limb for design in designs})
    if people > 1:
        return f"It compares {people} people, and this is one limb."
    if view.axes == "z" and "z" not in facts.axes:
        return f"It is about motion along z, and this limb measures along {axes_text(facts.axes)}."
    comparison = dict(dict(view.panels).get("compare", ()))
    if comparison.get("of") == "axes" and len(facts.axes) < 2:
        return f"It compares axes, and this limb measures along {axes_text(facts.axes)} alone."
    if facts.own and not _places_of(designs):
        return "It is about outputs of the published limbs."
    n_played, n_mapped = len(_places_of(designs)), len(_mapped_places(facts))
    if n_played > n_mapped:
        return (
            f"It is played at {counted(n_played, 'place')}, and this limb has "
            f"{counted(n_mapped, 'place')} on its map."
        )
    return _unplayable(designs, facts)


def opened_on(opened: OpenedScene, limb: str) -> OpenedScene:
    """Return a scene, given as its file has it, on a limb.

    Raises
    ------
    InvalidInputError
        The scene does not apply there.
    """
    known, design, view = opened.scene, opened.design, opened.view
    designs = tuple(condition.design for condition in opened.conditions)
    reason = reason_against(designs, view, limb)
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
    inferred = tuple(part.replace("m/s²", unit) for part in known.inferred)
    scene = replace(known, title=title, labels=labels, inferred=inferred)
    note = _note(facts, places, unit)

    def on_limb(design_of_file: Design) -> Design:
        changed = change_limb(design_of_file, view, limb)
        if isinstance(changed, Refusal):
            raise InvalidInputError(changed.sentence)
        inputs = tuple(
            replace(each, location=places.get(each.location, each.location))
            for each in design_of_file.inputs
        )
        label = labels[designs.index(design_of_file)]
        return replace(
            changed.design,
            inputs=inputs,
            title=f"{scene.full_title}{' · ' if label else ''}{label}",
            notes=f"{scene.notes}\n{note}",
        )

    pairs = zip(opened.conditions, labels, strict=True)
    moved = replace(
        opened,
        scene=scene,
        view=_view_on(view, design, facts, places),
        conditions=tuple(replace(condition, label=label) for condition, label in pairs),
        synthetic=facts.synthetic,
        chosen=note,
    )
    return with_designs(moved, on_limb)


def _places_of(designs: tuple[Design, ...]) -> tuple[int, ...]:
    return tuple(dict.fromkeys(track.location for each in designs for track in each.inputs))


def _mapped_places(facts: LimbFacts) -> tuple[int, ...]:
    """Return the places of a limb that lie on its map."""
    limb_map = own_map(facts.name)
    if limb_map is None:
        return tuple(range(1, facts.n_inputs + 1))
    on_map = np.isfinite(limb_map.input_positions).all(axis=1)
    return tuple(int(k) + 1 for k in np.flatnonzero(on_map))


def _places_on(places: tuple[int, ...], candidates: tuple[int, ...]) -> dict[int, int]:
    """Return the place on the limb for each place: the same, if it exists, else a free one."""
    unchanged = [place for place in places if place in candidates]
    free = iter(place for place in candidates if place not in unchanged)
    return {place: place if place in unchanged else next(free) for place in places}


def _unplayable(designs: tuple[Design, ...], facts: LimbFacts) -> str:
    """Return why the rate of the limb is too low for the waveforms; empty if it is not."""
    for waveform in dict.fromkeys(clip.waveform for design in designs for clip in design.clips):
        try:
            waveform.samples(facts.sample_rate_hz)
        except InvalidInputError:
            return (
                f"The limb has {facts.sample_rate_hz:g} Hz, which is too slow for what it plays: "
                f"{waveform.title.lower()}."
            )
    return ""


def _view_on(view: View, design: Design, facts: LimbFacts, places: Mapping[int, int]) -> View:
    """Return the view with axes and outputs of the limb."""
    edit = change_limb(design, view, facts.name)
    view = view if isinstance(edit, Refusal) else edit.view
    if not facts.own:
        return view
    place = next(iter(places.values()))
    return replace(view, outputs=_from_near_to_far(facts, place, len(view.outputs)))


def _from_near_to_far(facts: LimbFacts, place: int, count: int) -> tuple[int, ...]:
    """Return ``count`` outputs, evenly from the nearest to the farthest from a place."""
    limb_map = own_map(facts.name)
    numbers = np.arange(1, facts.n_outputs + 1)
    if limb_map is not None:
        offsets = limb_map.output_positions - limb_map.input_positions[place - 1]
        distance = np.linalg.norm(offsets, axis=1)
        known = np.isfinite(distance)
        if known.any():
            numbers = numbers[known][np.argsort(distance[known], kind="stable")]
    rows = np.unique(np.linspace(0, numbers.size - 1, min(count, numbers.size)).round().astype(int))
    return tuple(int(number) for number in numbers[rows])


def _label(label: str, design: Design, places: Mapping[int, int], unit: str) -> str:
    """Return the label of a design with its place on this limb.

    A strength is not given in m/s² or mm/s where the motion of the probe is not known.
    """
    if unit == ARBITRARY_UNIT and label.endswith(PROBE_UNITS):
        return f"{design.inputs[0].amplitude:.3g} {unit}"
    before, _, number = label.rpartition(" ")
    old = int(number) if before and number.isdecimal() else 0
    return f"Input {places[old]}" if old in places else label


def _note(facts: LimbFacts, places: Mapping[int, int], unit: str) -> str:
    note = f"This is {facts.title}, which may not show what the sentence says"
    if unit == ARBITRARY_UNIT:
        note += ", and in which unit its drive is measured is not known (a.u.)"
    if not facts.own:
        return f"{note}."
    names = [f"{new} in place of {old}" if new != old else f"{new}" for old, new in places.items()]
    word = "place" if len(names) == 1 else "places"
    return f"{note}: played at its {word} {', '.join(names)}; outputs from near to far."


_HIGH_HZ = 200.0


def told(opened: OpenedScene) -> OpenedScene:
    """Return a scene whose sentence ends with what is found on its limb, if anything is.

    Drives of inverse design are found there, too.
    """
    find, finding = FINDINGS.get(opened.scene.name), ""
    try:
        if not opened.scene.of_paper:
            opened, finding = _driven(opened)
        elif find is not None:
            finding = find(opened)
    except SkinSourceError:
        # The limb is not here: the window says so.
        pass
    if not finding:
        return opened
    scene = replace(opened.scene, sentence=f"{opened.scene.sentence} {finding}")

    def changed(design: Design) -> Design:
        return replace(design, notes=design.notes.replace(opened.scene.notes, scene.notes, 1))

    return replace(with_designs(opened, changed), scene=scene)


def _driven(opened: OpenedScene) -> tuple[OpenedScene, str]:
    """Return a scene of inverse design with its drives, and a sentence on them."""
    designs = tuple(each.design for each in opened.conditions)
    found = _wanted_on(opened.scene.name, tuple(each.limb for each in designs))
    driven = {
        design: replace(design, inputs=solved.inputs, motions=solved.motions)
        for design, solved in zip(designs, found.designs, strict=True)
    }
    return with_designs(opened, driven.__getitem__), found.sentence


@lru_cache(maxsize=16)
def _wanted_on(name: str, limbs: tuple[str, ...]) -> Wanted:
    """Return the designs of a scene of inverse design with their drives, on a limb each."""
    pairs = zip(_designs_of(path_of(name)), limbs, strict=True)
    return WANTED[name](tuple(replace(design, limb=limb) for design, limb in pairs))


def _above_noise(
    opened: OpenedScene, text: Callable[[Floats, float, list[int]], str], *, all_axes: bool = False
) -> str:
    """Return a text on the axes of the shown outputs above the noise; "" with less than two."""
    axes = facts_of(opened.design.limb).axes if all_axes else opened.view.axes
    view, names = replace(opened.view, axes=axes), ("axis_traces", "above_noise_db")
    results = evaluate(opened.design, *names, "sample_rate_hz", view=view)
    outputs, above_db = opened.view.outputs, results["above_noise_db"]
    heard = [
        row
        for row, k in enumerate(outputs)
        if above_db is None or above_db[k - 1] >= LEAST_ABOVE_NOISE_DB
    ]
    if len(heard) < 2:
        return ""
    numbers = [outputs[row] for row in heard]
    return text(results["axis_traces"][heard], results["sample_rate_hz"], numbers)


def _power(traces: Floats, rate_hz: float) -> tuple[Floats, Floats]:
    power = np.square(np.abs(scipy.fft.rfft(traces))).sum(axis=1)
    return scipy.fft.rfftfreq(traces.shape[-1], 1.0 / rate_hz), power / power.sum(axis=1)[:, None]


def _high_frequencies(traces: Floats, rate_hz: float, outputs: list[int]) -> str:
    frequency_hz, power = _power(traces, rate_hz)
    at_near, *_, at_far = 100.0 * power[:, frequency_hz > _HIGH_HZ].sum(axis=1)
    near, *_, far = outputs
    return (
        f"Above {_HIGH_HZ:g} Hz lies {at_near:.0f} % of the energy at output {near}, and "
        f"{at_far:.0f} % at output {far}."
    )


def _later_and_weaker(opened: OpenedScene) -> str:
    design = opened.design
    onset_s = min(clip.onset_s for clip in design.clips)
    begin_s = onset_s + facts_of(design.limb).pre_trigger_delay_s
    return _above_noise(opened, partial(_delay_and_loss, begin_s))


def _delay_and_loss(begin_s: float, traces: Floats, rate_hz: float, outputs: list[int]) -> str:
    near, *_, far = outputs
    (traces,) = np.moveaxis(traces[[0, -1]], 1, 0)
    peaks = np.abs(scipy.signal.hilbert(traces)).max(axis=1)
    weaker_db = float(-np.diff(decibels(peaks))[0])
    # Where the largest sample of a long tone lies is no time of travel.
    later_ms = 1e3 * float(arrivals(traces, rate_hz, begin_s)[1])
    delay = (
        f", and it comes {abs(later_ms):.0f} ms {'later' if later_ms > 0.0 else 'earlier'} (group "
        "delay)"
    )
    return (
        f"At output {far} its peak is {abs(weaker_db):.0f} dB "
        f"{'weaker' if weaker_db > 0.0 else 'stronger'} than at output {near}"
        f"{delay if np.isfinite(later_ms) else ''}."
    )


def _mean_frequencies(traces: Floats, rate_hz: float, outputs: list[int]) -> str:
    frequency_hz, power = _power(traces, rate_hz)
    (at_near, near), *others = zip(power @ frequency_hz, outputs, strict=True)
    lowest, there = min(others)
    return (
        f"The mean frequency is {at_near:.0f} Hz at output {near}; of the others it is lowest at "
        f"output {there}, {lowest:.0f} Hz."
    )


def _of_each(opened: OpenedScene, name: str) -> list[Any]:
    """Return a quantity of each design of a scene."""
    return [evaluate(each.design, name, view=opened.view)[name] for each in opened.conditions]


def _interference(opened: OpenedScene) -> str:
    levels_db = np.stack(_of_each(opened, "output_levels_db"))
    gains_db = levels_db[-1] - levels_db[:-1].max(axis=0)
    parts = (
        f"{abs(gain_db):.0f} dB {'louder' if gain_db > 0.0 else 'softer'} at output {number}"
        for number in opened.view.outputs[:2]
        for gain_db in [gains_db[number - 1]]
    )
    return (
        f"Along {opened.view.axes}, both are, beside the louder one alone, {' and '.join(parts)}."
    )


def _carried(opened: OpenedScene) -> str:
    """Return a text on the level at the last shown output, on each limb."""
    number = opened.view.outputs[-1]
    pairs = zip(opened.conditions, _of_each(opened, "output_levels_db"), strict=True)
    parts = (f"{at.label.lower()} {own.max() - own[number - 1]:.0f} dB" for at, own in pairs)
    return f"At output {number} it is below its maximum by: {', '.join(parts)}."


def _straightness(opened: OpenedScene) -> str:
    """Return a text on the lines of output over input, at all outputs and in all bands."""
    strengths = [each.design.inputs[0].amplitude for each in opened.conditions]
    in_bands = _of_each(opened, "output_band_rms")
    # A response may be too long for it.
    r2 = None if None in in_bands else straightness(strengths, in_bands).adjusted_r2
    return _at_least("Adjusted R²", r2)


def _superposition(opened: OpenedScene) -> str:
    """Return a text on the sum of what each input causes, and what both cause, at all outputs."""
    numbers = range(1, facts_of(opened.design.limb).n_outputs + 1)
    everywhere = replace(opened, view=replace(opened.view, outputs=tuple(numbers)))
    *parts, joint = _of_each(everywhere, "selected_traces")
    return _at_least("The correlation of the two", superposition(parts, joint).correlation)


def _at_least(name: str, values: Floats | None) -> str:
    known = np.zeros(0) if values is None else values[np.isfinite(values)]
    # Four digits, rounded down: what is straight but for rounding errors is at least 0.9999.
    least = np.floor(1e4 * known.min(initial=0.99999)) / 1e4
    return f"{name} on this limb is at least {least:.4f}." if known.size else ""


#: What is computed, by the name of the scene.
FINDINGS: dict[str, Callable[[OpenedScene], str]] = {
    "1D": partial(_above_noise, text=_high_frequencies, all_axes=True),
    "1G": _carried,
    "2A": _later_and_weaker,
    "2C": partial(_above_noise, text=_mean_frequencies),
    "2F": _interference,
    "5D": _straightness,
    "5E": _straightness,
    "5F": _superposition,
}


FOLDER, DESCRIPTIONS = "scenes", "scenes.toml"


def scenes_folder() -> Path:
    """Return the folder of the design files of the scenes.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.scenes.scenes_folder().name)
    scenes
    """
    return data_folder() / FOLDER


def all_scenes() -> tuple[Scene, ...]:
    """Return every scene, in the order of the figures; those of inverse design come last.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.scenes.all_scenes()[0].name)
    1C
    """
    return _scenes_in(scenes_folder())


def names() -> tuple[str, ...]:
    """Return the names of the scenes, as `scene` and `open_scene` take them.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.scenes.names()[:3])
    ('1C', '1D', '1E')
    """
    return tuple(each.name for each in all_scenes())


def scene(name: str) -> Scene:
    """Return the description of a scene; the case of its name does not matter.

    Raises
    ------
    InvalidInputError
        There is no such scene.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.scenes.scene("2F").title)
    Two inputs interfere
    """
    folded = name.casefold() if isinstance(name, str) else None
    for known in all_scenes():
        if known.name.casefold() == folded:
            return known
    raise InvalidInputError(
        f"the scene {quoted(name)} does not exist; choose one of {', '.join(names())}"
    )


def path_of(name: str) -> Path:
    """Return the path of the design file of a scene."""
    return scenes_folder() / f"{name}{SUFFIX}"


def why_not_on(name: str, limb: str) -> str:
    """Return why a scene does not apply on a limb, in a sentence; empty if it does.

    Raises
    ------
    InvalidInputError
        There is no such scene.
    DesignFileError, StorageError
        The installation is damaged.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(repr(ss.scenes.why_not_on("2F", "synthetic-1")))
    ''
    """
    content = open_design(path_of(scene(name).name))
    return reason_against(compared(content), content.view, limb)


def open_scene(
    name: str, *, available: Collection[str] | None = None, limb: str = ""
) -> OpenedScene:
    """Open a scene on the limbs that are available, or on one that is chosen for it.

    Parameters
    ----------
    name
        Name of the panel: ``"2F"``.
    available
        Limbs that can be used, `skinsource.available_limbs` unless given.  A measured limb that is
        not among them is replaced by the synthetic limb of its number, and `OpenedScene.note` says
        so.
    limb
        A limb for all designs, such as an imported one; empty: the limbs of the paper.

    Raises
    ------
    InvalidInputError
        There is no such scene, or it does not apply on ``limb``.
    DesignFileError, StorageError
        The installation is damaged.

    Examples
    --------
    >>> import skinsource as ss
    >>> opened = ss.scenes.open_scene("2F")
    >>> figure = ss.plot.map(opened.design)
    """
    return told(opened_plainly(name, available=available, limb=limb))


def opened_plainly(
    name: str, *, available: Collection[str] | None = None, limb: str = ""
) -> OpenedScene:
    """Return a scene as `open_scene`, without what is computed on its limb."""
    known = scene(name)
    content = open_design(path_of(known.name))
    pairs = zip(known.labels, compared(content), strict=True)
    of_file = OpenedScene(
        scene=known,
        design=content.design,
        view=content.view,
        conditions=tuple(Condition(label=label, design=design) for label, design in pairs),
        synthetic=False,
    )
    if limb:
        return opened_on(of_file, limb)
    limbs = frozenset(available_limbs() if available is None else available)
    opened = with_designs(of_file, lambda design: _on_limbs(design, limbs))
    return replace(opened, synthetic=opened.conditions != of_file.conditions)


def compared(content: DesignFile) -> tuple[Design, ...]:
    """Return the designs of a file by the numbers of their snapshots; others come last."""
    snapshots = sorted(content.view.snapshots, key=lambda snapshot: snapshot.number)
    designs = tuple(snapshot.design for snapshot in snapshots)
    return designs if content.design in designs else (*designs, content.design)


def _on_limbs(design: Design, limbs: frozenset[str]) -> Design:
    kind, _, number = design.limb.partition("-")
    if kind != "measured" or design.limb in limbs:
        return design
    return replace(design, limb=f"synthetic-{number}")


_SCENE_TITLE = re.compile(r"(?:Fig\.|Scene) ([\w-]+): ")
_LIMB = re.compile(r", limb \d+$")
_EDITED = "edited"


@checking
def title_of(design: Design) -> str:
    """Return the title of a design; that of an edited scene without details that may be wrong.

    Other titles are those of the user, and stay.

    >>> import skinsource as ss
    >>> tone = ss.scenes.open_scene("2B", available=("synthetic-1",)).conditions[0].design
    >>> ss.scenes.title_of(tone)
    'Fig. 2B: Low frequencies reach farther · 50 Hz'
    >>> ss.scenes.title_of(tone.with_input(0, amplitude=2.0))
    'Fig. 2B: Low frequencies reach farther · edited'
    """
    match = _SCENE_TITLE.match(design.title)
    if match is None:
        return design.title
    try:
        known = scene(match[1])
        designs = _designs_of(path_of(known.name))
        if not known.of_paper and target_in(design) is None:
            designs = _wanted_on(known.name, _limbs_like(designs, design.limb)).designs
    except SkinSourceError:
        return design.title
    titles = known.full_title, _LIMB.sub("", known.full_title)
    prefix = next((each for each in titles if f"{design.title} · ".startswith(f"{each} · ")), "")
    if not prefix or _is_as_made(known, designs, design):
        return design.title
    changed_limb = _LIMB.search(prefix) and not _is_on(designs[0], design)
    return f"{_LIMB.sub('', prefix) if changed_limb else prefix} · {_EDITED}"


def _is_as_made(known: Scene, designs: tuple[Design, ...], design: Design) -> bool:
    """Return whether a design still plays what its title promises."""
    if _has_other_unit(design):
        return False
    people = len({design.limb for design in designs}) > 1
    named = [original for original in designs if original.title == design.title]
    if named and (people or _LIMB.search(known.title)) and not _is_on(named[0], design):
        return False
    # On an imported limb a scene plays at other places, and its title names them.
    moved = design.limb not in PUBLISHED
    played = _played_content(design, moved=moved)
    return any(_played_content(candidate, moved=moved) == played for candidate in named or designs)


def _limbs_like(designs: tuple[Design, ...], limb: str) -> tuple[str, ...]:
    """Return the limbs of designs of a scene: those of people of this kind, or this one."""
    people, kind = len({each.limb for each in designs}) > 1, limb.partition("-")[0]
    return tuple(each.limb.replace("measured", kind) if people else limb for each in designs)


def _has_other_unit(design: Design) -> bool:
    """Return whether the title has a strength in a unit other than that of the drive."""
    if amplitude_unit(design) == ARBITRARY_UNIT:
        return design.title.endswith(PROBE_UNITS)
    return design.title.endswith(f" {ARBITRARY_UNIT}")


def _is_on(known: Design, design: Design) -> bool:
    """Return whether a design is on the limb of ``known``, or the synthetic one of its number."""
    number = known.limb.partition("-")[2]
    # An imported limb may have a number too.
    return design.limb in PUBLISHED and design.limb.partition("-")[2] == number


def _played_content(design: Design, *, moved: bool) -> Design:
    """Return what a design plays, without texts and limb; ``moved``: without places."""
    inputs = tuple(
        replace(track, colour=0, location=1 if moved else track.location) for track in design.inputs
    )
    played = Design(
        limb="synthetic-1", inputs=inputs, scaling=design.scaling, actuation=design.actuation
    )
    found = target_in(design)
    if found is None:
        return played
    # Drives of a target are other ones on each limb; what it wants is the same.
    own = replace(played, inputs=found[1].tracks()) == played
    wanted = replace(found[1], places=(), drives=(), solved_for="")
    group = MotionGroup(motion=wanted, clips=())
    return replace(played, inputs=() if own else inputs, motions=(group,))


@lru_cache(maxsize=64)
def _designs_of(path: Path) -> tuple[Design, ...]:
    return compared(open_design(path))


def missing_panels() -> tuple[tuple[str, str], ...]:
    """Return the panels of the paper that are no scenes, each with the reason.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.scenes.missing_panels()[-1][0])
    5C
    """
    return tuple((entry["name"], entry["reason"]) for entry in _read(scenes_folder())["missing"])


@lru_cache(maxsize=1)
def _read(folder: Path) -> dict[str, Any]:
    return tomllib.loads((folder / DESCRIPTIONS).read_text(encoding="utf-8"))


@lru_cache(maxsize=1)
def _scenes_in(folder: Path) -> tuple[Scene, ...]:
    scenes = []
    for group in ("scene", "inverse"):
        for entry in _read(folder)[group]:
            fields: dict[str, Any] = {
                name: tuple(value) if isinstance(value, list) else value
                for name, value in entry.items()
            }
            scenes.append(Scene(**fields, of_paper=group == "scene"))
    return tuple(scenes)
