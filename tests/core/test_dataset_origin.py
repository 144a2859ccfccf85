"""What a store knows of the files it was made from."""

import h5py
import numpy as np
import pytest

from skinsource.base.errors import DatasetError
from skinsource.limbs.dataset import store


def _set_attribute(path, name, value):
    with h5py.File(path, "r+") as opened:
        opened.attrs[name] = value


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
    _set_attribute(synthetic_installed, "unpublished", np.bytes_(b"none"))
    assert store.describe().unpublished == ()
    assert store.load_measured_limb(1).note == ""


def test_a_store_that_does_not_say_so_is_refused(synthetic_installed):
    with h5py.File(synthetic_installed, "r+", libver=("v110", "v110")) as opened:
        del opened.attrs["unpublished"]
    with pytest.raises(DatasetError, match="lacks unpublished"):
        store.describe()
