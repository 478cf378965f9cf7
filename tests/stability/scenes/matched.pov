// SPDX-License-Identifier: MIT
// Glass in glass of nearly the same index over a checker. Row 0: two halves of a box; 1: a ball in a box; 2: a stack of
// 16 sheets. The indices are 1.5 and 1.5 (1 + 10^-Match); Match = 0: all is one glass.
#version 3.7;
#ifndef (Row) #declare Row = 0; #end
#ifndef (Match) #declare Match = 0; #end
global_settings { assumed_gamma 1 #ifdef (Limits) max_trace_level Limits adc_bailout 0.00001 #end }
camera { location <.9, 1.5, -3.2> right 4/3*x look_at 0 angle 34 }
plane { y, -1 pigment { checker rgb <.9, .3, .2>, rgb <.2, .5, .9> scale .37 } finish { ambient 1 diffuse 0 } }
background { rgb <.6, .7, .9> }
#declare Clear = texture { pigment { rgbf <1, 1, 1, 1> } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } conserve_energy } }
#declare First = interior { ior 1.5 }
#declare Second = interior { ior 1.5 * (1 + pow(10, -Match)) }
#if (Match = 0)
  box { -.7, .7 texture { Clear } interior { First } }
#else
  #switch (Row)
  #case (0)
    box { <-.7, -.7, -.7>, <.11, .7, .7> texture { Clear } interior { First } }
    box { <.11, -.7, -.7>, <.7, .7, .7> texture { Clear } interior { Second } }
  #break
  #case (1)
    box { -.7, .7 texture { Clear } interior { First } }
    sphere { 0, .6 texture { Clear } interior { Second } }
  #break
  #case (2)
    #for (I, 0, 15)
      box { <-.7, -.7, -.7 + I * .0875>, <.7, .7, -.7 + (I + 1) * .0875> texture { Clear }
        #if (mod(I, 2)) interior { Second } #else interior { First } #end }
    #end
  #break
  #end
#end
