// Two cubes of 10 mm that share a face: hexahedra, tetrahedra, and gmsh's pyramids between them.
SetFactory("OpenCASCADE");
DefineConstant[n=2];
L=0.01;
Box(1)={0,0,0,L,L,L};
Box(2)={L,0,0,L,L,L};
Coherence;
Transfinite Curve{:} = n+1;
Transfinite Surface{Surface{:}};
Recombine Surface{ Boundary{Volume{1};} };
Transfinite Volume{1};
Physical Volume("body")={1,2};
