// SPDX-License-Identifier: MIT
// Shapes, boolean solids and glass at any scale and place (frame.inc). Row says which.
#include "frame.inc"
global_settings { assumed_gamma 1 max_trace_level 12 }
#default { finish { ambient .1 diffuse .7 } }
background { rgb <.25, .35, .5> }
#declare Plain = texture { pigment { rgb <.9, .5, .3> } finish { ambient .1 diffuse .7 specular .3 roughness .02 } }
#declare Clear = texture { pigment { rgbf <1, 1, 1, 1> } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } conserve_energy } }
#declare Glass = interior { ior 1.5 }
#declare Checker = texture { pigment { checker rgb .2, rgb .9 } }
#macro Floor(Y)
  plane { y, Y * S + Shift_in.y texture { Checker scale .5 * S translate Shift_in } transform To_place }
#end
#macro Sky() sky_sphere { pigment { gradient y color_map { [0 rgb <.8, .8, .9>] [1 rgb <.2, .4, .9>] } } } #end

#if (Row = 0)
  camera { location Far(<0, 2.2, -6>) right 4/3*x look_at Far(<0, .8, 0>) angle 45 }
#else
  camera { location Far(<.9, 1.7, -3.6>) right 4/3*x look_at Far(<0, 0, 0>) angle 38 }
#end
light_source { Far(<4, 7, -5>), rgb 1 }

#declare Box_in = box { At(<-2, -2, -2>), At(<0, 2, -.1>) }
#declare Box_around = box { At(<-.8, -.7, -.8>), At(<.9, .7, .7>) }
#declare Blob = blob { threshold .5 sphere { At(<-.4, 0, 0>), S, 1 } sphere { At(<.4, .2, 0>), .9 * S, 1 } cylinder { At(<-.5, -.6, 0>), At(<.5, -.6, .2>), .5 * S, 1 } }
#declare Lathe = lathe { cubic_spline 6, <.2, -1.1>, <.3, -.8>, <.8, 0>, <.3, .6>, <.4, .8>, <.5, .9> scale S translate At(<0, 0, 0>) }

#switch (Row)
#case (0) // the full scene
  sphere { At(<-1.1, 1, 0>), S texture { Clear } interior { Glass } transform To_place }
  difference {
    box { At(<.3, 0, -.7>), At(<1.9, 1.6, .9>) }
    sphere { At(<1.1, 1.6, .1>), .6 * S }
    cylinder { At(<1.1, -1, -.3>), At(<1.1, 3, -.3>), .25 * S }
    texture { Plain } transform To_place
  }
  torus { .5 * S, .15 * S translate At(<0, .15, -1.6>) texture { Plain } transform To_place }
  Floor(0)
  Sky()
#break
#case (1) sphere { At(<0, 0, 0>), S texture { Plain } transform To_place } #break
#case (2) box { At(<-.8, -.7, -.6>), At(<.8, .7, .6>) texture { Plain } transform To_place } #break
#case (3) cylinder { At(<-.4, -.7, 0>), At(<.5, .8, .2>), .5 * S texture { Plain } transform To_place } #break
#case (4) cone { At(<-.4, -.7, 0>), .8 * S, At(<.5, .9, .2>), .2 * S texture { Plain } transform To_place } #break
#case (5) torus { .8 * S, .25 * S rotate <20, 0, 30> translate At(<0, 0, 0>) texture { Plain } transform To_place } #break
#case (6) disc { At(<0, 0, 0>), <.3, 1, -.6>, S, .4 * S texture { Plain } transform To_place } #break
#case (7) // ellipsoid of the unit lengths 1, .7, .5
  quadric { <1, 2.04, 4>, <0, 0, 0>, <0, 0, 0>, -1 rotate <10, 20, 30> scale S translate At(<0, 0, 0>) texture { Plain } transform To_place }
#break
#case (8)
  prism { -.6, .6, 6, <-.9, -.6>, <.9, -.6>, <.9, .2>, <0, .1>, <-.2, .8>, <-.9, -.6>
    scale S translate At(<0, 0, 0>) texture { Plain } transform To_place }
