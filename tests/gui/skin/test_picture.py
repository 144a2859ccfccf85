from copy import copy
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, QRect, QRectF
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QImage, QPainter
from PySide6.QtWidgets import QApplication

from skinsource.limbs.limb import LimbMap
from skinsource_gui.panels.skin import picture as map_picture
from skinsource_gui.panels.skin.content import MapContent
from skinsource_gui.panels.skin.layout import HAND, VisiblePart
from skinsource_gui.panels.skin.map import SkinMap, paint_map_texts
from skinsource_gui.panels.skin.picture import heading_of
from skinsource_gui.plots.colour_maps import colour_indices, colour_table
from skinsource_gui.plots.small_map import FieldImage
from skinsource_gui.qt.frames import fitted
from skinsource_gui.qt.theme import LIGHT
from skinsource_gui.state.compared import SILENT
from tests.gui.skin.bench import SEED, pixel, place


def test_the_surface_is_asked_for_only_while_the_map_is_interpolated(window):
    assert {"limb_map", "output_levels_db", "surface", "surface_levels_db"} <= window.panel.needs
    window.show(map_style="sensors")
    assert window.panel.needs == {
        "limb_map",
        "limb_data",
        "match_gain",
        "output_levels_db",
        "record_samples",
    }


def test_sensors_only_is_drawn_without_a_surface(window):
    window.show(map_style="sensors", outputs=())
    window.deliver()
    level = window.results["output_levels_db"][51]
    low_high = window.panel.colour_bar.strip.value_range
    expected = QColor(int(colour_table()[colour_indices(np.array(level), low_high)]))
    picture = window.panel.map.grab().toImage()
    assert pixel(picture, place(window, 52)) == expected.getRgb()[:3]


def test_a_map_that_is_partly_out_of_sight_is_the_same_where_it_is_seen():
    spacing, levels = np.arange(40.0), np.random.default_rng(SEED).uniform(0, 40, (40, 40))
    field = FieldImage(np.ones((40, 40), bool), spacing, spacing, px_per_mm=1.0)
    frame = fitted(field.rect, QRectF(0, 0, 200, 600))
    pictures = []
    for room in (QRectF(0, 0, 200, 600), QRectF(0, 280, 200, 60)):
        pictures.append(QImage(200, 600, QImage.Format.Format_RGB32))
        painter = QPainter(pictures[-1])
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        field.paint(painter, frame, room, levels, (0.0, 40.0), colour_table())
        painter.end()
    seen = [picture.copy(0, 285, 200, 50) for picture in pictures]
    whole, part = (np.frombuffer(one.constBits(), np.uint8).astype(int) for one in seen)
    assert np.abs(whole - part).max() <= 3


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


