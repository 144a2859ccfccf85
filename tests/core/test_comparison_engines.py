"""Every engine of the benchmark computes the same response, as well as it claims."""

import importlib.util
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from skinsource.method_comparison import program
from skinsource.method_comparison.accuracy import errors_of, picked
from skinsource.method_comparison.engines import ENGINES, engine_of
from skinsource.method_comparison.method import Method, Setting, Unfit, taps_of
from skinsource.method_comparison.promises import PEAK_ERROR
from skinsource.method_comparison.references import Reference, load_reference
from skinsource.method_comparison.scenes import SCENES, ComparedScene, Player, scene_of

SCRIPT = Path(__file__).parents[1] / "references" / "comparison" / "make_references.py"
TINY = ComparedScene(
    key="tiny",
    title="",
    reference="tiny",
    players=(
        Player(location=7, seed=1, n_times=150, amplitude=0.7),
        Player(location=3, seed=2, n_times=90, amplitude=-1.1, start=61),
    ),
)
METHODS = [
    pytest.param(engine, method, id=f"{engine.name} {method.precision} {method.setting.name}")
    for engine in ENGINES
    for method in engine.methods
]


@pytest.fixture(scope="module")
def tiny_reference():
    spec = importlib.util.spec_from_file_location("make_references", SCRIPT)
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    made = script.reference_of(TINY, script.window_starts(TINY))
    starts = made["starts"].astype(np.int64)
    return Reference(
        channels=made["channels"].astype(np.int64),
        starts=starts,
        samples=starts[None, :, None] + made["offsets"],
        peaks=made["peaks"],
        high=made["high"],
        low=made["low"].astype(float),
    )


@pytest.mark.parametrize(("engine", "method"), METHODS)
def test_every_method_gives_the_exact_response_or_says_why_not(engine, method, tiny_reference):
    if (engine.name, method.precision) == ("this program", "float32"):
        with pytest.raises(Unfit, match="float64 only"):
            engine.prepare(TINY, method)
        return
    prepared = engine.prepare(TINY, method)
    values = [picked(tiny_reference, prepared.rows, prepared.run(k)) for k in (0, 1)]
    np.testing.assert_array_equal(values[0], values[1])
    errors = errors_of(tiny_reference, values[0])
    if method.setting.is_exact:
        assert errors.peak <= PEAK_ERROR[method.precision]
    else:
        assert 1e-10 < errors.peak < 0.5


@pytest.mark.parametrize("name", ["cached spectra", "overlap-add", "direct"])
def test_the_later_the_cut_the_smaller_the_error(name, tiny_reference):
    engine = engine_of(name)
    errors = [
        errors_of(
            tiny_reference,
            picked(tiny_reference, (ready := engine.prepare(TINY, method)).rows, ready.run(0)),
        ).peak
        for method in engine.methods
        if method.setting.cut_db is not None
    ]
    assert len(errors) == 3
    assert errors == sorted(errors, reverse=True)


def test_low_rank_gives_the_same_before_and_after_transforming_back():
    """With many inputs the shapes are combined in frequency, with few in time."""
    scene = replace(
        TINY, players=tuple(Player(location=k, seed=k, n_times=100) for k in range(1, 9))
    )
    few, many = (
        next(iter(engine_of("cached spectra").prepare(scene, method).run(0)))[1]
        for method in (Method(setting=Setting(rank=26)), Method(setting=Setting(rank=28)))
    )
    exact = next(iter(engine_of("cached spectra").prepare(scene, Method()).run(0)))[1]
    for found in (few, many):
        assert np.abs(found - exact).max() < 0.1 * np.abs(exact).max()


def test_a_cut_shortens_the_responses():
    lengths = [
        taps_of(TINY, Method(setting=Setting(cut_db=db))).shape[-1] for db in (-60.0, -80.0, -100.0)
    ]
    assert lengths == sorted(lengths)
    assert lengths[-1] < taps_of(TINY, Method()).shape[-1] == 522


@pytest.mark.parametrize(("changed", "drawn"), [(None, 6), (4, 1)])
def test_each_run_draws_what_is_edited_and_nothing_else(changed, drawn, monkeypatch):
    scene = replace(scene_of("S7"), players=scene_of("S7").players[:6], changed=changed)
    asked = []

    def samples(noise, sample_rate_hz, shift_s=0.0):
        asked.append(noise.seed)
        return noise.drive

    monkeypatch.setattr(program.MadeUpNoise, "samples", samples)
    engine = engine_of("this program")
    prepared = engine.prepare(scene, engine.methods[0])
    before = next(iter(prepared.run(0)))[1]
    assert len(asked) == 6
    after = next(iter(prepared.run(1)))[1]
    assert len(asked) == 6 + drawn
    np.testing.assert_array_equal(before, after)


@pytest.mark.parametrize("name", ["cached spectra", "direct", "fftconvolve", "oaconvolve"])
def test_engines_refuse_what_no_personal_computer_should_do(name):
    with pytest.raises(Unfit, match="limit is"):
        engine_of(name).prepare(scene_of("S5"), Method())


def test_this_program_keeps_its_promise_where_a_window_is_120_db_quieter():
    reference = load_reference("S6")
    prepared = engine_of("this program").prepare(
        scene_of("S6"), engine_of("this program").methods[0]
    )
    errors = errors_of(reference, picked(reference, prepared.rows, prepared.run(0)))
    assert errors.peak <= 1e-14
    assert errors.window <= 1e-9
    assert errors.silence == 0.0


def test_methods_have_names_of_their_own():
    for engine in ENGINES:
        names = [(method.precision, method.setting.name) for method in engine.methods]
        assert len(set(names)) == len(names)
        for precision, setting in names:
            assert engine.method_of(precision, setting).setting.name == setting
    assert len({engine.name for engine in ENGINES}) == len(ENGINES)
    assert len({scene.key for scene in SCENES}) == len(SCENES)
