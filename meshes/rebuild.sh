#!/bin/sh
# Makes every mesh of this folder from its .geo (gmsh 4.8 or later); `make meshes` calls it.
set -eu
cd "$(dirname "$0")"
for geo in *.geo; do
    gmsh -3 -v 2 -format msh41 -o "${geo%.geo}.msh" "$geo"
done
