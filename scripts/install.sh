#!/bin/sh
# Installs Debian packages, as root or by sudo without a password; says what to type where neither is possible.
#   sh scripts/install.sh PACKAGE...
set -eu

if ! command -v apt-get >/dev/null 2>&1; then
    echo "missing (Debian's names): $*" >&2
    echo "apt-get is not available: install them with this system's package manager" >&2
    exit 1
fi

if [ "$(id -u)" -eq 0 ]; then
    as_root=""
elif command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then
    as_root="sudo -n"
else
    echo "missing: $*; install them by" >&2
    echo "    sudo apt-get update && sudo apt-get install --yes $*" >&2
    exit 1
fi

echo "installing: $*"
# Empty, or a list of words.
# shellcheck disable=SC2086
{
    $as_root apt-get update
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends "$@"
}
