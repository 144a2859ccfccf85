"""What a notebook shows of a design."""

from dataclasses import replace
from xml.etree import ElementTree

import pytest

import skinsource as ss

SVG = "{http://www.w3.org/2000/svg}"


def drawing_of(design):
    html = design._repr_html_()
    return ElementTree.fromstring(html[html.index("<svg") : html.index("</svg>") + 6])  # noqa: S314


def curves_of(design):
    """Points of each drawn curve."""
    return [
        [tuple(map(float, point.split(","))) for point in polyline.get("points").split()]
        for polyline in drawing_of(design).iter(f"{SVG}polyline")
    ]


def tone(place, onset_s=0.0, **changes):
    waveform = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.1)
    return ss.track(place, waveform, onset_s=onset_s, **changes)


def test_it_names_title_limb_scaling_places_and_waveforms():
    design = ss.Design(limb="measured-3", inputs=(tone(7),), title="A <tone>")
    html = design._repr_html_()
    assert "A &lt;tone&gt;" in html
    assert "Measured 3 (185 mm)" in html
    assert "Probe acceleration" in html
    assert ">7 II pad</text>" in html
    assert "Tone(frequency_hz=100.0" in html
    assert "<td>1 m/s²</td>" in html


def test_each_track_has_a_curve_from_its_onset_on():
    design = ss.Design(limb="synthetic-1", inputs=(tone(7), tone(13, onset_s=0.1)))
    first, second = curves_of(design)
    assert len(first) == len(second) == 130
    end = 2 * first[-1][0] - first[-2][0]
    assert second[0][0] == pytest.approx(end, abs=0.2)
    middle = [min(y for _, y in curve) + max(y for _, y in curve) for curve in (first, second)]
    assert middle[1] > middle[0]


def test_what_is_not_heard_is_pale():
    design = ss.Design(limb="synthetic-1", inputs=(tone(7), tone(8, muted=True)))
    strokes = [polyline.get("stroke") for polyline in drawing_of(design).iter(f"{SVG}polyline")]
    assert strokes == ["#0072B2", "#BBBBBB"]


def test_a_long_track_is_drawn_with_few_points_and_its_peaks():
    sweep = ss.waveforms.Chirp(duration_s=60.0)
    (points,) = curves_of(ss.Design(limb="synthetic-1", inputs=(ss.track(3, sweep),)))
    assert 500 < len(points) < 1000
    heights = [y for _, y in points]
    assert max(heights) - min(heights) == pytest.approx(2 * 0.44 * 36, abs=1.0)


# At most two samples in a pixel, and many.
@pytest.mark.parametrize("duration_s", [0.3, 0.69, 5.0])
def test_many_long_tracks_take_less_than_200_kb(duration_s):
    noise = ss.waveforms.Noise(seed=1, duration_s=duration_s)
    glide = ss.waveforms.Glide(points=tuple((1e-4 * k, 100.0 + k / 7, 0.5) for k in range(2000)))
    clips = (ss.Clip(waveform=noise), ss.Clip(waveform=glide))
    many = ss.Design(limb="synthetic-1", inputs=(ss.Input(location=7, clips=clips),) * 30)
    assert 100_000 < len(many._repr_html_().encode()) < 200_000


def test_many_clips_are_counted_and_not_all_listed():
    clips = tuple(ss.Clip(waveform=ss.waveforms.Tap(), onset_s=0.02 * k) for k in range(60))
    design = ss.Design(limb="synthetic-1", inputs=(ss.Input(location=3, clips=clips),))
    html = design._repr_html_()
    assert "… and 20 more clips" in html
    assert "… and 1 more clip<" in design.with_input(0, clips=clips[:41])._repr_html_()
    assert html.count("<tr>") == 41


def test_what_effects_make_longer_is_drawn_to_its_end():
    (clip,) = tone(7).clips
    longer = replace(clip, effects=(ss.effects.Repeat(times=4),))
    design = ss.Design(limb="synthetic-1", inputs=(replace(tone(7), clips=(longer,)),))
    (points,) = curves_of(design)
    assert points[-1][0] <= float(drawing_of(design).get("width"))
