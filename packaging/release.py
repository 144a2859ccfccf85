"""Build what is released into ``dist`` and check it: ``make release``.

The conda recipe is read by rattler-build, the citation by cffconvert.  Wheel and
source archive are built, their pages checked (twine), the wheel installed in an empty environment:
there the studio renders its window without a screen, and the README's script and export run.
``SHA256SUMS`` comes last.
"""

import hashlib
import re
import runpy
import shutil
import subprocess
import sys
import tempfile
import venv
from importlib import import_module
from pathlib import Path

from uv import find_uv_bin

ROOT = Path(__file__).resolve().parents[1]
DIST = ROOT / "dist"
VERSION = runpy.run_path(str(ROOT / "core/skinsource/version.py"))["__version__"]


def main() -> None:
    """Build and check; end with the first failure."""
    check_versions()
    check_recipe()
    run(find_uv_bin(), "tool", "run", "cffconvert", "--validate", "-i", "CITATION.cff")
    shutil.rmtree(DIST, ignore_errors=True)
    run(sys.executable, "-m", "build", "--outdir", DIST, ROOT)
    files = sorted(DIST.iterdir())
    run(sys.executable, "-m", "twine", "check", "--strict", *files)
    (wheel,) = DIST.glob("*.whl")
    with tempfile.TemporaryDirectory() as empty:
        try_wheel(wheel, Path(empty))
    sums = "".join(
        f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" for file in files
    )
    (DIST / "SHA256SUMS").write_text(sums, encoding="utf-8")
    sys.stdout.write(sums)


def check_versions() -> None:
    """Changelog and citation name the version that stands in version.py, and no other."""
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    named = {
        "CHANGELOG.md": re.findall(r"^## (\S+)", changelog, re.MULTILINE)[:1],
        "CITATION.cff": re.findall(r"^version: (.*)", citation, re.MULTILINE),
    }
    for name, versions in named.items():
        if versions != [VERSION]:
            sys.exit(f"{name} names the versions {versions}, expected [{VERSION!r}]. Change it.")


def check_recipe() -> None:
    """Have rattler-build, which would build it, read and complete the conda recipe."""
    rattler = import_module("rattler_build")
    recipe = rattler.Stage0Recipe.from_file(ROOT / "packaging/conda/recipe.yaml")
    (variant,) = recipe.render(rattler.VariantConfig())
    sys.stdout.write(f"{variant}\n")


def try_wheel(wheel: Path, folder: Path) -> None:
    """Install the wheel where nothing else is, and use it from a folder that holds nothing."""
    venv.create(folder / "venv")
    scripts = folder / "venv" / ("Scripts" if sys.platform == "win32" else "bin")
    python = scripts / "python"
    run(find_uv_bin(), "pip", "install", "--quiet", "--python", python, f"{wheel}[all]")
    used = folder / "used"
    used.mkdir()
    run(scripts / "skinsource-gui", "--render", used / "rendered", folder=used)
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (script,) = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    script += "\nss.save_design('scene.skinsource', design)"
    run(python, "-c", script, folder=used)
    (command,) = re.findall(r"`skinsource (export scene.*?)`", readme)
    run(scripts / "skinsource", *command.split(), folder=used)
    run(scripts / "skinsource", "doctor", folder=used)


def run(*command: object, folder: Path = ROOT) -> None:
    """Run a command in a folder, and end with it if it fails."""
    subprocess.run(list(map(str, command)), check=True, cwd=folder)  # noqa: S603  our own


if __name__ == "__main__":
    main()
