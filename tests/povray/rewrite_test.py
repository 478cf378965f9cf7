#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Is what POV-Ray reads the scene that abbe reads?"""
import re
import unittest

import rewrite

# SCHOTT N-BK7, catalogue: nd 1.51680, nF - nC 0.008054 (Vd 64.17).
BK7 = rewrite.GlassConstants(1.51680, 0.008054)


def catalogue(name: str) -> rewrite.GlassConstants:
    return {'N-BK7': BK7, 'SCHOTT/N-BK7': BK7}[name]


def rewritten(text: str) -> str:
    return rewrite.rewrite(text, catalogue)


def index(ior: float, ratio: float, nm: float) -> float:
    return ior * ratio ** ((555 - nm) / 350)


class PovDispersion(unittest.TestCase):
    def test_goes_through_nd_and_the_principal_dispersion(self) -> None:
        for glass in (BK7, rewrite.GlassConstants(1.78472, 0.030467), rewrite.GlassConstants(1.5, 0)):
            ior, ratio = rewrite.pov_dispersion(glass)
            self.assertAlmostEqual(index(ior, ratio, 587.5618), glass.nd, 12)
            self.assertAlmostEqual(index(ior, ratio, 486.1327) - index(ior, ratio, 656.2725),
                                   glass.principal_dispersion, 12)

    def test_refuses_what_the_law_cannot_say(self) -> None:
        with self.assertRaises(rewrite.CannotRewrite):
            rewrite.pov_dispersion(rewrite.GlassConstants(1.5, -0.01))


class Glasses(unittest.TestCase):
    def interior_numbers(self, text: str) -> tuple:
        found = re.search(r'interior \{\s*ior ([\d.]+) dispersion ([\d.]+)', rewritten(text))
        self.assertTrue(found, rewritten(text))
        return float(found.group(1)), float(found.group(2))

    def test_every_spelling_of_a_catalogue_glass(self) -> None:
        wanted = rewrite.pov_dispersion(BK7)
        for text in ('sphere { 0, 1 interior { glass { "N-BK7" } } }',
                     'sphere { 0, 1 interior { glass "SCHOTT/N-BK7" dispersion { deterministic } } }',
                     '#declare G = glass { "N-BK7" }\nsphere { 0, 1 interior { glass { G } } }',
                     '#local G = glass { "N-BK7" };\nsphere { 0, 1 interior { glass G } }',
                     'sphere { 0, 1 interior { glass { abbe 1.51680, 64.166873 } } }'):
            numbers = self.interior_numbers(text)
            self.assertAlmostEqual(numbers[0], wanted[0], 8)
            self.assertAlmostEqual(numbers[1], wanted[1], 7)

    def test_formulas_of_bk7_agree_with_its_catalogue_constants(self) -> None:
        sellmeier = ('sellmeier <1.03961212, 0.231792344, 1.01046945>, '
                     '<0.00600069867, 0.0200179144, 103.560653> range 0.3, 2.5')
        schott = 'schott <2.2718929, -1.0108077e-2, 1.0592509e-2, 2.0816965e-4, -7.6472538e-6, 4.9240991e-7>'
        wanted = rewrite.pov_dispersion(BK7)
        for formula in (sellmeier, schott):
            numbers = self.interior_numbers(f'sphere {{ 0, 1 interior {{ glass {{ {formula} }} }} }}')
            self.assertAlmostEqual(numbers[0], wanted[0], 5)
            self.assertAlmostEqual(numbers[1], wanted[1], 5)

    def test_cauchy_of_two_terms(self) -> None:
        glass = rewrite.glass_of_formula('cauchy', [1.5, 0.004, 0])
        self.assertAlmostEqual(glass.nd, 1.5 + 0.004 / 0.5875618 ** 2, 12)

    def test_mode_none_has_no_dispersion(self) -> None:
        for text in ('interior { glass { "N-BK7" } dispersion { none } }',
                     'interior { dispersion { none } glass { "N-BK7" } }',
                     'global_settings { spectral { dispersion { none } } } interior { glass { "N-BK7" } }'):
            self.assertIn('ior 1.516800000', rewritten(text))
            self.assertNotIn('dispersion', rewritten(text))

    def test_a_material_may_differ_from_the_scene(self) -> None:
        text = rewritten('global_settings { spectral { dispersion { none } } } '
                         'interior { glass { "N-BK7" } dispersion { stochastic jitter uniform 1.0 } }')
        self.assertRegex(text, r'dispersion 1\.0\d+')
        self.assertNotIn('stochastic', text)


class Others(unittest.TestCase):
    def test_a_scene_of_povray_is_left_alone(self) -> None:
        self.assertIsNone(rewritten('#declare glass_size = 2; // glass { "X" }\n'
                                    'sphere { 0, 1 interior { ior 1.5 dispersion 1.02 } }'))

    def test_spectral_is_dropped_and_the_rest_kept(self) -> None:
        self.assertEqual(rewritten('global_settings { assumed_gamma 1 spectral { bands 8 range 380, 780 } }'),
                         'global_settings { assumed_gamma 1  }')

    def test_what_is_not_rendered_is_dropped_but_for_declarations(self) -> None:
        self.assertEqual(rewritten('global_settings { radiosity { count 3 } assumed_gamma 1 }\n'
                                   '#declare M = media { emission 1 }\n'
                                   'sphere { 0, 1 interior { ior 1 media { M } } photons { target } }'),
                         'global_settings {  assumed_gamma 1 }\n#declare M = media { emission 1 }\n'
                         'sphere { 0, 1 interior { ior 1  }  }')

    def test_what_has_no_counterpart_is_an_error(self) -> None:
        for text in ('light_source { 0, spectrum { blackbody 5600 } }',
                     'finish { reflection { metal "Au" } }', 'glass_catalog "x.agf"',
                     'interior { glass { formula 2 { 0, 1 } } }',
                     'interior { glass { samples { [0.40, 1.5308] } } }'):
            with self.assertRaises(rewrite.CannotRewrite, msg=text):
                rewritten(text)


if __name__ == '__main__':
    unittest.main()
