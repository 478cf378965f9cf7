# SPDX-License-Identifier: MIT
"""--check-finite: a sample that no picture may hold ends the work, with its path; no file is written."""
import unittest

from support import CliTest

SCENE = '''camera { location <0, 0, -4> look_at 0 angle 40 }
light_source { <-5, 5, -5>, rgb %s }
sphere { 0, 1 pigment { rgb 1 } finish { diffuse %s ambient 0 } }
'''


class Finite(CliTest):
    def check(self, colour: str, diffuse: str, status: int) -> str:
        self.write('scene.scn', SCENE % (colour, diffuse))
        return self.run_abbe('render', 'scene.scn', '-W', 24, '-H', 18, '--quiet', '--check-finite', '-o', 'out.exr',
                             status=status).stderr

    def test_infinite_light_is_traced_to_its_surface(self):
        said = self.check('1e300', '.6', 1)
        self.assertRegex(said, r'error\[E0710\]: the light of pixel \d+, \d+ \(sample 0\) is infinite')
        self.assertRegex(said, r'camera\s+ray, 3 channels, meets the sphere at <.*> of .*scene.scn:3:1: made there')
        self.assertEqual(self.names(), ['quick.scn', 'scene.scn'])

    def test_no_picture_holds_infinite_light(self):
        self.write('scene.scn', SCENE % ('1e300', '.6'))
        said = self.render('-o', 'out.exr', '--checkpoint', scene='scene.scn', status=1).stderr
        self.assertRegex(said, r'error\[E0710\]: the light of pixel \d+, \d+ is infinite')
        self.assertEqual(self.names(), ['quick.scn', 'scene.scn'])

    def test_negative_light_by_a_finish_is_wrong(self):
        self.assertIn('is negative', self.check('1', '-.5', 1))
        self.assertEqual(self.names(), ['quick.scn', 'scene.scn'])

    def test_negative_light_by_a_lamp_is_asked_for(self):
        self.assertEqual(self.check('-1', '.5', 0), '')
        self.assertIn('out.exr', self.names())

    def test_sound_scenes_are_written(self):
        self.assertEqual(self.check('1', '.6', 0), '')
        self.assertIn('out.exr', self.names())


if __name__ == '__main__':
    unittest.main()
