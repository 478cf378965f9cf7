// SPDX-License-Identifier: MIT
// Shapes whose surface is searched along the line, beside the same solid made of shapes whose surface is computed (Exact = 1).
// Row says which shape, Way what is done with it; Clear = 1: of glass; Swapped = 1: statements and operands the other way round.
#version 3.7;
#ifndef (Row) #declare Row = 0; #end
#ifndef (Way) #declare Way = 0; #end
#ifndef (Exact) #declare Exact = 0; #end
#ifndef (Clear) #declare Clear = 0; #end
#ifndef (Swapped) #declare Swapped = 0; #end
// Paths are short: in a curved body of glass each further reflection inside multiplies what a rounding moved.
global_settings { assumed_gamma 1 max_trace_level 6 }
#default { finish { ambient .6 diffuse .4 } }
camera { location <4, 3, -8> look_at <0, 0, 0> angle 22 }
light_source { <3, 9, -7>, rgb 1 }
sky_sphere { pigment { gradient y color_map { [0 rgb <.9, .8, .6>] [1 rgb <.2, .4, .9>] } } }
plane { y, -1.6 pigment { checker rgb <.9, .3, .2>, rgb .9 } }

#declare Plain = texture { pigment { rgb <.3, .5, .9> } }
#declare Other = texture { pigment { rgb <.9, .6, .3> } }
#declare Window = texture { pigment { rgbf 1 } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } conserve_energy } }
#macro Of_one() #if (Clear) texture { Window } interior { ior 1.5 } #else texture { Plain } #end #end
#macro Of_other() #if (Clear) texture { Window } interior { ior 1.7 } #else texture { Other } #end #end

#macro Octahedron()
  intersection {
    #for (A, -1, 1, 2) #for (B, -1, 1, 2) #for (C, -1, 1, 2) plane { <A, B, C>, 1 / sqrt(3) } #end #end #end
    bounded_by { box { -1, 1 } }
  }
#end
#macro Capsule(A, B, R) merge { cylinder { A, B, R } sphere { A, R } sphere { B, R } } #end
#declare Root = 1 / sqrt(2);

#switch (Row)
#case (0) #declare Low = -1; #if (Exact) #declare Body = Octahedron()
  #else #declare Body = isosurface { function { abs(x) + abs(y) + abs(z) - 1 } contained_by { sphere { 0, 2 } } max_gradient 2 } #end
#break
#case (1) #declare Low = -.7; #if (Exact) #declare Body = box { -.7, .7 }
  #else #declare Body = isosurface { function { max(abs(x), abs(y), abs(z)) } threshold .7 contained_by { box { -1, 1 } } max_gradient 1.1 } #end
#break
#case (2) #declare Low = -.3; #if (Exact) #declare Body = torus { .8, .3 }
  #else #declare Body = isosurface { function { sqrt(pow(sqrt(x*x + z*z) - .8, 2) + y*y) - .3 } contained_by { box { -1.2, 1.2 } } max_gradient 1.1 } #end
#break
#case (3) #declare Low = -1; #if (Exact) #declare Body = sphere { 0, 1 }
  #else #declare Body = isosurface { function { x*x + y*y + z*z - 1 } contained_by { box { -1.2, 1.2 } } max_gradient 4 } #end
#break
#case (4) #declare Low = -1; #if (Exact) #declare Body = sphere { 0, 1 } #else #declare Body = superellipsoid { <1, 1> } #end #break
#case (5) #declare Low = -1; #if (Exact) #declare Body = Octahedron() #else #declare Body = superellipsoid { <2, 2> } #end #break
#case (6) #declare Low = -1; #if (Exact) #declare Body = merge { cone { 0, 1, y, 0 } cone { 0, 1, -y, 0 } }
  #else #declare Body = superellipsoid { <1, 2> rotate 90*x } #end
