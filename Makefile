# Everything happens in .venv; nothing else on the machine is touched.
PYTHON ?= python3
BIN := .venv/bin

.PHONY: run test fix pictures bench clean

run: .venv/ready-to-run  ## open the studio
	@$(BIN)/python -m skinsource_gui

test: .venv/ready-to-test  ## lint, types, contracts, all tests, offscreen
	@$(BIN)/python -m skinsource_gui.system_libraries
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	QT_QPA_PLATFORM=offscreen $(BIN)/python -m pytest

fix: .venv/ready-to-test  ## let ruff mend what it can
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

pictures: .venv/ready-to-test  ## pictures of the window, light and dark, in build/pictures
	QT_QPA_PLATFORM=offscreen $(BIN)/python benchmarks/pictures.py

bench: .venv/ready-to-test  ## how fast a drag is painted
	QT_QPA_PLATFORM=offscreen $(BIN)/python benchmarks/frequency_drag.py

clean:
	rm -rf .venv build dist

.venv/ready-to-run: pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or newer is needed; try make PYTHON=python3.12")'
	test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --upgrade "pip>=25.1"
	$(BIN)/python -m pip install --quiet --editable ".[gui,dataset]"
	touch $@

.venv/ready-to-test: .venv/ready-to-run
	$(BIN)/python -m pip install --quiet --group dev
	touch $@
