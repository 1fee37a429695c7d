#!/bin/sh
# Installs what the build needs beside Rust, where it is missing: a C compiler and linker
# (Debian's package names). Quick and silent when everything is there.
set -eu

if ! command -v cargo >/dev/null 2>&1; then
    echo "cargo is missing: install Rust first, see https://rustup.rs" >&2
    exit 1
fi

missing=""
need() {
    missing="$missing $1"
}

if ! command -v gcc >/dev/null 2>&1 && ! command -v cc >/dev/null 2>&1; then
    need gcc
fi
# The C library's headers and start files; without them the linker cannot make a program.
if ! { [ -e /usr/include/stdio.h ] || [ -e /usr/local/include/stdio.h ]; }; then
    need libc6-dev
fi

[ -n "$missing" ] || exit 0

# A list of words.
# shellcheck disable=SC2086
sh "$(dirname "$0")/install.sh" $missing
