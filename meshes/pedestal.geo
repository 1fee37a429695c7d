// Solid pillow block, bore 12 mm with its axis along z through the origin, 10 mm wide, Tet10.
//
//            top (0, 10)
//          .-----.
//         /  .-.  \           seat of radius 10 mm on a foot 44 x 5 mm,
//        |  ( o )  |          underside at y = -13
//    ____|   `-'   |____
//   |__||___________||__|     bolt holes of 4 mm at x = -16 and 16
//
SetFactory("OpenCASCADE");
bore = 6;           // mm, radius
seat = 10;          // mm, outer radius of the bearing seat
width = 10;         // mm, along the axis
half_foot = 22;     // mm
foot_top = -8;      // mm
foot_bottom = -13;  // mm
bolt = 16;          // mm, |x| of the bolts
fine = 2;           // mm, element size at the bore
coarse = 3.5;       // mm, and elsewhere

Box(1) = {-half_foot, foot_bottom, -width/2, 2*half_foot, foot_top - foot_bottom, width};
Box(2) = {-seat, foot_top, -width/2, 2*seat, -foot_top, width};
Cylinder(3) = {0, 0, -width/2, 0, 0, width, seat};
body() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Cylinder(11) = {0, 0, -width, 0, 0, 2*width, bore};
Cylinder(12) = {-bolt, foot_bottom - 1, 0, 0, 10, 0, 2};
Cylinder(13) = { bolt, foot_bottom - 1, 0, 0, 10, 0, 2};
housing() = BooleanDifference{ Volume{body()}; Delete; }{ Volume{11, 12, 13}; Delete; };

e = 0.01;
bore_faces() = Surface In BoundingBox{-bore - e, -bore - e, -width, bore + e, bore + e, width};
feet() = Surface In BoundingBox{-half_foot - e, foot_bottom - e, -width, half_foot + e, foot_bottom + e, width};

Physical Volume("housing") = {housing()};
Physical Surface("bore") = {bore_faces()};
Physical Surface("feet") = {feet()};

Field[1] = Distance;
Field[1].FacesList = {bore_faces()};
Field[2] = Threshold;
Field[2].IField = 1;
Field[2].LcMin = fine;
Field[2].LcMax = coarse;
Field[2].DistMin = 0;
Field[2].DistMax = 8;
Background Field = 2;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;             // or three curved elements at the bolts fold
