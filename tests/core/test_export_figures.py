"""What exports say of how they were computed, and how wrong they can be."""

import hashlib
import os
import re

import numpy as np
import pytest
import scipy

from skinsource.base.errors import TooInaccurateError
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine import trace_rules
from skinsource.engine.gains import TraceError
from skinsource.engine.streaming import StreamedVibration
from skinsource.engine.transforms import BLOCK_FFT
from skinsource.export.tables import export_field, export_levels, export_traces
from skinsource.limbs.catalog import load_limb
from skinsource.version import __version__

EXPORTS = {"traces.csv": export_traces, "levels.csv": export_levels, "field.npz": export_field}
VIEW = View(axes="xz", outputs=(29, 7))


def design(duration_s: float, **more) -> Design:
    return Design(
        limb="synthetic-2",
        inputs=(
            track(location=7, waveform=Noise(seed=3, duration_s=duration_s), amplitude=0.1),
            track(location=13, waveform=Tap(), amplitude=-2.0, onset_s=0.25 * duration_s),
            track(location=2, waveform=Tone(), muted=True),
        ),
        **more,
    )


def about(path) -> str:
    if path.suffix == ".npz":
        with np.load(path, allow_pickle=False) as archive:
            return str(archive["about"])
    lines = path.read_text(encoding="utf-8").splitlines()
    return "\n".join(line[2:] for line in lines if line.startswith("#"))


def figures(text: str) -> tuple[float, float]:
    """Estimate and bound."""
    match = re.search(r"error of .*: about (\S+) \(.*\), at most (\S+) \(theory\)", text)
    assert match, text
    return float(match[1]), float(match[2])


@pytest.mark.parametrize("name", EXPORTS)
@pytest.mark.parametrize(
    ("duration_s", "method"), [(0.2, "cached spectra"), (16.0, f"overlap-save {BLOCK_FFT}")]
)
@pytest.mark.parametrize("scaling", ["upstream", "relative", "probe"])
def test_exports_carry_their_figures(tmp_path, name, duration_s, method, scaling):
    EXPORTS[name](tmp_path / name, design(duration_s, scaling=scaling), VIEW)
    text = about(tmp_path / name)
    digest = hashlib.sha256()
    for place in (7, 13):
        digest.update(load_limb("synthetic-2").response_to(place).tobytes())
    for fact in (
        f"skinsource {__version__}, numpy {np.__version__}, scipy {scipy.__version__}",
        f"precision and method: float64, {method}",
        "inputs heard: 2 of 3",
        "SYNTHETIC",
        f"responses to places 7, 13: SHA-256 {digest.hexdigest()}",
    ):
        assert fact in text
    estimate, bound = figures(text)
    assert 0.0 < estimate <= 1e-14
    assert estimate < bound < 1e-10


@pytest.mark.parametrize("name", EXPORTS)
def test_the_same_design_gives_the_same_bytes(tmp_path, name):
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir()
        EXPORTS[name](tmp_path / folder / name, design(16.0), VIEW)
    assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


@pytest.mark.parametrize("duration_s", [0.2, 16.0])
@pytest.mark.parametrize("name", EXPORTS)
def test_what_is_too_inaccurate_is_not_written(tmp_path, name, duration_s):
    (tmp_path / name).write_bytes(b"old")
    with pytest.raises(TooInaccurateError, match="Nothing was written"):
        EXPORTS[name](tmp_path / name, design(duration_s), VIEW, largest_error=1e-18)
    assert os.listdir(tmp_path) == [name]
    assert (tmp_path / name).read_bytes() == b"old"
    EXPORTS[name](tmp_path / name, design(duration_s), VIEW, largest_error=1e-3)
    assert (tmp_path / name).read_bytes() != b"old"


def test_an_error_that_is_no_number_is_too_large(tmp_path, monkeypatch):
    nothing = TraceError(estimate=float("nan"), bound=float("nan"))
    monkeypatch.setattr(trace_rules, "trace_error_of", lambda *_: nothing)
    with pytest.raises(TooInaccurateError):
        export_traces(tmp_path / "t.csv", design(0.2), VIEW, largest_error=1e-3)


def test_samples_that_are_wrong_show_in_the_figures_of_a_long_field(tmp_path, monkeypatch):
    right = StreamedVibration.blocks

    def a_little_late(self, *stop):
        for first, block in right(self, *stop):
            yield first, np.roll(block, 1, axis=-1)

    monkeypatch.setattr(StreamedVibration, "blocks", a_little_late)
    export_field(tmp_path / "field.npz", design(16.0), VIEW)
    assert figures(about(tmp_path / "field.npz"))[0] > 1e-2
