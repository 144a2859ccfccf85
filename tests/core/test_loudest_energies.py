"""Levels over the loudest 100 ms: against direct computation, and what they do not depend on."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.base.errors import Stopped
from skinsource.base.measurement_conditions import AXES
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Impulse, Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.limb import Limb
from skinsource.limbs.synthetic import load_synthetic_limb
from skinsource.signals.projection import METHODS, project_axes
from skinsource.signals.spectra import rms

SHORT = Design(
    limb="synthetic-1",
    scaling="relative",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=100.0), onset_s=0.2),
        track(location=3, waveform=Noise(seed=2), amplitude=-0.5),
        track(location=16, waveform=Tap(), amplitude=2.0, onset_s=1.5),
    ),
)
LONG = Design(
    limb="synthetic-1",
    scaling="relative",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=90.0, duration_s=0.3), onset_s=0.1),
        track(location=4, waveform=Noise(seed=2, duration_s=0.2), amplitude=3.0, onset_s=17.0),
        track(location=4, waveform=Tap(), onset_s=3.0),
    ),
)


@pytest.fixture(scope="module")
def limb() -> Limb:
    return load_synthetic_limb(1)


def shown(design: Design, view: View, *quantities: str, span: str = "loudest", graph=None, **stop):
    given = sources(design, replace(view, span=span))
    values = (graph or new_graph()).evaluate(quantities, given, **stop)
    return [values[name] for name in quantities]


def acceleration(limb: Limb, design: Design) -> np.ndarray:
    starts = [round(track.clips[0].onset_s * 1300) for track in design.inputs]
    played = [track.clips[0].waveform.samples(1300.0) for track in design.inputs]
    n_times = max(start + samples.size for start, samples in zip(starts, played, strict=True))
    drives = np.zeros((len(played), n_times))
    for row, start, samples in zip(drives, starts, played, strict=True):
        row[start : start + samples.size] = samples
    places = [track.location for track in design.inputs]
    amplitudes = [track.amplitude for track in design.inputs]
    return predict(limb, drives, places, amplitudes, design.scaling)


@pytest.mark.parametrize("design", [SHORT, LONG], ids=["at once", "streamed"])
@pytest.mark.parametrize("selected", [(1,), ()])
def test_loudest_levels_are_those_of_the_projected_signals(limb, design, selected):
    field = acceleration(limb, design)
    graph = new_graph()
    for axes in AXES:
        for method in METHODS:
            view = View(axes=axes, method=method, selected_inputs=selected)
            (levels,) = shown(design, view, "output_rms", graph=graph)
            expected = rms(project_axes(field, axes, method), "loudest", 1300.0)
            np.testing.assert_allclose(levels, expected, rtol=1e-11, err_msg=f"{axes} {method}")


def test_a_loud_burst_leaves_the_level_of_what_is_loud_elsewhere_alone(limb):
    # The burst of a strong tap far away is followed by silence, then by a quiet tone elsewhere.
    quiet = track(16, Tone(frequency_hz=200.0, duration_s=0.5), onset_s=2.0)
    loud = track(location=3, waveform=Tap(), amplitude=1000.0)
    both = replace(SHORT, inputs=(loud, quiet))
    field = acceleration(limb, both)
    for axes, method in (("z", "soc"), ("xyz", "pca"), ("xyz", "mag")):
        (levels,) = shown(both, View(axes=axes, method=method), "output_rms")
        expected = rms(project_axes(field, axes, method), "loudest")
        np.testing.assert_allclose(levels, expected, rtol=1e-11)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("waveform", [Tone(), Tap(), Impulse(), Noise(seed=3, duration_s=0.4)])
def test_the_loudest_level_does_not_change_when_the_onset_moves(method, waveform):
    graph, levels_db = new_graph(), []
    for onset_s in (0.0, 0.05, 1.0, 9.0, 14.0):
        design = replace(SHORT, inputs=(track(location=7, waveform=waveform, onset_s=onset_s),))
        levels_db += shown(design, View(method=method), "output_levels_db", graph=graph)
    # A main axis is that of data centred over the record, so that silence moves it a little.
    limit = 0.01 if method == "pca" else 1e-9
    assert np.ptp(levels_db, axis=0).max() < limit


@pytest.mark.parametrize("frequency_hz", [60.0, 250.0])
@pytest.mark.parametrize(("window", "scaling"), [("none", "upstream"), ("tukey", "probe")])
def test_the_loudest_level_of_a_tone_hardly_changes_with_its_length(frequency_hz, window, scaling):
    graph, levels_db = new_graph(), []
    for duration_s in (0.2, 0.3, 0.5, 1.0, 3.0):
        tone = Tone(frequency_hz=frequency_hz, duration_s=duration_s, window=window)
        design = replace(SHORT, scaling=scaling, inputs=(track(location=7, waveform=tone),))
        levels_db += shown(design, View(), "output_levels_db", graph=graph)
    levels = np.array(levels_db)
    audible = levels[-1] > levels[-1].max() - 20.0
    assert np.ptp(levels[:, audible], axis=0).max() < 0.5


def test_nothing_of_it_runs_where_the_whole_record_counts():
    graph = new_graph()
    shown(SHORT, View(), "output_rms", graph=graph)
    assert graph.work.inverse_transforms == 72
    shown(SHORT, View(), "output_rms", graph=graph, span="record")
    assert graph.work.inverse_transforms == graph.work.forward_transforms == 0
    graph = new_graph()
    shown(SHORT, View(), "output_rms", graph=graph, span="record")
    assert graph.work.inverse_transforms == 0


class Countdown:
    def __init__(self, times: int) -> None:
        self.left = times

    def __call__(self) -> bool:
        self.left -= 1
        return self.left < 0


@pytest.mark.parametrize("design", [SHORT, LONG], ids=["at once", "streamed"])
def test_it_stops_when_it_is_asked_to_and_is_right_afterwards(design):
    graph = new_graph()
    shown(design, View(), "output_rms", graph=graph, span="record")
    asked = Countdown(10**9)
    shown(design, View(), "output_rms", stop=asked, graph=graph)
    needed = 10**9 - asked.left
    assert needed >= 4
    for times in range(1, needed, max(1, needed // 8)):
        graph = new_graph()
        shown(design, View(), "output_rms", graph=graph, span="record")
        with pytest.raises(Stopped):
            shown(design, View(), "output_rms", stop=Countdown(times), graph=graph)
    expected = shown(design, View(), "output_rms")
    np.testing.assert_array_equal(shown(design, View(), "output_rms", graph=graph), expected)


def test_silence_has_the_lowest_level_by_either_span():
    for inputs in ((), (track(location=7, amplitude=0.0),), (track(location=7, muted=True),)):
        for method in METHODS:
            silent = replace(SHORT, inputs=inputs)
            (levels,) = shown(silent, View(method=method), "output_levels_db")
            assert (levels == -200.0).all()
