// examples/prism.scn as both programs read it: the same geometry, textures, lights and limits, no absorption.
//   Samples=0  one index for all wavelengths (nd of N-SF11); else POV-Ray's `dispersion` with so many samples.
#version 3.7;
#ifndef (Samples) #declare Samples = 0; #end
#ifndef (Detail) #declare Detail = 0; #end  // 1: the camera of prism_detail.scn
#include "../../../examples/grid.inc"

global_settings { assumed_gamma 1 max_trace_level 12 adc_bailout 1/255 }

camera {
  location <0, 7.5, -8.5>
  #if (Detail) look_at <0.25, 2.62, 0.02> angle 8 #else look_at <0, 1.15, 0.35> angle 36 #end
  right x * image_width / image_height
}

light_source { <-8, 16, -6>, rgb 1.3 }
background { rgb <0.10, 0.13, 0.20> }

Grid(Matte)

prism {
  linear_sweep linear_spline
  -2.2, 2.2, 4,
  <-1, 0.57735>, <1, 0.57735>, <0, -1.154701>, <-1, 0.57735>
  rotate -90 * x
  rotate 90 * y
  pigment { rgbt <1, 1, 1, 1> }
  finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } conserve_energy }
  // nd and nF - nC of SCHOTT N-SF11 by POV-Ray's law (tests/povray/rewrite.py).
  #if (Samples)
    interior { ior 1.790568 dispersion 1.035789 dispersion_samples Samples }
  #else
    interior { ior 1.784720 }
  #end
  rotate 22 * y
  translate 2.2 * y
}
