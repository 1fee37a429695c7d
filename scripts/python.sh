#!/bin/sh
# The Python package: builds and installs it into a clean environment, target/python, and tests it there beside the program. The first argument
# is cargo's profile (default: release), what was built with it is taken over; others go to pytest.
set -eu
cd "$(dirname "$0")/.."

profile=${1:-release}
[ $# -eq 0 ] || shift
env=target/python
pip="$env/bin/pip --disable-pip-version-check --quiet install"
pinned="--require-hashes --only-binary :all: -r scripts/python-build.txt"

python3 -m venv --clear "$env"
$pip $pinned
PATH="$PWD/$env/bin:$PATH" MATURIN_PEP517_ARGS="--profile $profile" $pip --no-build-isolation --no-deps .
# NumPy is all that it needs
"$env/bin/python" -c 'import plummer; print(plummer.Case.load("examples/modal/ring.toml").modes())'

$pip $pinned -r scripts/python-tests.txt
PLUMMER=${PLUMMER:-$(sh scripts/target.sh)/$profile/plummer} "$env/bin/python" -m pytest --quiet "$@"
