"""The engine of this program: the graph that the window evaluates, and the library's own call."""

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Floats
from skinsource.design import Design, Input, track
from skinsource.method_comparison.accuracy import Block
from skinsource.method_comparison.compared_limb import MADE_UP
from skinsource.method_comparison.made_up import made_up_drive
from skinsource.method_comparison.method import (
    Method,
    Prepared,
    Unfit,
    all_channels,
    drives_of,
    output_bytes,
    require_bytes,
    response_bytes,
)
from skinsource.method_comparison.scenes import ComparedScene, Player
from skinsource.quantities import new_graph, sources
from skinsource.response import predict
from skinsource.view import View
from skinsource.waveforms import Noise

#: Of `predict`: the field, its spectrum, and the copy that is given back.
_LIBRARY_COPIES = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class MadeUpNoise(Noise):
    """Noise known in advance; another ``edition`` counts as another waveform.

    Attributes
    ----------
    edition
        Number of the run, so that nothing is remembered from the run before.
    drive : (n_times,)
        The samples.
    """

    edition: int
    drive: NDArray[np.float64] = field(compare=False, repr=False)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,)."""
        return self.drive


def prepare(scene: ComparedScene, method: Method) -> Prepared:
    """Make the graph ready: every run is an edit of the waveforms."""
    if method.precision != "float64":
        raise Unfit("computes in float64 only")
    if method.setting.what == "library":
        return _library(scene, method)
    require_bytes(response_bytes(scene))
    graph, limb, n_channels = new_graph(), scene.limb.load(), scene.limb.n_channels
    whole = method.setting.what == "all"
    outputs = tuple(range(1, limb.n_outputs + 1)) if whole else scene.limb.visible_outputs
    chosen = () if scene.changed is None else (scene.changed + 1,)
    view = View(outputs=outputs, axes="xyz", selected_inputs=chosen)
    drives = [made_up_drive(player.seed, player.n_times) for player in scene.players]

    def run(edition: int) -> Iterator[Block]:
        given = {**sources(_design(scene, drives, edition), view), "limb_data": limb}
        if whole:
            streamed = graph.evaluate({"streamed_vibration"}, given)["streamed_vibration"]
            if streamed is not None:
                for first, block in streamed.blocks():
                    yield first, block.reshape(n_channels, -1)
                return
        wanted = {"axis_traces"} if whole else {"axis_traces", "output_rms"}
        traces: Floats = graph.evaluate(wanted, given)["axis_traces"]
        yield 0, traces.reshape(-1, traces.shape[-1])

    if scene.limb != MADE_UP:
        # Spectra of responses are made by the first run.  In the published shape that is lost in
        # the only scene that runs once; of a large limb it takes longer than the runs.
        for _ in run(-1):
            pass
    rows = limb.n_axes * (np.array(outputs) - 1)[:, None] + np.arange(limb.n_axes)
    lent_bytes = sum(drive.nbytes for drive in drives)
    return Prepared(rows=rows.ravel(), run=run, lent_bytes=lent_bytes)


def _design(scene: ComparedScene, drives: list[Floats], edition: int) -> Design:
    one = scene.changed
    inputs = tuple(
        _input(player, drive, scene.limb.sample_rate_hz, edition if one is None or one == k else 0)
        for k, (player, drive) in enumerate(zip(scene.players, drives, strict=True))
    )
    return Design(limb=scene.limb.name, inputs=inputs, scaling="relative")


def _input(player: Player, drive: Floats, sample_rate_hz: float, edition: int) -> Input:
    noise = MadeUpNoise(
        seed=player.seed,
        duration_s=player.n_times / sample_rate_hz,
        edition=edition,
        drive=drive,
    )
    return track(
        location=player.location,
        waveform=noise,
        amplitude=player.amplitude,
        onset_s=player.start / sample_rate_hz,
    )


def _library(scene: ComparedScene, method: Method) -> Prepared:
    require_bytes(_LIBRARY_COPIES * output_bytes(scene, method) + response_bytes(scene))
    limb = scene.limb.load()
    loud = [dataclasses.replace(player, amplitude=1.0) for player in scene.players]
    drives = drives_of(dataclasses.replace(scene, players=tuple(loud)), method)
    places = [player.location for player in scene.players]
    amplitudes = [player.amplitude for player in scene.players]

    def run(_: int) -> Iterator[Block]:
        field = predict(limb, drives, places, amplitudes, scaling="relative")
        yield 0, field.reshape(scene.limb.n_channels, -1)

    return Prepared(rows=all_channels(scene), run=run)
