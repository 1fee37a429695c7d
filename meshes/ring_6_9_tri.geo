// The annulus of ring_6_9.geo, unstructured, Tri6.
SetFactory("Built-in");
inner = 6;      // mm
outer = 9;      // mm
size = 0.9;     // mm, length of an element's side

Point(1) = {0, 0, 0};
Point(2) = { inner, 0, 0, size};
Point(3) = {0,  inner, 0, size};
Point(4) = {-inner, 0, 0, size};
Point(5) = {0, -inner, 0, size};
Point(6) = { outer, 0, 0, size};
Point(7) = {0,  outer, 0, size};
Point(8) = {-outer, 0, 0, size};
Point(9) = {0, -outer, 0, size};

For i In {0 : 3}
  j = (i + 1) % 4;
  Circle(1 + i) = {2 + i, 1, 2 + j};   // bore
  Circle(5 + i) = {6 + i, 1, 6 + j};   // outside
EndFor
Curve Loop(1) = {5 : 8};
Curve Loop(2) = {1 : 4};
Plane Surface(1) = {1, 2};

Physical Surface("housing") = {1};
Physical Curve("bore") = {1 : 4};
Physical Curve("outer") = {5 : 8};
Physical Curve("lower") = {7, 8};      // outside, y < 0
Physical Point("top") = {7};           // (0, 9)

Mesh.Algorithm = 6;                    // Frontal-Delaunay
Mesh.ElementOrder = 2;
