from copy import copy
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, QRectF, QTimer
from PySide6.QtGui import QColor, QFontMetricsF, QImage, QPainter
from PySide6.QtWidgets import QApplication

from skinsource.limbs.limb import LimbMap
from skinsource_gui.panels.skin.map import SkinMap, message_card, message_place, paint_map_texts
from skinsource_gui.panels.skin.painting import (
    MapContent,
    is_crowded,
    is_on_card,
    output_labels,
    small_font,
)
from skinsource_gui.panels.skin.panel import SkinPanel
from skinsource_gui.panels.skin.picture import SILENT
from skinsource_gui.plots.colour_maps import colour_indices, colour_table
from skinsource_gui.plots.small_map import FieldImage
from skinsource_gui.qt.theme import LIGHT
from tests.gui.skin.bench import (
    SEED,
    pixel,
    place,
)

# What is asked for


def test_the_surface_is_asked_for_only_while_the_map_is_interpolated(window):
    assert {"limb_map", "output_levels_db", "surface", "surface_levels_db"} <= window.panel.needs
    window.show(map_style="sensors")
    assert window.panel.needs == {"limb_map", "limb_data", "match_gain", "output_levels_db"}


def test_sensors_only_is_drawn_without_a_surface(window):
    window.show(map_style="sensors", outputs=())
    window.deliver()
    level = window.results["output_levels_db"][51]
    low_high = window.panel.colour_bar.range_db
    expected = QColor(int(colour_table()[colour_indices(np.array(level), low_high)]))
    picture = window.panel.map.grab().toImage()
    assert pixel(picture, place(window, 52)) == expected.getRgb()[:3]


def test_a_map_kept_from_before_is_not_shown_when_interpolation_is_switched_on_again(window):
    window.show(map_style="sensors")
    window.show(map_style="interpolated")
    assert window.panel.map.content.shown_field is None
    window.deliver()
    assert window.panel.map.content.shown_field is not None


# The picture


def test_every_place_of_the_skin_is_drawn_where_it_is(qtbot):
    """A level that grows evenly along x shows a shift of a part of a pixel."""
    spacing, corners = np.arange(5.0, 65.0), [(10.0, 10.0), (110, 10), (110, 110), (10, 110)]
    limb_map = LimbMap(
        outline=np.array(corners),
        output_positions=np.random.default_rng(SEED).uniform(20, 100, (72, 2)),
        input_positions=np.zeros((20, 2)),
        hand_length_px=100.0,
    )
    field = FieldImage(np.ones((60, 60), bool), spacing, spacing, px_per_mm=2.0)
    table = colour_table()
    row_of_colour = {int(argb): k for k, argb in enumerate(table)}
    canvas = SkinMap()
    qtbot.addWidget(canvas)
    canvas.resize(433, 517)
    for along_x in (True, False):
        levels = np.broadcast_to(spacing, (60, 60))
        content = MapContent(
            limb_map=limb_map,
            values=np.full(72, 30.0),
            field=field,
            field_values=np.ascontiguousarray(levels if along_x else levels.T),
            value_range=(0.0, 64.0),
            sensors_shown=False,
        )
        canvas.show_content(content)
        picture = canvas.grab().toImage()
        frame = canvas.stage.layout.frame
        for k in range(1, 20):
            part = 10 + 5 * k
            x, y = frame.to_screen(np.array([[part, part]]))[0]
            at = QPoint(int(x), int(y))
            centre = QPointF(at.x() + 0.5, at.y() + 0.5)
            level = frame.to_drawing(centre)[0 if along_x else 1] / 2.0
            rows = [row_of_colour[c] for c in near(picture.pixel(at), row_of_colour)]
            expected = level / 64.0 * 255
            # Half a pixel of the field is two rows of the table.
            assert min(abs(k - expected) for k in rows) <= 1.6


def near(argb, colours):
    """The colours of a table nearest to one that may lie between two of them."""
    channels = np.array([[(c >> s) & 255 for s in (0, 8, 16)] for c in colours], int)
    colour = np.array([(argb >> s) & 255 for s in (0, 8, 16)])
    distance = np.abs(channels - colour).sum(axis=1)
    return [c for c, d in zip(colours, distance, strict=True) if d == distance.min()]


