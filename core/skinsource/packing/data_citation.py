"""What to cite, with what a design rests on."""

from skinsource.choice_words import limb_word
from skinsource.dataset.store import describe
from skinsource.design import Design
from skinsource.errors import SkinSourceError
from skinsource.version import __version__

#: The paper, and the dataset.
PAPER_DOI, DATASET_DOI = "10.1109/HAPTICS59260.2024.10520852", "10.5281/zenodo.10547601"
_AUTHORS = "N. Tummala, G. Reardon, S. Fani, D. Goetz, M. Bianchi, Y. Visell"
_PAPER = (
    f"{_AUTHORS}: SkinSource: A Data-Driven Toolbox for Predicting Touch-Elicited Vibrations in "
    f"the Upper Limb. IEEE Haptics Symposium, 2024. doi:{PAPER_DOI}"
)
_DATASET = (
    f"{_AUTHORS}: SkinSource: impulse responses of the upper limb (dataset), 2024. "
    f"doi:{DATASET_DOI}"
)


def citation(design: Design) -> str:
    """What to cite for a design, as lines of text: the paper, the dataset, program and limb."""
    limb = limb_word(design.limb).title
    synthetic = design.limb.startswith("synthetic")
    what = "computed from a wave model, not measured" if synthetic else f"doi:{DATASET_DOI}"
    digest = data_of(design)["source_sha256"]
    lines = [
        _PAPER,
        *([] if synthetic else [_DATASET]),
        f"Predicted with SkinSource studio {__version__} on the limb {limb} ({what})"
        + (f", responses SHA-256 {digest}" if digest else ""),
    ]
    return "\n".join(lines) + "\n"


def data_of(design: Design) -> dict[str, str]:
    """Where the responses of a design's limb come from: name, DOI and SHA-256 of the file.

    What is not known here, or is computed, is empty.
    """
    found = {"limb": design.limb, "dataset_doi": "", "source_name": "", "source_sha256": ""}
    if not design.limb.startswith("measured"):
        return found
    found["dataset_doi"] = DATASET_DOI
    try:
        store = describe()
    except SkinSourceError:
        return found
    return {**found, "source_name": store.source_name, "source_sha256": store.source_sha256}
