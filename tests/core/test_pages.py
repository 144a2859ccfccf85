"""Pages of the project: links and files are there; README and examples say what is true."""

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

import skinsource as ss
from skinsource.cli.command_line import main

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


README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_both_ways_in_the_readme_give_the_same_levels():
    (script,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    values: dict = {}
    exec(compile(script, "README.md", "exec"), values)  # noqa: S102  our own page
    assert values["acceleration"].shape == (72, 3, 260 + 521)
    assert values["heatmap"].ndim == 2
    np.testing.assert_allclose(values["levels"], values["levels_db"], rtol=0, atol=1e-12)


def test_the_export_in_the_readme_is_written(tmp_path, monkeypatch, capsys):
    (call,) = re.findall(r"`skinsource (export scene.*?)`", README, re.DOTALL)
    monkeypatch.chdir(tmp_path)
    ss.save_design("scene.skinsource", ss.Design(limb="synthetic-1", inputs=(ss.track(7),)))
    assert main(call.split()) == 0
    path, *lines = capsys.readouterr().out.splitlines()
    assert path == "drive.wav"
    # What has to be known of it stands below, indented.
    assert lines
    assert all(line.startswith("  ") for line in lines)
    assert (tmp_path / "drive.wav.json").exists()


def test_make_has_the_targets_that_the_readme_names():
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for target in re.findall(r"^make (\w+)", README, re.MULTILINE):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target


def test_the_extras_that_the_readme_installs_exist():
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    for extras in re.findall(r'"\.\[(.*?)\]"', README):
        for extra in extras.split(","):
            assert re.search(rf"^{extra} = \[", project, re.MULTILINE), extra


@pytest.mark.parametrize("path", sorted((ROOT / "examples").glob("*.py")), ids=lambda p: p.stem)
def test_the_examples_run_on_the_built_in_limb(path, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(path), run_name="__main__")
    assert "synthetic-1" in capsys.readouterr().out
