// Plane annulus, radii 6 and 9 mm: the aluminium ring of examples/tadina2011.
// Structured Quad8: 72 elements round (bore nodes every 2.5 degrees from 0), 3 radially. Turned, not
// transfinite: the layers put the nodes at their angles to rounding.
SetFactory("Built-in");
inner = 6;      // mm
outer = 9;      // mm
DefineConstant[ quarter = 18 ];  // elements in 90 degrees; the coarser meshes of the same ring set both
DefineConstant[ radial = 3 ];    // elements from bore to outside

Point(1) = {inner, 0, 0};
Point(2) = {outer, 0, 0};
Line(1) = {1, 2};
Transfinite Curve {1} = radial + 1;

spoke = 1;
For i In {0 : 3}
  made[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi / 2} { Curve{spoke}; Layers{quarter}; Recombine; };
  spoke = made[0];
  surface[i] = made[1];
  outside[i] = made[2];
  inside[i] = made[3];
EndFor
top[] = Point In BoundingBox {-0.01, outer - 0.01, -0.01, 0.01, outer + 0.01, 0.01};

Physical Surface("housing") = {surface[]};
Physical Curve("bore") = {Abs(inside[0]), Abs(inside[1]), Abs(inside[2]), Abs(inside[3])};
Physical Curve("outer") = {Abs(outside[0]), Abs(outside[1]), Abs(outside[2]), Abs(outside[3])};
Physical Curve("lower") = {Abs(outside[2]), Abs(outside[3])};   // outside, y < 0
Physical Point("top") = {top[0]};                               // (0, 9)

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;        // Quad8, not Quad9
