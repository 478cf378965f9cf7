#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Cameras of every make show what POV-Ray's show: which way right is, where up is, how large all is.

A scene without symmetry all round, seen by cameras whose items stand in any order. The program in $ABBE, POV-Ray from the
path; status 77 without it."""
import itertools
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

WIDTH, HEIGHT = 48, 36
# Pixels of a picture whose middle lies on an edge to the last digits.
MOST_ON_EDGES = 16

HEAD = '''#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 1 diffuse 0 } }
background { rgb 0.1 }
box { <-0.5, -0.3, -0.4>, <0.7, 0.4, 0.2> pigment { rgb <1, 0, 0> } }
cylinder { 0, 1.5*x, 0.15 pigment { rgb <1, 1, 0> } }
cylinder { 0, 1.2*y, 0.15 pigment { rgb <0, 1, 0> } }
cylinder { 0, 1.8*z, 0.15 pigment { rgb <0, 0.5, 1> } }
'''

# Up, direction and right in one plane; a view along the sky, nearly so, without a sky; what `angle 0` means.
SPECIAL = '''
location <2.3, 1.5, 1.7> sky z up z right -4/3*x look_at 0
location <2.3, 1.5, 1.7> sky z up z right 4/3*x look_at 0
location <2.3, 1.5, 1.7> sky z direction <-1, 0, 0> right <-4/3, 0, 0> look_at 0
location <0, 0, -5> up z right 4/3*x look_at 0 angle 40
location <0, 0, -5> up z right 4/3*x angle 40
location <0, 0, -5> direction x look_at 0
location <0, 0, -5> direction x
location <0, 0, -5> direction y look_at 0
location <0, 0, -5> right y look_at 0
location <0, 0, -5> right y
location <0, 6, 0> right y look_at 0
orthographic location <0, 0, -5> up z right x
location <0, 6, 0> right <1, 1, 0> look_at 0
location <0, 6, 0> right -1.33*x look_at 0 angle 50
location <0, 0, -6> sky z right -1.33*x up z look_at 0
location <0, 0, -6> sky z right 1.33*x up z look_at 0
location <6, 0, 0> sky x right 1.33*z look_at 0
location <1e-9, 6, 0> right -4/3*x look_at 0
location <1e-11, 6, 0> right -4/3*x look_at 0
location <1e-8, 6, 0> sky 1e-3*y right -4/3*x look_at 0
location <1e-11, 6, 0> sky 1e3*y right -4/3*x look_at 0
location <1, 6, 0> sky 0 right -4/3*x look_at 0
location <0, 0, -5> look_at 0 angle 0
location <0, 0, -5> look_at 0 angle 40 angle 0
location <0, 0, -5> right 5*x up 4*y angle 0
orthographic location <0, 0, -5> look_at 0 angle 0
orthographic location <0, 0, -5> look_at 0 angle 0 right 0.8*x up 0.6*y
orthographic location <0, 0, -5> look_at 0 angle 0 right -0.8*x direction 2*z
'''.strip().splitlines()

# A quad of two faces with uv, and a mesh with a face for each pixel, rays of which go where the camera at z would look.
MESHES = '''
#declare Quad = mesh2 {
  vertex_vectors { 4, <-3, -2, -5>, <3, -2, -5>, <3, 2, -5>, <-3, 2, -5> }
  normal_vectors { 4, <-.3, -.2, 1>, <.3, -.2, 1>, <.3, .2, 1>, <-.3, .2, 1> }
  uv_vectors { 4, <0, 0>, <1, 0>, <1, 1>, <0, 1> }
  face_indices { 2, <0, 1, 2>, <0, 2, 3> } normal_indices { 2, <0, 1, 2>, <0, 2, 3> } uv_indices { 2, <0, 1, 2>, <0, 2, 3> }
}
#macro Faces(Shift)
  mesh { #for (J, 0, 35) #for (I, 0, 47)
    #local P = <(I - 23.5) / 8 + Shift, (17.5 - J) / 8, -5>;
    triangle { P, P + <.1, 0, (I - 24) / 400>, P + <0, .1, (17 - J) / 400> }
  #end #end }
#end
#declare Plane = Faces(0);
#declare Shifted = Faces(.3);
#declare Half = mesh { #for (J, 0, 35) #for (I, 0, 23)
    #local P = <(I - 11.5) / 4, (17.5 - J) / 8, -5>;
    triangle { P, P + .1*x, P + .1*y }
  #end #end }
'''
MESH_CAMERAS = '''
mesh_camera { 1 0 mesh { Plane } } location <0, 0, -.01>
mesh_camera { 1 0 mesh { Plane } } location <0, 0, .01> direction -z
mesh_camera { 1 0 mesh { Plane rotate 10*y translate .4*x } } direction -z
mesh_camera { 2 0 mesh { Plane } mesh { Shifted } } direction -z
mesh_camera { 2 1 mesh { Plane } mesh { Shifted } } direction -z
mesh_camera { 1 2 mesh { Half } mesh { Half translate .2*x } } direction -z
mesh_camera { 1 3 mesh { Quad } } direction -z
mesh_camera { 1 3 mesh { Quad } smooth } location <0, 0, -.01>
mesh_camera { 3 0 mesh { Plane } mesh { Half } mesh { Shifted } } direction -z
mesh_camera { 1 0 5 mesh { Plane } } direction -z
mesh_camera { 1 0 4.6 mesh { Plane rotate 10*y } } direction -z normal { gradient x 0.2 translate 0.3*x }
'''.strip().splitlines()

# A normal tilts rays by what it is at the numbers that the projection begins with; the camera's transforms leave it.
NORMAL = 'normal { gradient <1, 0.3, 0.2> sine_wave bump_size 0.15 scale 0.4 rotate 20*z translate <0.1, 0.2, 0.3> }'

CHOICES = [
    ('', 'perspective', 'orthographic'),
    ('location <2.3, 1.5, 1.7>', 'location <0, 0, -5>', 'location <0, 6, 0>', 'location <-4, 0, 0>'),
    ('', 'sky z', 'sky y', 'sky -y', 'sky <0.2, 1, 0.1>', 'sky x'),
    ('', 'up z', 'up 1.2*y', 'up <0.1, 1, 0.3>'),
    ('', 'right 4/3*x', 'right -4/3*x', 'right <1.2, 0, 0.3>', 'right <0.1, 0, -1>'),
    ('', 'direction 1.5*z', 'direction -x', 'direction <0.2, 0.1, 1>'),
    ('look_at 0', 'look_at <0.2, 0.3, -0.1>', ''),
    ('', 'angle 40', 'angle 75', 'angle 0'),
    ('', 'rotate 30*y', 'translate 0.3*x rotate 20*z', 'scale <1, 1, -1>'),
]


CURVED = ('fisheye', 'ultra_wide_angle', 'omnimax', 'panoramic', 'cylinder 1', 'cylinder 2', 'cylinder 3', 'cylinder 4',
          'spherical')
CURVED_ANGLES = ('', 'angle 60', 'angle 180', 'angle 250')


def spheres() -> str:
    """All round, so that no camera sees nothing."""
    draw = random.Random(7)
    text = ''
    for _ in range(60):
        at = [draw.uniform(-1, 1) for _ in range(3)]
        far = draw.uniform(6, 12) / sum(v * v for v in at) ** 0.5
        colour = [draw.choice((0.2, 0.5, 0.8, 1)) for _ in range(3)]
        text += (f'sphere {{ <{", ".join(f"{v * far:.3f}" for v in at)}>, {draw.uniform(0.6, 1.6):.2f} '
                 f'pigment {{ rgb <{", ".join(map(str, colour))}> }} }}\n')
    return text


def cameras() -> list:
    draw = random.Random(11)
    made = list(SPECIAL)
    # Every pair of choices of two items, the others and the order at random.
    for i, j in itertools.combinations(range(len(CHOICES)), 2):
        for first, second in itertools.product(CHOICES[i], CHOICES[j]):
            if draw.random() > 0.08:
                continue
            items = [draw.choice(choice) for choice in CHOICES]
            items[i], items[j] = first, second
            kind, *others = items  # POV-Ray wants the kind first
            draw.shuffle(others)
            made.append(' '.join(item for item in (kind, *others) if item))
    for kind, angle in itertools.product(CURVED, CURVED_ANGLES):
        items = [draw.choice(choice) for choice in CHOICES[1:7] + CHOICES[8:]] + [angle]
        draw.shuffle(items)
        made.append(' '.join(item for item in (kind, *items) if item))
    for kind in ('', 'orthographic') + CURVED:
        made.append(f'{kind} location <0, 0, -3> right 1.2*x look_at 0 {NORMAL} rotate 20*y scale <1, 1.1, 1>')
    return made + ['location <0, 0, -3> look_at 0 normal { crackle 0.1 scale 0.2 }',
                   'location <0, 0, -3> look_at 0 normal { bumps 0.4 scale <0.1, 0.2, 1> rotate 30*z }',
                   'spherical location <0, 0, -3> look_at 0 angle 120, 40',
                   'fisheye location <0, 0, -3> right x up y look_at 0 angle 140',
                   'omnimax location <0, 0, -3> right x up y look_at 0']


class Cameras(unittest.TestCase):
    def test_pictures_are_those_of_povray(self) -> None:
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        world, made = HEAD + MESHES + spheres(), cameras() + MESH_CAMERAS
        # One run of POV-Ray: a camera a frame.
        cases = ''.join(f'#case ({k}) camera {{ {text} }} #break\n' for k, text in enumerate(made))
        (folder / 'all.pov').write_text(f'{world}#switch (frame_number)\n{cases}#end\n', encoding='utf-8')
        subprocess.run(['povray', '+Iall.pov', '+Op.png', f'+W{WIDTH}', f'+H{HEIGHT}', '-J', '-A', '-D', '-P', '-GA',
                        '+KFI0', f'+KFF{len(made) - 1}'], cwd=folder, check=True, capture_output=True)
        digits = len(str(len(made) - 1))
        for k, text in enumerate(made):
            with self.subTest(camera=text):
                (folder / 'one.scn').write_text(f'{world}camera {{ {text} }}\n', encoding='utf-8')
                subprocess.run([os.environ['ABBE'], 'render', 'one.scn', '-o', 'a.png', '-W', str(WIDTH), '-H', str(HEIGHT),
                                '--aa', 'off', '--quiet'], cwd=folder, check=True, capture_output=True)
                shown = subprocess.run([os.environ['ABBE'], 'compare', f'p{k:0{digits}}.png', 'a.png', '--json', '--threshold',
                                        '2'], cwd=folder, check=True, capture_output=True, text=True).stdout
                self.assertLessEqual(json.loads(shown)['srgb']['differing_share'] * WIDTH * HEIGHT, MOST_ON_EDGES)


if __name__ == '__main__':
    if not shutil.which('povray'):
        sys.exit(77)
    unittest.main()
