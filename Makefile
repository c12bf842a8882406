# make lab    set everything up and open the studio in JupyterLab     make lab ARGS="--port=9000"
# make test   set everything up and run all tests                     make test ONLY="pytest vitest"
# make docs   set everything up and make the site: out/site/index.html
# All can be run again at any time: what is there already is kept.

# The first Python on the path that is recent enough.
PYTHON ?= $(firstword $(foreach p,python3 python3.14 python3.13 python3.12 python3.11 python,$(shell \
	$(p) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $(p))) python3)
VENV := .venv/bin
# .venv/bin first: a Node that set-up brought lies there.
export PATH := $(CURDIR)/$(VENV):$(PATH)

.PHONY: help lab test docs check bench front watch core notebooks format floors lock clean setup-lab setup-test
.DEFAULT_GOAL := help

help:  ## list the targets
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## (.*)/  make \1\t\2/' | expand -t 16

lab: setup-lab  ## set up, start JupyterLab on the studio notebook, print its address
	@$(VENV)/python scripts/lab.py $(ARGS)

test: setup-test  ## set up, run all checks and tests (ONLY="…" for some of them)
	@$(VENV)/python scripts/run_tests.py $(ONLY)

docs: setup-test  ## set up, make the site, print where its first page is
	@$(VENV)/python -m scripts.docs.site $(ARGS)

check: setup-test  ## linters, types, imports, stale bundles: no tests
	@$(VENV)/python scripts/run_tests.py check

bench: setup-test  ## print what is measured
	@$(VENV)/python -m tests.bench $(ARGS)

front: setup-test  ## build the front end into facade_nb/widgets/static
	@node scripts/front.mjs

notebooks: setup-test  ## run the notebooks and tutorials again that hold widgets: their saved state has the front end
	@$(VENV)/python scripts/notebooks.py

watch: setup-test  ## build the front end again after every change
	@node scripts/front.mjs --watch

core: setup-test  ## build the solver's compiled search into facade_nb/solver/alignment/core/core.wasm
	@$(VENV)/python scripts/core.py

format: setup-test  ## format Python and TypeScript
	@$(VENV)/ruff check -q --fix-only && $(VENV)/ruff format && node_modules/.bin/biome check --write .

lock: setup-test  ## choose the newest versions: constraints.txt and package-lock.json
	@$(PYTHON) scripts/versions.py lock && npm update --no-audit --no-fund --ignore-scripts

floors: setup-test  ## run the Python tests with the oldest versions that pyproject.toml allows
	@$(PYTHON) scripts/versions.py floors

clean:  ## remove what set-up made
	rm -rf .venv node_modules

setup-lab:
	@$(PYTHON) scripts/setup.py lab

setup-test:
	@$(PYTHON) scripts/setup.py test