#break
#case (9)
  mesh {
    triangle { At(<-.9, -.6, -.5>), At(<.9, -.6, -.5>), At(<0, -.5, .9>) }
    triangle { At(<-.9, -.6, -.5>), At(<.9, -.6, -.5>), At(<.1, .9, 0>) }
    triangle { At(<.9, -.6, -.5>), At(<0, -.5, .9>), At(<.1, .9, 0>) }
    triangle { At(<0, -.5, .9>), At(<-.9, -.6, -.5>), At(<.1, .9, 0>) }
    inside_vector <.31, .7, .2>
    texture { Plain } transform To_place
  }
#break
#case (10) triangle { At(<-.9, -.6, -.5>), At(<.9, -.6, -.2>), At(<.1, .9, 0>) texture { Plain } transform To_place } #break
#case (11) // boolean solids
  difference {
    box { At(<-.8, -.8, -.8>), At(<.8, .8, .8>) }
    sphere { At(<0, .8, -.2>), .6 * S }
    cylinder { At(<0, -2, -.4>), At(<0, 2, -.4>), .25 * S }
    texture { Plain } transform To_place
  }
#break
#case (12)
  intersection {
    merge { sphere { At(<-.3, 0, 0>), .8 * S } torus { .8 * S, .2 * S translate At(<.2, .1, 0>) } }
    plane { <.2, 1, -.4>, .3 * S + vdot(Shift_in, vnormalize(<.2, 1, -.4>)) }
    texture { Plain } transform To_place
  }
#break
#case (13) sphere { At(<0, 0, 0>), S texture { Clear } interior { Glass } transform To_place } Floor(-1) Sky() #break
#case (14) // a lens
  intersection {
    sphere { At(<0, 0, -1.2>), 1.5 * S } sphere { At(<0, 0, 1.2>), 1.5 * S }
    texture { Clear } interior { Glass } transform To_place
  }
  Floor(-1) Sky()
#break
#case (15) // a glass prism
  prism { -.9, .9, 4, <-.7, 0>, <.7, 0>, <0, 1.2>, <-.7, 0>
    rotate <-90, 0, 0> rotate <0, 30, 0> scale S translate At(<0, -.5, 0>)
    texture { Clear } interior { Glass } transform To_place }
  Floor(-1) Sky()
#break
#case (16)
  difference {
    torus { .8 * S, .3 * S }
    box { <-2, -.1, -2> * S, <2, 2, 0> * S rotate <0, 10, 7> }
    translate At(<0, 0, 0>)
    texture { Clear } interior { ior 1.8 } transform To_place
  }
  Floor(-1) Sky()
#break
#case (17) cylinder { At(<-.4, -.7, 0>), At(<.5, .8, .2>), .5 * S open texture { Plain } transform To_place } #break
#case (18) // quadric cut by a plane, a hyperboloid
  intersection {
    quadric { <1, -.6, 1>, <0, 0, 0>, <0, 0, 0>, -.25 scale S translate At(<0, 0, 0>) }
    box { At(<-1, -.8, -1>), At(<1, .8, 1>) }
    texture { Plain } transform To_place
  }
#break
#case (19) superellipsoid { <.3, .4> scale .8 * S translate At(<0, 0, 0>) texture { Plain } transform To_place } #break
#case (20)
  blob { threshold .5 sphere { At(<-.4, 0, 0>), S, 1 } sphere { At(<.4, .2, 0>), .9 * S, 1 } texture { Plain } transform To_place }
#break
#case (21)
  lathe { quadratic_spline 5, <.1, -.9>, <.2, -.8>, <.8, 0>, <.3, .6>, <.5, .9> scale S translate At(<0, 0, 0>) texture { Plain } transform To_place }
#break
#case (22)
  sphere_sweep { b_spline 5, At(<-2, 0, 0>), .3 * S, At(<-.7, .5, 0>), .3 * S, At(<0, -.5, .3>), .2 * S, At(<.7, .5, 0>), .3 * S, At(<2, 0, 0>), .3 * S
    texture { Plain } transform To_place }