def test_silence_is_told_and_shows_no_colours(window):
    window.deliver(
        output_levels_db=np.full(72, -200.0),
        surface_levels_db=np.where(window.results["surface"].mask, -200.0, np.nan),
    )
    view = window.panel.map
    assert view.content.message == SILENT
    assert view.content.shown_field is None
    view.stage.show_arm(shown=False)
    said = view.grab().toImage()
    view.show_content(replace(view.content, message=" "))
    other = view.grab().toImage()
    # No finger is under the message.
    above = QRect(0, 0, view.width(), view.height() * 3 // 4)
    assert said.copy(above) == other.copy(above)
    assert said != other
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


def test_a_synthetic_limb_is_named_so_on_the_map_and_in_pictures(window):
    assert window.panel.map.content.synthetic
    marked = window.panel.picture(400, 600)
    window.show(replace(window.design, limb="measured-1"))
    # The picture on screen is still that of the synthetic limb.
    assert window.panel.map.content.synthetic
    limb = copy(window.results["limb_data"])
    limb.name = "measured-1"
    window.deliver(limb_data=limb)
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
    assert window.panel.note.height() < 1.5 * window.panel.note.fontMetrics().height()
    assert window.panel.map.height() < without[0].height()
    limb.note += " ones: impulseResponses.mat"
    window.deliver(limb_data=limb)
    window.panel.note.resize(window.panel.note.minimumSizeHint())
    assert window.panel.note.text() == "Not the published files: impulseResponses.mat."
    # Below a picture the caption says it, which the window gives.
    assert window.panel.picture(400, 600) == without[1]
    window.panel.caption = lambda: "Made from files that are not the published."
    assert window.panel.picture(400, 600) != without[1]
    window.deliver()
    assert window.panel.note.text() == " ".join(window.results["surface"].warnings)
    assert window.panel.note.isHidden()


LOOKS = {
    "pale": {"values": np.full(72, -58.0)},
    "bright": {"values": np.full(72, -12.0)},
    "outdated": {},
    "fixed": {"fixed": True},
    "measured": {"synthetic": False},
    "message": {"message": "Nothing is heard."},
    "of another size": {"px_per_mm": 0.5},
    "of unknown size": {"px_per_mm": 0.0},
    "without outputs": {"outputs": ()},
    "as before": {},
}


def test_a_map_that_changed_looks_like_one_that_is_painted_anew(window, qtbot):
    view = window.panel.map
    content = replace(view.content, synthetic=True, px_per_mm=1.0)
    for name, changes in LOOKS.items():
        view.show_content(replace(content, **changes))
        view.show_outdated(name == "outdated")
        anew = SkinMap()
        qtbot.addWidget(anew)
        anew.resize(view.size())
        anew.stage.pan_zoom.fit = view.stage.pan_zoom.fit
        anew.show_content(view.content)
        anew.show_outdated(name == "outdated")
        assert view.grab().toImage() == anew.grab().toImage(), name


@pytest.mark.parametrize("size", [(150, 180), (266, 576), (900, 500)])
@pytest.mark.parametrize("fit", ["whole", "hand"])
def test_words_above_a_fitted_map_lie_on_no_skin(window, size, fit):
    view = window.panel.map
    view.setFixedSize(*size)
    QApplication.processEvents()
    view.stage.pan_zoom.show(fit)
    layout = view.stage.layout
    top = layout.frame.to_screen(view.content.limb_map.outline)[:, 1].min()
    image = QImage(*size, QImage.Format.Format_RGB32)
    image.fill(QColor("white"))
    painter = QPainter(image)
    painter.setFont(view.font())
    paint_map_texts(painter, view.content, QRectF(view.rect()), LIGHT, outdated=True)
    painter.end()
    pixels = np.frombuffer(image.constBits(), np.uint32).reshape(size[1], -1) & 0xFFFFFF
    inked = np.flatnonzero((pixels != 0xFFFFFF).any(axis=1))
    assert inked.size
    assert inked.max() < top


def test_pictures_say_what_is_shown_over_what_and_of_whom(window):
    heading = heading_of(window.design, window.panel.content.quantity)
    assert heading.title == "Skin acceleration, RMS over the whole record, 0.8 s"
    assert heading.details == "Synthetic 1 (175 mm) · x, y, z, principal axis"


def test_pictures_say_what_strokes_mean_where_there_are_some(window, monkeypatch):
    headings = []
    monkeypatch.setattr(
        map_picture,
        "_paint_heading",
        lambda painter, inner, heading, *rest: headings.append(heading) or 0.0,
    )
    for noisy, fit in (((), "whole"), ((3, 4), "whole"), ((54,), "whole"), ((54, 65), "hand")):
        window.panel.show_noisy(noisy)
        window.panel.map.stage.pan_zoom.show(fit)
        window.panel.picture(300, 400)
    # Beyond the hand nothing is seen of 54, and 65 has no place.
    assert ["hatched" in cell.details for cell in headings] == [False, True, True, False]
    assert headings[1].details.endswith("hatched: less than 6 dB above the noise")


def test_a_picture_of_the_hand_has_the_outputs_of_its_wrist_and_nothing_beside_them(window):
    hand, limb_map = VisiblePart(fit=HAND), window.results["limb_map"]
    room, metrics = QRectF(20.4, 20.4, 300.2, 400.2), QFontMetricsF(QFont())
    to_screen = hand.frame_in(limb_map, room, metrics).transform()
    for number in (43, 44, 52, 53):
        assert room.contains(to_screen.map(QPointF(*limb_map.output_positions[number - 1])))
    image = QImage(340, 440, QImage.Format.Format_RGB32)
    image.fill(QColor(LIGHT.base))
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    map_picture._paint_map(painter, window.panel.content, limb_map, room, LIGHT, hand)
    painter.end()
    # Where the arm is cut, the skin does not show beyond its outline.
    coloured = [
        {x for x in range(100, 200) if QColor(image.pixel(x, y)).saturation() > 8}
        for y in range(415, 425)
    ]
    assert coloured[0]
    assert not set.union(*coloured) - set(range(min(coloured[0]) - 1, 200))
