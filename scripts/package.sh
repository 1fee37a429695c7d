#!/bin/sh
# The Debian package: builds the program, its manual pages and completions, and packs them. Needs cargo-deb (cargo install cargo-deb).
set -eu
cd "$(dirname "$0")/.."

cargo build --release --locked
rm -rf target/shell
target/release/plummer man --out target/shell
target/release/plummer completions bash > target/shell/plummer.bash
target/release/plummer completions zsh > target/shell/_plummer
target/release/plummer completions fish > target/shell/plummer.fish
cargo deb --no-build --locked
