// SPDX-License-Identifier: GPL-2.0-or-later
// A slope of 45 degrees, 5 m high, on 3 m of the same ground; triangles of 6 nodes.
Point(1) = {0, 0, 0, 1.5}; Point(2) = {18, 0, 0, 1.5}; Point(3) = {18, 3, 0, 1.2}; Point(4) = {13, 3, 0, 0.5};
Point(5) = {8, 8, 0, 0.7}; Point(6) = {5, 8, 0, 0.7}; Point(7) = {0, 8, 0, 1.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 7};
Line(7) = {7, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7}; Plane Surface(1) = {1};
Mesh.ElementOrder = 2;
Physical Surface("ground") = {1};
Physical Curve("base") = {1};
Physical Curve("sides") = {2, 7};
Physical Curve("face") = {4};
Physical Curve("crest") = {5};
