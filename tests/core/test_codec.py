"""Trees come back from images and texts, and nothing else ever does; samples within them."""

import hashlib
import io
import json
import tracemalloc
from functools import partial
from hashlib import sha256

import h5py
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource.base import json_text
from skinsource.base.errors import FileFormatError, InvalidInputError
from skinsource.specs import codec, image
from skinsource.specs.samples import MAX_SAMPLES, Samples

VERSION = 2
to_image, from_image = (
    partial(convert, version=VERSION) for convert in (image.to_image, image.from_image)
)

SOUND = Samples(values=np.linspace(-1.0, 1.0, 50), sample_rate_hz=1300.0, unit="m/s²")
OTHER = Samples(values=np.array([5e-324, -0.0]), sample_rate_hz=44100.0)
TREE = {"kind": "Scene", "parts": [1, 2.5, -0.0, None, True, "ä\n触\x1b", SOUND], "again": SOUND}
PLAIN = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**62), 2**62)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(st.characters(exclude_categories=["Cs"]), max_size=20)
    | st.sampled_from([SOUND, OTHER]),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text("abc"), inner, max_size=4),
    max_leaves=20,
)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(tree=PLAIN)
def test_what_was_put_in_comes_out_and_gives_the_same_bytes_again(tree):
    stored = to_image(tree)
    assert repr(from_image(stored)) == repr(tree)
    assert to_image(from_image(stored)) == stored
    written = codec.to_text(tree, "a tree")
    assert repr(codec.from_text(written, "a tree")) == repr(tree)
    assert codec.to_text(codec.from_text(written, "a tree"), "a tree") == written


def test_samples_are_stored_once_however_often_they_are_used():
    once = len(to_image([SOUND, OTHER]))
    same = Samples(values=SOUND.values, sample_rate_hz=1300.0, unit="m/s²")
    often = to_image([SOUND, OTHER] + [same] * 10)
    assert len(often) - once < 10 * 100
    with h5py.File(io.BytesIO(often)) as file:
        assert set(file["samples"]) == {SOUND.digest, OTHER.digest}
    decoded = from_image(often)
    assert len({id(sounds) for sounds in decoded if sounds == SOUND}) == 1


