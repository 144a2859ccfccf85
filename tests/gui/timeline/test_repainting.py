"""What an edit has painted anew: the lanes that look different, and nothing else."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen
from PySide6.QtWidgets import QApplication, QScrollBar

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.effects.level import Fade
from skinsource.design.signal_path import UnplayableInput
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.panels.timeline.content import ClipLengths
from skinsource_gui.panels.timeline.gestures import GesturePreview
from skinsource_gui.panels.timeline.painting import mark_clip
from skinsource_gui.qt.frames import CachedPicture
from skinsource_gui.qt.theme import DARK, apply_theme
from tests.gui.timeline.bench import results_of
from tests.gui.timeline.lanes_bench import LanesBench

ALT, NONE = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.NoModifier
TONE = Tone(100.0, 0.0, 0.2)


@pytest.fixture
def bench(qtbot):
    made = LanesBench(qtbot)
    made.panel.resize(1000, 400)
    clips = (Clip(onset_s=0.1, waveform=TONE), Clip(onset_s=0.5, waveform=Tap()))
    tracks = tuple(Input(location=1 + k, clips=clips) for k in range(4))
    made.view = replace(made.view, time_range_s=(0.0, 1.2), selected_inputs=())
    made.show(Design(limb="synthetic-1", inputs=tracks))
    made.panel.show_results(results_of(made.design))
    settled(made)
    return made


def settled(bench):
    """Have everything painted that is to be painted; how many lanes that were."""
    before = bench.lanes.item.painted_lanes
    QApplication.processEvents()
    bench.lanes.viewport().repaint()
    return bench.lanes.item.painted_lanes - before


def picture(bench):
    return bench.lanes.viewport().grab().toImage()


def changed(bench, index, **changes):
    """Show a design in which the first clip of a track is something else."""
    clip = bench.design.inputs[index].clips[0]
    bench.show(bench.design.with_clip(clip.id, **changes))


def test_a_lane_that_cannot_be_played_is_framed_and_no_other(bench):
    before = picture(bench)
    (unplayable, *_) = bench.design.inputs
    bench.panel.show_unplayable((UnplayableInput(unplayable.id, "Too low. Choose another."),))
    after = picture(bench)
    frames = [box.rect for box in bench.lanes.content.boxes]
    reddened = [
        QColor(after.pixel(round(rect.center().x()), round(rect.top()))).red()
        > QColor(before.pixel(round(rect.center().x()), round(rect.top()))).red()
        for rect in frames
    ]
    assert reddened == [True, True] + [False] * (len(frames) - 2)


def test_an_edit_of_one_clip_repaints_one_lane(bench):
    changed(bench, 1, onset_s=0.15)
    assert settled(bench) == 1


def test_results_repaint_the_lane_whose_samples_are_new(bench):
    results = results_of(bench.design)
    bench.panel.show_results(results)
    assert settled(bench) == 4
    bench.panel.show_results(dict(results))
    assert settled(bench) == 0
    first, *others = results["clip_waveforms"]
    results["clip_waveforms"] = ((first[0] * 0.5, first[1]), *others)
    bench.panel.show_results(results)
    assert settled(bench) == 1


def test_a_drag_of_a_clip_repaints_its_lane_at_each_move(bench):
    start = bench.box(3).center()
    bench.drag(start, start + QPointF(10, 0), ALT, release=False, steps=1)
    settled(bench)
    bench.lanes.mouse.move(start + QPointF(40, 0), ALT)
    assert settled(bench) == 1
    bench.lanes.mouse.move(start + QPointF(80, 0), ALT)
    assert settled(bench) == 1


def test_the_clip_under_the_pointer_repaints_its_lane(bench):
    bench.lanes.item.show_hovered(3)
    assert settled(bench) == 1
    bench.lanes.item.show_hovered(5)
    # What lies between two lanes is looked at with them.
    assert 2 <= settled(bench) <= 3
    bench.lanes.item.show_hovered(5)
    assert settled(bench) == 0


def test_words_guide_and_marquee_of_a_gesture_repaint_no_lane(bench):
    shown = GesturePreview(guide_s=0.3, label="0.3 s", covered=bench.box(3))
    bench.lanes.overlay.show_preview(shown, QPointF(100, 100))
    with_them = picture(bench)
    assert settled(bench) == 0
    bench.lanes.overlay.show_preview(GesturePreview(), QPointF(100, 100))
    assert picture(bench) != with_them
    assert settled(bench) == 0


EDITS = {
    "clip moved over another": lambda bench: changed(bench, 1, onset_s=0.4),
    "clip stronger than all": lambda bench: changed(bench, 2, gain=3.0),
    "clip muted": lambda bench: changed(bench, 0, muted=True),
    "clip renamed": lambda bench: changed(bench, 0, label="knock"),
    "clip faded": lambda bench: changed(bench, 3, effects=(Fade(),)),
    "track muted": lambda bench: bench.show(bench.design.with_input(2, muted=True)),
    "track alone": lambda bench: bench.show(bench.design.with_input(1, solo=True)),
    "another colour": lambda bench: bench.show(bench.design.with_input(1, colour=7)),
    "clip added": lambda bench: bench.show(
        bench.design.with_input(
            3, clips=(*bench.design.inputs[3].clips, Clip(onset_s=0.8, waveform=TONE))
        )
    ),
    "no clips": lambda bench: bench.show(bench.design.with_input(0, clips=())),
    "loop": lambda bench: bench.show(replace(bench.design, loop_s=(0.2, 0.7))),
    "clip selected": lambda bench: bench._look(replace(bench.view, selected_clips=(3,))),
    "track selected": lambda bench: bench._look(replace(bench.view, selected_inputs=(2,))),
    "other times": lambda bench: bench._look(replace(bench.view, time_range_s=(0.0, 0.9))),
    "hovered": lambda bench: bench.lanes.item.show_hovered(3),
    "no samples": lambda bench: bench.panel.show_problem("No limb."),
    "theme": lambda bench: apply_theme(QApplication.instance(), DARK),
}


def test_a_clip_that_the_inspector_showed_already_is_seen_to_be_selected(bench):
    bench._look(replace(bench.view, selected_inputs=(2,)))
    settled(bench)
    shown = picture(bench)
    bench._look(replace(bench.view, selected_clips=(3,)))
    assert settled(bench) == 1
    assert picture(bench) != shown


def test_the_clip_that_the_inspector_shows_is_another_one_where_tracks_stay_selected(bench):
    first, second = (track.id for track in bench.design.inputs[:2])
    bench._look(replace(bench.view, selected_inputs=(first, second)))
    settled(bench)
    shown = picture(bench)
    bench._look(replace(bench.view, selected_inputs=(second, first)))
    assert settled(bench) == 2
    assert picture(bench) != shown


@pytest.mark.parametrize("name", EDITS)
def test_what_was_not_repainted_looks_as_if_everything_were(bench, name):
    before = picture(bench)
    EDITS[name](bench)
    settled(bench)
    zoomed_picture = picture(bench)
    assert zoomed_picture != before
    bench.lanes.item.update()
    settled(bench)
    assert zoomed_picture == picture(bench)


def test_only_clips_that_changed_are_asked_for_their_length(bench):
    first = ClipLengths(bench.design)
    second = first.of(bench.design.with_clip(3, onset_s=0.9, waveform=Tone(100.0, 0.0, 0.7)))
    assert (first.n_computed, second.n_computed) == (8, 1)
    assert second.durations_s[3] == 0.7
    assert second.durations_s[4] == first.durations_s[4]
    assert second.whole_s == pytest.approx((0.0, 0.9 + 0.7 + 0.4))
    assert second.of(second.design) is second


class CountedPicture(CachedPicture):
    """Counts how often something is painted anew."""

    def __init__(self):
        super().__init__()
        self.times = 0

    def paint(self, painter, room, depends_on, paint_anew, ground=None):
        def counted(on_image):
            self.times += 1
            paint_anew(on_image)

        super().paint(painter, room, depends_on, counted, ground)


def test_dots_around_the_clip_that_the_inspector_shows_are_painted_once_for_its_size(bench):
    dots = bench.lanes.item.pictures.mark = CountedPicture()
    bench.view = replace(bench.view, selected_inputs=(bench.design.inputs[1].id,))
    bench.show(bench.design)
    settled(bench)
    assert dots.times == 1
    changed(bench, 1, waveform=Tone(150.0, 0.0, 0.2))
    assert settled(bench) == 1
    assert dots.times == 1
    changed(bench, 1, waveform=Tone(150.0, 0.0, 0.3))
    settled(bench)
    assert dots.times == 2


@pytest.mark.parametrize("ratio", [1.0, 1.5, 2.0])
def test_dots_are_where_they_would_be_painted_anew(qapp, ratio):
    def drawn(paint):
        image = QImage(int(200 * ratio), int(60 * ratio), QImage.Format.Format_RGB32)
        image.setDevicePixelRatio(ratio)
        image.fill(Qt.GlobalColor.white)
        painter = QPainter(image)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint(painter)
        painter.end()
        return image

    def dots(rect):
        def paint(painter):
            painter.setPen(QPen(QColor(DARK.accent), 2, Qt.PenStyle.DotLine))
            painter.drawRoundedRect(rect.adjusted(1, 1, -1, -1), 3, 3)

        return paint

    mark_picture = CountedPicture()
    # The second lies elsewhere among the same pixels; of the last, both ends are out of sight.
    for rect, times in (
        (QRectF(12.3, 7.0, 90.6, 31.0), 1),
        (QRectF(32.3, 9.0, 90.6, 31.0), 1),
        (QRectF(-300.2, 5.5, 700.0, 40.0), 2),
    ):
        shown = rect.intersected(QRectF(-2, 0, 204, 60))
        marked = partial(
            mark_clip, rect=rect, shown=shown, mark=mark_picture, colour=QColor(DARK.accent)
        )
        # Through a picture, colours may be rounded once more.
        assert most_apart(drawn(marked), drawn(dots(rect))) <= 1
        assert mark_picture.times == times


def test_a_marked_clip_is_painted_however_little_of_its_lane_is_in_sight(bench):
    clip = (Clip(onset_s=0.1, waveform=TONE),)
    tracks = tuple(Input(location=1 + k, clips=clip) for k in range(20))
    bench.view = replace(bench.view, selected_inputs=(10,))
    bench.show(Design(limb="synthetic-1", inputs=tracks))
    bars = bench.panel.findChildren(QScrollBar)
    (bar,) = (bar for bar in bars if bar.accessibleName() == "Tracks shown")
    in_sight = set()
    for scrolled in range(bar.maximum() + 1):
        bar.setValue(scrolled)
        settled(bench)
        content = bench.content
        lane = content.lanes[9]
        in_sight |= {content.height_px - lane.top_px, lane.bottom_px - content.ruler_px}
    assert set(range(8)) <= in_sight


def most_apart(first, other):
    """Largest difference of two pictures in any colour of any pixel."""
    pixels = [np.array(each.constBits(), np.int16) for each in (first, other)]
    return np.abs(pixels[0] - pixels[1]).max()
