# SPDX-License-Identifier: MIT
"""What a scene may read and write, what the command line gives to it."""
import os
import unittest

from support import CliTest

SAY = '#debug concat("<", {}, ">\\n")\n'
WRITER = '#fopen Out "made.txt" write\n#write (Out, 1, ",", <1, 2, 3>)\n#fclose Out\n'


class Declared(CliTest):
    def said(self, text: str, *words) -> str:
        self.write('say.scn', SAY.format(text))
        return self.run_abbe('check', 'say.scn', *words).stderr

    def test_float(self):
        self.assertIn('<2.50>', self.said('str(A, 0, 2)', '-D', 'A=2.5'))
        self.assertIn('<-1000>', self.said('str(A, 0, 0)', '-DA=-1e3'))

    def test_string(self):
        self.assertIn('<SF6>', self.said('Glass', '-D', 'Glass=SF6'))
        self.assertIn('<1.5>', self.said('Glass', '-D', 'Glass="1.5"'))
        self.assertIn('<a=b c>', self.said('Glass', '-D', 'Glass=a=b c'))

    def test_several(self):
        self.assertIn('<3>', self.said('str(A + B, 0, 0)', '-D', 'A=1', '-D', 'B=2'))

    def test_scene_may_give_a_default(self):
        text = '#ifndef (A) #declare A = 7; #end\n' + SAY.format('str(A, 0, 0)')
        self.write('default.scn', text)
        self.assertIn('<7>', self.run_abbe('check', 'default.scn').stderr)
        self.assertIn('<8>', self.run_abbe('check', 'default.scn', '-D', 'A=8').stderr)


class Includes(CliTest):
    def test_beside_the_scene_wherever_the_program_runs(self):
        self.write('deep/scene.scn', '#include "part.inc"\n')
        self.write('deep/part.inc', '#declare A = 1;\n')
        self.run_abbe('check', 'deep/scene.scn')

    def test_folders_of_the_command_line_in_order(self):
        self.write('scene.scn', '#include "part.inc"\n' + SAY.format('A'))
        self.run_abbe('check', 'scene.scn', status=1)
        for name in ('one', 'two'):
            self.write(f'{name}/part.inc', f'#declare A = "{name}"\n')
        self.assertIn('<one>', self.run_abbe('check', 'scene.scn', '-I', 'one', '-I', 'two').stderr)
        self.assertIn('<two>', self.run_abbe('check', 'scene.scn', '-I', 'two', '-I', 'one').stderr)

    def test_standard_library_is_always_there(self):
        self.write('scene.scn', '#include "colors.inc"\nsphere { 0, 1 pigment { Red } }\n')
        self.run_abbe('check', 'scene.scn')


class Reading(CliTest):
    def read(self, name: str, status: int, *words) -> str:
        self.write('home/scene.scn', f'#fopen In "{name}" read\n#read (In, A)\n' + SAY.format('str(A, 0, 0)'))
        return self.run_abbe('check', 'home/scene.scn', *words, status=status).stderr

    def test_below_the_scene(self):
        self.write('home/data/a.csv', '42, 43')
        self.assertIn('<42>', self.read('data/a.csv', 0))

    def test_not_above_it(self):
        self.write('secret.csv', '42')
        self.assertIn('error[E0502]', self.read('../secret.csv', 1))
        self.assertIn('error[E0502]', self.read(str(self.folder / 'secret.csv'), 1))
        self.assertIn('<42>', self.read('../secret.csv', 0, '-I', '.'))

    def test_not_through_a_link(self):
        self.write('secret.csv', '42')
        (self.folder / 'home').mkdir()
        os.symlink('../secret.csv', self.folder / 'home' / 'link.csv')
        self.assertIn('error[E0502]', self.read('link.csv', 1))


class Writing(CliTest):
    def test_only_when_allowed(self):
        self.write('writer.scn', WRITER)
        done = self.run_abbe('check', 'writer.scn', status=1)
        self.assertRegex(done.stderr, r"writer\.scn:1:\d+.*error\[E0503\].*'made\.txt'.*--allow-write")
        self.assertFalse((self.folder / 'made.txt').exists())
        self.run_abbe('check', 'writer.scn', '--allow-write')
        self.assertEqual((self.folder / 'made.txt').read_text(), '1,<1,2,3> ')

    def test_in_the_folder_of_the_scene(self):
        self.write('deep/writer.scn', WRITER)
        self.run_abbe('check', 'deep/writer.scn', '--allow-write')
        self.assertTrue((self.folder / 'deep' / 'made.txt').exists())

    def test_never_outside_it(self):
        for name in ('../made.txt', '/tmp/abbe-made.txt', 'deep/../../made.txt'):
            with self.subTest(name):
                self.write('home/writer.scn', WRITER.replace('made.txt', name))
                done = self.run_abbe('check', 'home/writer.scn', '--allow-write', status=1)
                self.assertIn('error[E0503]', done.stderr)
                self.assertEqual(self.names(), ['home', 'quick.scn'])

    def test_never_through_a_link(self):
        (self.folder / 'home').mkdir()
        os.symlink('../made.txt', self.folder / 'home' / 'made.txt')
        self.write('home/writer.scn', WRITER)
        self.run_abbe('check', 'home/writer.scn', '--allow-write')  # the link is replaced
        self.assertFalse((self.folder / 'made.txt').exists())
        self.assertFalse((self.folder / 'home' / 'made.txt').is_symlink())
        self.assertEqual(sorted(path.name for path in (self.folder / 'home').iterdir()), ['made.txt', 'writer.scn'])

    def test_nothing_when_the_scene_is_wrong(self):
        self.write('writer.scn', WRITER + 'shpere { 0, 1 }\n')
        self.run_abbe('check', 'writer.scn', '--allow-write', status=1)
        self.assertFalse((self.folder / 'made.txt').exists())


if __name__ == '__main__':
    unittest.main()
