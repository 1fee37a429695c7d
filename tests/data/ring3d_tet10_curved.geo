// Ring 6-9 mm, 4 mm wide, of curved tet10; n elements round the bore (12: one spans 30 degrees).
// gmsh ring3d_tet10_curved.geo -3 -setnumber n 12 -format msh41 -bin -o ring3d_tet10_30deg.msh
SetFactory("Built-in");
DefineConstant[n = 12];
mm = 1e-3; inner = 6*mm; outer = 9*mm; width = 4*mm;
Point(1) = {0, 0, 0};
For k In {0:3}
  a = k*Pi/2;
  Point(10 + k) = {inner*Cos(a), inner*Sin(a), 0, inner*2*Pi/n};
  Point(20 + k) = {outer*Cos(a), outer*Sin(a), 0, outer*2*Pi/n};
EndFor
For k In {0:3}
  Circle(10 + k) = {10 + k, 1, 10 + (k + 1)%4};
  Circle(20 + k) = {20 + k, 1, 20 + (k + 1)%4};
EndFor
Curve Loop(1) = {20:23};
Curve Loop(2) = {10:13};
Plane Surface(1) = {1, 2};
v[] = Extrude {0, 0, width} { Surface{1}; };
Physical Volume("ring") = {v[1]};
Mesh.ElementOrder = 2;
Mesh.SecondOrderLinear = 0;
