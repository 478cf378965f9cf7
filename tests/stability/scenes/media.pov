// SPDX-License-Identifier: MIT
// Media that touch, overlap, or just miss each other. Gap: how much wider than the bore of the glass (and deeper
// than its floor) the water is: 0 contact, > 0 overlap, < 0 a film of air between.
#include "frame.inc"
#ifndef (Gap) #declare Gap = 0; #end
#ifndef (Turn) #declare Turn = 0; #end
global_settings { assumed_gamma 1 max_trace_level 30 }
#declare There = transform { translate -Shift_in rotate Turn * <17, 31, 9> translate Shift_in transform To_place }
#declare Clear = texture { pigment { rgbf <1, 1, 1, 1> } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } conserve_energy } }
#declare Checker = texture { pigment { checker rgb .2, rgb .9 } finish { ambient .3 diffuse .6 } }
light_source { Far(<3, 6, -4>), rgb 1 }
plane { y, -.3 * S + Shift_in.y texture { Checker scale .25 * S translate Shift_in } transform To_place }
sky_sphere { pigment { gradient y color_map { [0 rgb <.8, .8, .9>] [1 rgb <.2, .4, .9>] } } }

// POV-Ray knows no priorities: the suite declares it for abbe.
#ifdef (Priority) #declare Glass = interior { ior 1.5 priority Priority } #else #declare Glass = interior { ior 1.5 } #end

#macro Tumbler()
  difference {
    cylinder { At(<0, 0, 0>), At(<0, 1, 0>), .5 * S }
    cylinder { At(<0, .1, 0>), At(<0, 1.2, 0>), .45 * S }
    texture { Clear } interior { Glass } transform There
  }
#end
#switch (Row)
#case (0) // water in a tumbler
  camera { location Far(<.8, 1.2, -2.6>) right 4/3*x look_at Far(<0, .45, 0>) angle 30 }
  Tumbler()
  cylinder { At(<0, .1 - Gap, 0>), At(<0, .8, 0>), (.45 + Gap) * S texture { Clear } interior { ior 1.33 } transform There }
#break
#case (1) // two boxes of different glass side by side
  camera { location Far(<1.3, 1.6, -2.6>) right 4/3*x look_at Far(<.5, .45, .5>) angle 32 }
  box { At(<0, 0, 0>), At(<.5, 1, 1>) texture { Clear } interior { ior 1.5 } transform There }
  box { At(<.5 - Gap, 0, 0>), At(<1, 1, 1>) texture { Clear } interior { ior 1.7 } transform There }
#break
#case (2) // two boxes of one glass side by side
  camera { location Far(<1.3, 1.6, -2.6>) right 4/3*x look_at Far(<.5, .45, .5>) angle 32 }
  box { At(<0, 0, 0>), At(<.5, 1, 1>) texture { Clear } interior { ior 1.5 } transform There }
  box { At(<.5 - Gap, 0, 0>), At(<1, 1, 1>) texture { Clear } interior { ior 1.5 } transform There }
#break
#end
