"""Operators of maps on disk: found again bit by bit, built again whatever has happened to them."""

import os
from dataclasses import replace

import numpy as np
import pytest

from skinsource.base.assets import cache_folder
from skinsource.base.work import counting
from skinsource.limbs.surface import surface
from skinsource.limbs.surface.surface import cached_surface_operator, surface_operator

SPACING_MM = 8.0


@pytest.fixture(autouse=True)
def _a_folder_of_its_own(user_data, monkeypatch):
    monkeypatch.setenv("SKINSOURCE_CACHE", str(user_data / "kept"))


@pytest.fixture(scope="module")
def built(limb):
    return surface_operator(limb, SPACING_MM)


def fetched(limb, spacing_mm=SPACING_MM):
    """The operator, and how many were built."""
    with counting() as work:
        operator = cached_surface_operator(limb, spacing_mm)
    return operator, work.operators_built


def files():
    return sorted((cache_folder() / "surface").iterdir())


def bits(operator):
    """All of an operator, to the last bit."""
    weights, grid = operator.weights, (operator.mask, operator.x_mm, operator.y_mm)
    arrays = (weights.data, weights.indices, weights.indptr, *grid)
    rest = ("fallback_count", "blind_vertices", "single_vertices", "same_place", "warnings")
    told = [getattr(operator, name) for name in rest]
    return weights.shape, [(array.dtype, array.tobytes()) for array in arrays], told


def same(operator, expected) -> bool:
    return bits(operator) == bits(expected)


def test_an_operator_is_built_once_and_found_again_to_the_last_bit(limb, built):
    first, n_first = fetched(limb)
    again, n_again = fetched(limb)
    assert (n_first, n_again) == (1, 0)
    assert same(first, built)
    assert same(again, built)
    values = np.linspace(-40, 0, 72)
    np.testing.assert_array_equal(again.interpolate(values), built.interpolate(values))


def test_another_map_hand_or_spacing_is_another_operator(limb, limb_of):
    fetched(limb)
    nudged = limb.map.output_positions.copy()
    nudged[30] += 1e-9
    moved = replace(limb.map, output_positions=nudged)
    others = (
        limb_of(limb.response_to, map=moved),
        limb_of(limb.response_to, hand_length_mm=limb.hand_length_mm + 1e-9),
        limb_of(limb.response_to, map=replace(limb.map, densify=not limb.map.densify)),
    )
    assert [fetched(other)[1] for other in others] == [1, 1, 1]
    assert fetched(limb, 9.0)[1] == 1
    assert fetched(limb)[1] == 0


def test_other_code_builds_anew(limb, monkeypatch):
    fetched(limb)
    monkeypatch.setattr(surface, "_version_bytes", lambda: b"changed")
    assert fetched(limb)[1] == 1


def test_of_any_damage_nothing_is_seen(limb, built):
    fetched(limb)
    (path,) = files()
    whole = path.read_bytes()
    random = np.random.default_rng(1)
    for place in [0, 21, 30, *random.integers(0, len(whole), 7).tolist()]:
        bent = bytearray(whole)
        bent[place] ^= 1 << int(random.integers(8))
        path.write_bytes(bent)
        operator, n_built = fetched(limb)
        assert n_built == 1
        assert same(operator, built)
        assert path.read_bytes() == whole  # mended
    for cut in (0, 10, 60, len(whole) // 2, len(whole) - 1):
        path.write_bytes(whole[:cut])
        operator, n_built = fetched(limb)
        assert (n_built, same(operator, built)) == (1, True)


def test_a_folder_that_cannot_be_written_costs_the_time_and_nothing_else(
    limb, built, user_data, monkeypatch
):
    (user_data / "file").write_text("no folder")
    monkeypatch.setenv("SKINSOURCE_CACHE", str(user_data / "file"))
    for _ in range(2):
        operator, n_built = fetched(limb)
        assert (n_built, same(operator, built)) == (1, True)


def test_what_was_used_last_is_kept_longest(limb, monkeypatch):
    spacings = (8.0, 8.5, 9.0, 9.5)
    for k, spacing in enumerate(spacings):
        fetched(limb, spacing)
        newest = max(files(), key=lambda path: path.stat().st_mtime_ns)
        os.utime(newest, (1000 + k, 1000 + k))
    assert fetched(limb, 8.0)[1] == 0  # used now
    largest = max(path.stat().st_size for path in files())
    monkeypatch.setattr(surface, "MOST_ON_DISK_BYTES", 3 * largest)
    fetched(limb, 10.0)
    assert sum(path.stat().st_size for path in files()) <= 3 * largest
    assert [fetched(limb, spacing)[1] for spacing in (8.0, 10.0)] == [0, 0]
    assert fetched(limb, 8.5)[1] == 1


def test_too_large_an_operator_is_not_kept(limb, monkeypatch):
    monkeypatch.setattr(surface, "LARGEST_BYTES", 1000)
    assert [fetched(limb)[1] for _ in range(2)] == [1, 1]
    assert not cache_folder().exists()
