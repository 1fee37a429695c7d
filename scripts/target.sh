#!/bin/sh
# Says where cargo builds: `target`, or what CARGO_TARGET_DIR or a configuration of cargo names.
set -eu
cd "$(dirname "$0")/.."
cargo metadata --format-version 1 --no-deps --offline | sed 's/.*"target_directory":"\([^"]*\)".*/\1/'
