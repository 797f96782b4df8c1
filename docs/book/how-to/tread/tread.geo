// A tread block of one piece: 10 by 6 by 3 mm, with two slits 0.3 mm wide and 4.5 mm deep.
// gmsh -3 tread.geo
h = 0.75;
Point(1) = {0, 0, 0, h};     Point(2) = {3.1, 0, 0, h};   Point(3) = {3.1, 0, 4.5, h};
Point(4) = {3.4, 0, 4.5, h}; Point(5) = {3.4, 0, 0, h};   Point(6) = {6.6, 0, 0, h};
Point(7) = {6.6, 0, 4.5, h}; Point(8) = {6.9, 0, 4.5, h}; Point(9) = {6.9, 0, 0, h};
Point(10) = {10, 0, 0, h};   Point(11) = {10, 0, 6, h};   Point(12) = {0, 0, 6, h};
For i In {1:11}
  Line(i) = {i, i + 1};
EndFor
Line(12) = {12, 1};
Curve Loop(1) = {1:12};
Plane Surface(1) = {1};
Recombine Surface{1};
Extrude {0, 3, 0} { Surface{1}; Layers{3}; Recombine; }
Physical Volume("tread") = {1};
