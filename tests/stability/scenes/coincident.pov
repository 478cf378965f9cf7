// SPDX-License-Identifier: MIT
// Boolean solids whose faces coincide. Row says which; Clean = 1 is the same solid built without coincidences:
// what the picture must be. Turn rotates it; sizes and places as in frame.inc.
#include "frame.inc"
#ifndef (Clean) #declare Clean = 0; #end
#ifndef (Turn) #declare Turn = 0; #end
#ifdef (Unlimited) global_settings { assumed_gamma 1 } #else global_settings { assumed_gamma 1 max_trace_level 30 } #end
#default { finish { ambient .3 diffuse .6 } }
#declare Rotated = transform { translate -Shift_in rotate Turn * <17, 31, 9> translate Shift_in }
#declare There = transform { transform Rotated transform To_place }
camera { location Far(<1.3, 1.6, -2.6>) right 4/3*x look_at Far(<.5, .45, .5>) angle 32 }
light_source { Far(<3, 6, -4>), rgb 1 }
#declare Outer = texture { pigment { rgb <.9, .5, .3> } }
#declare Inner = texture { pigment { rgb <.3, .5, .9> } }
#declare Clear = texture { pigment { rgbf <1, 1, 1, 1> } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } conserve_energy } }
#declare Glass = interior { ior 1.5 }
#declare Checker = texture { pigment { checker rgb .2, rgb .9 } }
#macro Floor()
  plane { y, -.3 * S + Shift_in.y texture { Checker scale .25 * S translate Shift_in } transform To_place }
  sky_sphere { pigment { gradient y color_map { [0 rgb <.8, .8, .9>] [1 rgb <.2, .4, .9>] } } }
#end
#macro Block(A, B) box { At(A), At(B) } #end
#macro Glass_cube() object { Block(<0, 0, 0>, <1, 1, 1>) texture { Clear } interior { Glass } transform There } Floor() #end

#if (Row < 4) background { rgb <.1, .15, .2> } #end
#declare Out = (Clean ? .25 : 0); // how far cutters reach beyond the faces that they share
#switch (Row)
#case (0) // a hole through two opposite faces, the cutter flush with both
  difference {
    object { Block(<0, 0, 0>, <1, 1, 1>) texture { Outer } }
    object { Block(<.25, .25, -Out>, <.75, .75, 1 + Out>) texture { Inner } }
    transform There
  }
#break
#case (1) // a notch: the cutter flush with three faces
  difference {
    object { Block(<0, 0, 0>, <1, 1, 1>) texture { Outer } }
    object { Block(<.5, .5, -Out>, <1 + Out, 1 + Out, .5>) texture { Inner } }
    transform There
  }
#break
#case (2) // A - A: nothing
  #if (!Clean)
    difference {
      object { Block(<0, 0, 0>, <1, 1, 1>) texture { Outer } }
      object { Block(<0, 0, 0>, <1, 1, 1>) texture { Inner } }
      transform There
    }
  #end
#break
#case (3) // A & A: A
  #if (Clean)
    object { Block(<0, 0, 0>, <1, 1, 1>) texture { Outer } transform There }
  #else
    intersection {
      object { Block(<0, 0, 0>, <1, 1, 1>) texture { Outer } }
      object { Block(<0, 0, 0>, <1, 1, 1>) texture { Outer } }
      transform There
    }
  #end
#break
#case (4) // two glass boxes sharing a face, as a union: one box
  #if (Clean) Glass_cube()
  #else
    union {
      Block(<0, 0, 0>, <.5, 1, 1>)
      Block(<.5, 0, 0>, <1, 1, 1>)
      texture { Clear } interior { Glass } transform There
    }
    Floor()
  #end
#break
#case (5) // and merged
  #if (Clean) Glass_cube()
  #else
    merge {
      Block(<0, 0, 0>, <.5, 1, 1>)
      Block(<.5, 0, 0>, <1, 1, 1>)
      texture { Clear } interior { Glass } transform There
    }
    Floor()
  #end
#break
#case (6) // two glass boxes that overlap, their sides flush, merged
  #if (Clean) Glass_cube()
  #else
    merge {
      Block(<0, 0, 0>, <.6, 1, 1>)
      Block(<.4, 0, 0>, <1, 1, 1>)
      texture { Clear } interior { Glass } transform There
    }
    Floor()
  #end
#break
#case (7) // 64 cubes of glass, merged: one cube
  #if (Clean) Glass_cube()
  #else
    merge {
      #for (I, 0, 3) #for (J, 0, 3) #for (K, 0, 3)
        Block(<I, J, K> / 4, <I + 1, J + 1, K + 1> / 4)
      #end #end #end
      texture { Clear } interior { Glass } transform There
    }
    Floor()
  #end
#break
#case (8) // 64 cubes of glass as a union of 64 solids
  #if (Clean) Glass_cube()
  #else
    union {
      #for (I, 0, 3) #for (J, 0, 3) #for (K, 0, 3)
        Block(<I, J, K> / 4, <I + 1, J + 1, K + 1> / 4)
      #end #end #end
      texture { Clear } interior { Glass } transform There
    }
    Floor()
  #end
#break
#case (9) // two glass spheres in one place, as a union of two solids: one
  union {
    sphere { At(<.5, .5, .5>), .5 * S }
    #if (!Clean) sphere { At(<.5, .5, .5>), .5 * S } #end
    texture { Clear } interior { Glass } transform There
  }
  Floor()
#break
#case (10) // a glass cube whose left half is there twice
  #if (Clean) Glass_cube()
  #else
    union {
      Block(<0, 0, 0>, <1, 1, 1>)
      Block(<0, 0, 0>, <.5, 1, 1>)
      texture { Clear } interior { Glass } transform There
    }
    Floor()
  #end
#break
#end
