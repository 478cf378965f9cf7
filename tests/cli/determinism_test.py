# SPDX-License-Identifier: MIT
"""Law 2: the same bytes for every run, number of threads and size of tiles, and any registers."""
import hashlib
import os
import pathlib
import unittest

from support import CliTest, GLASS


# Lots are drawn for the places of areas; fog is on all ways.
AIR = GLASS + '''
light_source { <3, 5, -4>, rgb 0.6 area_light 2*x, 2*z, 5, 3 adaptive 0 jitter orient media_attenuation on }
light_source { <-3, 5, -4>, rgb 0.6 area_light 2*x, 2*y, 3, 3 jitter area_illumination on }
fog { distance 20 rgbf <0.5, 0.6, 0.7, 0.2> turbulence 0.4 }
fog { fog_type 2 distance 9 fog_offset 0 fog_alt 1 rgb 0.6 }
rainbow { direction z angle 12 width 8 distance 9 jitter 0.1 color_map { [0 rgbt <1, 0, 0, 1>] [1 rgb z] } }
'''


class SameBytes(CliTest):
    def hash_of(self, *words) -> str:
        self.run_abbe('render', 'glass.scn', '-W', 31, '-H', 23, '-o', 'out.exr', '--quiet', *words)
        return hashlib.sha256((self.folder / 'out.exr').read_bytes()).hexdigest()

    def same(self, *common, scene: str = GLASS) -> None:
        self.write('glass.scn', scene)
        first = self.hash_of(*common)
        for words in ([], ['-j', 1], ['-j', 2], ['-j', 7], ['--tile', 8], ['--tile', 33],
                      ['-j', 7, '--tile', 1], ['-j', 3, '--tile', 4096]):
            with self.subTest(words):
                self.assertEqual(self.hash_of(*common, *words), first)

    def test_registers(self):
        """The kernels of AVX-512, of AVX2 and those for any processor, of whole scenes. (Where the machine has not all, some are one.)"""
        examples = pathlib.Path(__file__).resolve().parents[2] / 'examples'
        self.write('air.scn', AIR)
        for scene, modes in ((self.folder / 'air', ('none', 'stochastic')), ('prism', ('deterministic', 'stochastic', 'hero 4')), ('brilliant', ('deterministic',)),
                             ('glasses_on_table', ('none',)), ('csg', ('none',))):
            for mode in modes:
                with self.subTest(scene=scene, mode=mode):
                    pictures = []
                    for registers in ('avx512', 'avx2', 'baseline'):
                        self.run_abbe('render', examples / f'{scene}.scn', '-W', 48, '-H', 36, '--dispersion', mode,
                                      '-o', 'out.exr', '--quiet', env=os.environ | {'ABBE_REGISTERS': registers})
                        pictures.append((self.folder / 'out.exr').read_bytes())
                    self.assertEqual(pictures[0], pictures[1])
                    self.assertEqual(pictures[1], pictures[2])

    def test_rgb(self):
        self.same()

    def test_spectral(self):
        self.same('--spectral', '--dispersion', 'faithful')

    def test_air_and_areas(self):
        self.same('--dispersion', 'none', scene=AIR)
        self.same('--aa', 2, '--aa-method', 2, '--aa-threshold', 0.05, scene=AIR)

    def test_samples(self):
        self.same('--samples', 5, '--dispersion', 'stochastic')
        self.same('--samples', '1..32', '--samples-error', 0.05, '--dispersion', 'stochastic rays 2')
        self.same('--samples', '2..8', '--dispersion', 'none', scene=AIR)

    def test_anti_aliasing_on_a_grid(self):
        self.same('--aa', 3, '--aa-threshold', 0.05)

    def test_anti_aliasing_by_subdivision(self):
        self.same('--aa', 2, '--aa-method', 2, '--aa-threshold', 0.05)


if __name__ == '__main__':
    unittest.main()
