"""The hand panel, driven by real mouse and key events; hand and skin side by side."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize
from PySide6.QtGui import QColor, QHelpEvent, QTransform
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolTip

import skinsource as ss
from skinsource.design.design import track
from skinsource.engine import evaluation
from skinsource.limbs.catalog import load_limb
from skinsource.limbs.own_limbs import install_limb
from skinsource_gui.panels.hand import picture as site_marker
from skinsource_gui.panels.hand.picture import HandState, Mark, caption_of
from skinsource_gui.qt.buttons import text_colour_on
from skinsource_gui.qt.theme import DARK, LIGHT, Theme, current_theme
from skinsource_gui.qt.wheel import FREE, WHOLE
from tests.core.own_limbs.lab_bench import own_limb, response
from tests.gui.hand.bench import KEY, LEFT, NONE, Studio, contrast
from tests.gui.skin.bench import wheel


def test_an_input_has_its_own_colour_on_the_hand_in_both_themes(studio, use_theme):
    studio.put(track(location=20), track(location=16), selected=1)
    for theme in (LIGHT, DARK):
        use_theme(theme)
        image = studio.diagram.grab().toImage()
        for index, site in enumerate((20, 16)):
            point = studio.diagram.site_centre(site) + QPoint(0, 8)
            assert image.pixelColor(point).name() == theme.inputs[index]
        # A silent input is hollow.
        studio.put(track(location=20, muted=True), track(location=16), selected=1)
        image = studio.diagram.grab().toImage()
        point = studio.diagram.site_centre(20) + QPoint(0, 7)
        assert image.pixelColor(point).name() != theme.inputs[0]
        studio.put(track(location=20), track(location=16), selected=1)


def test_a_hand_without_room_is_a_picture_too(studio):
    drawing = studio.diagram.stage.drawing
    assert not site_marker.hand_pixmap(drawing, QTransform(), QSize(0, 90), 1.0, LIGHT).isNull()


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=lambda theme: theme.name)
def test_numbers_are_readable_on_every_input_colour(theme: Theme):
    for number in range(len(theme.inputs)):
        colour = theme.input_colour(number)
        assert contrast(text_colour_on(colour), colour) >= 4.5


def test_the_tooltip_names_place_contact_and_inputs(studio):
    studio.put(track(location=2, muted=True), selected=0)
    point = studio.diagram.site_centre(2)
    event = QHelpEvent(QEvent.Type.ToolTip, point, studio.diagram.mapToGlobal(point))
    QApplication.sendEvent(studio.diagram, event)
    text = QToolTip.text()
    for expected in ("2 ·", "Digit II, tip", "in-axis", "Tone, muted, selected"):
        assert expected in text
    QToolTip.hideText()
    # What the cursor reaches is announced.
    studio.put(track(location=7), selected=4)
    assert studio.diagram.stage.state.selected is None
    studio.keys(KEY.Key_7)
    text = studio.diagram.accessibleDescription()
    assert text.startswith("Place 7 · Digit II, pad. perpendicular")
    assert "Input 1: Tone" in text
    assert studio.diagram.accessibleName()


@pytest.mark.parametrize("size", [(260, 330), (260, 900), (900, 330)])
def test_all_sites_stay_inside_at_every_size(studio, size):
    studio.panel.resize(*size)
    radius = round(studio.diagram.stage.layout.radius_px(20))
    for site in range(1, 21):
        area = studio.diagram.stage.layout.marker_area(site).toAlignedRect()
        assert studio.diagram.rect().contains(area.adjusted(-radius // 4, 0, radius // 4, 0))


MARKS = (Mark(site=7, colour=QColor("red")), Mark(site=13, colour=QColor("blue")))


def caption(most=200, **state):
    return caption_of(HandState(**state), "synthetic-1", lambda text: len(text) <= most)


def test_the_pointer_is_named_before_the_ring_in_short_where_there_is_little_room():
    state = {"marks": MARKS, "selected": 0}
    assert caption(**state) == "7 · Digit II, pad"
    assert caption(**state, hovered=13) == "13 · Digit III, base"
    assert caption(**state, hovered=13, most=10) == "13 · III base"
    assert caption(**state, cursor=5).startswith("5 · ")


@pytest.fixture
def with_places(user_data, qtbot):
    """Makes a panel on a limb with places at these points, mm around the middle of a hand."""

    def make(points, size=(300, 380)) -> Studio:
        evaluation._evaluator.cache_clear()
        places = np.asarray(points, float)
        limb = own_limb(input_positions=places, input_names=(), axes="z", n_taps=8)
        install_limb(limb, (response(1, "z")[..., :8] for _ in places))
        return Studio(qtbot, *size, limb="lab-1")

    return make


def crowd(n):
    return np.random.default_rng(2).uniform((-35, -50), (35, 50), (n, 2))


@pytest.mark.parametrize("n", [64, 256])
def test_no_marker_covers_another_however_many_there_are(with_places, n):
    hand = with_places(crowd(n)).diagram.stage.layout
    distances_px = np.linalg.norm(hand.centres[:, None] - hand.centres[None], axis=-1)
    np.fill_diagonal(distances_px, np.inf)
    touching = hand.radii_px[:, None] + hand.radii_px[None] >= distances_px
    # Only where they lie so near that they could not be seen else.
    assert (np.minimum(hand.radii_px[:, None], hand.radii_px[None])[touching] == 2.5).all()
    assert hand.radii_px.min() == 2.5
    assert hand.radii_px.max() > 2.0 * hand.radii_px.min()


def test_what_is_pointed_at_or_in_use_has_its_number_and_lies_above(with_places, monkeypatch):
    numbers = []
    paint = site_marker._paint_number

    def note(painter, place, colour, *, bold):
        numbers.append(place.site)
        paint(painter, place, colour, bold=bold)

    def numbered(studio):
        """Sites whose number is painted while a panel is grabbed."""
        numbers.clear()
        studio.diagram.grab()
        return set(numbers)

    monkeypatch.setattr(site_marker, "_paint_number", note)
    studio = with_places(crowd(256))
    stage = studio.diagram.stage
    small = int(np.argmin(stage.layout.radii_px)) + 1
    assert small not in numbered(studio)
    stage.change(hovered=small)
    assert small in numbered(studio)
    stage.change(hovered=None, cursor=small)
    assert small in numbered(studio)
    stage.change(cursor=None)
    studio.click(small)
    assert studio.sites == [small]
    assert small in numbered(studio)
    assert stage.layout.radius_in_use_px(small) >= 8.0


def test_places_at_one_point_lie_beside_each_other_and_each_can_be_clicked(with_places):
    studio = with_places([(0.0, 0.0), (0.0, 0.0), (20.0, 20.0)])
    stage = studio.diagram.stage
    first, second = stage.layout.centres[:2]
    assert np.linalg.norm(first - second) > 4.0
    # Their middle is where both are.
    np.testing.assert_allclose(
        (first + second) / 2.0,
        stage.layout.centres[2] + stage.layout.transform.m11() * np.array([80.0, 80.0]),
        atol=1e-6,
    )
    studio.click(2)
    studio.click(1)
    assert studio.sites == [2, 1]


def test_a_place_that_lies_nowhere_stands_beside_the_hand(with_places):
    studio = with_places([(np.nan, np.nan), (0.0, 0.0), (np.nan, np.nan)])
    stage = studio.diagram.stage
    outline = stage.layout.transform.map(stage.drawing.outline).boundingRect()
    for site in (1, 3):
        marker = stage.layout.marker_area(site)
        assert marker.right() < outline.left() + 2.0
        assert QRectF(studio.diagram.rect()).contains(marker)
    QTest.mouseClick(studio.diagram, LEFT, NONE, studio.diagram.site_centre(3))
    assert studio.sites == [3]
    assert stage.site_at(QPointF(outline.center())) == 2


def test_the_wheel_zooms_at_the_pointer_and_back_to_the_whole_hand(studio):
    diagram, stage = studio.diagram, studio.diagram.stage
    before = stage.layout.transform.m11()
    at = diagram.site_centre(18)
    wheel(diagram, at, 3)
    assert stage.layout.transform.m11() > 1.5 * before
    assert (diagram.site_centre(18) - at).manhattanLength() <= 2
    wheel(diagram, at, -9)
    assert stage.layout.transform.m11() == before
    wheel(diagram, diagram.site_centre(3), 8)
    # What is magnified beyond the picture is not hit.
    below = [k for k in range(1, 21) if diagram.site_centre(k).y() > diagram.height()]
    assert stage.site_at(QPointF(diagram.site_centre(below[0]))) is None
    QTest.mouseClick(diagram, LEFT, pos=QPoint(diagram.width() // 2, diagram.height() - 3))
    assert studio.edits == []


def test_a_double_click_beside_the_places_shows_the_whole_hand(studio):
    diagram, stage = studio.diagram, studio.diagram.stage
    wheel(diagram, QPoint(2, 2), 4)
    assert stage.pan_zoom.fit == FREE
    empty = next(
        QPoint(x, y)
        for y in range(10, diagram.height(), 7)
        for x in range(10, diagram.width(), 7)
        if stage.layout.site_at(QPointF(x, y)) is None
    )
    QTest.mouseDClick(diagram, LEFT, pos=empty)
    assert stage.pan_zoom.fit == WHOLE
    assert studio.edits == []


def mirror(studio):
    QTest.mouseClick(studio.panel.mirror, LEFT)


def test_a_switch_shows_the_palm_through_the_hand_and_is_stored_in_the_view(studio):
    layout = studio.diagram.stage.layout
    thumb, fifth = layout.centre(6).x(), layout.centre(10).x()
    mirror(studio)
    assert studio.view.panels == (("hand", (("mirrored", True),)),)
    layout = studio.diagram.stage.layout
    assert (layout.centre(6).x() < layout.centre(10).x()) != (thumb < fifth)
    assert "through" in studio.diagram.stage.drawing.side
    studio.click(7)
    assert studio.sites == [7]
    mirror(studio)
    assert studio.diagram.stage.layout.centre(6).x() == pytest.approx(thumb)


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("limb", ["synthetic-1", "synthetic-3"])
def test_a_place_under_the_pointer_is_marked_on_hand_and_skin(studio, limb, mirrored):
    if mirrored:
        mirror(studio)
    studio.show(type(studio.design)(limb=limb))
    limb_data, told = load_limb(limb), []
    studio.panel.place_pointed_at.connect(told.append)
    QTest.mouseMove(studio.diagram, studio.diagram.site_centre(13))
    # Nothing is known of the map yet.
    assert told == [None]
    studio.panel.show_results({"limb_data": limb_data})
    for site in (16, 3, 20):
        QTest.mouseMove(studio.diagram, studio.diagram.site_centre(site))
        assert told[-1] == pytest.approx(tuple(limb_data.map.input_positions[site - 1]), abs=1e-6)
        assert studio.diagram.stage.state.ring is None
    for site in (8, 16, 20):
        studio.panel.show_pointed_place(tuple(limb_data.map.input_positions[site - 1]))
        drawing, ring = studio.diagram.stage.drawing, studio.diagram.stage.state.ring
        assert np.allclose(ring, drawing.sites[site - 1], atol=1e-6)
    QTest.mouseMove(studio.diagram, QPoint(2, studio.diagram.height() - 2))
    assert told[-1] is None
    assert studio.diagram.stage.state.ring is None


def test_between_places_the_ring_is_where_the_pointer_is(studio):
    limb_data, told = load_limb("synthetic-1"), []
    studio.panel.show_results({"limb_data": limb_data})
    studio.panel.place_pointed_at.connect(told.append)
    layout = studio.diagram.stage.layout
    between = (layout.centre(18) + layout.centre(20)) / 2.0
    QTest.mouseMove(studio.diagram, between.toPoint())
    at = QPointF(*studio.diagram.stage.state.ring)
    assert (layout.transform.map(at) - between).manhattanLength() < 2.0
    positions = limb_data.map.input_positions
    assert told[-1] == pytest.approx(tuple((positions[17] + positions[19]) / 2.0), abs=12.0)


def colours_around(studio, site):
    at, picture = studio.diagram.site_centre(site), studio.diagram.grab().toImage()
    reach = range(-16, 17)
    return {picture.pixelColor(at.x() + x, at.y() + y).name() for x in reach for y in reach}


def test_pointed_at_and_selected_look_different(studio):
    studio.click(7)
    accent = current_theme().accent.lower()
    QTest.mouseMove(studio.diagram, studio.diagram.site_centre(16))
    assert accent in colours_around(studio, 7)
    assert accent not in colours_around(studio, 16)


DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tone()),))


def test_the_place_under_the_pointer_is_marked_on_the_other_drawing_and_read(open_window):
    window = open_window(DESIGN)
    skin, hand = window.panel("skin"), window.panel("hand").diagram
    positions = skin.map.content.limb_map.input_positions
    [palm] = skin.map.stage.layout.frame.to_screen(positions[15:16])
    QTest.mouseMove(skin.map, QPointF(*palm).toPoint())
    ring = hand.stage.layout.transform.map(QPointF(*hand.stage.state.ring))
    assert (ring - hand.stage.layout.centre(16)).manhattanLength() < 3.0
    QTest.mouseMove(skin.map, QPoint(2, skin.map.height() // 2))
    assert hand.stage.state.ring is None
    QTest.mouseMove(hand, hand.site_centre(16))
    assert np.allclose(skin.map.ring, positions[15])
    assert skin.readout.toolTip().startswith("−")
    assert "dB re 1 m/s²" in skin.readout.toolTip()
    QTest.mouseMove(hand, QPoint(2, hand.height() - 2))
    assert skin.map.ring is None
    assert "selected" in skin.readout.toolTip()
