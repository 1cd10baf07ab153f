# make demo | test | check | pythons | bench | soak | sanitize | docs | clean
# Everything happens in .venv here; it is made when it is missing.

PYTHON ?= python3
JOBS ?= 2
VENV := .venv
PY := $(VENV)/bin/python
PIP := $(PY) -m pip --disable-pip-version-check install --quiet
RRNN := $(PY) -m rrnn_opt.cli.start

.DELETE_ON_ERROR:
.PHONY: help demo test check pythons dev bench soak sanitize docs clean

help:
	@sed -n 's/^# make/make/p' Makefile

demo: $(VENV)/demo.stamp
	$(RRNN) demo

test: $(VENV)/test.stamp
	$(PY) -m pytest -q -n $(JOBS)

check:
	.ci/run

pythons: $(VENV)/dev.stamp
	.ci/pythons

dev: $(VENV)/dev.stamp

bench: $(VENV)/test.stamp
	$(PY) -m benchmarks

soak: $(VENV)/test.stamp
	$(PY) -m benchmarks.interval_soundness
	$(PY) -m benchmarks.fuzz
	$(PY) -m benchmarks.soak

sanitize: $(VENV)/test.stamp
	$(PY) -m benchmarks.sanitize --jobs $(JOBS)

docs: $(VENV)/dev.stamp
	$(PY) -m sphinx -q -W --keep-going -b html docs docs/_build/html
	@echo docs/_build/html/index.html

clean:
	rm -rf build docs/_build dist runs .pythons rrnn_opt.egg-info .pytest_cache .ruff_cache .mypy_cache \
	  .hypothesis .import_linter_cache $(VENV)/demo.stamp $(VENV)/test.stamp \
	  $(VENV)/dev.stamp
	find . -name __pycache__ -not -path './$(VENV)/*' -prune -exec rm -rf {} +

$(VENV)/made.stamp:
	@"$(PYTHON)" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "rrnn_opt needs Python >= 3.11: make PYTHON=python3.11 ..." >&2; exit 1; }
	@test -x $(PY) && $(PY) -m pip --version >/dev/null 2>&1 || \
	  "$(PYTHON)" -m venv $(VENV) || \
	  { echo "could not make .venv: apt install python3-venv" >&2; exit 1; }
	@touch $@

$(VENV)/demo.stamp: $(VENV)/made.stamp pyproject.toml
	@echo 'installing packages into $(VENV): a minute or more'
	$(PIP) -e '.[viz]'
	@touch $@

$(VENV)/test.stamp: $(VENV)/made.stamp pyproject.toml
	@echo 'installing packages into $(VENV): a minute or more'
	$(PIP) -e '.[test,viz]'
	@touch $@

$(VENV)/dev.stamp: $(VENV)/made.stamp pyproject.toml
	@echo 'installing packages into $(VENV): a minute or more'
	$(PIP) -e '.[test,viz,dev]'
	@touch $@
