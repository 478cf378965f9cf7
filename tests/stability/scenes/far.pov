// SPDX-License-Identifier: MIT
// A unit object seen from 10^Distance away, always as large in the picture. Row: 0 sphere, 1 cylinder, 2 cone, 3 box,
// 4 torus, 5 quadric, 6 a boolean solid, 7 triangle, 8 prism, 9 mesh,
// 10 superellipsoid, 11 blob, 12 lathe, 13 sphere_sweep, 14 isosurface, 15 quartic, 16 sor.
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
#end
