"""Commands on designs of a limb that lacks outputs which the usual view looks at."""

import numpy as np

from skinsource.cli.command_line import main
from skinsource.design.design import Design, track
from skinsource.design.design_file import save_design
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Impulse
from skinsource.design.waveforms.tones import Tone
from tests.core.own_limbs.lab_bench import installed, keep


def test_a_design_is_rendered_and_packed_that_was_saved_without_a_view(user_data, tmp_path, capsys):
    installed()
    path = tmp_path / "lab.skinsource"
    save_design(path, Design(limb="lab-1", inputs=(track(2, Tone(duration_s=0.02)),)))
    assert View().outputs == (29, 52)
    assert main(["render", str(path), "--out", str(tmp_path)]) == 0
    lines = (tmp_path / "traces.csv").read_text().splitlines()
    (header,) = [line for line in lines if line.startswith("time_s")]
    assert header == "time_s,output_29_m_per_s2"
    assert main(["pack", str(path), "--out", str(tmp_path / "lab.zip")]) == 0
    assert capsys.readouterr().err == ""


def test_a_response_without_a_frequency_in_the_band_is_checked_and_no_line_is_told(
    user_data, tmp_path, capsys
):
    responses = np.random.default_rng(5).normal(size=(2, 3, 1, 6))
    rate = {"sample_rate_hz": 48_000.0, "pre_trigger_delay_s": 0.0, "band_hz": (25.0, 600.0)}
    keep("lab-short", responses, **rate)
    path = tmp_path / "short.skinsource"
    inputs = tuple(track(place, Impulse()) for place in (1, 2))
    save_design(path, Design(limb="lab-short", inputs=inputs))
    assert main(["check", str(path)]) == 0
    assert "adjusted R² –; superposition: r 1" in capsys.readouterr().out
