// SPDX-License-Identifier: MIT
// Clear glass in uniform white. Every pixel is white (furnace), or, seen from inside a cube, white or black: a ray
// leaves the cube, at once or after any number of total reflections, only if one component of its direction is above
// sqrt(1 - 1/n^2); else never. Limits = 0: no limits given. Row: 0 cube, 1 sphere, 2 brilliant, 3 inside a cube, 9 nothing.
#include "frame.inc"
#ifndef (Limits) #declare Limits = 0; #end
#ifndef (Index) #declare Index = 1.5; #end
global_settings { assumed_gamma 1 #if (Limits) max_trace_level Limits adc_bailout 0 #end }
background { rgb 1 }
#declare Clear = texture { pigment { rgbf <1, 1, 1, 1> } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } conserve_energy } }
#declare Glass = interior { ior Index }
#if (Row = 3)
  camera { location <.11, .07, -.13> right 4/3*x direction z*.7 rotate <20, 30, 0> translate <.0, .0, .0> }
#else
  camera { location <.9, 1.5, -3.2> right 4/3*x look_at 0 angle 30 }
#end
#switch (Row)
#case (1) sphere { 0, .7 texture { Clear } interior { Glass } } #break
#case (2)
  intersection {
    plane { y, .25 }
    #for (I, 0, 7)
      plane { vrotate(vrotate(y, <56, 0, 0>), <0, 45 * I, 0>), .5 }
      plane { vrotate(vrotate(-y, <49, 0, 0>), <0, 45 * I, 0>), .5 }
    #end
    texture { Clear } interior { Glass } rotate <20, 10, 0>
  }
#break
#case (0) #case (3) box { -.6, .6 texture { Clear } interior { Glass } } #break
#end
