# Everything a reader needs: `make demo`, then `make test`.

CASE := examples/tadina2011/outer-dent.toml
# 26 revolutions, which suffice for a verdict on the races and the ball, and the paper's window
WINDOWS := analysis.envelope=[{from=1.0,to=2.6},{from=2.3,to=2.4}]
REPORT := out/outer-dent/report.html
MDBOOK := $(firstword $(wildcard target/tools/bin/mdbook) mdbook)
.PHONY: help setup demo machines test python nightly figures meshes book docs bench bench-peers bench-all clean

help:
	@echo "make demo    build, run the dented bearing and say where its report is"
	@echo "make machines  a spindle and a motor in two bearings each, from their .geo to the verdict (needs gmsh)"
	@echo "make test    all tests, documentation tests and examples"
	@echo "make python  the Python package, built and tested in a clean environment"
	@echo "make nightly  the tests that take hours, and the readers under libFuzzer"
	@echo "make setup   install the system libraries that are missing"
	@echo "make figures the figures of the documents"
	@echo "make meshes  make the example meshes again (needs gmsh)"
	@echo "make book    the documents as a book, target/book/index.html (needs mdbook)"
	@echo "make docs    documentation of the library"
	@echo "make bench   benchmarks"
	@echo "make bench-peers  other integrators on the same equations (needs numpy, scipy, scikit-sundae)"
	@echo "make bench-all  most tables of docs/performance.md (hours; needs gmsh, ccx, slepc4py, numpy, scipy, scikit-sundae, scikit-sparse, exudyn)"
	@echo "make clean   remove what was built and computed"

setup:
	@sh scripts/setup.sh

demo: setup
	cargo run --release -- run $(CASE) --set '$(WINDOWS)'
	@test -f $(REPORT) && echo "The report: $(CURDIR)/$(REPORT)"

machines: setup
	@command -v gmsh >/dev/null 2>&1 || { echo "gmsh is missing: see https://gmsh.info" >&2; exit 1; }
	sh meshes/rebuild.sh spindle_block motor
	cargo run --release -- run examples/machines/spindle.toml
	cargo run --release -- run examples/machines/motor.toml

# cargo-nextest where it is installed; it leaves out documentation tests. The profile `release` takes over what `make demo` has built, `ci` checks
# sums for overflow too.
PROFILE := release
test: setup
	@if cargo nextest --version >/dev/null 2>&1; then \
		echo "cargo nextest run --cargo-profile $(PROFILE) && cargo test --profile $(PROFILE) --doc"; \
		cargo nextest run --cargo-profile $(PROFILE) && cargo test --profile $(PROFILE) --doc; \
	else \
		echo "cargo test --profile $(PROFILE)"; \
		cargo test --profile $(PROFILE); \
	fi
	cargo run --profile $(PROFILE) --example compare_integrators
	cargo run --profile $(PROFILE) --example bending_lock

python: setup
	cargo build --profile $(PROFILE)
	sh scripts/python.sh $(PROFILE)

nightly: setup
	sh scripts/nightly.sh

figures: setup
	cargo build --release
	sh scripts/figures.sh

meshes:
	@command -v gmsh >/dev/null 2>&1 || { echo "gmsh is missing: see https://gmsh.info" >&2; exit 1; }
	sh meshes/rebuild.sh

# mdBook as scripts/setup-ci.sh installs it, else one on the path.
book:
	@command -v $(MDBOOK) >/dev/null 2>&1 || { echo "mdbook is missing: sh scripts/setup-ci.sh, or cargo install mdbook" >&2; exit 1; }
	$(MDBOOK) build docs
	@echo "The book: $(CURDIR)/target/book/index.html"

docs:
	RUSTDOCFLAGS="-D warnings" cargo doc --no-deps

bench: setup
	cargo bench

bench-peers: setup
	python3 benches/peers.py

# Most tables of docs/performance.md: hours on an idle machine, with gmsh, CalculiX and SLEPc installed.
bench-all: bench
	cargo build --release
	python3 benches/housings.py
	python3 benches/housings.py --sizes 10,76,182,244,482,1156 --programs plummer --repeats 1
	python3 benches/condensation.py
	python3 benches/ensembles.py
	python3 benches/peers.py

clean:
	cargo clean
	rm -rf target benches/peers/target out
