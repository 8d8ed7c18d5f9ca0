// A peg in a block; x is r, y is z. Mesh it by: gmsh -2 peg.geo
Point(1) = {0, -0.5, 0};   Point(2) = {0.5, -0.5, 0};   Point(3) = {0.5, 0, 0};
Point(4) = {0.5, 1, 0};    Point(5) = {0, 1, 0};
Point(6) = {2, 0, 0};      Point(7) = {2, 1, 0};
Line(1) = {1, 2};   Line(2) = {2, 3};   Line(3) = {3, 4};   Line(4) = {4, 5};   Line(5) = {5, 1};
Line(6) = {3, 6};   Line(7) = {6, 7};   Line(8) = {7, 4};
Curve Loop(1) = {1, 2, 3, 4, 5};    Plane Surface(1) = {1};
Curve Loop(2) = {6, 7, 8, -3};      Plane Surface(2) = {2};
Physical Surface("peg") = {1};
Physical Surface("block") = {2};
Physical Curve("free end") = {1};
Physical Curve("shaft") = {3};
Physical Curve("top of the block") = {8};
Mesh.MeshSizeMax = 0.2;
Mesh.RecombineAll = 1;              // quadrilaterals
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;     // of 8 nodes
Mesh.MshFileVersion = 4.1;          // or 2.2
Mesh.Binary = 0;
