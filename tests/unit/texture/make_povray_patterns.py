#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes povray_patterns.tsv: what the installed povray gives for patterns at points.

Run once, by hand, where povray is installed; the table is ground truth for pattern_povray_test.cpp.
POV-Ray keeps omega, lambda, frequency, phase and the patterns' own items in single precision: the
numbers given for them here have an exact one, so that all printed digits can be compared.
"""
import pathlib
import subprocess
import tempfile

PATTERNS = """
agate
agate turbulence .5
agate agate_turb .375 omega .625
agate octaves 3 noise_generator 1
bozo
bozo turbulence .3
bozo turbulence <.3,.1,0> octaves 4 omega .625 lambda 1.75
bozo noise_generator 1
bozo noise_generator 3
bozo frequency 3 phase .25
spotted
bumps noise_generator 3
boxed
brick
brick brick_size <2,1,1.3> mortar .1
brick turbulence .2
cells
cells turbulence .5
checker
checker turbulence .3
checker frequency 2 phase .375
checker sine_wave
brick phase .25 triangle_wave
crackle
crackle form <1,0,0>
crackle form <-1,1,.2> metric 1
crackle metric 3 offset .125
crackle offset .375
crackle solid
crackle solid noise_generator 1
crackle turbulence .4
cubic
cylindrical
dents
dents noise_generator 3
gradient x
gradient <1,2,3>
gradient y sine_wave
gradient y scallop_wave
gradient y triangle_wave
gradient y cubic_wave
gradient y poly_wave 2.5
gradient y poly_wave
gradient z frequency 2.5 phase .25 triangle_wave
gradient z frequency -1.5
gradient x frequency 0
gradient x frequency 0 sine_wave
granite
granite noise_generator 1
granite noise_generator 3
granite turbulence .2
hexagon
julia <.3125,.5>, 30
julia <.3125,.5>, 30 exponent 4 exterior 6, .125
julia <.25,.5>, 30 exponent 3 interior 2, 1
leopard
leopard frequency 2
magnet 1 mandel 30
magnet 1 mandel 30 interior 6, .125
magnet 2 mandel 30 exterior 2, .00048828125
magnet 1 julia <.3125,.5>, 30
magnet 2 julia <.3125,.5>, 30 interior 1, .5
mandel 30
mandel 30 exponent 3
mandel 30 exterior 6, .125
mandel 30 exterior 3, .125 interior 1, .5
mandel 30 interior 5, .5
marble
marble turbulence .3
marble turbulence .3 octaves 3 omega .375 lambda 2.25
marble turbulence .3 noise_generator 1
marble turbulence .3 noise_generator 3
marble octaves 3
onion
onion sine_wave
planar
quilted
quilted control0 .375 control1 .75
quilted phase .375 sine_wave
quilted frequency 2
radial
radial frequency 6
ripples
ripples frequency 2 phase .375
spherical
spherical turbulence .3
spiral1 3
spiral1 3 turbulence .4
spiral1 -2 ramp_wave
spiral2 3
spiral2 4 turbulence .4
spiral2 3 ramp_wave
waves
waves frequency 2 phase .375
wood
wood turbulence .3
wood turbulence <.1,.2,.3> octaves 3
wood octaves 3
wrinkles
wrinkles noise_generator 1
wrinkles noise_generator 3
""".strip().splitlines()

POINTS = [(.3, .7, 1.9), (-3.3, .7, -1.9), (.3, .2, .1), (4, 1.5, 2), (0, 0, 0), (1, 0, 0),
          (0, 1, 0), (-1, 2, -3), (-1.25, -.4, .6), (12.7, -45.3, 101.9), (-.3, .25, 0),
          (.5, .5, .5), (7.25, 2.5, -.125), (-.01, .99, .49)]


def main() -> None:
    lines = ['#version 3.7;', 'global_settings { assumed_gamma 1 }']
    for i, pattern in enumerate(PATTERNS):
        lines.append(f'#declare F{i} = function {{ pattern {{ {pattern} }} }}')
        for x, y, z in POINTS:
            lines.append(f'#debug concat("@",str(F{i}({x},{y},{z}),0,12),"\\n")')
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder, 'patterns.pov')
        scene.write_text('\n'.join(lines) + '\n')
        run = subprocess.run(['povray', scene.name, '+W8', '+H8', '-D', '+Oout.png'], cwd=folder,
                             text=True, capture_output=True)
    values = [line[1:] for line in run.stderr.splitlines() if line.startswith('@')]
    keys = [(pattern, *point) for pattern in PATTERNS for point in POINTS]
    if len(values) != len(keys):
        raise SystemExit(f'{len(values)} values instead of {len(keys)}:\n{run.stderr[-2000:]}')
    rows = ['\t'.join(map(str, (*key, value))) for key, value in zip(keys, values)]
    head = ['# Pattern values printed by POV-Ray 3.7.0.10 (make_povray_patterns.py): function{pattern{..}}',
            '# pattern\tx\ty\tz\tvalue']
    out = pathlib.Path(__file__).with_name('povray_patterns.tsv')
    out.write_text('\n'.join(head + rows) + '\n')


if __name__ == '__main__':
    main()
