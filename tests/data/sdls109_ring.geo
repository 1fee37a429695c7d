// SDLS109: thick free ring, mean radius 0.369 m, 0.048 m thick, 0.05 m wide; hex20.
// gmsh sdls109_ring.geo -3 -format msh41 -bin -o sdls109_ring.msh
SetFactory("Built-in");
R = 0.369; t = 0.048; b = 0.05;
Point(1) = {R - t/2, 0, -b/2};
Point(2) = {R + t/2, 0, -b/2};
Point(3) = {R + t/2, 0, b/2};
Point(4) = {R - t/2, 0, b/2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = 4;
Transfinite Surface {1};
Recombine Surface {1};
volumes[] = {};
s = 1;
For i In {0:3}
  e[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi/2} { Surface{s}; Layers{16}; Recombine; };
  s = e[0];
  volumes[] += e[1];
EndFor
Coherence;
Physical Volume("ring") = volumes[];
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
