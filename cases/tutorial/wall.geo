// SPDX-License-Identifier: GPL-2.0-or-later
// Ground 2 m x 1 m; the upper half of its left side is a wall. gmsh -2 wall.geo
h = 0.17;
Point(1) = {0, 0, 0, h}; Point(2) = {2, 0, 0, h}; Point(3) = {2, 1, 0, h}; Point(4) = {0, 1, 0, h}; Point(5) = {0, 0.5, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Physical Curve("base") = {1};
Physical Curve("far") = {2};
Physical Curve("surface") = {3};
Physical Curve("wall") = {4};
Physical Curve("below_wall") = {5};
Physical Point("toe") = {5};         // of both the wall and the side below: it moves with the wall
Physical Surface("ground") = {1};
Mesh.RecombineAll = 1;               // quadrilaterals
Mesh.ElementOrder = 2;               // of 8 nodes
Mesh.SecondOrderIncomplete = 1;
