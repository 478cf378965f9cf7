# SPDX-License-Identifier: MIT
"""Law 2: the same bytes for every run, number of threads and size of tiles, and any registers."""
import hashlib
import os
import pathlib
import unittest

from support import CliTest, GLASS


class SameBytes(CliTest):
    def hash_of(self, *words) -> str:
        self.run_abbe('render', 'glass.scn', '-W', 31, '-H', 23, '-o', 'out.exr', '--quiet', *words)
        return hashlib.sha256((self.folder / 'out.exr').read_bytes()).hexdigest()

    def same(self, *common) -> None:
        self.write('glass.scn', GLASS)
        first = self.hash_of(*common)
        for words in ([], ['-j', 1], ['-j', 2], ['-j', 7], ['--tile', 8], ['--tile', 33],
                      ['-j', 7, '--tile', 1], ['-j', 3, '--tile', 4096]):
            with self.subTest(words):
                self.assertEqual(self.hash_of(*common, *words), first)

    def test_registers(self):
        """The kernels of AVX-512, of AVX2 and those for any processor, of whole scenes. (Where the machine has not all, some are one.)"""
        examples = pathlib.Path(__file__).resolve().parents[2] / 'examples'
        for scene, modes in (('prism', ('deterministic', 'stochastic', 'hero 4')), ('brilliant', ('deterministic',)),
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

    def test_anti_aliasing_on_a_grid(self):
        self.same('--aa', 3, '--aa-threshold', 0.05)

    def test_anti_aliasing_by_subdivision(self):
        self.same('--aa', 2, '--aa-method', 2, '--aa-threshold', 0.05)


if __name__ == '__main__':
    unittest.main()
