// A ball and a bitten block of glass on bricks, as both programs read it.
//   Ortho=1  seen by an orthographic camera
#version 3.7;
#ifndef (Ortho) #declare Ortho = 0; #end
#ifndef (Adc) #declare Adc = 1/255; #end
global_settings { assumed_gamma 1.0 max_trace_level 12 adc_bailout Adc }
#if (Ortho)
camera { orthographic location <3,4,-8> look_at <0,0.8,0> right 6*x up 4.5*y }
#else
camera { location <3,4,-8> look_at <0,0.8,0> angle 36 right x*4/3 }
#end
background { rgb <0.3,0.4,0.5> }
light_source { <8,14,-10> color rgb <1,0.97,0.9> }
plane { y, 0 pigment { brick color rgb 0.75, color rgb <0.6,0.25,0.15> scale 0.12 translate -0.2*y } finish { ambient 0.12 diffuse 0.8 } }
#declare G = material { texture { pigment { color rgbf <0.96,0.99,0.97,0.95> } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } conserve_energy } } interior { ior 1.52 } }
sphere { <-1.2,1.05,0.4>, 1 material { G } }
difference { box { <0.2,0.1,-0.9>,<2.0,1.8,0.9> } sphere { <1.1,1.8,0>, 0.65 } material { G } rotate 15*y }
