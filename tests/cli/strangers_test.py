# SPDX-License-Identifier: MIT
"""What a scene or the machine's limits can do to a run: no abort, no control of the terminal, no file of others."""
import os
import re
import subprocess
import unittest

import support
from support import CliTest, SLOW


class Messages(CliTest):
    def test_control_characters_are_shown(self):
        escapes = r'concat("A", chr(27), "]0;title", chr(7), chr(27), "[2J", chr(155), "31m", chr(13))'
        self.write('scene.scn', f'#debug concat({escapes}, "\\n")\n#warning {escapes}\n#error {escapes}\n')
        said = self.run_abbe('check', 'scene.scn', status=1).stderr
        self.assertNotRegex(said, r'[\x00-\x08\x0b-\x1f\x7f-\x9f]')
        self.assertIn(r'A\x1b]0;title\x07\x1b[2J', said)

    def test_text_stays_text(self):
        self.write('scene.scn', '#debug "K\u00f6nig \u2192 \U0001f600\tx\\n"\n')
        self.assertIn('K\u00f6nig \u2192 \U0001f600\tx\n', self.run_abbe('check', 'scene.scn').stderr)

    def test_no_message_is_a_reason_to_have_no_picture(self):
        self.write('chatty.scn', '#debug "x"\n' + support.QUICK)
        for where in ('2>/dev/full', '2>&-', '>&- 2>&-', '0<&- 2>&-'):
            with self.subTest(where=where):
                done = subprocess.run(['sh', '-c', f'exec "$ABBE" render chatty.scn -W 8 -H 8 -o out.png {where}'],
                                      cwd=self.folder, env={**os.environ, 'ABBE': support.ABBE}, check=False)
                self.assertEqual(done.returncode, 0)
                self.assertTrue((self.folder / 'out.png').read_bytes().startswith(b'\x89PNG'))
                (self.folder / 'out.png').unlink()
                done = subprocess.run(['sh', '-c', f'exec "$ABBE" check no.scn {where}'],
                                      cwd=self.folder, env={**os.environ, 'ABBE': support.ABBE}, check=False)
                self.assertEqual(done.returncode, 3)

    def test_no_file_gets_the_number_of_standard_error(self):
        self.write('slow.scn', SLOW)
        command = f'"{support.ABBE}" render slow.scn -W 1000 -H 1000 -o out.exr --checkpoint --max-time 1'
        done = subprocess.run(['sh', '-c', f'exec {command} 2>&-'], cwd=self.folder, check=False)
        self.assertEqual(done.returncode, 124)
        kept = (self.folder / 'out.exr.abbe-checkpoint').read_bytes()
        self.assertTrue(kept.startswith(b'abbe checkpoint'))


class Files(CliTest):
    def test_a_replaced_picture_keeps_its_mode(self):
        picture = self.write('out.png', 'old')
        for mode in (0o600, 0o640, 0o666):
            picture.chmod(mode)
            self.render('-o', 'out.png')
            self.assertEqual(picture.stat().st_mode & 0o777, mode)

    def test_a_replaced_file_of_a_scene_keeps_its_mode(self):
        self.write('scene.scn', '#fopen F "made.txt" write\n#write (F, 1)\n#fclose F\n')
        made = self.write('made.txt', 'old')
        made.chmod(0o600)
        self.run_abbe('check', 'scene.scn', '--allow-write')
        self.assertEqual(made.stat().st_mode & 0o777, 0o600)
        self.assertNotEqual(made.read_text(), 'old')

    def test_a_scene_writes_through_no_link(self):
        self.write('scene.scn', '#fopen F "made.txt" write\n#write (F, 1)\n#fclose F\n')
        victim = self.write('victim.txt', 'mine')
        (self.folder / '.made.txt.tmp').symlink_to(victim)
        self.run_abbe('check', 'scene.scn', '--allow-write')
        self.assertEqual(victim.read_text(), 'mine')

    def test_other_answers_of_file_exists_make_another_picture(self):
        self.write('asks.scn', SLOW + '#if (file_exists("flag.txt")) sphere { 2, 1 } #end')
        words = ('render', 'asks.scn', '-W', 1000, '-H', 1000, '-o', 'out.exr')
        self.run_abbe(*words, '--checkpoint', '--max-time', 1, status=124)
        self.write('flag.txt', '')
        self.assertIn('E0520', self.run_abbe(*words, '--resume', status=1).stderr)

    def test_the_empty_name_is_an_error(self):
        for mode in ('read', 'write', 'append'):
            self.write('scene.scn', f'#fopen F "" {mode}\n')
            self.assertTrue(re.search(r'scene\.scn:1:\d+.*error', self.run_abbe('check', 'scene.scn', status=1).stderr))


class Numbers(CliTest):
    def test_triangles_of_any_size_are_drawn_or_not(self):
        lamp = 'camera { location <0, 1.5, -6> look_at 0 } light_source { <-5, 5, -5>, 1 }\n'
        for shape in ('triangle { <-1,0,0>, <1,0,0>, <0,1,0> matrix <1,0,0, 1e300,1,0, 0,0,1, 0,0,0> }',
                      'mesh { triangle { <-1,0,0>, <1e308,0,0>, <-1e300,1,0> } triangle { <-1,0,1>, <1,0,1>, <0,1,1> } }',
                      'mesh { triangle { <-1,0,0>, <1,0,0>, <0,1,0> } scale 1e-300 }'):
            with self.subTest(shape=shape):
                self.write('scene.scn', lamp + shape)
                self.render('-o', 'out.png', scene='scene.scn')


class Limits(CliTest):
    def test_little_address_space_is_an_error(self):
        for kilobytes in (200000, 300000, 400000, 600000):
            with self.subTest(kilobytes=kilobytes):
                done = subprocess.run(['bash', '-c', f'ulimit -v {kilobytes}; exec "{support.ABBE}" check quick.scn'],
                                      cwd=self.folder, capture_output=True, check=False, text=True)
                self.assertIn(done.returncode, (0, 1))
                if done.returncode:
                    self.assertIn('E0706', done.stderr)


if __name__ == '__main__':
    unittest.main()
