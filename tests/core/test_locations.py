import pytest

from skinsource.base.measurement_conditions import VOLAR_OUTPUTS
from skinsource.limbs.locations import INPUTS, OUTPUTS, REGIONS


def test_every_place_has_its_own_name_and_short_name():
    for places in (INPUTS, OUTPUTS):
        assert len({place.name for place in places}) == len(places)
        assert len({place.short_name for place in places}) == len(places)
        assert max(len(place.short_name) for place in places) <= 18


def test_only_outputs_61_to_66_are_volar():
    volar = tuple(place.number for place in OUTPUTS if place.side == "volar")
    assert volar == VOLAR_OUTPUTS


def test_outputs_1_to_42_are_on_the_hand_and_the_rest_on_the_arm():
    arm = {"wrist", "forearm", "elbow"}
    assert all((place.region in arm) == (place.number > 42) for place in OUTPUTS)
    assert {place.region for place in OUTPUTS} == set(REGIONS)


@pytest.mark.parametrize(
    ("number", "name", "region"),
    [
        (20, "Digit III, beside the nail, radial", "digit III"),
        (28, "Digit II, beside the nail, ulnar", "digit II"),
        (24, "Digit III, proximal phalanx", "digit III"),
        (32, "Digit II, knuckle", "hand"),
        (41, "Digit I, distal phalanx", "digit I"),
        (57, "Forearm, middle, 1 of 5 from the wrist", "forearm"),
        (51, "Forearm, ulnar side, 5 of 5 from the wrist", "forearm"),
        (69, "Elbow, middle", "elbow"),
    ],
)
def test_an_output_is_found_by_its_number(number, name, region):
    place = OUTPUTS[number - 1]
    assert (place.number, place.name, place.region) == (number, name, region)
