// Unit cube (mm) for the tests of solid elements: the same groups in three element kinds. The bottom is in two
// groups, "support" and "contact" (with the top), the volume in "body" and in one without a name, the
// edge at x = y = 0 in "corner edge". rebuild.sh sets kind: 1 Hex20, 2 Wedge15, 3 Tet10.
If (!Exists(kind)) kind = 1; EndIf
SetFactory("Built-in");
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Transfinite Curve {1 : 4} = 3;
Transfinite Surface {1};
If (kind == 1)
  Recombine Surface {1};
  top[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; Recombine; };
ElseIf (kind == 2)
  top[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; Recombine; };
Else
  top[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; };
EndIf

Physical Volume("body", 1) = {top[1]};
Physical Volume(2) = {top[1]};
Physical Surface("support", 3) = {1};
Physical Surface("contact", 4) = {1, top[0]};
Physical Curve("corner edge", 5) = {11};

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
