// The block of two_blocks.geo in one part of hex20.
// gmsh one_block.geo -3 -format msh41 -bin -o one_block.msh
SetFactory("Built-in");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Point(1) = {0, 0, 0}; Point(2) = {20, 0, 0}; Point(3) = {20, 10, 0}; Point(4) = {0, 10, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 7; Transfinite Curve {2, 4} = 4;
Transfinite Surface {1}; Recombine Surface {1};
e[] = Extrude {0, 0, 10} { Surface{1}; Layers{4}; Recombine; };
Physical Volume("block") = {e[1]};
Physical Surface("base") = {1};
Physical Surface("top") = {e[0]};
