# Everything happens in .venv; nothing else on the machine is touched.
PYTHON ?= python3
BIN := .venv/bin
PYTEST_OPTIONS ?=
# As many at once as there are cores; each prepares the dataset for itself, so not too many.
# Neighbours stay with one worker, which keeps what they share, until another has nothing to do.
AT_ONCE := -n auto --maxprocesses 8 --dist worksteal

BENCHMARKS := "engine_speed.py --long" predict_speed.py slots.py frequency_drag.py hops.py slider_storm.py start.py long_design.py import_hour.py sweeps.py

.PHONY: run test checks types tests docs fix pictures bench nightly faults growth frozen release clean

run: .venv/ready-to-run  ## open the studio
	@$(BIN)/python -m skinsource_gui

test: .venv/ready-to-test  ## lint, types, contracts, all tests, offscreen
	@$(MAKE) --no-print-directory checks

checks:  # the same in an environment that is there already: make checks BIN=...
	@$(BIN)/python -m skinsource_gui.qt.system_libraries
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports
	@$(MAKE) --no-print-directory --jobs=2 types tests

types:  # beside the tests: alone it would leave the other cores idle
	$(BIN)/mypy

tests:
	QT_QPA_PLATFORM=offscreen $(BIN)/python -m pytest $(AT_ONCE) $(PYTEST_OPTIONS)

docs: .venv/ready-for-docs  ## the site in build/docs, which Help opens; warnings are errors
	rm -rf build/docs
	$(BIN)/python -m sphinx -b html -d build/doctrees -W --keep-going -q docs build/docs
	find build/docs -name '*.map' -delete

fix: .venv/ready-to-test  ## let ruff mend what it can
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

pictures: .venv/ready-to-test  ## of the window: build/pictures, docs/window.png, docs/pictures
	QT_QPA_PLATFORM=offscreen $(BIN)/python benchmarks/pictures.py
	QT_QPA_PLATFORM=offscreen $(BIN)/python benchmarks/pictures_in_use.py
	QT_QPA_PLATFORM=offscreen $(BIN)/python benchmarks/tutorial.py

bench: .venv/ready-to-test  ## promises of speed and memory, as ratios; on any machine (5 minutes)
	@failed=0; for each in $(BENCHMARKS); do \
	  echo "== $$each"; QT_QPA_PLATFORM=offscreen $(BIN)/python benchmarks/$$each || failed=1; \
	done; exit $$failed

nightly: .venv/ready-to-test  ## damaged files, killed exports, studios that end at once, deeds at random, reference vectors
	$(BIN)/python -m tests.nightly.mutants
	$(BIN)/python tests/core/exporting/killed_exports.py 300
	$(BIN)/python -m tests.nightly.short_lives
	$(BIN)/python -m tests.nightly.monkey
	$(BIN)/python tests/references/check.py

faults: .venv/ready-to-test  ## do the tests still notice the faults that they noticed once? (an hour or more)
	$(BIN)/python -m tests.nightly.planted_faults

growth: .venv/ready-to-test  ## how cost grows with length, inputs and outputs: build/growth
	$(BIN)/python benchmarks/growth.py

frozen: docs .venv/ready-to-test  ## the studio as a folder that needs no Python: build/frozen (10 minutes)
	$(BIN)/python packaging/freeze.py

release: docs .venv/ready-to-test  ## build and check what is released, with checksums: dist
	$(BIN)/python -m pip install --quiet --group release
	$(BIN)/python packaging/release.py

clean:
	rm -rf .venv build dist docs/gallery

.venv/ready-to-run: pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or newer is needed; try make PYTHON=python3.12")'
	test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --upgrade "pip>=25.1"
	$(BIN)/python -m pip install --quiet --editable ".[gui,dataset]"
	touch $@

.venv/ready-to-test: .venv/ready-to-run
	$(BIN)/python -m pip install --quiet --group dev
	touch $@

.venv/ready-for-docs: .venv/ready-to-run
	$(BIN)/python -m pip install --quiet --group docs
	touch $@
