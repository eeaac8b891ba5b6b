# The doors. Each makes its own .venv the first time; later runs start at once.
#
#   make populate      a sentence becomes a populated world (TEXT="..." AGENTS=60 OUT=out/station)
#   make test          the tests
#   make check         everything that must hold before a change lands
#   make docs          writes docs/cli.md anew from the commands
#   make player        builds the browser player anew (needs Node.js 20.19 or newer)

TEXT   ?= At the station concourse on Friday evening, commuters queue for coffee while a school class waits for a delayed train
AGENTS ?= 60
OUT    ?= out/station
BIN    := .venv/bin
READY  := .venv/.ready

export TEXT

.PHONY: populate test check docs player
.DELETE_ON_ERROR:

populate: $(READY)
	$(BIN)/genc populate "$$TEXT" --agents $(AGENTS) --steering jupedsim --out $(OUT)
	$(BIN)/genc story $(OUT) --group 1

test: $(READY)
	$(BIN)/pytest

check: $(READY)
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python docs/cli_reference.py --check
	cd player && npm ci --silent
	$(BIN)/pytest

player:
	cd player && npm ci --silent && npm run --silent build

docs: $(READY)
	$(BIN)/python docs/cli_reference.py

# Made anew whenever the requirements change. Of what jupedsim asks for, only its own window needs the rest (1.2 GB).
$(READY): pyproject.toml constraints.txt
	@python=$$(for p in python3 python3.11 python3.12 python3.13 python3.14 python; do \
		if $$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then echo $$p; break; fi; \
	done); \
	if [ -z "$$python" ]; then echo "genc needs Python 3.11 or newer on the PATH" >&2; exit 1; fi; \
	echo "installing into .venv with $$($$python --version)"; \
	test -x $(BIN)/python || $$python -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt --no-deps jupedsim
	@touch $@
