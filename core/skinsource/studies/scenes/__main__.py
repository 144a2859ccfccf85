"""Writes the scenes to the data folder: ``python -m skinsource.studies.scenes``."""

from skinsource.design.design_file import SUFFIX, save_design
from skinsource.studies.scenes.catalog import path_of, scenes_folder
from skinsource.studies.scenes.shipped import SHIPPED


def main() -> None:
    """Write every file anew, and delete those of scenes that are no more."""
    folder = scenes_folder()
    folder.mkdir(exist_ok=True)
    for old in folder.glob(f"*{SUFFIX}"):
        old.unlink()
    for made in SHIPPED:
        save_design(path_of(made.scene.name), made.content.design, made.content.view)


if __name__ == "__main__":
    main()
