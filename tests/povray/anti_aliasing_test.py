#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Both methods of anti-aliasing take the samples that POV-Ray's take: edges have the same 8-bit values.

The program in $ABBE, POV-Ray from the path; status 77 without it."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

# Edges that lie nowhere in particular, slanted and straight, against black.
SCENE = '''#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -5> look_at 0 up y * 4 right x * 4 }
background { rgb 0 }
#declare F = finish { ambient 1 diffuse 0 }
box { <-1.13, -1.07, 0>, <1.19, 1.11, 1> pigment { rgb 1 } finish { F } }
box { <-0.43, -0.31, -1>, <0.37, 0.77, -0.5> rotate z * 17 pigment { rgb <0.9, 0.2, 0.1> } finish { F } }
disc { <1.2, -1.1, -2>, z, 0.61 pigment { rgb <0.1, 0.5, 1> } finish { F } }
'''
SIZE = 64


class AntiAliasing(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / 'scene.pov').write_text(SCENE, encoding='utf-8')

    def run_in_folder(self, *words) -> str:
        return subprocess.run([*map(str, words)], cwd=self.folder, check=True, capture_output=True, text=True).stdout

    def largest_difference(self, method: int, depth: int, threshold: float) -> float:
        self.run_in_folder('povray', '+Iscene.pov', '+Opovray.png', f'+W{SIZE}', f'+H{SIZE}', '-J', '-D', '-P', '-GA',
                           f'+AM{method}', f'+R{depth}', f'+A{threshold}')
        abbe = os.environ['ABBE']
        self.run_in_folder(abbe, 'render', 'scene.pov', '-o', 'abbe.png', '-W', SIZE, '-H', SIZE, '--quiet', '--aa', depth,
                           '--aa-method', method, '--aa-threshold', threshold)
        return json.loads(self.run_in_folder(abbe, 'compare', 'povray.png', 'abbe.png', '--json'))['srgb']['max_codes']

    def test_edges_are_those_of_povray(self) -> None:
        # With method 1, POV-Ray compares a pixel with a neighbour that may have been sampled again by then, abbe with its
        # first sample: at a threshold near the step of an edge that makes a difference.
        for method, thresholds in ((1, (0.1, 0.3)), (2, (0.1, 0.3, 0.9))):
            for depth in (1, 3, 5):
                for threshold in thresholds:
                    with self.subTest(method=method, depth=depth, threshold=threshold):
                        # A sample on an edge may fall to either side of it: none does here.
                        self.assertLessEqual(self.largest_difference(method, depth, threshold), 1)


if __name__ == '__main__':
    if not shutil.which('povray'):
        sys.exit(77)
    unittest.main()
