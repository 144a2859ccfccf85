"""The store: reads only what is touched, and notices every change."""

import zipfile

import numpy as np
import psutil
import pytest

import skinsource as ss
from skinsource.base.errors import DatasetError, DatasetMissingError
from skinsource.limbs.dataset import store
from skinsource.limbs.dataset.published import response_name
from tests.core.dataset_bench import flip, offset_of, rewrite

RESPONSE_BYTES = 72 * 3 * 522 * 8


@pytest.mark.usefixtures("user_data")
@pytest.mark.parametrize(
    "call", [lambda: store.load_measured_limb(1), store.describe, store.verify]
)
def test_without_a_store_the_message_says_how_to_get_it(call):
    assert not store.is_installed()
    with pytest.raises(DatasetMissingError) as caught:
        call()
    assert "'skinsource dataset fetch'" in str(caught.value)
    assert "'skinsource dataset install PATH'" in str(caught.value)


def test_opening_a_limb_reads_no_responses_and_one_input_reads_one_chunk(synthetic_installed):
    limb = store.load_measured_limb(2)
    assert limb.bytes_read == 0
    limb.response_to(7)
    limb.response_to(7)
    assert limb.bytes_read == RESPONSE_BYTES
    limb.response_to(8)
    assert limb.bytes_read == 2 * RESPONSE_BYTES


def test_one_flipped_bit_is_noticed_when_that_input_is_read(synthetic_installed):
    flip(synthetic_installed, offset_of(synthetic_installed, response_name(1, 5)) + 12_345)
    limb = store.load_measured_limb(1)
    limb.response_to(4)
    limb.response_to(6)
    with pytest.raises(DatasetError, match=r"limb 1, input 5 is damaged.*dataset fetch"):
        limb.response_to(5)
    (problem,) = store.verify()
    assert "limb 1, input 5 is damaged: it has another checksum" in problem


@pytest.mark.parametrize("part", ["outline", "visibility"])
def test_one_flipped_bit_in_the_map_is_noticed_when_a_limb_is_opened(synthetic_installed, part):
    flip(synthetic_installed, offset_of(synthetic_installed, f"map/{part}") + 200)
    with pytest.raises(DatasetError, match=f"map/{part} is damaged"):
        store.load_measured_limb(1)
    assert [part in problem for problem in store.verify()] == [True]


def test_verify_counts_every_checksum_and_finds_a_whole_store_whole(synthetic_installed):
    progress = []
    assert store.verify(progress=lambda *report: progress.append(report)) == ()
    assert [done for done, _, _ in progress] == list(range(1, 89))
    assert progress[-1][1] == 88


def test_a_limb_in_use_notices_that_the_store_is_gone(synthetic_installed):
    limb = store.load_measured_limb(1)
    store.remove()
    with pytest.raises(DatasetMissingError):
        limb.response_to(1)


def test_a_limb_in_use_notices_that_other_data_took_the_place(synthetic_installed):
    limb = store.load_measured_limb(1)
    with zipfile.ZipFile(synthetic_installed) as opened:
        contents = {name: opened.read(name) for name in opened.namelist()}
    with zipfile.ZipFile(synthetic_installed, "w") as opened:
        for name, content in contents.items():
            other = name == "responses/1-7.npy"
            opened.writestr(name, content[:-1] + b"!" if other else content)
    with pytest.raises(DatasetError, match="Open the limb again"):
        limb.response_to(1)


def test_a_response_and_the_map_cannot_be_written_to(synthetic_installed):
    limb = store.load_measured_limb(1)
    limb_map = limb.map
    for array in (
        limb.response_to(3),
        limb_map.outline,
        limb_map.output_positions,
        limb_map.input_positions,
        limb_map.visibility,
    ):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_remove_deletes_the_store_its_downloads_and_remains_but_nothing_else(synthetic_installed):
    folder = synthetic_installed.parent
    downloads = folder / "measured-download"
    (downloads / "visualization").mkdir(parents=True)
    for name in ("impulseResponses.mat", "visualization/mask1.mat", "impulseResponses.mat.part"):
        (downloads / name).write_bytes(b"x")
    (folder / ".measured.npz.abc.part").write_bytes(b"x")
    (folder / "design.skinsource").write_bytes(b"mine")
    (downloads / "notes.txt").write_bytes(b"mine")
    assert len(store.installed_files()) == 5
    store.remove()
    left = sorted(path.name for path in folder.rglob("*"))
    assert left == ["design.skinsource", "measured-download", "notes.txt"]


@pytest.mark.parametrize(
    ("about", "message"),
    [
        ({"format_version": 2}, r"version 2, expected 3\. Install it again"),
        ({"format_version": None}, "the store is damaged"),
        ({"format": "something else"}, "is not a store of the measured dataset"),
        ({"unpublished": None}, "the store is damaged"),
    ],
)
def test_a_store_that_says_something_else_of_itself_is_refused(synthetic_installed, about, message):
    rewrite(synthetic_installed, **about)
    with pytest.raises(DatasetError, match=message):
        store.load_measured_limb(1)


def test_a_store_says_which_files_were_not_the_published_ones(synthetic_installed):
    info = store.describe()
    assert {"impulseResponses.mat", "surface.mat", "mask4.mat"} <= set(info.unpublished)
    assert "not the published ones" in info.note
    assert "surface.mat" in store.load_measured_limb(1).note
    design = ss.Design(limb="measured-1", inputs=(ss.track(7, ss.waveforms.Tone(100.0)),))
    assert f"from measured responses ({info.note})." in ss.methods_text(design)
    rewrite(synthetic_installed, unpublished=[])
    assert store.load_measured_limb(1).note == ""


def test_no_file_stays_open_after_reading(synthetic_installed):
    store.load_measured_limb(1).response_to(1)
    opened = [file.path for file in psutil.Process().open_files()]
    assert str(synthetic_installed) not in opened


def test_a_store_cut_off_anywhere_is_refused(synthetic_installed):
    random = np.random.default_rng(20262)
    size = synthetic_installed.stat().st_size
    cuts = [size - 1, *sorted(random.integers(0, size, 30).tolist(), reverse=True), 100, 47, 8, 1]
    for cut in cuts:
        with synthetic_installed.open("r+b") as opened:
            opened.truncate(cut)
        for call in (store.describe, lambda: store.load_measured_limb(1), store.verify):
            with pytest.raises(DatasetError, match="Install it again"):
                call()
            assert synthetic_installed.stat().st_size == cut
