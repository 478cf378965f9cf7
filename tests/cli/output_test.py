# SPDX-License-Identifier: MIT
"""Pictures: every format can be read by others, and a file is written whole or not at all."""
import os
import resource
import subprocess
import unittest

from support import CliTest, GLASS, have


def outside(*words) -> str:
    done = subprocess.run([str(word) for word in words], capture_output=True, check=False)
    return f'status {done.returncode}\n{(done.stdout + done.stderr).decode("utf-8", "replace")}'


class Formats(CliTest):
    def test_default_name_is_the_scene_with_png(self):
        self.render()
        self.assertEqual(self.names(), ['quick.png', 'quick.scn'])

    @unittest.skipUnless(have('pngcheck'), 'no pngcheck here')
    def test_png(self):
        self.render('-o', 'out.png')
        text = outside('pngcheck', '-v', self.folder / 'out.png')
        self.assertRegex(text, r'24 x 18 image')
        self.assertIn('No errors detected', text)

    @unittest.skipUnless(have('exrheader'), 'no exrheader here')
    def test_exr(self):
        self.render('-o', 'out.exr')
        text = outside('exrheader', self.folder / 'out.exr')
        self.assertRegex(text, r'dataWindow.*\(0 0\) - \(23 17\)')
        self.assertRegex(text, r'R, 32-bit')
        self.render('-o', 'out.exr', '--half')
        self.assertRegex(outside('exrheader', self.folder / 'out.exr'), r'R, 16-bit')

    @unittest.skipUnless(have('exrheader'), 'no exrheader here')
    def test_spectral_exr_has_a_channel_a_band(self):
        self.write('glass.scn', GLASS)
        self.render('-o', 'out.exr', '--spectral', '--bands', 5, scene='glass.scn')
        text = outside('exrheader', self.folder / 'out.exr')
        self.assertEqual(text.count('S0.'), 5, text)
        self.assertIn('spectralLayoutVersion', text)

    @unittest.skipUnless(have('tiffinfo'), 'no tiffinfo here')
    def test_tiff_is_log_luv(self):
        self.render('-o', 'out.tif')
        text = outside('tiffinfo', self.folder / 'out.tif')
        self.assertRegex(text, r'Image Width: 24 Image Length: 18')
        self.assertRegex(text, r'CIE Log2\(L\)')
        self.assertIn('SGILog', text)

    def test_region_is_that_part_of_the_whole(self):
        self.render('-o', 'whole.exr')
        self.render('-o', 'part.exr', '--region', '3,4,20,11')
        self.render('-o', 'all.exr', '--region', '0,0,24,18')
        self.assertEqual((self.folder / 'whole.exr').read_bytes(), (self.folder / 'all.exr').read_bytes())
        self.assertEqual(self.compare('whole.exr', 'part.exr')[0], 1)  # sizes or pixels differ

    def compare(self, a: str, b: str) -> tuple:
        import json
        import support
        done = subprocess.run([support.ABBE, 'compare', '--json', a, b], cwd=self.folder,
                              capture_output=True, check=False)
        if done.returncode:
            return done.returncode, None
        return int(json.loads(done.stdout)['srgb']['differing_share'] > 0), None


class Options(CliTest):
    def bytes_of(self, *words, scene: str = 'glass.scn') -> bytes:
        self.render('-o', 'out.exr', *words, scene=scene)
        return (self.folder / 'out.exr').read_bytes()

    def test_options_change_the_picture(self):
        self.write('glass.scn', GLASS)
        plain = self.bytes_of()
        for words in (['--seed', 7], ['--bands', 3], ['--dispersion', 'none'], ['--dispersion', 'faithful'],
                      ['--dispersion', 'deterministic'], ['--aa', 3], ['--aa', 2, '--aa-method', 2]):
            with self.subTest(words):
                self.assertNotEqual(self.bytes_of(*words), plain)

    def test_seed_does_not_matter_without_chance(self):
        self.write('sure.scn', GLASS.replace('stochastic', 'deterministic'))
        self.render('-o', 'a.png', scene='sure.scn')
        self.render('-o', 'b.png', '--seed', 12345, scene='sure.scn')
        self.assertIn('0.000 % of the pixels', self.run_abbe('compare', 'a.png', 'b.png').stdout)

    def test_size_is_known_to_the_scene(self):
        self.write('size.scn', '#debug concat(str(image_width, 0, 0), "x", str(image_height, 0, 0), "\\n")\n')
        self.assertIn('33x22\n', self.run_abbe('check', 'size.scn', '-W', 33, '-H', 22).stderr)


