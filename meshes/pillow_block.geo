// Plane pillow block, bore 12 mm, centre of the bore at the origin, Tri6.
//
//            top (0, 10)
//          .-----.
//         /  .-.  \
//        |  ( o )  |        foot 44 x 5 mm, underside at y = -13
//    ____|   `-'   |____    "feet": the underside below the two bolts, 8 mm each
//   |___________________|
//      ^^^         ^^^
SetFactory("Built-in");
bore = 6;           // mm, radius
shell = 10;         // mm, outer radius of the bearing seat
half_foot = 22;     // mm
foot_top = -8;      // mm
foot_bottom = -13;  // mm
bolt_from = 11;     // mm, |x| where a bolt region begins
bolt_to = 19;       // mm, and ends
fine = 0.7;         // mm, element size at the bore
coarse = 1.5;       // mm, and in the foot

Point(1) = {0, 0, 0};
// bore
Point(2) = { bore, 0, 0, fine};
Point(3) = {0,  bore, 0, fine};
Point(4) = {-bore, 0, 0, fine};
Point(5) = {0, -bore, 0, fine};
// seat and foot, anticlockwise from the right end of the seat's arc
Point(10) = { shell, 0, 0, coarse};
Point(11) = {0, shell, 0, coarse};
Point(12) = {-shell, 0, 0, coarse};
Point(13) = {-shell, foot_top, 0, coarse};
Point(14) = {-half_foot, foot_top, 0, coarse};
Point(15) = {-half_foot, foot_bottom, 0, coarse};
Point(16) = {-bolt_to, foot_bottom, 0, coarse};
Point(17) = {-bolt_from, foot_bottom, 0, coarse};
Point(18) = { bolt_from, foot_bottom, 0, coarse};
Point(19) = { bolt_to, foot_bottom, 0, coarse};
Point(20) = { half_foot, foot_bottom, 0, coarse};
Point(21) = { half_foot, foot_top, 0, coarse};
Point(22) = { shell, foot_top, 0, coarse};

Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Circle(10) = {10, 1, 11};
Circle(11) = {11, 1, 12};
For i In {12 : 21}
  Line(i) = {i, i + 1};
EndFor
Line(22) = {22, 10};

Curve Loop(1) = {10 : 22};
Curve Loop(2) = {1 : 4};
Plane Surface(1) = {1, 2};

Physical Surface("housing") = {1};
Physical Curve("bore") = {1 : 4};
Physical Curve("feet") = {16, 18};     // undersides of the bolt regions
Physical Point("top") = {11};          // (0, 10)

Mesh.Algorithm = 6;                    // Frontal-Delaunay
Mesh.ElementOrder = 2;