def test_the_rim_shows_no_empty_pixel(window):
    window.show(outputs=(), sensors_shown=False, map_range_db=(-100.0, -99.0))
    window.panel.resize(900, 1900)
    view = window.panel.map
    picture = view.grab().toImage()
    highest = QColor(int(colour_table()[-1])).getRgb()[:3]
    layout = view.stage.layout
    outline = layout.frame.to_screen(window.results["limb_map"].outline)
    ahead = np.roll(outline, -1, axis=0) - outline
    # The outline runs counter-clockwise; on the screen, with y down, inside is to the left.
    inwards = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1)
    inwards /= np.linalg.norm(inwards, axis=1)[:, None]
    wrong = 0
    for x, y in outline + 2.0 * inwards:
        wrong += pixel(picture, QPoint(int(x), int(y))) != highest
    # Where it bends, two pixels inwards may lie on the line itself.
    assert wrong <= 0.01 * len(outline)


def test_levels_outside_the_range_have_the_colours_of_its_ends():
    levels = np.array([-200.0, -50.0, -24.95, 0.0, 40.0, np.nan])
    assert colour_indices(levels, (-50.0, 0.0)).tolist() == [0, 0, 128, 255, 255, 0]


def test_fingers_are_up_and_the_thumb_is_left(window):
    assert place(window, 20).y() < place(window, 52).y() < place(window, 69).y()
    assert place(window, 41).x() < place(window, 6).x()


def test_silence_is_told_and_shows_no_colours(window):
    window.deliver(
        output_levels_db=np.full(72, -200.0),
        surface_levels_db=np.where(window.results["surface"].mask, -200.0, np.nan),
    )
    assert window.panel.map.content.message == SILENT
    assert window.panel.map.content.shown_field is None
    window.deliver()
    assert window.panel.map.content.message == ""
    assert window.panel.map.content.shown_field is not None


def test_a_problem_empties_the_map_and_is_told_there(window):
    window.panel.show_problem("no dataset is installed")
    content = window.panel.map.content
    assert content.message == "no dataset is installed"
    assert content.shown_field is None
    assert content.coloured_values is None
    window.panel.map.grab()
    window.deliver()
    assert window.panel.map.content.message == ""


def test_a_problem_before_any_result_is_told(qtbot):
    panel = SkinPanel()
    qtbot.addWidget(panel)
    panel.show_problem("no dataset is installed")
    empty = SkinPanel()
    qtbot.addWidget(empty)
    assert panel.grab().toImage() != empty.grab().toImage()


def test_something_outdated_is_marked_after_a_while(window, qtbot):
    window.panel.show_stale(True)
    assert not window.panel.map.content.outdated
    qtbot.waitUntil(lambda: window.panel.map.content.outdated)
    window.deliver()
    assert not window.panel.map.content.outdated


def test_results_in_time_prevent_the_mark(window):
    window.panel.show_stale(True)
    window.deliver()
    assert not any(timer.isActive() for timer in window.panel.findChildren(QTimer))


def test_a_synthetic_limb_is_named_so_on_the_map_and_in_pictures(window):
    assert window.panel.map.content.synthetic
    marked = window.panel.picture(400, 600)
    window.design = replace(window.design, limb="measured-1")
    window.show()
    # The picture on screen is still that of the synthetic limb.
    assert window.panel.map.content.synthetic
    window.deliver()
    assert not window.panel.map.content.synthetic
    assert window.panel.picture(400, 600) != marked


def test_a_limb_about_which_there_is_something_to_know_says_so_below_the_map(window):
    limb = copy(window.results["limb_data"])
    limb.note = "made from files that are not the published"
    without = window.panel.map.grab().toImage(), window.panel.picture(400, 600)
    window.deliver(limb_data=limb)
    assert "Made from files that are not the published." in window.panel.note.text()
    assert window.panel.note.isVisible()
    assert "not the published" in window.panel.note.toolTip()
    QApplication.processEvents()
    assert window.panel.map.height() < without[0].height()
    # Below a picture the caption says it, which the window gives.
    assert window.panel.picture(400, 600) == without[1]
    window.panel.caption = lambda: "Made from files that are not the published."
    assert window.panel.picture(400, 600) != without[1]
    window.deliver()
    assert window.panel.note.text() == " ".join(window.results["surface"].warnings)
    assert window.panel.note.isHidden()


