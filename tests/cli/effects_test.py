# SPDX-License-Identifier: MIT
"""The plan: overrides, strict, what is out of reach, the probe; what is not called for changes no bit."""
import re
import unittest

from support import CliTest, GLASS, QUICK

PLAIN = QUICK + 'plane { y, -1 pigment { rgb 0.7 } }\n'
BALL = 'sphere { <0, 0, -9>, 1 interior { glass { "N-SF11" } } }\n'  # behind the camera


class Effects(CliTest):

    def same(self, first: str, second: str) -> None:
        for name, text in (('a', first), ('b', second)):
            self.write(f'{name}.scn', text)
            self.render('-o', f'{name}.exr', scene=f'{name}.scn')
        self.assertIn('"max_codes": 0', self.run_abbe('compare', 'a.exr', 'b.exr', '--json').stdout)
        linear = self.run_abbe('compare', 'a.exr', 'b.exr', '--json').stdout
        self.assertRegex(linear, r'"linear": \{\s*"rmse": 0.0,')

    def plan(self, text: str, *words) -> str:
        self.write('scene.scn', text)
        return self.run_abbe('explain', '--no-probe', 'scene.scn', *words).stdout

    def test_override_of_what_is_not_called_for_changes_no_byte(self):
        off = 'effects { spectral off reflection off refraction off dispersion off absorption off distance_fade off ' \
              'filtering_shadows off }\n'
        self.write('a.scn', PLAIN)
        self.render('-o', 'out.exr', scene='a.scn')
        plain = (self.folder / 'out.exr').read_bytes()
        self.write('a.scn', off + PLAIN)
        self.render('-o', 'out.exr', scene='a.scn')
        self.assertEqual((self.folder / 'out.exr').read_bytes(), plain)

    def test_glass_behind_the_camera_changes_no_pixel(self):
        self.same(PLAIN, PLAIN + BALL)
        self.assertIn('transport: r g b', self.plan(PLAIN + BALL))

    def test_unseen_glass_is_not_there_unless_the_camera_is_in_it(self):
        flags = BALL.replace('} }\n', '} no_image no_reflection no_shadow }\n').replace('0, -9>, 1 ', '0, 0>, 2 ')
        self.same(PLAIN, PLAIN + flags)
        self.assertIn('transport: r g b', self.plan(PLAIN + flags))
        self.assertRegex(self.plan(PLAIN + flags.replace('>, 2 ', '>, 6 ')), 'dispersion +on')

    def test_glass_that_a_shadow_ray_may_meet_counts(self):
        between = BALL.replace('<0, 0, -9>', '<-4, 4, -5>').replace(', 1 ', ', 0.2 ')
        self.assertRegex(self.plan(PLAIN + between), 'dispersion +on')

    def test_mirror_sees_the_glass_behind_the_camera(self):
        mirror = PLAIN.replace('rgb 0.7 }', 'rgb 0.7 } finish { reflection 0.5 }')
        self.assertRegex(self.plan(mirror + BALL), 'dispersion +on')

    def test_glass_in_an_opaque_coat_does_not_disperse(self):
        coat = 'sphere { 0, 1 pigment { rgb 1 } interior { ior 1.5 dispersion 1.05 } }\n'
        self.assertRegex(self.plan(PLAIN + coat), '\ndispersion +off\n')
        self.assertRegex(self.plan(PLAIN + coat.replace('rgb 1 ', 'rgbt <1, 1, 1, 0.5> ')), '\ndispersion +on')
        self.assertRegex(self.plan(PLAIN + coat.replace('0, 1 ', '<0, 0, -4>, 1 ')), '\ndispersion +on')  # camera inside

    def test_air_and_lights_are_named_with_their_places(self):
        text = self.plan('fog { distance 9 rgb 1 }\n' + PLAIN
                         + 'light_group { light_source { 0, rgb 1 area_light x, y, 2, 2 } }\n')
        self.assertRegex(text, r'\nfog and rainbows +on +fog  \(scene.scn:1:1\)')
        self.assertRegex(text, r'\narea lights +on +area_light  \(scene.scn:')
        self.assertRegex(text, r'\nlight groups +on +a light in a light_group  \(scene.scn:')
        for effect in ('fog and rainbows', 'area lights', 'light groups'):
            self.assertRegex(self.plan(PLAIN), f'\n{effect} +off')

    def test_dispersion_off_is_the_scene_without_it(self):
        body = GLASS.replace('dispersion { stochastic }', 'dispersion { none }').replace(
            'dispersion { deterministic }', 'dispersion { none }')
        self.same(body, 'effects { dispersion off }\n' + GLASS)

    def test_plan_says_what_was_overridden(self):
        text = self.plan('effects { dispersion off }\n' + GLASS)
        self.assertRegex(text, r'\ndispersion +off  by effects \{ dispersion off \}  \(scene.scn:1:11\); '
                               r'asked for by SCHOTT/N-SF11 disperses  \(scene.scn:\d+:\d+\)')

    def test_unknown_effect_gets_the_nearest(self):
        self.write('scene.scn', 'effects { dispersoin off }\n' + PLAIN)
        self.assertIn("did you mean 'dispersion'", self.run_abbe('check', 'scene.scn', status=1).stderr)

    def test_only_spectral_can_be_forced_on(self):
        self.write('scene.scn', 'effects { reflection on }\n' + PLAIN)
        self.assertIn('scene.scn:1:22', self.run_abbe('check', 'scene.scn', status=1).stderr)
        self.assertIn('16 bands', self.plan('effects { spectral on }\n' + PLAIN))

    def test_last_word_counts(self):
        self.assertEqual(self.plan('effects { dispersion off }\neffects { dispersion auto }\n' + GLASS).splitlines()[4],
                         re.sub(r':(\d+):', lambda m: f':{int(m[1]) + 2}:', self.plan(GLASS).splitlines()[4]))

    def test_strict(self):
        for text, words in (('effects { strict dispersion off }\n', ()), ('effects strict\n', ('--dispersion', 'none'))):
            self.write('scene.scn', text + GLASS)
            message = self.run_abbe('check' if not words else 'explain', 'scene.scn', *words, status=1).stderr
            self.assertRegex(message, r'scene.scn:1:\d+.*error\[E0431\].*which the scene asks for: SCHOTT/N-SF11')
        self.write('scene.scn', 'effects { strict dispersion off }\n' + PLAIN)  # nothing to take away
        self.run_abbe('check', 'scene.scn')
        self.write('scene.scn', 'effects strict\n' + GLASS)
        self.assertIn('[', self.run_abbe('explain', 'scene.scn').stdout)  # the probe is no override

    def test_spectra_cannot_go_without_bands(self):
        self.write('scene.scn', 'effects { spectral off }\n' + PLAIN.replace('rgb 1 }', 'spectrum { blackbody 3000 } }', 1))
        self.assertRegex(self.run_abbe('check', 'scene.scn', status=1).stderr, r'error\[E0430\].*a spectrum')

    def test_probe_counts_rays_the_same_each_time(self):
        self.write('scene.scn', GLASS)
        texts = [self.run_abbe('explain', 'scene.scn').stdout for _ in range(2)]
        counts = [re.findall(r'\[(-?\d+) % of the rays', text) for text in texts]
        self.assertEqual(counts[0], counts[1])
        self.assertGreaterEqual(len(counts[0]), 4)
        self.assertRegex(texts[0], r'probe: \d+ x \d+ pixels, .* rays: camera \d+')

    def test_plan_is_in_the_picture(self):
        self.write('scene.scn', 'effects { dispersion off }\n' + GLASS)
        for name, key in (('out.png', b'tEXtPlan\0'), ('out.exr', b'Plan\0string\0')):
            self.render('-o', name, scene='scene.scn')
            data = (self.folder / name).read_bytes()
            self.assertIn(key, data)
            self.assertIn(b'by effects { dispersion off }', data)


if __name__ == '__main__':
    unittest.main()
