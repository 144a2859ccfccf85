"""What to cite, with what a design rests on."""

from skinsource.choice_words import limb_word
from skinsource.dataset.store import describe
from skinsource.design import Design
from skinsource.errors import SkinSourceError
from skinsource.own_limbs import facts_of
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
    """What to cite for a design, as lines of text: the paper, the dataset, program and limb.

    The dataset is named where its limbs are used: one of a lab's own is told by its digest.
    """
    limb, data = limb_word(design.limb).title, data_of(design)
    published = bool(data["dataset_doi"])
    what = f"doi:{DATASET_DOI}" if published else _kind_of(design.limb)
    unverified = f"; {data['source_note']}" if data["source_note"] else ""
    digest, own = data["source_sha256"], data["limb_sha256"]
    lines = [
        _PAPER,
        *([_DATASET] if published else []),
        f"Predicted with SkinSource studio {__version__} on the limb {limb} ({what}{unverified})"
        + (f", responses SHA-256 {digest}" if digest else "")
        + (f", its numbers SHA-256 {own}" if own else ""),
    ]
    return "\n".join(lines) + "\n"


def data_of(design: Design) -> dict[str, str]:
    """Where the responses of a design's limb come from: name, DOI and SHA-256 of the file.

    And a note where it is not known to be the published one.  Of a limb that a lab imported: the
    SHA-256 of its numbers.  What is not known here, or is computed, is empty.
    """
    found = {
        "limb": design.limb,
        "dataset_doi": "",
        "source_name": "",
        "source_note": "",
        "source_sha256": "",
        "limb_sha256": design.limb_digest or facts_of(design.limb).digest,
    }
    if not design.limb.startswith("measured"):
        return found
    found["dataset_doi"] = DATASET_DOI
    try:
        store = describe()
    except SkinSourceError:
        return found
    return {
        **found,
        "source_name": store.source_name,
        "source_note": f"not verified as published: {store.note}" if store.note else "",
        "source_sha256": store.source_sha256,
    }


def _kind_of(limb: str) -> str:
    facts = facts_of(limb)
    if facts.synthetic:
        return "computed from a wave model, not measured"
    return "imported here" if facts.own else "not known here"
