"""What the benchmark reckons of a limb: memory before it is taken, digests, bounds of rounding."""

import hashlib

import numpy as np
import pytest

from skinsource.catalogue import load_limb
from skinsource.method_comparison import commands
from skinsource.method_comparison.compared_limb import limb_called
from skinsource.method_comparison.direct_sums import EXACT_NAME, exact_response, write_references
from skinsource.method_comparison.engines import engine_of
from skinsource.method_comparison.made_up import made_up_drive
from skinsource.method_comparison.measure import QUICK, cases_of
from skinsource.method_comparison.method import Method, Setting, Unfit, response_bytes
from skinsource.method_comparison.references import load_reference
from skinsource.method_comparison.scenes import scene_of
from skinsource.method_comparison.worker import Task, measured
from tests.core.own_limbs.compared import keep, sized


def test_one_call_of_the_library_counts_the_responses_that_it_reads():
    big = scene_of("S3", sized(256, 512, 9000))
    with pytest.raises(Unfit, match=r"would hold 19\.3 GB at once"):
        engine_of("this program").prepare(big, Method(setting=Setting(what="library")))


def test_responses_to_a_place_that_plays_twice_count_once():
    limb = sized(7, 31, 90)
    assert response_bytes(scene_of("S6", limb)) == 31 * 2 * 90 * 8
    assert response_bytes(scene_of("S2", limb)) == 4 * 31 * 2 * 90 * 8


def test_sums_over_long_responses_to_many_places_are_not_begun(user_data):
    limb = keep("wide", np.ones((30, 1, 1, 10_000)))
    with pytest.raises(Unfit, match=r"would hold 2\.5 GB at once"):
        engine_of("direct").prepare(scene_of("S3", limb), Method())


def test_the_digest_of_a_limb_that_names_none_is_that_of_its_numbers():
    limb, digest = load_limb("synthetic-2"), hashlib.sha256()
    for place in range(1, limb.n_inputs + 1):
        digest.update(limb.response_to(place).astype("<f8").tobytes())
    assert limb_called("synthetic-2").digest == digest.hexdigest()


def test_exact_values_are_as_far_off_as_those_of_the_worst_scene(user_data, tmp_path):
    taps = np.ones((2, 1, 1, 2))
    # Of one place some bits are left out, of the other none.
    taps[0, 0, 0, 1] = 2.0**-110 / 7.0
    limb = keep("steep", taps)
    cases = cases_of(
        [scene_of(key, limb) for key in ("S1", "S6")], [engine_of("direct")], quick=True
    )
    path = tmp_path / EXACT_NAME
    found = commands._write_exact(path, cases, QUICK, lambda *_: None)
    bounds = [exact_response(case.scene).bound for case in cases]
    assert min(bounds) < found == max(bounds)
    assert load_reference("S1", path).high.size


def test_the_ratio_is_over_the_norms_of_drives_and_responses(user_data, tmp_path):
    taps = np.random.default_rng(8).normal(size=(7, 1, 1, 30))
    limb = keep("lab-1", taps)
    scene, path = scene_of("S2", limb), tmp_path / EXACT_NAME
    write_references(path, {"S2": exact_response(scene)})
    task = Task(
        scene="S2",
        engine="direct",
        precision="float64",
        setting="exact",
        longest_s=0.0,
        most_runs=1,
        warm_ups=0,
        limb=limb.name,
        digest=limb.digest,
        references=str(path),
    )
    found, bound = measured(task), 0.0
    for one in scene.players:
        drive = abs(one.amplitude) * np.linalg.norm(made_up_drive(one.seed, one.n_times))
        bound += drive * np.linalg.norm(taps[one.location - 1])
    unit = np.finfo(float).eps * np.log2(scene.response_samples) * bound
    error = found["errors"]["peak"] * exact_response(scene).peaks.max()
    assert error > 0.0
    assert found["ratio"] == pytest.approx(error / unit)
