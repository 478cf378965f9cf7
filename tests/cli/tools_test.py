# SPDX-License-Identifier: MIT
"""glass, compare, tonemap, dump, check, explain."""
import json
import unittest

from support import CliTest, GLASS


class Glass(CliTest):
    def test_list(self):
        names = self.run_abbe('glass', 'list').stdout.splitlines()
        self.assertGreaterEqual(len(names), 1759)
        self.assertIn('SCHOTT/N-BK7', names)
        schott = self.run_abbe('glass', 'list', '--maker', 'SCHOTT').stdout.splitlines()
        self.assertTrue(schott and set(schott) < set(names) | set(f'SCHOTT/{name}' for name in schott))

    def test_unknown_maker_lists_the_known(self):
        self.assertRegex(self.run_abbe('glass', 'list', '--maker', 'SCHOT', status=1).stderr,
                         "did you mean 'SCHOTT'.*OHARA")

    def test_show(self):
        glass = json.loads(self.run_abbe('glass', 'show', 'SCHOTT/N-BK7', '--json', '--at', '587.5618,632.8').stdout)
        self.assertAlmostEqual(glass['nd'], 1.5168, delta=5e-6)   # SCHOTT data sheet
        self.assertAlmostEqual(glass['Vd'], 64.17, delta=5e-3)
        self.assertAlmostEqual(glass['at'][1]['n'], 1.51509, delta=5e-6)
        self.assertIn('1.5168', self.run_abbe('glass', 'show', 'N-BK7').stdout)

    def test_unknown_glass(self):
        self.assertRegex(self.run_abbe('glass', 'show', 'N-BK8', status=1).stderr, "N-BK8.*did you mean")
        for name in ('"', 'a\nb', ''):
            with self.subTest(name):
                self.run_abbe('glass', 'show', name, status=1)


class Compare(CliTest):
    def setUp(self) -> None:
        super().setUp()
        self.render('-o', 'a.exr')
        self.render('-o', 'b.exr', '-D', 'Unused=1')
        self.write('other.scn', (self.folder / 'quick.scn').read_text().replace('0.5', '0.6'))
        self.render('-o', 'c.exr', scene='other.scn')

    def test_equal(self):
        found = json.loads(self.run_abbe('compare', '--json', 'a.exr', 'b.exr').stdout)
        self.assertEqual((found['width'], found['height'], found['linear']['rmse']), (24, 18, 0))
        self.assertEqual(found['srgb']['differing_share'], 0)

    def test_different(self):
        found = json.loads(self.run_abbe('compare', '--json', 'a.exr', 'c.exr', '--diff', 'd.png').stdout)
        self.assertGreater(found['linear']['rmse'], 0)
        self.assertGreater(found['ciede2000']['max'], 1)
        self.assertEqual((self.folder / 'd.png').read_bytes()[:4], b'\x89PNG')

    def test_images_of_different_sizes(self):
        self.run_abbe('render', 'quick.scn', '-W', 10, '-H', 10, '-o', 'small.exr')
        self.assertIn('24 x 18', self.run_abbe('compare', 'a.exr', 'small.exr', status=1).stderr)

    def test_truncated_and_junk_images(self):
        whole = (self.folder / 'a.exr').read_bytes()
        for name in ('x.png', 'x.tif'):
            self.render('-o', name)
        for name, data in (('x.exr', whole), ('x.png', (self.folder / 'x.png').read_bytes()),
                           ('x.tif', (self.folder / 'x.tif').read_bytes())):
            for end in (0, 1, 8, 60, len(data) // 4, len(data) // 2):
                with self.subTest(name=name, bytes=end):
                    (self.folder / name).write_bytes(data[:end])
                    self.assertIn(name, self.run_abbe('compare', 'a.exr', name, status=3).stderr)
            (self.folder / name).write_bytes(bytes(range(256)) * 8)
            self.run_abbe('compare', 'a.exr', name, status=3)


class Tonemap(CliTest):
    def test_png(self):
        self.render('-o', 'a.exr')
        for words in ([], ['--exposure', 'auto'], ['--exposure', '-1.5'], ['--gamut', 'hue']):
            with self.subTest(words):
                self.run_abbe('tonemap', 'a.exr', 'a.png', *words)
                self.assertEqual((self.folder / 'a.png').read_bytes()[:4], b'\x89PNG')

    def test_same_as_rendering_a_png(self):
        self.render('-o', 'a.exr')
        self.render('-o', 'direct.png')
        self.run_abbe('tonemap', 'a.exr', 'mapped.png')
        found = json.loads(self.run_abbe('compare', '--json', 'direct.png', 'mapped.png').stdout)
        self.assertEqual(found['srgb']['differing_share'], 0)

    def test_wrong_words(self):
        self.render('-o', 'a.exr')
        self.run_abbe('tonemap', 'a.exr', 'a.jpg', status=2)
        self.run_abbe('tonemap', 'a.exr', 'a.png', '--exposure', 'bright', status=2)
        self.run_abbe('tonemap', 'a.exr', 'no/a.png', status=3)


class Inspect(CliTest):
    def setUp(self) -> None:
        super().setUp()
        self.write('glass.scn', GLASS)

    def test_check(self):
        self.assertEqual(self.run_abbe('check', 'glass.scn').stdout, 'glass.scn: no errors\n')

    def test_tokens_have_places(self):
        text = self.run_abbe('dump', '--tokens', 'quick.scn').stdout
        self.assertEqual(text.splitlines()[0], '1:1 word camera')

    def test_tree_and_graph(self):
        self.assertIn('sphere', self.run_abbe('dump', '--ast', 'quick.scn').stdout)
        self.assertIn('sphere', self.run_abbe('dump', '--scene', 'quick.scn').stdout)

    def test_dumps_are_the_same_each_time(self):
        for stage in ('--tokens', '--ast', '--scene', '--plan'):
            with self.subTest(stage):
                self.assertEqual(self.run_abbe('dump', stage, 'glass.scn').stdout,
                                 self.run_abbe('dump', stage, 'glass.scn').stdout)

    def test_plan_names_effects_and_causes(self):
        for command in (['explain'], ['dump', '--plan']):
            text = self.run_abbe(*command, 'glass.scn').stdout
            self.assertRegex(text, r'stochastic dispersion +on')
            self.assertIn('SCHOTT/N-SF11', text)
            self.assertRegex(self.run_abbe(*command, 'quick.scn').stdout, r'stochastic dispersion +off')


if __name__ == '__main__':
    unittest.main()
