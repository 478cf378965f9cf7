# SPDX-License-Identifier: MIT
"""--passes: the mean of pictures with random numbers of their own; refused where they would be one picture."""
import json
import unittest

from support import CliTest, GLASS

JITTERED = ('--aa', 2, '--aa-jitter', 1)


class Passes(CliTest):
    def setUp(self) -> None:
        super().setUp()
        self.write('glass.scn', GLASS)

    def bytes_of(self, name: str) -> bytes:
        return (self.folder / name).read_bytes()

    def glass(self, *words, **more):
        return self.render(*words, scene='glass.scn', **more)

    def test_same_bytes_for_any_threads_and_in_every_format(self):
        for name in ('exr', 'png', 'tif'):
            with self.subTest(name):
                for threads in (1, 3):
                    self.glass('--passes', 3, '-j', threads, '-o', f'{threads}.{name}')
                self.assertEqual(self.bytes_of(f'1.{name}'), self.bytes_of(f'3.{name}'))
        self.assertIn('14 x 9', self.glass('--passes', 3, '--spectral', '--region', '3,2,17,11', '-o', 'part.exr').stderr)

    def test_one_pass_is_the_picture_without(self):
        self.glass(*JITTERED, '-o', 'a.exr')
        self.glass(*JITTERED, '--passes', 1, '-o', 'b.exr')
        self.assertEqual(self.bytes_of('a.exr'), self.bytes_of('b.exr'))

    def test_more_passes_come_nearer(self):
        self.glass('--aa', 12, '--aa-threshold', 0, '--aa-jitter', 1, '-o', 'r.exr')
        error = []
        for passes in (1, 8):
            self.glass('--aa', 1, '--aa-threshold', 0, '--aa-jitter', 1, '--passes', passes, '-o', 'a.exr')
            error.append(json.loads(self.run_abbe('compare', '--json', 'r.exr', 'a.exr').stdout)['ciede2000']['mean'])
        self.assertLess(error[1], 0.6 * error[0])

    def test_file_and_statistics_tell_of_them(self):
        self.glass('--passes', 3, '--stats', 's.json', '-o', 'a.png')
        self.assertIn(b'Passes\x003', self.bytes_of('a.png'))
        stats = json.loads(self.bytes_of('s.json'))
        self.glass('--stats', 's.json', '-o', 'b.png')
        self.assertNotIn(b'Passes', self.bytes_of('b.png'))
        one = json.loads(self.bytes_of('s.json'))
        self.assertEqual((stats['passes'], one['passes']), (3, 1))
        self.assertEqual(stats['rays']['camera'], 3 * one['rays']['camera'])

    def test_same_picture_again_is_refused(self):
        for words in ((), ('--aa', 3), ('--aa', 3, '--aa-method', 2, '--aa-jitter', 1)):
            with self.subTest(words):
                self.assertIn('same picture', self.render('--passes', 2, *words, '-o', 'a.png', status=2).stderr)
        self.render('--passes', 2, *JITTERED, '-o', 'a.png')
        self.glass('--passes', 2, '--dispersion', 'deterministic', '-o', 'a.png', status=2)
        for words in (('--passes', 0), ('--passes', 2, '--time', 3), ('--passes', 2, '--error', 1)):
            self.render(*words, '-o', 'a.png', status=2)

    def test_what_no_memory_holds_is_refused(self):
        done = self.run_abbe('render', 'glass.scn', '-W', 100000, '-H', 100000, '--passes', 2, '-o', 'a.png', status=1)
        self.assertRegex(done.stderr, r'E0706.*240 GB.*--region')

    def test_wrong_light_is_found_in_its_pass(self):
        self.write('bad.scn', GLASS.replace('checker rgb 1', 'checker rgb 1e300').replace('light_source {', 'light_source { <5, 5, -5>, rgb 1e300 }\nlight_source {'))
        done = self.run_abbe('render', 'bad.scn', '-W', 24, '-H', 18, '--passes', 2, '--check-finite', '-o', 'a.png', status=1)
        self.assertRegex(done.stderr, r'E0710[^$]*in pass 1')


if __name__ == '__main__':
    unittest.main()
