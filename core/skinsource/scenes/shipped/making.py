"""How the shipped scenes are put together."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from skinsource.comparing import NUMBERS, Snapshot
from skinsource.design import Design, Input, track
from skinsource.design_file import DesignFile
from skinsource.scaling.response_scaling import Scaling
from skinsource.scenes.paper_scene import Scene
from skinsource.view import View
from skinsource.waveforms import Waveform

#: The panel in which numbers are turned in front of an audience.
CONTROLS = "frequency_and_amplitude"
#: The skin as it moves along z, slowed down: of scenes that speak of what travels.
MOVING = {"skin": {"quantity": "z"}}
#: A row for each output, relative to its own peak: of scenes in which most others would be flat.
OWN_ROWS = {"traces": {"layout": "stacked", "relative": True}}
#: Spectra along each axis in a row for each output, relative to its own peak, as amplitudes.
OWN_SPECTRA = {
    "spectra": {
        "layout": "axes",
        "log_magnitude": False,
        "relative": True,
        "frequency_range_hz": (25.0, 600.0),
    }
}
#: The same, each magnitude the mean over ten bins: of noise.
OWN_MEAN_SPECTRA = {"spectra": {**OWN_SPECTRA["spectra"], "averaged": True}}
#: Maps of all designs of a scene at once: of scenes that compare people, places or frequencies.
BESIDE = {"side_by_side": {"of": "snapshots"}}
#: The same, each relative to its own loudest output.
EACH_TO_ITS_MAXIMUM = {"side_by_side": {"of": "snapshots", "own_maximum": True}}
#: Maps of the design along each axis at once.
AXES_BESIDE = {"side_by_side": {"of": "axes"}}


@dataclass(frozen=True, slots=True, kw_only=True)
class MadeScene:
    """A scene and the content of its file."""

    scene: Scene
    content: DesignFile


def played(
    limb: int,
    *inputs: Input,
    scaling: Scaling = "upstream",
) -> Design:
    """A design on one of the measured limbs."""
    return Design(limb=f"measured-{limb}", inputs=inputs, scaling=scaling)


def at(places: Sequence[int], waveform: Waveform, amplitude: float = 1.0) -> tuple[Input, ...]:
    """The same waveform at some places, at once."""
    return tuple(
        track(place, waveform, amplitude=amplitude, colour=rank)
        for rank, place in enumerate(places)
    )


def made(
    scene: Scene,
    *designs: Design,
    shown: int = 0,
    turned: str = "all",
    panels: Mapping[str, Mapping[str, Any]] | None = None,
    **view: Any,
) -> MadeScene:
    """Put a scene together.

    Parameters
    ----------
    scene
        What is known of it; it has a label for each design.
    designs
        What it compares, in the order of the figure: snapshots, and one more where there is no
        number left for it.
    shown
        Which of them is in the window when it is opened; the one without a number, if there is one.
    turned
        The one number that it is about, of those that the panel for presenting can show.
    panels
        Settings of panels, by their names.
    view
        Fields of `View`.
    """
    if len(designs) != len(scene.labels):
        raise ValueError(f"{scene.name}: {len(designs)} designs, {len(scene.labels)} labels")
    if len(designs) > len(NUMBERS) and shown != len(designs) - 1 == len(NUMBERS):
        raise ValueError(f"{scene.name}: of {len(designs)} designs the last one must be shown")
    titled = tuple(_titled(scene, one, k) for k, one in enumerate(designs))
    snapshots: tuple[Snapshot, ...] = ()
    if len(titled) > 1:
        # The one that was shown last stands last.
        ordered = sorted(range(len(titled)), key=lambda k: k == shown)
        snapshots = tuple(
            Snapshot(number=NUMBERS[k], design=titled[k]) for k in ordered if k < len(NUMBERS)
        )
    settings = {**(panels or {}), CONTROLS: {"control": turned}}
    held = tuple((name, tuple(one.items())) for name, one in settings.items())
    looked = View(snapshots=snapshots, panels=held, **view)
    return MadeScene(scene=scene, content=DesignFile(design=titled[shown], view=looked))


def _titled(scene: Scene, design: Design, rank: int) -> Design:
    label = scene.labels[rank]
    words = f"Fig. {scene.name}: {scene.title}{' · ' if label else ''}{label}"
    return replace(design, title=words, notes=scene.notes)
