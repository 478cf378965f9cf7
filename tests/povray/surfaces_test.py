#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Each kind of surface on each way to it: seen by the camera, in a mirror, through glass, and by a shadow ray.

One picture a way, in which the kinds stand side by side, by the program in $ABBE and by POV-Ray from the path
(status 77 without it). Each way is taken twice: with a perspective camera, whose rays abbe traces together, and
with an orthographic one beside glass, whose rays it traces one by one."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # the checkout stays clean
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / 'stability'))
from pictures import Picture  # noqa: E402

SQUARE = 'vertex_vectors { 4, <-.8,-.8,0>, <.8,-.75,0>, <.77,.8,0>, <-.82,.73,0> }'
FACES = 'face_indices { 2, <0,1,2>, <0,2,3> }'
TURNED = 'face_indices { 2, <0,2,1>, <0,3,2> }'
LEANING = 'normal_vectors { 4, <-.2,0,-1>, <.2,.1,-1>, <.3,.2,-1>, <-.2,.3,-1> }'
OUTSIDE = 'texture { pigment { rgbf <1, .4, .3, .5> } finish { F } }'
INSIDE = 'interior_texture { pigment { rgbt <.3, .9, .4, .5> } finish { F } }'
SIDES = f'{OUTSIDE} {INSIDE}'
# Where the corner normals look the other way they turn the sides round.
LEANING_BACK = LEANING.replace('-1>', '1>')

# Objects about the origin, seen along +z within -.9 .. .9.
KINDS = {
    'plain': f'mesh2 {{ {SQUARE} {FACES} texture {{ pigment {{ rgb <.9, .5, .2> }} finish {{ F }} }} }}',
    'layered': f'mesh2 {{ {SQUARE} {FACES} texture {{ pigment {{ rgbt <1, .4, .2, .6> }} finish {{ F }} }} '
               'texture { pigment { checker rgbf <.4, .9, 1, .8> rgbt <.8, .8, .1, .7> scale .5 translate .1 } finish { F } } }',
    'face textures': f'mesh2 {{ {SQUARE} texture_list {{ 2, texture {{ A }} texture {{ B }} }} '
                     'face_indices { 2, <0,1,2>, 0, <0,2,3>, 1 } }',
    'blended face textures': f'mesh2 {{ {SQUARE} texture_list {{ 3, texture {{ A }} texture {{ B }} texture {{ C }} }} '
                             'face_indices { 2, <0,1,2>, 0,1,2, <0,2,3>, 2,2,0 } }',
    'texture of a triangle': 'mesh { triangle { <-.8,-.8,0>, <.8,-.8,0>, <0,.8,0> texture { A } } }',
    'interior_texture': f'mesh2 {{ {SQUARE} {FACES} {SIDES} }}',
    'interior_texture, other winding': f'mesh2 {{ {SQUARE} {TURNED} {SIDES} }}',
    'interior_texture, smoothed': f'mesh2 {{ {SQUARE} {LEANING_BACK} {FACES} {SIDES} }}',
    'interior_texture, equal normals': f'mesh2 {{ {SQUARE} normal_vectors {{ 4, z, z, z, z }} {FACES} {SIDES} }}',
    'interior_texture, inverse': f'mesh2 {{ {SQUARE} {FACES} {SIDES} inverse }}',
    'interior_texture and face textures': f'mesh2 {{ {SQUARE} texture_list {{ 2, texture {{ A }} texture {{ B }} }} '
                                          f'face_indices {{ 2, <0,1,2>, 0, <0,2,3>, 1 }} {SIDES} }}',
    'interior_texture of a triangle': f'triangle {{ <-.8,-.8,0>, <.8,-.8,0>, <0,.8,0> {SIDES} }}',
    'interior_texture of a smoothed triangle': 'smooth_triangle { <-.8,-.8,0>, <.1,0,-1>, <.8,-.8,0>, -z, <0,.8,0>, -z '
                                               f'{SIDES} }}',
    'interior_texture of a disc': f'disc {{ 0, -z, .8 {SIDES} }}',
    'interior_texture of a solid': f'sphere {{ 0, .8 {SIDES} }}',
    'smoothed normals': f'mesh2 {{ {SQUARE} {LEANING} {FACES} texture {{ A }} }}',
    'pattern': f'mesh2 {{ {SQUARE} {FACES} texture {{ pigment {{ gradient x color_map {{ [0 rgbf <1, .2, .2, .9>] '
               '[1 rgbt <.2, .2, 1, .6>] } scale .9 } finish { F } } }',
    'filter': f'mesh2 {{ {SQUARE} {FACES} texture {{ pigment {{ rgbf <.9, .6, .3, .7> }} finish {{ F }} }} }}',
    'transmit': f'mesh2 {{ {SQUARE} {FACES} texture {{ pigment {{ rgbt <.9, .6, .3, .7> }} finish {{ F }} }} }}',
    'caustics': f'sphere {{ 0, .8 {OUTSIDE} interior {{ caustics .1 }} }}',
    'caustics, layered and smoothed': f'mesh2 {{ {SQUARE} {LEANING} {FACES} {OUTSIDE} {OUTSIDE} interior {{ caustics .3 }} }}',
}
SEEN = {'camera': '', 'mirror': 'no_image', 'glass': '', 'shadow': 'no_image'}
PIXELS = 16  # of a kind's square

