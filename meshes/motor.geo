// Frame of a small electric motor with its two end shields and feet, as one casting: solid, second-order tetrahedra.
//
// In mm, axis along z. The bore of the drive end has 52 mm (bearing 6205) and its middle at z = 0, that of the other end 40 mm (6203) and
// z = 130. A tube of radii 60 and 66 mm joins the shields; it stands on two feet whose undersides are at y = -80.
SetFactory("OpenCASCADE");
fine = 9;           // mm, element size at the bores
coarse = 15;        // mm, and elsewhere

Cylinder(1) = {0, 0, -8, 0, 0, 146, 66};                  // the outside
Cylinder(2) = {0, 0, -1, 0, 0, 132, 60};                  // the room for rotor and stator
Cylinder(3) = {0, 0, -8, 0, 0, 16, 35};                   // hubs
Cylinder(4) = {0, 0, 122, 0, 0, 16, 28};
Box(5) = {-62, -80, 20, 24, 40, 90};                      // feet
Box(6) = {38, -80, 20, 24, 40, 90};
shell() = BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; };
feet() = BooleanDifference{ Volume{5, 6}; Delete; }{ Volume{2}; Delete; };
body() = BooleanUnion{ Volume{shell()}; Delete; }{ Volume{3, 4, feet()}; Delete; };
Cylinder(11) = {0, 0, -20, 0, 0, 40, 26};
Cylinder(12) = {0, 0, 110, 0, 0, 40, 20};
housing() = BooleanDifference{ Volume{body()}; Delete; }{ Volume{11, 12}; Delete; };

e = 0.1;
drive() = Surface In BoundingBox{-26 - e, -26 - e, -8 - e, 26 + e, 26 + e, 8 + e};
other() = Surface In BoundingBox{-20 - e, -20 - e, 122 - e, 20 + e, 20 + e, 138 + e};
feet() = Surface In BoundingBox{-62 - e, -80 - e, 20 - e, 62 + e, -80 + e, 110 + e};

Physical Volume("housing") = {housing()};
Physical Surface("drive bore") = {drive()};
Physical Surface("rear bore") = {other()};
Physical Surface("feet") = {feet()};

Field[1] = Distance;
Field[1].FacesList = {drive(), other()};
Field[2] = Threshold;
Field[2].IField = 1;
Field[2].LcMin = fine;
Field[2].LcMax = coarse;
Field[2].DistMin = 0;
Field[2].DistMax = 25;
Background Field = 2;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;             // or curved elements at the bores fold