#break
#case (7) #declare Low = -Root; #if (Exact) #declare Body = sphere { 0, Root } #else #declare Body = blob { threshold .25 sphere { 0, 1, 1 } } #end #break
#case (8) #declare Low = -Root; #if (Exact) #declare Body = Capsule(-.6*x, .6*x, Root)
  #else #declare Body = blob { threshold .25 cylinder { -.6*x, .6*x, 1, 1 } } #end
#break
#case (9) #declare Low = -.8; #if (Exact) #declare Body = merge { cone { -.8*y, .3, .1*y, .9 } cone { .1*y, .9, .8*y, 0 } }
  #else #declare Body = lathe { linear_spline 5, <0, -.8>, <.3, -.8>, <.9, .1>, <0, .8>, <0, -.8> } #end
#break
#case (10) #declare Low = -.8; #if (Exact) #declare Body = cone { -.8*y, .9, .8*y, .3 }
  #else #declare Body = lathe { bezier_spline 12, <0, -.8>, <.3, -.8>, <.6, -.8>, <.9, -.8>, <.9, -.8>, <.7, -.8 + 1.6/3>, <.5, -.8 + 3.2/3>, <.3, .8>,
    <.3, .8>, <.2, .8>, <.1, .8>, <0, .8> } #end
#break
#case (11) #declare Low = -.8; #if (Exact) #declare Body = cone { -.8*y, .9, .8*y, .3 }
  #else #declare Body = sor { 6, <1.275, -1.8>, <.9, -.8>, <.675, -.2>, <.4875, .3>, <.3, .8>, <.1125, 1.3> } #end
#break
#case (12) #declare Low = -.5; #if (Exact) #declare Body = Capsule(-.6*x, .6*x, .5)
  #else #declare Body = sphere_sweep { linear_spline 2, -.6*x, .5, .6*x, .5 } #end
#break
#case (13) #declare Low = -.5; #if (Exact) #declare Body = Capsule(-.6*x, .6*x, .5)
  #else #declare Body = sphere_sweep { b_spline 4, -1.8*x, .5, -.6*x, .5, .6*x, .5, 1.8*x, .5 } #end
#break
#case (14) #declare Low = -.3; #if (Exact) #declare Body = torus { .8, .3 }
  #else #declare Body = quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -1.46, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1.1, 0, 0, 0, 0, 1, 0, -1.46, 0, .3025> } #end
#break
#case (15) // (x^2 + y^2 + z^2 - .64) (y + 4), within a ball
  #declare Low = -.8; #if (Exact) #declare Body = sphere { 0, .8 }
  #else #declare Body = intersection { cubic { <0, 1, 0, 4, 0, 0, 0, 0, 0, 0, 1, 0, 4, 1, 0, -.64, 0, 4, 0, -2.56> } sphere { 0, 2 } } #end
#break
#end

// What the body stands beside, is cut by and is glued to; it stands on Low.
#declare Block = box { <-2, -.35, -2>, <.1, .25, .15> }
#macro Pair(A, B) #if (Swapped) object { B } object { A } #else object { A } object { B } #end #end
#declare The_body = object { Body Of_one() }
#declare Far_block = box { <-2, -1.5, .95>, <2, .8, 1.3> texture { Other } }
#declare Crossing_block = object { Block texture { Other } }
#declare Stand = box { <-1.2, -1.5, -1.2>, <1.2, Low, 1.2> Of_other() }
#declare Under = plane { y, .1 }
#declare Upper = difference { object { Body } object { Under } Of_one() }
#declare Lower = intersection { Pair(Body, Under) Of_other() }
#switch (Way)
#case (0) Pair(The_body, Far_block) #break // close to it
#case (1) Pair(The_body, Crossing_block) #break // through an opaque one
#case (2) difference { object { Body } object { Block } Of_one() } #break
#case (3) intersection { Pair(Body, Block) Of_one() } #break
#case (4) merge { Pair(Body, Block) Of_one() } #break
#case (5) Pair(Upper, Lower) #break // parted by a plane, and together again
#case (6) Pair(The_body, Stand) #break // on a face that it touches
#end
