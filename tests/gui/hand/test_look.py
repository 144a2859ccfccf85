"""The hand panel, driven by real mouse and key events."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF
from PySide6.QtGui import QColor, QHelpEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolTip

from skinsource.design.design import track
from skinsource.engine import evaluation
from skinsource.limbs.own_limbs import install_limb
from skinsource_gui.panels.hand import layout as site_marker
from skinsource_gui.panels.hand.layout import HandState, Mark
from skinsource_gui.panels.hand.picture import caption_of
from skinsource_gui.qt.buttons import text_colour_on
from skinsource_gui.qt.theme import DARK, LIGHT, Theme
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
    assert studio.diagram.state.selected is None
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


@pytest.fixture
def numbered(monkeypatch):
    """Sites whose number was painted, while a panel is grabbed."""
    numbers = []
    paint = site_marker._paint_number

    def note(painter, place, colour, *, bold):
        numbers.append(place.site)
        paint(painter, place, colour, bold=bold)

    def of(studio):
        numbers.clear()
        studio.diagram.grab()
        return set(numbers)

    monkeypatch.setattr(site_marker, "_paint_number", note)
    return of


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


def test_what_is_pointed_at_or_in_use_has_its_number_and_lies_above(with_places, numbered):
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
