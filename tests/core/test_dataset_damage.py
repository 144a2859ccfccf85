"""Damaged stores: whatever happens to the bytes, no other data are ever given."""

from collections import Counter

import numpy as np
import pytest

from skinsource.base.errors import DatasetError
from skinsource.limbs.dataset import store
from skinsource.limbs.dataset.published import MAP_SHAPES, map_name
from tests.core.dataset_bench import offset_of

SEED = 20262


def everything():
    limb = store.load_measured_limb(1)
    arrays = (
        limb.map.outline,
        limb.map.output_positions,
        limb.map.input_positions,
        limb.map.visibility,
        limb.response_to(1),
        limb.response_to(20),
    )
    return store.describe(), [array.tobytes() for array in arrays]


@pytest.mark.parametrize("way", ["flip", "hole", "noise"])
def test_damage_outside_the_values_is_refused_or_makes_no_difference(synthetic_installed, way):
    random = np.random.default_rng(SEED)
    size = synthetic_installed.stat().st_size
    # Headers of the arrays, and the table of contents.
    read = (*map(map_name, MAP_SHAPES), "responses/1-1", "responses/1-20")
    heads = [np.arange(-60, 128) + offset_of(synthetic_installed, name) for name in read]
    places = np.concatenate([np.arange(400), *heads, np.arange(size - 8000, size - 32)])
    expected, outcome = everything(), Counter()
    with synthetic_installed.open("r+b", buffering=0) as opened:
        for attempt in range(150):
            place = int(random.choice(places[places >= 0]))
            opened.seek(place)
            old = opened.read(32)
            opened.seek(place)
            flipped = bytes([old[0] ^ 1 << int(random.integers(8))]) + old[1:]
            opened.write({"flip": flipped, "hole": bytes(32), "noise": random.bytes(32)}[way])
            try:
                content = everything()
            except DatasetError as error:
                outcome["refused" if "Install it again" in str(error) else str(error)] += 1
            else:
                outcome["the same" if content == expected else f"another, {attempt}"] += 1
            opened.seek(place)
            opened.write(old)
    assert set(outcome) <= {"refused", "the same"}, f"{SEED=}: {outcome}"
    assert outcome["refused"] > 25, f"{SEED=}: {outcome}"


def test_a_store_cut_off_anywhere_is_refused(synthetic_installed):
    random = np.random.default_rng(SEED)
    size = synthetic_installed.stat().st_size
    cuts = [size - 1, *sorted(random.integers(0, size, 30).tolist(), reverse=True), 100, 47, 8, 1]
    for cut in cuts:
        with synthetic_installed.open("r+b") as opened:
            opened.truncate(cut)
        for call in (store.describe, lambda: store.load_measured_limb(1), store.verify):
            with pytest.raises(DatasetError, match="Install it again"):
                call()
            assert synthetic_installed.stat().st_size == cut, f"{SEED=}"
