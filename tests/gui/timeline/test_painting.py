"""What the lanes paint: only lanes that look different, and the wave through the samples."""

from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QSizeF
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QApplication

from skinsource import Clip, Design, Input, View, edits
from skinsource.design.effects.level import Fade
from skinsource.design.signal_path import UnplayableInput
from skinsource.design.waveforms.pulses import Tap
from skinsource_gui.panels.timeline import painting
from skinsource_gui.plots.preview import ClipPictures, ClipStyle
from skinsource_gui.qt.theme import DARK, apply_theme, current_theme
from tests.gui.panel_host import clip_results
from tests.gui.timeline.bench import ALT, TONE, LanesBench


@pytest.fixture
def four_lanes(qtbot):
    made = LanesBench(qtbot)
    made.panel.resize(1000, 400)
    clips = (Clip(onset_s=0.1, waveform=TONE), Clip(onset_s=0.5, waveform=Tap()))
    tracks = tuple(Input(location=1 + k, clips=clips) for k in range(4))
    made.view = replace(made.view, time_range_s=(0.0, 1.2), selected_inputs=())
    made.show(Design(limb="synthetic-1", inputs=tracks))
    made.panel.show_results(clip_results(made.design))
    settled(made)
    return made


def settled(lanes):
    """Have everything painted that is to be painted; how many lanes that were."""
    lanes_painted, last_step = [], painting.paint_silence_reason

    def count(*given):
        lanes_painted.append(1)
        return last_step(*given)

    with patch.object(painting, "paint_silence_reason", count):
        QApplication.processEvents()
        lanes.lanes.viewport().repaint()
    return len(lanes_painted)


def picture(lanes):
    return lanes.lanes.viewport().grab().toImage()


def changed(lanes, index, **changes):
    """Show a design in which the first clip of a track is something else."""
    clip = lanes.design.inputs[index].clips[0]
    lanes.show(lanes.design.with_clip(clip.id, **changes))


def test_words_on_a_silent_lane_look_the_same_over_clips_and_gain_curves(four_lanes):
    muted = four_lanes.design.with_input(0, muted=True, gain_curve=((0.0, 0.1), (0.3, 0.05)))
    four_lanes.show(muted.with_input(1, muted=True, clips=()), time_range_s=(0.0, 0.25))
    settled(four_lanes)
    seen, left = picture(four_lanes), four_lanes.lanes.width() - 40
    tops = [round(lane.bottom_px) - 16 for lane in four_lanes.content.lanes[:2]]
    over, free = (seen.copy(left, top, 20, 11) for top in tops)
    assert over == free


def test_a_lane_that_cannot_be_played_is_framed_and_no_other(four_lanes):
    before = picture(four_lanes)
    (unplayable, *_) = four_lanes.design.inputs
    four_lanes.panel.show_unplayable(
        (UnplayableInput(unplayable.id, "Too low. Choose another.", unplayable.location),)
    )
    after = picture(four_lanes)
    tops = [
        (round(box.rect.center().x()), round(box.rect.top())) for box in four_lanes.content.boxes
    ]
    reddened = [QColor(after.pixel(*at)).red() > QColor(before.pixel(*at)).red() for at in tops]
    assert reddened == [True, True] + [False] * (len(tops) - 2)


def test_results_repaint_the_lane_whose_samples_are_new(four_lanes):
    results = clip_results(four_lanes.design)
    four_lanes.panel.show_results(results)
    assert settled(four_lanes) == 4
    four_lanes.panel.show_results(dict(results))
    assert settled(four_lanes) == 0
    first, *others = results["clip_waveforms"]
    results["clip_waveforms"] = ((first[0] * 0.5, first[1]), *others)
    four_lanes.panel.show_results(results)
    assert settled(four_lanes) == 1


def test_a_drag_of_a_clip_repaints_its_lane_at_each_move(four_lanes):
    start = four_lanes.middle(3)
    four_lanes.drag(start, start + QPointF(10, 0), ALT, release=False, steps=1)
    settled(four_lanes)
    for way in (40, 80):
        four_lanes.lanes.mouse.move(start + QPointF(way, 0), ALT)
        assert settled(four_lanes) == 1


def select_what_the_inspector_shows(lanes):
    lanes.look(replace(lanes.view, selected_inputs=(2,)))
    settled(lanes)
    lanes.look(replace(lanes.view, selected_clips=(3,)))


EDITS = {
    "clip moved over another": lambda bench: changed(bench, 1, onset_s=0.4),
    "clip stronger than all": lambda bench: changed(bench, 2, gain=3.0),
    "clip muted": lambda bench: changed(bench, 0, muted=True),
    "clip renamed": lambda bench: changed(bench, 0, label="knock"),
    "clip faded": lambda bench: changed(bench, 3, effects=(Fade(),)),
    "track muted": lambda bench: bench.show(bench.design.with_input(2, muted=True)),
    "track alone": lambda bench: bench.show(bench.design.with_input(1, solo=True)),
    "another colour": lambda bench: bench.show(bench.design.with_input(1, colour=7)),
    "no clips": lambda bench: bench.show(bench.design.with_input(0, clips=())),
    "loop": lambda bench: bench.show(replace(bench.design, loop_s=(0.2, 0.7))),
    "clip selected": lambda bench: bench.look(replace(bench.view, selected_clips=(3,))),
    "shown clip selected": select_what_the_inspector_shows,
    "track selected": lambda bench: bench.look(replace(bench.view, selected_inputs=(2,))),
    "other times": lambda bench: bench.look(replace(bench.view, time_range_s=(0.0, 0.9))),
    "hovered": lambda bench: bench.lanes.item.show_hovered(3),
    "no samples": lambda bench: bench.panel.show_problem("No limb."),
    "theme": lambda bench: apply_theme(QApplication.instance(), DARK),
}
#: What changes one lane alone.
OF_ONE_LANE = (
    "clip moved over another",
    *list(EDITS)[2:5],
    "another colour",
    "clip selected",
    "shown clip selected",
    "hovered",
)


