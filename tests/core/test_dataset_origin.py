"""What a store knows of the files it was made from."""

import pytest

from skinsource.base.errors import DatasetError
from skinsource.limbs.dataset import store
from tests.core.dataset_bench import rewrite


def test_a_store_says_which_files_were_not_the_published_ones(synthetic_installed):
    info = store.describe()
    assert {"impulseResponses.mat", "surface.mat", "mask4.mat"} <= set(info.unpublished)
    assert "not the published ones" in info.note
    assert "surface.mat" in store.load_measured_limb(1).note


def test_the_measured_dataset_here_is_noted_as_another_file_with_the_published_map(measured):
    assert store.describe().unpublished == ("impulseResponses.mat",)
    assert store.load_measured_limb(4).note == (
        "made from files that are not the published ones: impulseResponses.mat"
    )


def test_a_store_made_of_the_published_files_has_no_note(synthetic_installed):
    rewrite(synthetic_installed, unpublished=[])
    assert store.describe().unpublished == ()
    assert store.load_measured_limb(1).note == ""


def test_a_store_that_does_not_say_so_is_refused(synthetic_installed):
    rewrite(synthetic_installed, unpublished=None)
    with pytest.raises(DatasetError, match="the store is damaged"):
        store.describe()
