"""Writes the shipped presets to the data folder: ``python -m skinsource.design.presets``."""

from skinsource.design.presets.presets import SUFFIX, save_preset, shipped_folder
from skinsource.design.presets.shipped import SHIPPED


def main() -> None:
    """Write all files anew, and delete those of removed presets."""
    folder = shipped_folder()
    for old in folder.glob(f"*{SUFFIX}"):
        old.unlink()
    for preset in SHIPPED:
        save_preset(folder, preset)


if __name__ == "__main__":
    main()
