#!/bin/sh
# Makes every mesh of this folder from its .geo, or those that are named (gmsh 4.8 or later); `make meshes` calls it.
set -eu
cd "$(dirname "$0")"
[ $# -gt 0 ] || set -- $(ls *.geo | sed 's/\.geo$//')
for name in "$@"; do
    gmsh -3 -v 2 -format msh41 -o "$name.msh" "$name.geo"
done
