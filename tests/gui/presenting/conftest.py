"""Three designs in a folder, the second of them open."""

from dataclasses import replace

import pytest

import skinsource as ss
from skinsource.design.design_file import save_design


@pytest.fixture
def design():
    tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
    tracks = (ss.track(7, tone), ss.track(13, tone, colour=1, onset_s=0.05))
    return ss.Design(limb="synthetic-1", inputs=tracks)


@pytest.fixture
def folder(tmp_path, design):
    """Three designs, each with its name as its title."""
    for name in ("1 tap", "2 tone", "3 both"):
        scene_design = replace(design, title=name, notes=f"Say {name}")
        save_design(tmp_path / f"{name}.skinsource", scene_design, ss.View())
    return tmp_path


@pytest.fixture
def studio(open_window, folder, design):
    window = open_window(design)
    window.files.open(folder / "2 tone.skinsource")
    return window
