#!/bin/sh
# Makes the meshes of this folder that have a .geo (gmsh 4.8 or later); the cubes in every encoding.
set -eu
cd "$(dirname "$0")"
for pair in 1:hex20 2:wedge15 3:tet10; do
    for format in msh41 msh22; do
        for binary in 0 1; do
            name="cube_${pair#*:}_$format"
            [ $binary = 0 ] || name="${name}_bin"
            gmsh -3 -v 2 -setnumber kind "${pair%:*}" -setnumber Mesh.Binary $binary \
                -format "$format" -o "$name.msh" cube.geo
        done
    done
done
for pair in 0:hex27 1:hex20; do
    gmsh -3 -v 2 -order 2 -setnumber Mesh.SecondOrderIncomplete "${pair%:*}" -format msh41 -o "mixed_${pair#*:}.msh" mixed.geo
done
for name in one_block two_blocks nafems6_ring sdls109_ring; do
    gmsh -3 -v 2 -bin -format msh41 -o "$name.msh" "$name.geo"
done
gmsh -3 -v 2 -setnumber n 12 -format msh41 -bin -o ring3d_tet10_30deg.msh ring3d_tet10_curved.geo
