// End shield of a small motor, bore 12 mm with its axis along z through the origin, Tet10.
//
//   z                   hub of radius 10 mm, 10 mm long, its middle at z = 0
//   |_  rim             web of 2.5 mm, radius 10 to 26 mm, flush with the hub's back at z = -5
//   |_|____   _         rim of radius 26 to 32 mm, 6 mm long, with four bolt holes of 4 mm on a circle of radius 29 mm
//   |______|_| |
//          hub
//
SetFactory("OpenCASCADE");
bore = 6;           // mm, radius
hub = 10;           // mm, outer radius
hub_length = 10;    // mm, along the axis
web = 2.5;          // mm, thickness
rim_in = 26;        // mm, inner radius
rim = 32;           // mm, outer radius
rim_length = 6;     // mm
bolts = 29;         // mm, radius of their circle
fine = 2.6;         // mm, element size at the bore
coarse = 5;         // mm, and elsewhere

back = -hub_length/2;
Cylinder(1) = {0, 0, back, 0, 0, hub_length, hub};
Cylinder(2) = {0, 0, back, 0, 0, web, rim};
Cylinder(3) = {0, 0, back, 0, 0, rim_length, rim};
Cylinder(4) = {0, 0, back + web, 0, 0, rim_length, rim_in};
ring() = BooleanDifference{ Volume{3}; Delete; }{ Volume{4}; Delete; };
body() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2, ring()}; Delete; };
Cylinder(11) = {0, 0, -hub_length, 0, 0, 2*hub_length, bore};
For k In {0:3}
  angle = Pi/4 + k*Pi/2;
  Cylinder(12 + k) = {bolts*Cos(angle), bolts*Sin(angle), -hub_length, 0, 0, 2*hub_length, 2};
EndFor
housing() = BooleanDifference{ Volume{body()}; Delete; }{ Volume{11:15}; Delete; };

e = 0.01;
bore_faces() = Surface In BoundingBox{-bore - e, -bore - e, -hub_length, bore + e, bore + e, hub_length};
bolt_faces() = {};
For k In {0:3}
  angle = Pi/4 + k*Pi/2;
  x = bolts*Cos(angle);
  y = bolts*Sin(angle);
  bolt_faces() += Surface In BoundingBox{x - 2 - e, y - 2 - e, -hub_length, x + 2 + e, y + 2 + e, hub_length};
EndFor

Physical Volume("housing") = {housing()};
Physical Surface("bore") = {bore_faces()};
Physical Surface("bolts") = {bolt_faces()};

Field[1] = Distance;
Field[1].FacesList = {bore_faces()};
Field[2] = Threshold;
Field[2].IField = 1;
Field[2].LcMin = fine;
Field[2].LcMax = coarse;
Field[2].DistMin = 0;
Field[2].DistMax = 10;
Background Field = 2;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;             // or curved elements at the bolts fold
