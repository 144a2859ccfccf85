"""The published dataset: download, check, installation and the store it is read from."""