def test_every_flipped_bit_of_an_image_is_refused():
    stored = to_image({"a": 1, "sound": OTHER})
    for bit in range(8 * len(stored)):
        damaged = bytearray(stored)
        damaged[bit // 8] ^= 1 << bit % 8
        with pytest.raises(FileFormatError):
            from_image(bytes(damaged))


def test_every_changed_character_of_a_text_is_refused():
    written = codec.to_text({"a": 1, "sound": OTHER}, "a tree")
    for place in range(len(written)):
        changed = chr(ord(written[place]) ^ 1)
        with pytest.raises(FileFormatError):
            codec.from_text(written[:place] + changed + written[place + 1 :], "a tree")


def test_a_text_that_holds_something_else_says_so():
    for other in ("", "hello", "[]", "{}", '{"format":"a design"}', "\ud800", "[" * 10**5):
        with pytest.raises(FileFormatError):
            codec.from_text(other, "a tree")
    with pytest.raises(FileFormatError, match="does not hold inputs"):
        codec.from_text(codec.to_text([1], "waveforms"), "inputs")


def signed(change, padding: bytes = b"") -> bytes:
    """An image that ``change`` made on purpose, with the right checksum."""
    memory = io.BytesIO()
    with h5py.File(memory, "w", libver=("v110", "v110"), userblock_size=512) as file:
        file.attrs["version"] = 2
        change(file)
    stored = memory.getvalue()[512:] + padding
    header = f"SkinSource design, version 2\nSHA-256 {sha256(stored).hexdigest()}\n"
    return header.encode().ljust(512, b"\n") + stored


def holding(content: bytes, **options):
    def change(file):
        values = np.frombuffer(content, np.uint8)
        file.create_dataset("content", data=values, **options)
        file.create_group("samples")

    return change


def naming(used=True, **changes):
    """Give samples that are not what the content says of them, or that nothing uses."""

    def change(file):
        about = {"count": 2, "sample_rate_hz": 44100.0, "unit": "", **changes}
        content = {"$samples": OTHER.digest} if used else 1
        tree = {"content": content, "samples": {OTHER.digest: about}}
        holding(json.dumps(tree).encode())(file)
        file["samples"][OTHER.digest] = OTHER.values

    return change


def linked(link):
    def change(file):
        holding(b"x")(file)
        file.move("content", "elsewhere")
        file["content"] = link

    return change


EMPTY = b'{"content":1,"samples":{}}'
HOSTILE = {
    "chunks": holding(EMPTY, chunks=(1,)),
    "filters": holding(EMPTY * 100, compression="gzip", chunks=(1000,)),
    "checksums of HDF5": holding(EMPTY, fletcher32=True, chunks=(10,)),
    "a soft link": linked(h5py.SoftLink("/elsewhere")),
    "another file": linked(h5py.ExternalLink("/etc/passwd", "/")),
    "no text": lambda file: file.create_dataset("content", data=np.arange(3.0)),
    "no content": lambda file: file.create_group("samples"),
    "a group": lambda file: file.create_group("content"),
    "two rows": lambda file: file.create_dataset("content", data=np.zeros((2, 2), np.uint8)),
    "a scalar": lambda file: file.create_dataset("content", data=np.uint8(3)),
    "no JSON": holding(b"{"),
    "no UTF-8": holding(b'"\xff"'),
    "another form": holding(b"[]"),
    "NaN": holding(b'{"content":NaN,"samples":{}}'),
    "huge numbers": holding(b'{"content":' + b"9" * 10_000 + b',"samples":{}}'),
    "doubles": holding(b'{"content":1,"content":2,"samples":{}}'),
    "depth": holding(b'{"content":' + b"[" * 10**6 + b"]" * 10**6 + b',"samples":{}}'),
    "samples that are not there": holding(b'{"content":1,"samples":{"a":{}}}'),
    "a name of no samples": holding(b'{"content":{"$samples":"a"},"samples":{}}'),
    "a name that is none": holding(b'{"content":{"$samples":[]},"samples":{}}'),
    "another rate": naming(sample_rate_hz=1300.0),
    "a rate that is none": naming(sample_rate_hz=None),
    "another unit": naming(unit="m"),
    "another count": naming(count=3),
    "more words": naming(more=1),
    "samples that nothing uses": naming(used=False),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_an_image_made_to_harm_is_refused(case):
    stored = signed(HOSTILE[case])
    with pytest.raises(FileFormatError) as caught:
        from_image(stored)
    assert len(str(caught.value)) < 500


def test_an_image_that_claims_to_be_enormous_costs_nothing():
    def enormous(file):
        plist = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        plist.set_alloc_time(h5py.h5d.ALLOC_TIME_LATE)
        space = h5py.h5s.create_simple((10**12,))
        h5py.h5d.create(file.id, b"content", h5py.h5t.NATIVE_UINT8, space, plist)
        file.create_group("samples")

    stored = signed(enormous)
    tracemalloc.start()
    try:
        with pytest.raises(FileFormatError, match="not larger than the file"):
            from_image(stored)
        assert tracemalloc.get_traced_memory()[1] < 2**20
    finally:
        tracemalloc.stop()


def test_a_file_holds_no_more_than_it_says():
    padded = signed(holding(EMPTY), padding=bytes(10**7))
    with pytest.raises(FileFormatError, match="bytes, 0 of them in samples"):
        from_image(padded)


def test_what_could_not_be_read_again_is_not_written(monkeypatch):
    monkeypatch.setattr(image, "MAX_IMAGE_BYTES", 100_000)
    with pytest.raises(InvalidInputError, match="too large for a file"):
        to_image([Samples(values=np.zeros(10_000), sample_rate_hz=1.0)])
    for carrier in (to_image, lambda tree: codec.to_text(tree, "a tree")):
        with pytest.raises(InvalidInputError, match="expected at most"):
            carrier(["x" * json_text.MAX_TEXT_BYTES])


def test_other_programs_can_look_into_an_image(tmp_path):
    path = tmp_path / "any.skinsource"
    path.write_bytes(to_image(TREE))
    assert path.read_bytes()[:29] == b"SkinSource design, version 2\n"
    with h5py.File(path) as file:
        assert file.attrs["format"] == b"skinsource design"
        assert file.attrs["version"] == 2
        assert json.loads(file["content"][()].tobytes())["content"]["kind"] == "Scene"
        np.testing.assert_array_equal(file["samples"][SOUND.digest], SOUND.values)


VALUES = np.array([0.0, 1.0, -0.5, 5e-324])


def of(values, rate=1300.0, unit="") -> Samples:
    return Samples(values=values, sample_rate_hz=rate, unit=unit)


def test_samples_cannot_be_changed_from_within_or_without():
    given = VALUES.copy()
    samples = of(given)
    given[0] = 9.0
    assert samples.values[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        samples.values[0] = 1.0


def test_samples_are_equal_when_every_bit_is():
    assert of(VALUES) == of(VALUES.copy())
    assert hash(of(VALUES)) == hash(of(list(VALUES)))
    for other in (of(VALUES, rate=1300.0000001), of(VALUES, unit="m/s²"), of(VALUES[:3])):
        assert of(VALUES) != other
    assert of([0.0]) != of([-0.0])
    assert of(VALUES) != "samples"


def test_what_they_hold_is_hashed_once(monkeypatch):
    samples, same = of(VALUES), of(VALUES)
    monkeypatch.setattr(hashlib, "sha256", lambda *_: pytest.fail("was hashed again"))
    assert len({samples, same}) == 1
    assert samples == same


@pytest.mark.parametrize(
    "values", [[], [[1.0]], [np.nan], [np.inf], [1j], ["1"], [True], [None], 3.0, np.ma.array([1])]
)
def test_what_is_no_signal_is_refused(values):
    with pytest.raises(InvalidInputError):
        of(values)


def test_too_many_samples_are_refused():
    with pytest.raises(InvalidInputError, match=f"expected 1 to {MAX_SAMPLES}"):
        of(np.broadcast_to(np.float64(0.0), (MAX_SAMPLES + 1,)))


@pytest.mark.parametrize("rate", [0, -1.0, np.inf, np.nan, "1300", True, None, 1e10])
def test_a_rate_that_is_none_is_refused(rate):
    with pytest.raises(InvalidInputError, match="sample_rate_hz is"):
        of(VALUES, rate=rate)
