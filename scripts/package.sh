#!/bin/sh
# The Debian package: builds the program, its manual pages and completions, and packs them. Needs cargo-deb (cargo install cargo-deb).
set -eu
cd "$(dirname "$0")/.."

cargo build --release --locked
plummer=$(sh scripts/target.sh)/release/plummer
# where Cargo.toml names them for cargo-deb
rm -rf target/shell
"$plummer" man --out target/shell
"$plummer" completions bash > target/shell/plummer.bash
"$plummer" completions zsh > target/shell/_plummer
"$plummer" completions fish > target/shell/plummer.fish
cargo deb --no-build --locked
