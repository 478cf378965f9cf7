# SPDX-License-Identifier: MIT
"""abbe render --error lands near the error asked for, on every example; what the user gives is kept."""
import json
import re
import shlex
import unittest

from support import ROOT, CliTest, GLASS

EXAMPLES = sorted((ROOT / 'examples').glob('*.scn'))
SIZE = ['-W', 24, '-H', 18]
# Reachable at this size, where thin lines are below a pixel: the mean CIEDE2000 that is asked for.
TARGETS = {'brilliant': 8, 'prism_detail': 4, 'paperweight': 3, 'lens': 3, 'prism': 6}
SIZES = {'prism': ['-W', 64, '-H', 48]}
# Its grids are so thin at any small size that the samples of the program's own reference are too few (docs/study.md).
TOO_THIN = {'lamps'}
# What the choice is judged by: another and finer sampling than the one that the program compares with.
REFERENCE = ['--aa', 8, '--aa-threshold', 0]


class Error(CliTest):
    def test_examples_land_within_a_quarter(self):
        for scene in EXAMPLES:
            if scene.stem in TOO_THIN:
                continue
            target, size = TARGETS.get(scene.stem, 2), SIZES.get(scene.stem, SIZE)
            with self.subTest(scene.name):
                said = self.run_abbe('render', scene, *size, '--error', target, '-o', 'a.exr', timeout=600).stderr
                explained = self.run_abbe('explain', scene).stdout
                mode = ['--dispersion', 'stochastic'] if re.search(r'^\s*(stochastic )?dispersion +on', explained, re.M) else []
                self.run_abbe('render', scene, *size, *REFERENCE, *mode, '--quiet', '-o', 'r.exr', timeout=600)
                found = json.loads(self.run_abbe('compare', '--json', 'r.exr', 'a.exr').stdout)['ciede2000']['mean']
                self.assertLess(found, 1.25 * target, said)
                if 'nothing cheaper' not in said:
                    self.assertGreater(found, 0.75 * target, said)

    def test_the_choice_is_the_same_each_time(self):
        self.write('glass.scn', GLASS)
        said = [re.sub(r'[\d.e+-]+ s\b', '', self.render('--error', '3', '-j', threads, '-o', 'a.exr', scene='glass.scn').stderr)
                for threads in (1, 3)]
        self.assertEqual(said[0], said[1])
        self.assertRegex(said[0], r'bands.*expected error')

    def test_what_is_given_is_kept(self):
        self.write('glass.scn', GLASS)
        said = self.render('--error', '3', '--bands', '5', '--dispersion', 'deterministic', '-o', 'a.exr', scene='glass.scn').stderr
        self.assertIn('5 bands', said)
        self.assertNotIn('stochastic', said)
        said = self.render('--error', '0.01', '--aa', 'off', '-o', 'a.exr', scene='glass.scn').stderr
        self.assertRegex(said, 'no anti-aliasing')
        self.assertRegex(said, 'cannot be reached')

    def test_a_plain_scene_needs_no_bands(self):
        self.assertIn('expected error', self.render('--error', '1', '-o', 'a.exr').stderr)

    def again(self, *words) -> str:
        """Renders by the clock, and then what it says makes the same bytes; what it said."""
        said = self.render('--time', '2', *words, '-o', 'a.exr', scene='glass.scn', timeout=600).stderr
        told = re.search(r'for --time 2:(.*)', said).group(1)
        self.render(*shlex.split(told), *words, '-o', 'b.exr', scene='glass.scn', timeout=600)
        self.assertEqual((self.folder / 'a.exr').read_bytes(), (self.folder / 'b.exr').read_bytes(), said)
        return told

    def test_time_can_be_had_again_without_a_clock(self):
        self.write('glass.scn', GLASS)
        self.assertRegex(self.again(), r'--dispersion.*--bands \d')

    def test_time_with_what_is_given(self):
        self.write('glass.scn', GLASS)
        told = self.again('--dispersion', 'deterministic', '--bands', 5, '--aa', 'off')
        self.assertEqual(told, '', 'one pass: another would be the same picture')
        told = self.again('--dispersion', 'stochastic', '--aa', 2, '-j', 3)
        self.assertRegex(told, r'^ --bands \d+( --passes \d+)?$')

    def test_time_keeps_no_checkpoint(self):
        for word in ('--resume', '--checkpoint'):
            self.assertIn('clock', self.render('--time', '2', word, '-o', 'a.png', status=2).stderr)

    def test_wrong_words(self):
        for words in (['--error', '0'], ['--error', 'x'], ['--time', '0'], ['--time', '3 moons'], ['--error', '1', '--time', '3']):
            with self.subTest(words):
                self.render(*words, '-o', 'a.exr', status=2)


if __name__ == '__main__':
    unittest.main()
