"""What the Wave panel says of a speed that the delays do not bear out."""

from dataclasses import replace

import numpy as np

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.engine.evaluation import evaluate
from skinsource.signals.analysis.wave_speed import travelling_wave
from skinsource_gui.panels.wave.panel import wave_text


def the_wave():
    """A tone burst that passes four points at 10 m/s."""
    rate, way_mm = 4000.0, np.array([0.0, 20.0, 40.0, 60.0])
    time = np.arange(2000) / rate
    burst = [np.exp(-(((time - 0.2 - d / 1e4) * 60.0) ** 2)) for d in way_mm]
    carried = [
        b * np.sin(2 * np.pi * 150.0 * (time - d / 1e4)) for b, d in zip(burst, way_mm, strict=True)
    ]
    return travelling_wave(np.array(carried), way_mm, rate)


def test_a_speed_is_said_where_delays_grow_with_the_way():
    assert wave_text(the_wave()).startswith("Speed 10.0 ± ")


def test_a_speed_less_sure_than_itself_is_none():
    unsure = replace(the_wave(), speed_m_per_s=688.1, speed_deviation_m_per_s=3090.9)
    assert wave_text(unsure).startswith("No speed: delays do not grow in step with the distance")
    negative = replace(unsure, speed_m_per_s=-20.0, speed_deviation_m_per_s=30.0)
    assert wave_text(negative).startswith("No speed")


def test_a_way_to_and_fro_and_delays_out_of_step_are_said_to_have_no_speed():
    nothing = replace(the_wave(), speed_m_per_s=np.nan, speed_deviation_m_per_s=np.nan)
    back = wave_text(replace(nothing, straight=0.2))
    assert back.startswith("No speed: the selected outputs do not go one way · attenuation")
    jumping = wave_text(replace(nothing, explained=0.4))
    assert jumping.startswith("No speed: delays do not grow in step with the distance")
    late = wave_text(nothing)
    assert late.startswith("No speed: the arrival is not later farther away")


def test_all_outputs_one_after_the_other_are_no_line():
    design = Design(limb="synthetic-1", inputs=(track(7),))
    every = evaluate(design, "line_wave", view=View(outputs=tuple(range(1, 73))))["line_wave"]
    assert every.wave.straight < 0.5
    assert np.isnan(every.wave.speed_m_per_s)
    assert wave_text(every.wave).startswith("No speed: the selected outputs do not go one way")


def test_one_output_above_the_noise_has_neither_speed_nor_attenuation():
    counted = np.array([True, False, False, False])
    text = wave_text(replace(the_wave(), counted=counted, timed=counted))
    assert text == "fewer than two outputs are more than noise"


def test_a_line_through_two_outputs_is_said_to_have_no_uncertainty():
    assert "two outputs: no uncertainty" not in wave_text(the_wave())
    two = replace(
        the_wave(),
        timed=np.array([True, True, False, False]),
        speed_deviation_m_per_s=float("nan"),
    )
    assert wave_text(two).startswith("Speed 10.0 m/s ")
    assert wave_text(two).endswith("two outputs: no uncertainty")
