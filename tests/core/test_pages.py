"""Pages of the project: their links and files are there, and each of them is reached."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BEGIN = ("README.md", "CONTRIBUTING.md", "docs/index.md")
PAGES = [ROOT / name for name in (*BEGIN, "CHANGELOG.md")] + sorted((ROOT / "docs").rglob("*.md"))
#: Paths that begin like this are those of files of the project.
CODE = "benchmarks", "core", "examples", "skinsource_gui", "tests"
FOLDERS = (".ci", "data", "docs", "resources", *CODE)
every = pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))


def text_of(page: Path) -> str:
    return page.read_text(encoding="utf-8")


def links_of(page: Path) -> list[Path]:
    """What it leads to within the project."""
    targets = re.findall(r"\]\((?!http)([^)#]+)", text_of(page))
    return [(page.parent / target).resolve() for target in targets]


def shown_beside(page: Path) -> list[Path]:
    """Pages that a list of the site names, by themselves or by a pattern."""
    lists = re.findall(r"```{toctree}\n(?::.*\n)*\n((?:.*\n)*?)```", text_of(page))
    # Some with another title before: Title <name>.
    names = [re.sub(r".*<(.*)>", r"\1", line) for text in lists for line in text.splitlines()]
    return [path for name in names if name for path in page.parent.glob(f"{name}.md")]


def anchors_of(page: Path) -> set[str]:
    """Names of its headings in links."""
    headings = re.findall(r"^#+ (.*)$", text_of(page), re.MULTILINE)
    return {
        re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings
    }


@every
def test_links_lead_somewhere(page):
    assert [target for target in links_of(page) if not target.exists()] == []
    for target, anchor in re.findall(r"\]\((?!http)([^)#]*)#([^)]+)\)", text_of(page)):
        assert anchor in anchors_of((page.parent / target) if target else page), anchor


@every
def test_files_that_are_named_are_there(page):
    named = re.findall(rf"`((?:{'|'.join(map(re.escape, FOLDERS))})/[\w./-]+)`", text_of(page))
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_every_page_is_reached_from_the_readme_or_from_what_contributors_read():
    reached, ahead = set(), [ROOT / name for name in BEGIN]
    while ahead:
        page = ahead.pop()
        if page.suffix == ".md" and page not in reached:
            reached.add(page)
            ahead += links_of(page) + shown_beside(page)
    assert {page.name for page in set(PAGES) - reached} == {"CHANGELOG.md"}