#break
#case (23)
  isosurface { function { x*x + 2*y*y + z*z - .5 } contained_by { box { -1, 1 } } max_gradient 4 scale S translate At(<0, 0, 0>) texture { Plain } transform To_place }
#break
#case (24)
  quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -1.36, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1.2, 0, 0, 0, 0, 1, 0, -1.36, 0, .36>
    sturm rotate <30, 0, 20> scale S translate At(<0, 0, 0>) texture { Plain } transform To_place }
#break
#case (25) sor { 5, <.3, -1>, <.3, -.8>, <.8, 0>, <.3, .6>, <.5, .9> scale S translate At(<0, 0, 0>) texture { Plain } transform To_place } #break
#case (26)
  polygon { 6, <-.9, -.6>, <.9, -.6>, <.9, .2>, <0, .1>, <-.2, .8>, <-.9, -.6> rotate <10, 30, 5> scale S translate At(<0, 0, 0>)
    texture { Plain } transform To_place }
#break
#case (27) // x^6 + y^6 + z^6 - .1
  poly { 6, <1, 0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,
    1, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 1,0,0,0,0,0,-.1>
    sturm rotate <20, 40, 0> scale S translate At(<0, 0, 0>) texture { Plain } transform To_place }
#break
#case (28) // Cayley's cubic
  intersection {
    cubic { <0, 0, 0, 2, 0, 4, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, -1> sturm scale .6 * S translate At(<0, 0, 0>) }
    object { Box_around }
    texture { Plain } transform To_place
  }
#break
#case (29) object { Blob texture { Clear } interior { Glass } transform To_place } Floor(-1) Sky() #break
#case (30) difference { object { Blob } object { Box_in } texture { Plain } transform To_place } #break
#case (31)
  lathe { linear_spline 6, <0, -.8>, <.8, -.7>, <.3, 0>, <.6, .6>, <0, .8>, <0, -.8> scale S translate At(<0, 0, 0>)
    texture { Clear } interior { Glass } transform To_place }
  Floor(-1) Sky()
#break
#case (32) difference { object { Lathe } object { Box_in } texture { Plain } transform To_place } #break
#case (33)
  merge {
    sphere_sweep { linear_spline 3, At(<-.7, -.3, 0>), .3 * S, At(<0, .4, .2>), .2 * S, At(<.7, -.2, 0>), .35 * S }
    box { At(<-.4, -.6, -.3>), At(<.4, .1, .3>) }
    texture { Clear } interior { Glass } transform To_place
  }
  Floor(-1) Sky()
#break
#case (34)
  difference {
    superellipsoid { <.4, .6> scale .8 * S translate At(<0, 0, 0>) } sphere { At(<.1, .8, -.3>), .5 * S }
    texture { Clear } interior { Glass } transform To_place
  }
  Floor(-1) Sky()
#break
#case (35)
  intersection {
    isosurface { function { x*x + 2*y*y + z*z - .7 } contained_by { box { -1, 1 } } max_gradient 6 scale S translate At(<0, 0, 0>) }
    object { Box_around }
    texture { Clear } interior { Glass } transform To_place
  }
  Floor(-1) Sky()
#break
#case (36)
  difference {
    sor { 5, <.3, -1>, <.3, -.8>, <.8, 0>, <.3, .6>, <.5, .9> scale S translate At(<0, 0, 0>) } object { Box_in }
    texture { Clear } interior { Glass } transform To_place
  }
  Floor(-1) Sky()
#break
#case (37)
  intersection {
    quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -1.36, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1.2, 0, 0, 0, 0, 1, 0, -1.36, 0, .36>
      sturm rotate <30, 0, 20> scale S translate At(<0, 0, 0>) }
    object { Box_around }
    texture { Clear } interior { Glass } transform To_place
  }
  Floor(-1) Sky()
#break
#end