@pytest.mark.parametrize("size", [(150, 180), (220, 300), (266, 576), (420, 640), (900, 500)])
@pytest.mark.parametrize("fit", ["whole", "hand"])
def test_words_above_a_fitted_map_lie_on_no_skin(window, size, fit):
    view = window.panel.map
    view.setFixedSize(*size)
    QApplication.processEvents()
    view.stage.pan_zoom.show(fit)
    view.show_content(replace(view.content, outdated=True))
    layout = view.stage.layout
    top = layout.frame.to_screen(view.content.limb_map.outline)[:, 1].min()
    image = QImage(*size, QImage.Format.Format_RGB32)
    image.fill(QColor("white"))
    painter = QPainter(image)
    painter.setFont(view.font())
    paint_map_texts(painter, view.content, layout, QRectF(view.rect()), LIGHT)
    painter.end()
    pixels = np.frombuffer(image.constBits(), np.uint32).reshape(size[1], -1) & 0xFFFFFF
    inked = np.flatnonzero((pixels != 0xFFFFFF).any(axis=1))
    assert inked.size
    assert inked.max() < top


def test_a_message_hides_no_output_and_no_card(window):
    view = window.panel.map
    for size in ((266, 576), (420, 640), (600, 900)):
        view.resize(*size)
        layout, room = view.stage.layout, QRectF(view.rect())
        area = QRectF(0, 0, 150, 30)
        area.moveCenter(room.center())
        place = message_place(area, room, layout)
        assert place.size() == area.size()
        assert room.contains(place)
        assert not any(place.contains(QPointF(x, y)) for x, y in layout.points)
        assert not place.intersects(layout.palmar_card)
        assert not place.intersects(layout.triad_card)
    # Nothing is free for one that is as large as the map.
    assert message_place(room, room, layout) is None


@pytest.mark.parametrize("size", [(236, 288), (200, 400), (266, 576), (420, 640)])
def test_words_on_a_small_map_are_broken_rather_than_that_they_hide_a_card(window, size):
    view = window.panel.map
    view.resize(*size)
    layout, room = view.stage.layout, QRectF(view.rect()).adjusted(8, 5, -5, -6)
    card = message_card("Silent: nothing is driven", room, layout, QFontMetricsF(view.font()))
    assert room.contains(card)
    assert not card.intersects(layout.palmar_card)
    assert not card.intersects(layout.triad_card)
    assert not any(card.contains(QPointF(x, y)) for x, y in layout.points)


def test_numbers_of_outputs_lie_beside_the_words_above_the_map(window):
    view = window.panel.map
    metrics = QFontMetricsF(small_font(view.font()))
    caption_area = QRectF(0, 0, 2000, 1.7 * metrics.height())
    for size in ((266, 576), (420, 640), (900, 500)):
        view.resize(*size)
        labels = output_labels(range(1, 61), view.stage.layout, 4.5, metrics, QRectF())
        assert len(labels) > 10
        assert not any(label.area.intersects(caption_area) for label in labels)


def test_many_selected_outputs_do_not_hide_the_map_until_it_is_magnified(window):
    view = window.panel.map
    view.resize(266, 400)
    layout = view.stage.layout
    assert is_crowded(44, layout)
    assert not is_crowded(12, layout)
    view.stage.pan_zoom.zoom(6.0, view.stage.place_of(20))
    assert not is_crowded(44, view.stage.layout)


def test_what_lies_under_a_card_has_neither_ring_nor_number(window):
    view = window.panel.map
    view.stage.pan_zoom.zoom(4.0, view.stage.place_of(20))
    card = view.stage.layout.triad_card.center()
    for number in range(1, 61):
        by = card - view.stage.place_of(number)
        view.stage.pan_zoom.pan(by.x(), by.y())
        if is_on_card(number, view.stage.layout):
            break
    assert is_on_card(number, view.stage.layout)
    assert not is_on_card(61, view.stage.layout)
    view.show_content(replace(view.content, outputs=()))
    plain = view.grab(view.stage.layout.triad_card.toAlignedRect()).toImage()
    view.show_content(replace(view.content, outputs=(number,)))
    assert view.grab(view.stage.layout.triad_card.toAlignedRect()).toImage() == plain
