"""What the engine remembers is bounded."""

import subprocess
import sys
import tracemalloc

import pytest

from skinsource.base.measurement_conditions import N_AXES, N_OUTPUTS
from skinsource.design.signal_path import Part, SignalPath, UnitVoice
from skinsource.design.waveforms.tones import Tone
from skinsource.engine import memory as budgets
from skinsource.engine.memory import ENTRY_BYTES, Memory
from skinsource.engine.shared import Shared
from skinsource.engine.spectra import ResponseSpectra
from skinsource.engine.transforms import length_at_once
from skinsource.limbs.synthetic import load_synthetic_limb


def test_all_memories_together_hold_at_most_256_mebibytes():
    assert budgets.TOTAL_BYTES <= 256 * 2**20


def test_every_memory_of_an_engine_is_held_to_its_budget():
    shared = Shared()
    remembered = shared.remembered()
    drives = remembered.drives
    held_to = [
        remembered.responses._budget_bytes,
        drives._drawn._budget_bytes,
        drives._spectra._budget_bytes,
        drives.clips._known._budget_bytes,
        remembered.exact_spectra._known._budget_bytes,
        remembered.gains._known._budget_bytes,
        shared._surfaces._budget_bytes,
    ]
    assert sum(held_to) == budgets.TOTAL_BYTES


@pytest.mark.parametrize("n_places", [1, 2, 4, 5, 7, 10, 19, 20])
def test_whatever_is_transformed_at_once_fits(n_places):
    longest = max(n for n in range(500, 40_000, 97) if length_at_once(n, n_places, 216) is not None)
    n_bins = length_at_once(longest, n_places, 216) // 2 + 1
    held = n_places * N_OUTPUTS * N_AXES * n_bins * 16
    assert held <= budgets.RESPONSE_SPECTRA_BYTES
    # Nor is less transformed at once than there is room for.
    assert n_places < 5 or held > budgets.RESPONSE_SPECTRA_BYTES / 2


def test_the_least_recently_used_goes_first():
    memory = Memory[bytes](budget_bytes=2 * ENTRY_BYTES + 10, size_of=len)
    memory.add("a", b"1234")
    memory.add("b", b"1234")
    assert memory.find("a") == b"1234"
    memory.add("c", b"1234")
    assert (memory.find("a"), memory.find("b"), memory.find("c")) == (b"1234", None, b"1234")
    assert memory.held_bytes == 2 * ENTRY_BYTES + 8


def test_many_small_values_do_not_exceed_the_budget_by_their_keys():
    # Traced, not counted: what Python takes for a key like those of the engine.
    tracemalloc.start()
    try:
        memory = Memory[float](budget_bytes=10**6, size_of=sys.getsizeof)
        for k in range(5000):
            tone = Tone(frequency_hz=100 + k / 100, duration_s=0.1)
            memory.add((UnitVoice(SignalPath((Part(tone),)), 7), 1920), k / 7)
        held_bytes, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert held_bytes < 10**6


def test_spectra_of_lengths_not_in_use_go_before_the_budget_is_exceeded():
    limb = load_synthetic_limb(1)
    one_place = N_OUTPUTS * N_AXES * (1152 // 2 + 1) * 16
    spectra = ResponseSpectra(budget_bytes=3 * one_place)
    for n_fft in (768, 960, 1152):
        spectra.of(limb, [7], "relative", n_fft)
        assert spectra.held_bytes <= 3 * one_place
    spectra.of(limb, [8], "relative", 1152)
    spectra.stack(limb, (7, 8), "relative", 768)
    assert 0 < spectra.held_bytes <= 3 * one_place


def test_spectra_are_kept_while_they_fit_and_read_once():
    limb = load_synthetic_limb(1)
    spectra = ResponseSpectra()
    (first,) = spectra.of(limb, [7], "relative", 1152)
    assert spectra.of(limb, [7], "upstream", 1152)[0] is first
    assert spectra.of(limb, [7], "probe", 1152)[0] is not first
    stack = spectra.stack(limb, (3, 7), "relative", 1152)
    assert spectra.stack(limb, (3, 7), "relative", 1152) is stack
    assert (stack.responses[7].values == first.values).all()


@pytest.mark.skipif(sys.platform != "linux", reason="reads how much is resident from /proc")
def test_places_that_were_never_asked_for_take_no_memory():
    # In a process of its own: what others left behind would count.
    script = """
from skinsource.base.allocation import keep_freed_memory
from skinsource.engine.spectra import ResponseSpectra
from skinsource.engine.shared import Shared
from skinsource.limbs.synthetic import load_synthetic_limb
from skinsource.design.waveforms import Tone
import numpy as np
keep_freed_memory()
limb = load_synthetic_limb(1)
limb.response_to(7)
del (waste := [np.ones(2**25)])[:]
def resident():
    return int(open("/proc/self/statm").read().split()[1]) * 4096
before = resident()
spectra = ResponseSpectra()
for n_fft in (3072, 3840, 4608, 6144):
    spectra.of(limb, [7], "relative", n_fft)
held = spectra.held_bytes
assert held < 60e6, held
# Each length ends within a large page.
assert resident() - before < 2 * held + 4 * 2**21, (resident() - before, held)
"""
    subprocess.run([sys.executable, "-c", script], check=True)