SETTING = '''#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
#declare F = finish { ambient .3 diffuse .6 }
#declare A = texture { pigment { rgbf <.9, .5, .3, .6> } finish { F } }
#declare B = texture { pigment { rgbt <.3, .8, .9, .5> } finish { F } }
#declare C = texture { pigment { checker rgb <.1, .7, .2> rgbf <.8, .3, .9, .7> scale .4 } finish { F } }
#declare Shown = finish { ambient 1 diffuse 0 }
#declare Stripes = pigment { gradient y color_map { [0 rgb .3] [1 rgb <.6, .7, .9>] } scale .7 translate .05 }
'''
WAYS = {
    'camera': '''light_source { <3, 8, -30>, .8 }
        plane { -z, -3 pigment { Stripes } finish { Shown } }''',
    'mirror': '''light_source { <3, 8, 4>, .8 }
        plane { -z, -6 pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection .9 } }
        plane { z, -45 pigment { Stripes } finish { Shown } no_image no_shadow }''',
    'glass': '''light_source { <3, 8, -30>, .8 }
        plane { -z, -3 pigment { Stripes } finish { Shown } }
        box { <-60, -9, -3>, <60, 9, -2> pigment { rgbf .95 } finish { ambient 0 diffuse 0 } interior { ior 1.5 } rotate 8 * x }''',
    'shadow': '''light_source { <0, 0, -60>, .8 }
        plane { -z, -.9 pigment { rgb <.9, .8, .7> } finish { ambient .1 diffuse .8 } }''',
}
PERSPECTIVE = 'camera {{ location -40 * z look_at 0 right {wide} * x up 2 * y direction 40 * z }}'
ORTHOGRAPHIC = '''camera {{ orthographic location -40 * z look_at 0 right {wide} * x up 2 * y }}
    sphere {{ 1000 * z, 1 pigment {{ rgbt 1 }} interior {{ ior 1.1 }} }}'''


class Surfaces(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def pictures(self, way: str, camera: str) -> tuple:
        wide = 2 * len(KINDS)
        objects = [f'object {{ {kind} {SEEN[way]} translate {2 * i + 1 - wide / 2} * x }}' for i, kind in enumerate(KINDS.values())]
        text = '\n'.join([SETTING, camera.format(wide=wide), WAYS[way], *objects])
        (self.folder / 'scene.pov').write_text(text, encoding='utf-8')
        size = PIXELS * len(KINDS), PIXELS
        for command in (['povray', '+Iscene.pov', '+Opovray.png', f'+W{size[0]}', f'+H{size[1]}', '-A', '-J', '-D', '-P', '-GA', '+FN8'],
                        [os.environ['ABBE'], 'render', 'scene.pov', '-o', 'abbe.png', '-W', size[0], '-H', size[1], '--aa', 'off', '--quiet']):
            subprocess.run([*map(str, command)], cwd=self.folder, check=True, capture_output=True)
        return Picture(self.folder / 'abbe.png'), Picture(self.folder / 'povray.png')

    def test_every_kind_on_every_way(self) -> None:
        for way in WAYS:
            for name, camera in (('together', PERSPECTIVE), ('one by one', ORTHOGRAPHIC)):
                ours, theirs = self.pictures(way, camera)
                off = ours.differing(theirs, 2)
                for i, kind in enumerate(KINDS):
                    with self.subTest(way=way, rays=name, kind=kind):
                        own = [pixel for pixel in off if i == pixel[0] // PIXELS]
                        # An edge that goes through the middle of a pixel may fall to either side of it.
                        self.assertLessEqual(len(own), PIXELS // 4, sorted(own)[:20])


if __name__ == '__main__':
    if not shutil.which('povray'):
        sys.exit(77)
    unittest.main()