class WholeOrNotAtAll(CliTest):
    def before(self, name: str) -> None:
        self.write(name, 'an older picture')

    def untouched(self, name: str) -> None:
        self.assertEqual((self.folder / name).read_text(), 'an older picture')
        self.assertEqual(self.names(), sorted([name, 'quick.scn']))

    def test_wrong_scene_keeps_the_old_picture(self):
        self.before('out.png')
        self.write('quick.scn', 'shpere { 0, 1 }\n')
        self.render('-o', 'out.png', status=1)
        self.untouched('out.png')

    def test_full_disk(self):
        for name in ('out.png', 'out.exr', 'out.tif'):
            with self.subTest(name):
                self.before(name)
                done = self.run_abbe('render', 'quick.scn', '-W', 120, '-H', 90, '-o', name, '--quiet', status=3,
                                     preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (700, 700)))
                self.assertIn(f"cannot write '{name}'", done.stderr)
                self.untouched(name)
                os.unlink(self.folder / name)

    @unittest.skipIf(os.geteuid() == 0 and not have('setpriv'), 'root may write everywhere')
    def test_folder_that_cannot_be_written(self):
        closed = self.folder / 'closed'
        closed.mkdir()
        closed.chmod(0o555)
        self.folder.chmod(0o755)
        words = ['render', 'quick.scn', '-W', '24', '-H', '18', '-o', 'closed/out.png']
        if os.geteuid() != 0:
            done = self.run_abbe(*words, status=3)
        else:
            done = self.run_abbe(*words, status=3, user=65534, group=65534)
        self.assertIn("cannot write 'closed/out.png': Permission denied", done.stderr)
        self.assertEqual(list(closed.iterdir()), [])

    def test_something_else_in_the_way(self):
        (self.folder / 'out.png').mkdir()
        self.assertIn('directory', self.render('-o', 'out.png', status=3).stderr)
        os.mkfifo(self.folder / 'pipe.png')
        self.render('-o', 'pipe.png', status=3, timeout=10)

    def test_link_stays_a_link(self):
        self.write('real.png', 'an older picture')
        os.symlink('real.png', self.folder / 'link.png')
        self.render('-o', 'link.png')
        self.assertTrue((self.folder / 'link.png').is_symlink())
        self.assertEqual((self.folder / 'real.png').read_bytes()[:4], b'\x89PNG')

    def test_results_that_cannot_be_printed(self):
        for words in (['dump', '--ast', 'quick.scn'], ['glass', 'list'], ['check', 'quick.scn'],
                      ['glass', 'show', 'N-BK7', '--json'], ['explain', 'quick.scn'], ['--help']):
            with self.subTest(words), open('/dev/full', 'w') as full:
                import support
                done = subprocess.run([support.ABBE, *words], cwd=self.folder, stdout=full,
                                      stderr=subprocess.PIPE, check=False)
                self.assertEqual(done.returncode, 3, done.stderr)

    def test_reader_that_goes_away(self):
        import support
        done = subprocess.run(f"'{support.ABBE}' glass list | head -n 1; exit ${{PIPESTATUS[0]}}", shell=True,
                              executable='/bin/bash', capture_output=True, check=False)
        self.assertEqual(done.stderr, b'')


if __name__ == '__main__':
    unittest.main()
