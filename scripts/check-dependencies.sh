#!/bin/sh
# Dependencies: licences, versions beside each other, sources; and advisories where their database can be reached. Rules: deny.toml.
set -eu
cd "$(dirname "$0")/.."

deny=cargo-deny
[ -x target/tools/bin/cargo-deny ] && deny=target/tools/bin/cargo-deny
"$deny" --workspace check licenses bans sources

# the database comes from the network, and its absence is no fault of ours; an advisory is
said=$("$deny" --workspace check advisories 2>&1) && { echo "advisories ok"; exit 0; }
case $said in
*"failed to fetch advisory database"*) echo "advisories not checked: their database cannot be reached" ;;
*)
    echo "$said"
    exit 1
    ;;
esac
