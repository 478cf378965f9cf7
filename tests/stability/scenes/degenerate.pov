// SPDX-License-Identifier: MIT
// Input at the edge of sense, beside a plain sphere. Row says which.
#version 3.7;
#ifndef (Row) #declare Row = 0; #end
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <0, 1, -6> right 4/3*x look_at <0, 0, 0> angle 40 }
light_source { <4, 7, -5>, rgb 1 }
background { rgb <.25, .35, .5> }
#declare Plain = texture { pigment { rgb <.9, .5, .3> } finish { ambient .1 diffuse .7 specular .3 } }
#declare Clear = texture { pigment { rgbf 1 } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } conserve_energy } }
sphere { <-1.2, 0, 0>, .8 texture { Plain } }
#switch (Row)
#case (0) sphere { <1, 0, 0>, 0 texture { Plain } } #break
#case (1) box { <.4, -.5, 0>, <1.6, .5, 0> texture { Plain } } #break
#case (2) cylinder { <1, -.5, 0>, <1, .5, 0>, 0 texture { Plain } } #break
#case (3) cylinder { <1, 0, 0>, <1, 0, 0>, .5 texture { Plain } } #break
#case (4) cone { <1, -.5, 0>, 0, <1, .5, 0>, 0 texture { Plain } } #break
#case (5) torus { 0, .5 translate x texture { Plain } } #break
#case (6) torus { .5, 0 translate x texture { Plain } } #break
#case (7) sphere { 0, .8 scale <1, 0, 1> translate x texture { Plain } } #break
#case (8) sphere { 0, .8 scale <-1, 1, 1> translate 1.2*x texture { Plain } } #break
#case (9) sphere { 0, .8 matrix <1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0> texture { Plain } } #break
#case (10) mesh { triangle { <.4, 0, 0>, <1, 0, 0>, <1.6, 0, 0> } triangle { <.4, -.5, 0>, <1.6, -.5, 0>, <1, .5, 0> } texture { Plain } } #break
#case (11) triangle { <1, 0, 0>, <1, 0, 0>, <1, .5, 0> texture { Plain } } #break
#case (12) sphere { <1e308, 0, 0>, 1 texture { Plain } } #break
#case (13) sphere { 0, 1e308 translate <0, 0, 1.5e308> texture { Plain } } #break
#case (14) sphere { <1, 0, 0>, 1e-310 texture { Plain } } #break
#case (15) box { <.4, -.5, 0>, <1.6, .5, 5e-324> texture { Plain } } #break
#case (16) sphere { 0, .8 scale 1e-310 scale 1e308 translate x texture { Plain } } #break
#case (17) plane { <0, 0, 0>, 1 texture { Plain } } #break
#case (18) difference { sphere { x, .8 } sphere { x, .8 } texture { Clear } interior { ior 1.5 } } #break
#case (19) sphere { <1.2, 0, 0>, .8 texture { Clear } interior { ior 0 } } #break
#case (20) sphere { <1.2, 0, 0>, .8 texture { Clear } interior { ior 1e308 } } #break
#case (21) light_source { <-1.2, .8, 0>, rgb 1 } #break
#case (22) sphere { <0, 1, -6>, .8 texture { Clear } interior { ior 1.5 } } #break
#case (23) prism { -.5, .5, 4, <.4, 0>, <1, 0>, <1.6, 0>, <.4, 0> texture { Plain } } #break
#case (24) quadric { <0, 0, 0>, <0, 0, 0>, <0, 0, 0>, -1 texture { Plain } } #break
#case (25) disc { x, <0, 0, 0>, 1 texture { Plain } } #break
#end
