// SPDX-License-Identifier: MIT
// A unit object seen from 10^Distance away, always as large in the picture. Row: 0 sphere, 1 cylinder, 2 cone, 3 box,
// 4 torus, 5 quadric, 6 a boolean solid, 7 triangle, 8 prism, 9 mesh,
// 10 superellipsoid, 11 blob, 12 lathe, 13 sphere_sweep, 14 isosurface, 15 quartic, 16 sor, 17 disc, 18 polygon, 19 poly;
// boolean solids: 20 cubic, 21 blob, 22 lathe, 23 sphere_sweep, 24 superellipsoid, 25 isosurface, 26 sor, 27 quartic;
// glass: 28 sphere, 29 blob, 30 lathe, 31 superellipsoid minus a sphere.
#version 3.7;
#ifndef (Row) #declare Row = 0; #end
#ifndef (Distance) #declare Distance = 1; #end
global_settings { assumed_gamma 1 max_trace_level 5 }
#declare D = pow(10, Distance);
// Towards the eye, the same to the last digit for every D.
#declare Eye = vnormalize(<.3, .5, -.8>);
// All rays nearly parallel from 10^3 on: the picture no longer depends on D but by 1/D.
camera { location D * Eye right 4/3*x look_at 0 angle 2 * degrees(atan2(1.7, D)) }
light_source { <4, 7, -5> * D, rgb 1 }
background { rgb <.25, .35, .5> }
#declare Plain = texture { pigment { rgb <.9, .5, .3> } finish { ambient .1 diffuse .7 } }
#declare Box_in = box { -2, <0, 2, -.1> }
#declare Box_around = box { <-.8, -.7, -.8>, <.9, .7, .7> }
#declare Blob = blob { threshold .5 sphere { <-.4, 0, 0>, 1, 1 } sphere { <.4, .2, 0>, .9, 1 } cylinder { <-.5, -.6, 0>, <.5, -.6, .2>, .5, 1 } }
#declare Lathe = lathe { linear_spline 6, <0, -.8>, <.8, -.7>, <.3, 0>, <.6, .6>, <0, .8>, <0, -.8> }
#declare Quartic = quartic {
  <1, 0, 0, 0, 2, 0, 0, 2, 0, -1.36, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1.2, 0, 0, 0, 0, 1, 0, -1.36, 0, .36> sturm rotate <30, 0, 20> }
#declare Clear = texture { pigment { rgbf <1, 1, 1, 1> } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } conserve_energy } }
#if (Row >= 28)
  sky_sphere { pigment { gradient y color_map { [0 rgb <.8, .8, .9>] [.4 rgb <.2, .4, .9>] [1 rgb <.9, .5, .2>] } scale 2 translate -1 } }
#end
#switch (Row)
#case (0) sphere { 0, 1 texture { Plain } } #break
#case (1) cylinder { <-.4, -.7, 0>, <.5, .8, .2>, .6 texture { Plain } } #break
#case (2) cone { <-.4, -.8, 0>, .8, <.5, .9, .2>, .2 texture { Plain } } #break
#case (3) box { <-.8, -.7, -.6>, <.8, .7, .6> texture { Plain } } #break
#case (4) torus { .8, .3 rotate <20, 0, 30> texture { Plain } } #break
#case (5) quadric { <1, 2.04, 2>, <0, 0, 0>, <0, 0, 0>, -1 rotate <10, 20, 30> texture { Plain } } #break
#case (6) difference { sphere { 0, 1 } box { <0, 0, -2>, 2 } cylinder { <-2, -.4, 0>, <2, -.4, 0>, .3 } texture { Plain } } #break
#case (7) triangle { <-.9, -.6, -.5>, <.9, -.6, -.2>, <.1, .9, 0> texture { Plain } } #break
#case (8) prism { -.6, .6, 6, <-.9, -.6>, <.9, -.6>, <.9, .2>, <0, .1>, <-.2, .8>, <-.9, -.6> texture { Plain } } #break
#case (9)
  mesh {
    triangle { <-.9, -.6, -.5>, <.9, -.6, -.5>, <0, -.5, .9> } triangle { <-.9, -.6, -.5>, <.9, -.6, -.5>, <.1, .9, 0> }
    triangle { <.9, -.6, -.5>, <0, -.5, .9>, <.1, .9, 0> } triangle { <0, -.5, .9>, <-.9, -.6, -.5>, <.1, .9, 0> }
    texture { Plain }
  }
