// The annulus of ring_6_9.geo with 20 elements round, turned by 7.3 degrees on the bore: bore
// nodes at 7.3, 16.3, 25.3, ... degrees, none where a ring of 72 nodes has its own (7 degrees would
// make every fifth node match). Outside, the nodes are at 0, 9, 18, ... so that (0, 9) is a node and
// y < 0 is half of the elements.
SetFactory("Built-in");
inner = 6;              // mm
outer = 9;              // mm
turn = 7.3 * Pi / 180;  // start of the bore
quarter = 5;            // elements in 90 degrees
radial = 2;             // elements from bore to outside

Point(1) = {0, 0, 0};
For i In {0 : 3}
  Point(2 + i) = {inner * Cos(turn + i * Pi / 2), inner * Sin(turn + i * Pi / 2), 0};
EndFor
Point(6) = { outer, 0, 0};
Point(7) = {0,  outer, 0};
Point(8) = {-outer, 0, 0};
Point(9) = {0, -outer, 0};

For i In {0 : 3}
  j = (i + 1) % 4;
  Circle(1 + i) = {2 + i, 1, 2 + j};   // bore
  Circle(5 + i) = {6 + i, 1, 6 + j};   // outside
  Line(9 + i) = {2 + i, 6 + i};        // spokes, slightly oblique
EndFor
For i In {0 : 3}
  j = (i + 1) % 4;
  Curve Loop(1 + i) = {9 + i, 5 + i, -(9 + j), -(1 + i)};
  Plane Surface(1 + i) = {1 + i};
EndFor

Transfinite Curve {1 : 8} = quarter + 1;
Transfinite Curve {9 : 12} = radial + 1;
Transfinite Surface {1 : 4};
Recombine Surface {1 : 4};

Physical Surface("housing") = {1 : 4};
Physical Curve("bore") = {1 : 4};
Physical Curve("outer") = {5 : 8};
Physical Curve("lower") = {7, 8};      // outside, y < 0
Physical Point("top") = {7};           // (0, 9)

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;        // Quad8, not Quad9