@pytest.mark.parametrize("name", EDITS)
def test_what_was_not_repainted_looks_as_if_everything_were(four_lanes, name):
    before = picture(four_lanes)
    EDITS[name](four_lanes)
    n_painted = settled(four_lanes)
    assert name not in OF_ONE_LANE or n_painted == 1
    after = picture(four_lanes)
    assert after != before
    four_lanes.lanes.item.update()
    settled(four_lanes)
    assert after == picture(four_lanes)


def test_a_label_stays_in_its_row_under_the_ruler(four_lanes):
    four_lanes.panel.resize(1000, 140)
    settled(four_lanes)
    four_lanes.rows.verticalScrollBar().setValue(four_lanes.content.lanes[0].height_px - 8)
    pictures = []
    for label in ("Tone", "Longer"):
        changed(four_lanes, 0, label=label)
        four_lanes.lanes.item.update()
        settled(four_lanes)
        top = round(four_lanes.content.lanes[1].top_px)
        pictures.append(picture(four_lanes).copy(0, top, 1000, 40))
    assert four_lanes.content.lanes[0].bottom_px == four_lanes.content.ruler_px + 8
    assert pictures[0] == pictures[1]


def test_the_curve_of_a_fade_goes_on_where_a_split_cut_it(four_lanes):
    clip = Clip(onset_s=0.1, waveform=TONE, effects=(Fade(0.0, 0.08, "straight"),))
    design, text = four_lanes.design.with_input(0, clips=(clip,)), QColor(current_theme().text)
    (whole,) = design.inputs[0].clips
    four_lanes.show(edits.split_clips(design, View(), (whole.id,), 0.25).design)
    settled(four_lanes)
    image, box = picture(four_lanes), four_lanes.content.boxes[1].rect
    for time_s in (0.23, 0.24, 0.27, 0.29):
        x = round(four_lanes.at(time_s).x())
        y = round(box.bottom() - (0.3 - time_s) / 0.08 * box.height())
        near = [image.pixelColor(x + k, y + j) for k in range(-4, 5) for j in range(-4, 5)]
        assert min(abs(colour.lightness() - text.lightness()) for colour in near) < 20


def height_of_curve(lanes, clip):
    """How high the curve of a clip is drawn, as a share of the room for it."""
    lanes.show(lanes.design.with_clip(clip, label=" "))
    image, box = picture(lanes), lanes.box(clip).toRect().adjusted(6, 3, -6, -3)
    ground = QColor(image.pixel(box.right(), box.bottom()))
    rows = [
        y
        for y in range(box.top(), box.bottom())
        if sum(
            abs(QColor(image.pixel(x, y)).blue() - ground.blue()) > 30
            for x in range(box.left() + 40, box.right())
        )
        > 8
    ]
    return (rows[-1] - rows[0]) / box.height()


def test_clips_of_all_tracks_are_drawn_in_one_amplitude_scale(four_lanes):
    design = four_lanes.design
    for index, track in enumerate(({}, {"amplitude": 0.25}, {"gain_curve": ((0.0, 0.5),)}, {})):
        design = design.with_input(index, **track)
    clip = design.inputs[3].clips[0]
    four_lanes.show(design.with_clip(clip.id, gain=-0.5))
    content = four_lanes.content
    peaks = [
        abs(track.amplitude * clip.gain) * content.drawn[clip.id].peak / content.loudest
        for track in content.design.inputs
        for clip in track.clips[:1]
    ]
    assert peaks == pytest.approx([1.0, 0.25, 0.5, 0.5], abs=0.01)
    settled(four_lanes)
    heights = [height_of_curve(four_lanes, track.clips[0].id) for track in design.inputs]
    assert heights == pytest.approx([1.0, 0.25, 0.5, 0.5], abs=0.12)


@pytest.mark.parametrize(("reach", "part"), [(0.5, (0.4, 0.6)), (-0.5, (0.4, 0.6)), (0.5, (0, 1))])
def test_crests_between_samples_are_as_high_as_they_are(reach, part):
    tone = np.sin(2 * np.pi * 433.0 * np.arange(260) / 1300.0)
    look = ClipStyle(1300.0, QColor("blue").rgba(), reach, part)
    pictures = ClipPictures()
    image = pictures.picture(tone, QSizeF(520, 201), look).toImage()
    pixels = np.frombuffer(image.constBits(), np.uint32).reshape(image.height(), -1)
    tops = np.argmax(pixels >> 24 > 100, axis=0)
    # Each stretch of 50 px has a crest at half of the upper half.
    crests = tops[10:-10].reshape(-1, 50).min(axis=1)
    assert np.abs(crests - 201 / 4).max() <= 3


def test_names_of_clips_that_overlap_do_not_lie_on_each_other(four_lanes, monkeypatch):
    rooms = set()
    monkeypatch.setattr(
        painting, "_write", lambda _, text, rect, free, *look, **pale: rooms.add(free.getCoords())
    )
    clips = tuple(Clip(onset_s=0.1 * k, waveform=TONE) for k in range(2))
    four_lanes.show(Design(limb="synthetic-1", inputs=(Input(location=1, clips=clips),)))
    settled(four_lanes)
    (_, _, end, _), (begin, _, _, _) = sorted(rooms)
    assert end <= begin
