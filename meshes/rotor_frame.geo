// Frame of a rotor rig with two pedestals, 1.5 m apart: in mm, solid, second-order tetrahedra.
//
// The axis of the bores is z; their middles are at z = 0 and z = 1500. Pedestals are 20 mm thick and 120 mm wide, the bores
// 90 mm in diameter. The base of 60 mm stands on six feet, two below each pedestal and two halfway.
SetFactory("OpenCASCADE");
Mesh.CharacteristicLengthMin = 65;
Mesh.CharacteristicLengthMax = 65;
Mesh.MinimumCirclePoints = 16;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;             // or curved elements at the bores fold

Box(1) = {-150, -360, -50, 300, 60, 1600};
Box(2) = {-60, -300, -10, 120, 360, 20};
Box(3) = {-60, -300, 1490, 120, 360, 20};
v() = {};
For z In {-50:1490:760}
  For x In {-150:90:240}
    f = newv;
    Box(f) = {x, -380, z, 60, 20, 80};
    v() += f;
  EndFor
EndFor
all() = BooleanUnion{Volume{1}; Delete;}{Volume{2, 3, v()}; Delete;};
c = newv;
Cylinder(c) = {0, 0, -20, 0, 0, 1540, 45};
body() = BooleanDifference{Volume{all()}; Delete;}{Volume{c}; Delete;};

e = 1;
front() = Surface In BoundingBox{-45 - e, -45 - e, -10 - e, 45 + e, 45 + e, 10 + e};
rear() = Surface In BoundingBox{-45 - e, -45 - e, 1490 - e, 45 + e, 45 + e, 1510 + e};
feet() = Surface In BoundingBox{-150 - e, -380 - e, -50 - e, 150 + e, -380 + e, 1550 + e};

Physical Volume("housing") = {body()};
Physical Surface("front bore") = {front()};
Physical Surface("rear bore") = {rear()};
Physical Surface("feet") = {feet()};
