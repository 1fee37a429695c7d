// A block of 20 x 10 x 10 mm in two parts that share no node: hex20 below, tet10 above.
// gmsh two_blocks.geo -3 -format msh41 -bin -o two_blocks.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.MeshSizeMax = 3.1;
Box(1) = {0, 0, 0, 20, 10, 5};
Box(2) = {0, 0, 5, 20, 10, 5};
// edges 9-12 of a box run along x, 1-8 along y and z
Transfinite Curve {9:12} = 7;
Transfinite Curve {2, 4, 6, 8} = 4;
Transfinite Curve {1, 3, 5, 7} = 3;
Transfinite Surface {1:6};
Recombine Surface {1:6};
Transfinite Volume {1};
Physical Volume("lower") = {1};
Physical Volume("upper") = {2};
Physical Surface("base") = {5};
Physical Surface("seat") = {6};
Physical Surface("foot") = {11};
Physical Surface("top") = {12};
