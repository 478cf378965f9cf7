# SPDX-License-Identifier: MIT
"""Law 2: the same bytes for every run, number of threads and size of tiles."""
import hashlib
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
