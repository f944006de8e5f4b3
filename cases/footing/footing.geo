// SPDX-License-Identifier: GPL-2.0-or-later
// Half of the ground below a strip footing of half width 1 m; the left side is the plane of symmetry.
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {6, 0, 0};
Point(4) = {6, 4, 0}; Point(5) = {1, 4, 0}; Point(6) = {0, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, -7}; Plane Surface(2) = {2};
Transfinite Curve {1, 5} = 5;
Transfinite Curve {2} = 11 Using Progression 1.15;
Transfinite Curve {4} = 11 Using Progression 1 / 1.15;
Transfinite Curve {3, 7} = 11 Using Progression 1 / 1.1;
Transfinite Curve {6} = 11 Using Progression 1.1;
Transfinite Surface {1, 2};
Recombine Surface {1, 2};
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
Physical Surface("ground") = {1, 2};
Physical Curve("base") = {1, 2};
Physical Curve("sides") = {3, 6};
Physical Curve("footing") = {5};
Physical Curve("surface") = {4};
