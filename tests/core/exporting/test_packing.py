"""A design as one zip, and what to cite."""

import hashlib
import importlib
import json
import zipfile
from dataclasses import replace

import pytest

import skinsource as ss
from skinsource import View, __version__, open_design, save_design
from skinsource.actuators.rigs import Rig, RigChannel, save_rig
from skinsource.base.errors import MissingExtraError, Stopped
from skinsource.cli.command_line import main
from skinsource.export.packing import citation, data_of, pack
from skinsource.limbs.own_limbs import facts_of
from tests.core.own_limbs.lab_bench import installed

# The package has a function of the same name.
packing_module = importlib.import_module("skinsource.export.packing")
DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7),), title="One tone")
VIEW = View(outputs=(29,))


def names(path):
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        return set(archive.namelist())


def read(path, name):
    with zipfile.ZipFile(path) as archive:
        return archive.read(name)


@pytest.fixture(scope="module")
def packed(tmp_path_factory):
    path = tmp_path_factory.mktemp("pack") / "one.zip"
    pack(path, DESIGN, VIEW)
    return path


def test_a_pack_holds_all_that_belongs_to_a_design(packed):
    assert names(packed) == {
        "README.txt",
        "about.json",
        "citation.txt",
        "design.skinsource",
        "figure.pdf",
        "figure.svg",
        "levels.csv",
        "map.csv",
        "map.png",
        "stimulus.wav",
        "stimulus.wav.json",
        "traces.csv",
    }


def test_its_design_is_the_design_and_its_digests_are_those_of_its_files(packed, tmp_path):
    path = tmp_path / "again.skinsource"
    path.write_bytes(read(packed, "design.skinsource"))
    content = open_design(path)
    assert (content.design, content.view) == (DESIGN, VIEW)
    about = json.loads(read(packed, "about.json"))
    assert about["versions"]["skinsource"] == __version__
    assert set(about["sha256"]) == names(packed) - {"about.json"}
    for name, digest in about["sha256"].items():
        assert hashlib.sha256(read(packed, name)).hexdigest() == digest


def test_the_same_design_gives_the_same_bytes(packed, tmp_path):
    again = tmp_path / "again.zip"
    pack(again, DESIGN, VIEW)
    different = {name for name in names(packed) if read(again, name) != read(packed, name)}
    assert different == set()
    assert again.read_bytes() == packed.read_bytes()


def test_silence_and_no_outputs_are_packed_too(tmp_path):
    path = tmp_path / "silent.zip"
    pack(path, ss.Design(limb="synthetic-1"), View(outputs=()))
    assert not {"stimulus.wav", "traces.csv"} & names(path)


def test_a_stopped_pack_leaves_what_stood_there(tmp_path):
    path = tmp_path / "one.zip"
    path.write_bytes(b"before")
    asked = []

    def stop():
        asked.append(1)
        return len(asked) > 3

    with pytest.raises(Stopped):
        pack(path, DESIGN, VIEW, stop=stop)
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_without_matplotlib_all_but_the_figure_is_packed(tmp_path, monkeypatch, packed):
    def missing(name, extra):
        raise MissingExtraError(f"{name} of {extra}")

    monkeypatch.setattr(packing_module, "package_of_extra", missing)
    path = tmp_path / "plain.zip"
    pack(path, DESIGN, VIEW)
    assert names(packed) - names(path) == {"figure.svg", "figure.pdf"}


def test_the_command_packs_a_file_with_its_rig(tmp_path, capsys):
    design, rig, out = (tmp_path / name for name in ("a.skinsource", "a.skinrig", "a.zip"))
    save_design(design, DESIGN, VIEW)
    save_rig(rig, Rig())
    assert main(["pack", str(design), "--out", str(out), "--rig", str(rig)]) == 0
    assert capsys.readouterr().out == f"{out}\n"
    assert "rig.skinrig" in names(out)
    pack(out, replace(DESIGN, rig=Rig(channels=(RigChannel(place=7),))), VIEW)
    assert "rig.skinrig" in names(out)


def test_a_citation_names_paper_version_and_limb_and_the_dataset_where_it_was_used():
    text = citation(DESIGN)
    assert "10.1109/HAPTICS59260.2024.10520852" in text
    assert __version__ in text
    assert "Synthetic 1 (175 mm) (computed from a wave model, not measured)" in text
    assert "zenodo" not in text
    measured = citation(ss.Design(limb="measured-2"))
    assert "10.5281/zenodo.10547601" in measured
    assert "Measured 2" in measured
    assert data_of(DESIGN)["dataset_doi"] == ""
    assert data_of(ss.Design(limb="measured-2"))["dataset_doi"] == "10.5281/zenodo.10547601"


def test_a_limb_of_a_lab_is_told_by_its_digest_and_not_by_the_published_dataset():
    installed()
    digest = facts_of("lab-1").digest
    design = replace(DESIGN, limb="lab-1")
    for exported in (design, replace(design, limb_digest=digest)):
        assert "zenodo" not in citation(exported)
        assert f"on the limb Lab 1 (imported here), its numbers SHA-256 {digest}" in citation(
            exported
        )
        assert data_of(exported)["limb_sha256"] == digest
    installed(synthetic=True)
    assert "computed from a wave model" in citation(design)
    assert "not known here" in citation(replace(DESIGN, limb="gone-1"))
    assert data_of(DESIGN)["limb_sha256"] == ""


def test_a_citation_says_that_files_are_not_verified_as_published(synthetic_installed):
    design = ss.Design(limb="measured-2")
    assert "not verified as published: made from files that are not" in citation(design)
    assert data_of(design)["source_note"].startswith("not verified as published")