#break
#case (10) superellipsoid { <.3, .4> scale .8 texture { Plain } } #break
#case (11) blob { threshold .5 sphere { <-.4, 0, 0>, 1, 1 } sphere { <.4, .2, 0>, .9, 1 } texture { Plain } } #break
#case (12) lathe { quadratic_spline 5, <.1, -.9>, <.2, -.8>, <.8, 0>, <.3, .6>, <.5, .9> texture { Plain } } #break
#case (13)
  sphere_sweep { b_spline 5, <-2, 0, 0>, .3, <-.7, .5, 0>, .3, <0, -.5, .3>, .2, <.7, .5, 0>, .3, <2, 0, 0>, .3 texture { Plain } }
#break
#case (14) isosurface { function { x*x + 2*y*y + z*z - .5 } contained_by { box { -1, 1 } } max_gradient 4 texture { Plain } } #break
#case (15)
  quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -1.36, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1.2, 0, 0, 0, 0, 1, 0, -1.36, 0, .36>
    sturm rotate <30, 0, 20> texture { Plain } }
#break
#case (16) sor { 5, <.3, -1>, <.3, -.8>, <.8, 0>, <.3, .6>, <.5, .9> texture { Plain } } #break
#case (17) disc { 0, <.3, 1, -.6>, 1, .4 texture { Plain } } #break
#case (18) polygon { 6, <-.9, -.6>, <.9, -.6>, <.9, .2>, <0, .1>, <-.2, .8>, <-.9, -.6> rotate <10, 30, 5> texture { Plain } } #break
#case (19)
  poly { 6, <1, 0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,
    1, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 1,0,0,0,0,0,-.1> sturm rotate <20, 40, 0> texture { Plain } }
#break
#case (20)
  intersection {
    cubic { <0, 0, 0, 2, 0, 4, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, -1> sturm scale .6 } object { Box_around } texture { Plain }
  }
#break
#case (21) difference { object { Blob } object { Box_in } texture { Plain } } #break
#case (22) difference { object { Lathe } object { Box_in } texture { Plain } } #break
#case (23)
  merge {
    sphere_sweep { linear_spline 3, <-.7, -.3, 0>, .3, <0, .4, .2>, .2, <.7, -.2, 0>, .35 } box { <-.4, -.6, -.3>, <.4, .1, .3> }
    texture { Plain }
  }
#break
#case (24) difference { superellipsoid { <.4, .6> scale .8 } sphere { <.1, .8, -.3>, .5 } texture { Plain } } #break
#case (25)
  intersection {
    isosurface { function { x*x + 2*y*y + z*z - .7 } contained_by { box { -1, 1 } } max_gradient 6 } object { Box_around } texture { Plain }
  }
#break
#case (26) difference { sor { 5, <.3, -1>, <.3, -.8>, <.8, 0>, <.3, .6>, <.5, .9> } object { Box_in } texture { Plain } } #break
#case (27) intersection { object { Quartic } object { Box_around } texture { Plain } } #break
#case (28) sphere { 0, 1 texture { Clear } interior { ior 1.5 } } #break
#case (29) object { Blob texture { Clear } interior { ior 1.5 } } #break
#case (30) object { Lathe texture { Clear } interior { ior 1.5 } } #break
#case (31)
  difference { superellipsoid { <.4, .6> scale .8 } sphere { <.1, .8, -.3>, .5 } texture { Clear } interior { ior 1.5 } }
#break
#end
