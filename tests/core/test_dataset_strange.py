"""Strange stores: what the installation does not write is refused before it is read."""

from pathlib import Path

import h5py
import numpy as np
import pytest

from skinsource.base.errors import DatasetError
from skinsource.limbs.dataset import store
from skinsource.limbs.dataset import store as upkeep


def put_text_of_free_length(opened):
    for name in ("format", "installed_at", "source_name", "source_sha256"):
        opened.attrs[name] = opened.attrs[name].decode()


def put_digest_of_free_length(opened):
    part = opened["map/outline"]
    part.attrs["sha256"] = part.attrs["sha256"].decode()


def put_fewer_digests(opened):
    part = opened["responses/limb-1"]
    part.attrs["sha256"] = part.attrs["sha256"][:19]


def put_long_text(opened):
    opened.attrs["source_name"] = np.bytes_(b"x" * 10_000)


def put_no_text(opened):
    opened.attrs["format"] = h5py.Empty("S5")


def put_number_for_text(opened):
    opened.attrs["format"] = 1


def put_text_for_number(opened):
    opened.attrs["format_version"] = np.bytes_(b"1")


def put_fraction(opened):
    opened.attrs["format_version"] = 1.0


def put_numbers(opened):
    opened.attrs["format_version"] = [1, 1]


def put_unknown_attribute(opened):
    opened.attrs["more"] = 1


def put_unknown_attribute_of_group(opened):
    opened["map"].attrs["more"] = 1


def put_unknown_attribute_of_array(opened):
    opened["map/outline"].attrs["more"] = 1


def put_unknown_group(opened):
    opened.create_group("more")


def put_unknown_array(opened):
    opened["map/more"] = [1.0]


def put_soft_link(opened):
    opened.move("map/outline", "map/there")
    opened["map/outline"] = h5py.SoftLink("/map/there")


def put_soft_link_to_group(opened):
    opened.move("map", "responses/map")
    opened["map"] = h5py.SoftLink("/responses/map")


def put_external_link(opened):
    del opened["map/outline"]
    opened["map/outline"] = h5py.ExternalLink(f"{opened.filename}.other", "/map/outline")


def put_array_for_group(opened):
    del opened["map"]
    opened["map"] = [1.0]


def put_group_for_array(opened):
    del opened["map/outline"]
    opened.create_group("map/outline")


def replace_outline(opened, **how):
    """Put the same values there, stored in another way."""
    values = opened["map/outline"][()]
    digest = opened["map/outline"].attrs["sha256"]
    del opened["map/outline"]
    values = how.pop("data", values)
    opened.create_dataset("map/outline", data=values, **how).attrs["sha256"] = digest


def put_other_shape(opened):
    replace_outline(opened, data=np.zeros((1504, 2)))


def put_other_type(opened):
    replace_outline(opened, dtype="<f4")


def put_texts_for_values(opened):
    replace_outline(opened, data=np.full((1505, 2), "1", object), dtype=h5py.string_dtype())


def put_values_in_another_file(opened):
    values = np.zeros((1505, 2))
    other = Path(f"{opened.filename}.raw")
    values.tofile(other)
    external = [(str(other), 0, values.nbytes)]
    replace_outline(opened, data=None, shape=values.shape, dtype="<f8", external=external)


def put_values_elsewhere(opened):
    digest = opened["map/outline"].attrs["sha256"]
    opened.move("map/outline", "there")
    virtual = h5py.VirtualLayout((1505, 2), "<f8")
    virtual[...] = h5py.VirtualSource(".", "there", (1505, 2))
    opened.create_virtual_dataset("map/outline", virtual).attrs["sha256"] = digest
    opened.move("there", "responses/limb-5")


def put_packed_values(opened):
    replace_outline(opened, compression="gzip")


def put_values_in_pieces(opened):
    replace_outline(opened, chunks=(5, 2))


STRANGE = (
    put_text_of_free_length,
    put_digest_of_free_length,
    put_fewer_digests,
    put_long_text,
    put_no_text,
    put_number_for_text,
    put_text_for_number,
    put_fraction,
    put_numbers,
    put_unknown_attribute,
    put_unknown_attribute_of_group,
    put_unknown_attribute_of_array,
    put_unknown_group,
    put_unknown_array,
    put_soft_link,
    put_soft_link_to_group,
    put_external_link,
    put_array_for_group,
    put_group_for_array,
    put_other_shape,
    put_other_type,
    put_texts_for_values,
    put_values_in_another_file,
    put_values_elsewhere,
    put_packed_values,
    put_values_in_pieces,
)


@pytest.mark.parametrize("change", STRANGE, ids=lambda change: change.__name__)
def test_what_the_installation_does_not_write_is_not_read(synthetic_installed, change):
    with h5py.File(synthetic_installed, "r+", libver=("v110", "v110")) as opened:
        change(opened)
    with pytest.raises(DatasetError, match="Install it again with 'skinsource dataset fetch'"):
        store.load_measured_limb(1)
    with pytest.raises(DatasetError, match="Install it again with 'skinsource dataset fetch'"):
        upkeep.verify()
