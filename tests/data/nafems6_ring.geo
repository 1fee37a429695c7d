// NAFEMS test 6: free ring of mean radius 1 m and round section of 0.1 m; hex20.
// gmsh nafems6_ring.geo -3 -format msh41 -bin -o nafems6_ring.msh
SetFactory("Built-in");
R = 1; r = 0.05; c = r / 2;
Point(1) = {R, 0, 0};
For k In {0:3}
  a = Pi/4 + k*Pi/2;
  Point(10 + k) = {R + c*Cos(a), 0, c*Sin(a)};
  Point(20 + k) = {R + r*Cos(a), 0, r*Sin(a)};
EndFor
For k In {0:3}
  n = (k + 1) % 4;
  Line(10 + k) = {10 + k, 10 + n};
  Circle(20 + k) = {20 + k, 1, 20 + n};
  Line(30 + k) = {10 + k, 20 + k};
EndFor
Curve Loop(1) = {10, 11, 12, 13};
Plane Surface(1) = {1};
For k In {0:3}
  n = (k + 1) % 4;
  Curve Loop(2 + k) = {30 + k, 20 + k, -(30 + n), -(10 + k)};
  Plane Surface(2 + k) = {2 + k};
EndFor
Transfinite Curve {10:13, 20:23} = 3;
Transfinite Curve {30:33} = 2;
Transfinite Surface {1:5};
Recombine Surface {1:5};
volumes[] = {};
f[] = {1, 2, 3, 4, 5};
For i In {0:3}
  For j In {0:4}
    e[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi/2} { Surface{f[j]}; Layers{16}; Recombine; };
    f[j] = e[0];
    volumes[] += e[1];
  EndFor
EndFor
Coherence;
Physical Volume("ring") = volumes[];
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
