"""The benchmark on a limb of a lab: its scenes, its exact values, its rows."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from scipy import fft

from skinsource.commands.command_line import main
from skinsource.errors import FileFormatError, InvalidInputError, UnknownLimbError
from skinsource.method_comparison import commands, program
from skinsource.method_comparison.accuracy import errors_of, picked
from skinsource.method_comparison.compared_limb import MADE_UP, limb_called
from skinsource.method_comparison.direct_sums import EXACT_NAME, exact_response, write_references
from skinsource.method_comparison.engines import ENGINES, engine_of
from skinsource.method_comparison.machine import facts
from skinsource.method_comparison.measure import QUICK, cases_of, measure
from skinsource.method_comparison.method import Method, Setting, Unfit, spectra_of
from skinsource.method_comparison.promises import PEAK_ERROR
from skinsource.method_comparison.report import report_of
from skinsource.method_comparison.scenes import SCENES, scene_of, scenes_on
from skinsource.method_comparison.table import read_table, write_table
from skinsource.method_comparison.worker import measured
from skinsource.own_limbs import install_limb, remove_limb
from skinsource.rendering import response_spectra
from tests.core.own_limbs.compared import keep, sized, tiny
from tests.core.own_limbs.lab_bench import N_INPUTS, N_OUTPUTS, own_limb, response

METHODS = [
    pytest.param(engine, method, id=f"{engine.name} {method.precision} {method.setting.name}")
    for engine in ENGINES
    for method in engine.methods
    if method.setting.is_exact and (engine.name, method.precision) != ("this program", "float32")
]


@pytest.mark.parametrize(("engine", "method"), METHODS)
def test_every_engine_keeps_its_errors_on_a_limb_of_another_shape(lab, engine, method):
    scene = tiny(limb_called("lab-1"))
    prepared = engine.prepare(scene, method)
    reference = exact_response(scene)
    errors = errors_of(reference, picked(reference, prepared.rows, prepared.run(0)))
    assert 0.0 < errors.peak <= PEAK_ERROR[method.precision]
    if engine.is_ours:
        assert errors.silence == 0.0


def in_this_process(folder, engines, *, key="S1"):
    limb = limb_called("lab-1")
    cases = cases_of([scene_of(key, limb)], engines, quick=True)
    path = folder / EXACT_NAME
    write_references(path, {key: exact_response(scene_of(key, limb))})
    return measure(cases, QUICK, start=lambda task, _: measured(task), references=path)


@pytest.mark.parametrize(
    ("fault", "broken"),
    [
        (lambda field: field, False),
        (lambda field: field * (1.0 + 1e-12), True),
        (lambda field: field[::-1], True),
        (lambda field: np.roll(field, 1, axis=-1), True),
        (lambda field: field * np.array([1.0, 0.0])[:, None], True),
    ],
    ids=["none", "scaled by 1e-12", "outputs swapped", "a sample late", "an axis lost"],
)
def test_a_fault_in_an_engine_is_an_error_of_its_row(lab, tmp_path, monkeypatch, fault, broken):
    predict = program.predict
    monkeypatch.setattr(program, "predict", lambda *a, **k: fault(predict(*a, **k)))
    rows = in_this_process(tmp_path, [engine_of("this program")])
    (library,) = (row for row in rows if row.setting == "predict()")
    assert library.promise.startswith("broken: error of the peak" if broken else "kept")
    assert {row.promise for row in rows if row is not library} == {"kept"}


def test_rows_say_on_which_limb_and_come_back_from_the_table(lab, tmp_path):
    rows = in_this_process(tmp_path, [engine_of("direct")])
    limb = limb_called("lab-1")
    assert {row.limb for row in rows} == {limb}
    assert {(row.channels, row.samples) for row in rows} == {(62, 2089)}
    path = tmp_path / "t.csv"
    write_table(path, rows)
    assert read_table(path) == rows
    header = path.read_text().splitlines()[0]
    assert header.endswith(
        ",failure,limb,limb_digest,limb_inputs,limb_outputs,limb_axes,limb_taps,limb_rate_hz"
    )
    write_table(path, [replace(row, limb=MADE_UP) for row in rows])
    assert path.read_text().splitlines()[0] == header.partition(",limb,")[0]


def test_a_table_with_axes_that_no_limb_has_is_explained(lab, tmp_path):
    path = tmp_path / "t.csv"
    write_table(path, in_this_process(tmp_path, [engine_of("direct")]))
    path.write_text(path.read_text().replace(",xz,", ",zx,"))
    with pytest.raises(FileFormatError, match=r"t\.csv: line 2 cannot be read"):
        read_table(path)


def test_the_report_names_limb_digest_shape_rate_and_how_exact_values_are(lab, tmp_path):
    rows = in_this_process(tmp_path, [engine_of("direct")])
    limb = limb_called("lab-1")
    report = report_of(rows, facts(limb, tmp_path / EXACT_NAME), QUICK, bound=2.0**-106)
    for words in (
        "- limb: lab-1\n",
        "- shape and rate: 7 places × 31 outputs × 2 axes (xz) × 90 samples, 4000 Hz\n",
        f"- SHA-256 of the limb: {limb.digest}\n",
        "no engine has computed",
        "off by at most 1.3e-32 of the channel's peak",
        "along x and z of the outputs named above",
        "Left out are scenes that do not depend on the limb",
        "## S1: 1 input × 0.5 s",
    ):
        assert words in report
    assert len(limb.digest) == 64


def test_scenes_are_scaled_to_the_limb():
    scenes = {scene.key: scene for scene in scenes_on(sized())}
    assert list(scenes) == ["S1", "S2", "S3", "S4", "S6", "S7"]
    assert [scene.n_inputs for scene in scenes.values()] == [1, 4, 7, 4, 2, 7]
    assert sorted(player.location for player in scenes["S3"].players) == list(range(1, 8))
    assert scenes["S3"].title == "7 inputs × 2 s"
    assert scenes["S2"].stimulus_samples == 8000
    assert scenes["S2"].response_samples == 8000 + 89
    assert scenes["S7"].title == "1 of 7 inputs changed, 2 s"


@pytest.mark.parametrize("n_inputs", [1, 2, 4, 5, 7, 14, 20, 64, 210, 256])
def test_all_places_play_once_and_exact_values_of_each_scene_are_made(n_inputs):
    scenes = {scene.key: scene for scene in scenes_on(sized(n_inputs))}
    assert {scene.reference for scene in scenes.values()} <= set(scenes)
    most = max(scene.n_inputs for key, scene in scenes.items() if key != "S6")
    places = next(scene.players for scene in scenes.values() if scene.n_inputs == most)
    assert sorted(player.location for player in places)[-n_inputs:] == list(range(1, n_inputs + 1))
    assert all(scene.key != "S7" or n_inputs > 1 for scene in scenes.values())
    assert all((scene.changed or 0) < scene.n_inputs for scene in scenes.values())


def test_without_a_limb_the_scenes_are_those_of_the_published_shape():
    assert scenes_on(MADE_UP) == SCENES
    assert [scene.key for scene in SCENES] == ["S1", "S2", "S3", "S4", "S5", "S6", "S7"]
    assert (MADE_UP.n_channels, MADE_UP.n_taps) == (216, 522)


@pytest.mark.parametrize("n_taps", [1, 90, 4000, 20_000])
def test_between_the_bursts_is_silence_however_long_responses_are(n_taps):
    scene = scene_of("S6", sized(n_taps=n_taps))
    loud, quiet = scene.players
    assert quiet.start - (loud.n_times + n_taps - 1) >= 1000


def test_a_limb_of_one_place_and_output_is_told_in_words_of_one():
    limb = sized(1, 1, 1, axes="z", sample_rate_hz=100.0)
    assert limb.size == "1 place × 1 output × 1 axis (z) × 1 sample, 100 Hz"
    assert scenes_on(limb)[0].title == "1 input × 0.5 s"


def test_errors_are_measured_at_outputs_spread_over_the_limb():
    assert sized().visible_outputs == (1, 7, 13, 19, 25, 31)
    assert sized().checked_channels[:4] == (0, 1, 12, 13)
    assert sized(n_outputs=2, axes="z").checked_channels == (0, 1)
    assert sized(axes="xyz").checked_axes == (0, 2)


def test_an_output_without_a_response_is_exactly_silent(user_data):
    taps = np.random.default_rng(2).standard_normal((2, 3, 1, 400))
    taps[:, 1] = 0.0
    # Nothing arrives for a while, although something plays.
    taps[..., :150] = 0.0
    limb = keep("deaf", taps, sample_rate_hz=1000.0)
    scene = scene_of("S6", limb)
    reference = exact_response(scene)
    assert (reference.high[1] == 0.0).all()
    for engine in ENGINES:
        prepared = engine.prepare(scene, Method())
        errors = errors_of(reference, picked(reference, prepared.rows, prepared.run(0)))
        assert errors.peak <= 1e-14
        if engine.is_ours:
            assert errors.silence == 0.0
    values = reference.high.copy()
    values[1, 0, 0] = 1e-20
    assert errors_of(reference, values).peak > 1.0


def test_what_does_not_fit_a_limb_is_said():
    big = scene_of("S3", sized(256, 512, 9000, name="x"))
    for engine in ENGINES:
        with pytest.raises(Unfit, match=r"would hold .* GB at once"):
            engine.prepare(big, Method())


def test_spectra_of_a_large_limb_are_made_without_a_second_copy_of_all():
    taps = np.random.default_rng(1).standard_normal((8, 16, 100))
    tracemalloc.start()
    spectra = spectra_of(taps, 4096)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    np.testing.assert_array_equal(spectra, fft.rfft(taps, 4096))
    assert most < 1.5 * spectra.nbytes
    assert spectra_of(taps.astype(np.float32), 4096).dtype == np.complex64


@pytest.mark.parametrize("method", engine_of("this program").methods[:2])
def test_spectra_of_responses_are_no_part_of_the_runs_of_this_program(lab, method, monkeypatch):
    prepared = engine_of("this program").prepare(scene_of("S7", limb_called("lab-1")), method)
    transformed = []
    monkeypatch.setattr(response_spectra, "scaled_taps", lambda *a: transformed.append(a))
    assert all(block.size for _, block in prepared.run(0))
    assert transformed == []


def test_settings_that_short_or_long_responses_leave_no_room_for_are_said(user_data):
    taps = np.random.default_rng(2).standard_normal((2, 3, 1, 1000))
    scene = scene_of("S1", keep("long", taps))
    with pytest.raises(Unfit, match="blocks of 1024 samples are hardly longer than responses"):
        engine_of("overlap-add").prepare(scene, Method(setting=Setting(block=1024)))
    scene = scene_of("S1", keep("short", taps[..., :20]))
    with pytest.raises(Unfit, match="responses of 20 samples have no 32 shapes"):
        engine_of("cached spectra").prepare(scene, Method(setting=Setting(rank=32)))
    # As many shapes as samples there are.
    assert engine_of("cached spectra").prepare(scene, Method(setting=Setting(rank=20))).rows.size


def test_blocks_of_no_given_length_suit_long_responses(user_data):
    taps = np.random.default_rng(2).standard_normal((1, 2, 1, 6000))
    scene = scene_of("S1", keep("long", taps))
    reference = exact_response(scene)
    prepared = engine_of("overlap-add").prepare(scene, Method())
    assert errors_of(reference, picked(reference, prepared.rows, prepared.run(0))).peak <= 1e-14


def test_a_limb_that_is_removed_or_replaced_is_told(lab):
    limb = limb_called("lab-1")
    assert (limb.n_inputs, limb.n_outputs, limb.n_channels) == (N_INPUTS, N_OUTPUTS, 62)
    install_limb(own_limb(), (2.0 * response(place) for place in range(1, N_INPUTS + 1)))
    with pytest.raises(InvalidInputError, match="is another one"):
        limb.load()
    remove_limb("lab-1")
    with pytest.raises(UnknownLimbError):
        limb.load()


def test_a_short_run_on_a_limb_writes_all_of_it(lab, tmp_path, monkeypatch, capsys):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    chosen = ("this program", "direct")
    monkeypatch.setattr(commands, "EVERY_ENGINE", tuple(e for e in ENGINES if e.name in chosen))
    monkeypatch.setattr(commands, "scenes_on", lambda limb: (scene_of("S1", limb),))
    folder = tmp_path / "new"
    words = ["bench", "--quick", "--limb", "lab-1", "--progress", "lines", "--out", str(folder)]
    assert main(words) == 0
    said = capsys.readouterr().out
    # Float32 is no precision of this program, and not in the short run.
    assert said.startswith("0/6 exact values of S1\n0/6 S1 ")
    assert "6 rows, 0 of them could not be measured; this program breaks its promises in 0." in said
    assert sorted(path.name for path in folder.iterdir()) == [
        EXACT_NAME,
        "report.md",
        *(f"work_precision.{kind}" for kind in ("csv", "png", "svg")),
    ]
    rows = read_table(folder / "work_precision.csv")
    assert {row.limb for row in rows} == {limb_called("lab-1")}
    assert all(0.0 < row.err_window < 1e-5 for row in rows)
    assert "lab-1: 7 places × 31 outputs" in (folder / "work_precision.svg").read_text()


def test_a_limb_that_is_not_there_is_one_sentence_and_nothing_is_written(
    user_data, tmp_path, capsys
):
    assert main(["bench", "--quick", "--limb", "nobody", "--out", str(tmp_path / "x")]) == 1
    said = capsys.readouterr().err
    assert said.startswith("skinsource: the limb 'nobody' is not available here; choose one of ")
    assert len(said.splitlines()) == 1
    assert not (tmp_path / "x").exists()
