"""Hands of labs with many places: markers make room for each other."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QTransform
from PySide6.QtTest import QTest

from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.engine import evaluation
from skinsource.limbs.own_limbs import install_limb
from skinsource_gui.panels.hand import layout as site_marker
from skinsource_gui.panels.hand.layout import HandLayout
from skinsource_gui.panels.hand.panel import HandPanel
from tests.core.own_limbs.lab_bench import own_limb, response
from tests.gui.hand.bench import LEFT, NONE, Studio


@pytest.fixture
def with_places(user_data, qtbot):
    """Makes a panel on a limb with places at these points, mm around the middle of a hand."""

    def make(points, size=(300, 380)) -> Studio:
        evaluation._evaluator.cache_clear()
        places = np.asarray(points, float)
        limb = own_limb(input_positions=places, input_names=(), axes="z", n_taps=8)
        install_limb(limb, (response(1, "z")[..., :8] for _ in places))
        panel = HandPanel()
        qtbot.addWidget(panel)
        panel.resize(*size)
        with qtbot.waitExposed(panel):
            panel.show()
        studio = Studio(panel)
        studio.design, studio.view = Design(limb="lab-1"), View(selected_inputs=())
        panel.show_state(studio.design, studio.view)
        return studio

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


@pytest.mark.parametrize("n", [64, 128, 256])
def test_no_marker_covers_another_however_many_there_are(with_places, n):
    hand = with_places(crowd(n)).diagram.stage.layout
    distances_px = np.linalg.norm(hand.centres[:, None] - hand.centres[None], axis=-1)
    np.fill_diagonal(distances_px, np.inf)
    touching = hand.radii_px[:, None] + hand.radii_px[None] >= distances_px
    # Only where they lie so near that they could not be seen else.
    assert (np.minimum(hand.radii_px[:, None], hand.radii_px[None])[touching] == 2.5).all()
    assert hand.radii_px.min() == 2.5
    assert hand.radii_px.max() > 2.0 * hand.radii_px.min()


def test_where_there_is_room_markers_are_as_large_as_ever_and_have_their_numbers(
    with_places, numbered
):
    studio = with_places(crowd(3))
    assert (studio.diagram.stage.layout.radii_px >= 11.0).all()
    assert numbered(studio) == {1, 2, 3}


def test_numbers_stand_where_they_fit_and_come_as_one_looks_closer(with_places, numbered):
    studio = with_places(crowd(128))
    stage = studio.diagram.stage
    few = numbered(studio)
    assert len(few) < 32
    assert all(stage.layout.radius_px(site) >= 4.5 for site in few)
    for _ in range(8):
        stage.pan_zoom.step("zoom_in")
    assert len(numbered(studio)) > 3 * len(few)


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


def test_of_many_places_within_reach_the_nearest_is_meant(with_places):
    studio = with_places(crowd(256))
    hand = studio.diagram.stage.layout
    for site in range(1, 257, 16):
        assert hand.site_at(hand.centre(site)) == site
        studio.click(site)
    # Whole pixels of the mouse may lie nearer to a neighbour than two places are apart.
    assert len(set(studio.sites) & set(range(1, 257, 16))) >= 12


def test_a_small_place_does_not_reach_as_far_as_a_large_one_elsewhere():
    centres = np.array([[0.0, 0.0], [200.0, 0.0]])
    layout = HandLayout(
        transform=QTransform(),
        radii_px=np.array([3.0, 20.0]),
        centres=centres,
        pushes=np.zeros((2, 2)),
    )
    assert layout.site_at(QPointF(8.0, 0.0)) == 1
    assert layout.site_at(QPointF(15.0, 0.0)) is None
    assert layout.site_at(QPointF(185.0, 0.0)) == 2
    assert layout.site_at(QPointF(176.0, 0.0)) == 2


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
