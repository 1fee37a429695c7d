// Block with two bearing seats on one axis, as of a small spindle: in mm, solid, second-order tetrahedra.
//
// Axis along z. The seats are 12 mm in diameter and 5 mm long, their middles at z = 2.5 and z = 27.5 mm; between them the hole has
// 10 mm. The block stands on its lower face.
SetFactory("OpenCASCADE");
Mesh.CharacteristicLengthMin = 2.8;
Mesh.CharacteristicLengthMax = 2.8;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;             // or curved elements at the seats fold

Box(1) = {-11, -11, 0, 22, 22, 30};
Cylinder(2) = {0, 0, -1, 0, 0, 32, 5};
Cylinder(3) = {0, 0, -1, 0, 0, 6, 6};
Cylinder(4) = {0, 0, 25, 0, 0, 6, 6};
BooleanDifference(5) = {Volume{1}; Delete;}{Volume{2, 3, 4}; Delete;};

e = 0.1;
front() = Surface In BoundingBox{-6 - e, -6 - e, -e, 6 + e, 6 + e, 5 + e};
rear() = Surface In BoundingBox{-6 - e, -6 - e, 25 - e, 6 + e, 6 + e, 30 + e};
front() -= Surface In BoundingBox{-6 - e, -6 - e, 5 - e, 6 + e, 6 + e, 5 + e};        // shoulders
rear() -= Surface In BoundingBox{-6 - e, -6 - e, 25 - e, 6 + e, 6 + e, 25 + e};
foot() = Surface In BoundingBox{-11 - e, -11 - e, -e, 11 + e, -11 + e, 30 + e};

Physical Volume("housing") = {5};
Physical Surface("front bore") = {front()};
Physical Surface("rear bore") = {rear()};
Physical Surface("foot") = {foot()};
