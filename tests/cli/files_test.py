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

    def test_working_directory(self):
        self.write('deep/scene.scn', '#include "part.inc"\n' + SAY.format('A'))
        self.write('part.inc', '#declare A = "here"\n')
        self.assertIn('<here>', self.run_abbe('check', 'deep/scene.scn').stderr)
        self.write('deep/part.inc', '#declare A = "beside"\n')
        self.assertIn('<beside>', self.run_abbe('check', 'deep/scene.scn').stderr)

    def test_standard_library_is_always_there(self):
        self.write('scene.scn', '#include "colors.inc"\nsphere { 0, 1 pigment { Red } }\n')
        self.run_abbe('check', 'scene.scn')


class PovRayIncludes(CliTest):
    """The folder of POV-Ray's includes, here one of the test's own."""

    def setUp(self) -> None:
        super().setUp()
        self.write('povray/part.inc', '#declare A = "of POV-Ray"\n')
        self.write('povray/metals.inc', '#declare Only_There = 42;\n'
                                        '#macro Finish_Gold() finish { diffuse 0.123 } #end\n')
        self.environment = dict(os.environ, ABBE_POVRAY_INCLUDE=str(self.folder / 'povray'))

    def said(self, text: str, *words, status: int = 0) -> str:
        self.write('home/scene.scn', text)
        return self.run_abbe('check', 'home/scene.scn', *words, status=status, env=self.environment).stderr

    def test_are_found_without_being_named(self):
        self.assertIn('<of POV-Ray>', self.said('#include "part.inc"\n' + SAY.format('A')))

    def test_come_last(self):
        self.write('home/part.inc', '#declare A = "own"\n')
        self.assertIn('<own>', self.said('#include "part.inc"\n' + SAY.format('A')))

    def test_are_read_too_where_the_library_has_the_same_name(self):
        self.assertIn('<42>', self.said('#include "metals.inc"\n' + SAY.format('str(Only_There, 0, 0)')))
        self.write('home/scene.scn', '#include "metals.inc"\nsphere { 0, 1 Finish_Gold() }\n')
        dumped = self.run_abbe('dump', '--scene', 'home/scene.scn', env=self.environment).stdout
        self.assertIn('metal Au', dumped)  # where both declare it, the library's counts
        self.assertNotIn('0.123', dumped)

    def test_may_be_none(self):
        done = self.run_abbe('check', 'home/scene.scn', env=dict(os.environ, ABBE_POVRAY_INCLUDE=''), status=3)
        self.assertIn('No such file or directory', done.stderr)
        self.write('home/scene.scn', '#include "metals.inc"\n' + SAY.format('str(Only_There, 0, 0)'))
        self.run_abbe('check', 'home/scene.scn', env=dict(os.environ, ABBE_POVRAY_INCLUDE=''), status=1)

    def test_a_scene_without_version_is_of_the_newest_after_them(self):
        # As in POV-Ray, whose files say `#version` twice; with and without them.
        self.write('povray/colors.inc', '#declare Temp = version;\n#version 3.5;\n#version Temp;\n')
        for folder in ('povray', ''):
            for text, version in (('', '3.62'), ('#include "colors.inc"\n', '3.7')):
                with self.subTest(folder=folder, text=text):
                    self.write('scene.scn', text + 'sphere { 0, 1 }\n')
                    dumped = self.run_abbe('dump', '--scene', 'scene.scn',
                                           env=dict(self.environment, ABBE_POVRAY_INCLUDE=folder)).stdout
                    self.assertIn(f'settings version {version} ', dumped)

    def test_their_names_are_known(self):
        text = self.said('#declare B = Only_There;\n', status=1)
        self.assertIn('; metals.inc declares it: #include "metals.inc"', text)


class Reading(CliTest):
    def read(self, name: str, status: int, *words) -> str:
        self.write('home/scene.scn', f'#fopen In "{name}" read\n#read (In, A)\n' + SAY.format('str(A, 0, 0)'))
        return self.run_abbe('check', 'scene.scn', *words, status=status, cwd='home').stderr

    def test_below_the_scene(self):
        self.write('home/data/a.csv', '42, 43')
        self.assertIn('<42>', self.read('data/a.csv', 0))

    def test_not_above_it(self):
        self.write('secret.csv', '42')
        text = self.read('../secret.csv', 1)
        self.assertIn('error[E0502]', text)
        self.assertIn(f'--allow-read {self.folder}\n', text)
        self.assertIn('error[E0502]', self.read(str(self.folder / 'secret.csv'), 1))
        self.assertIn('<42>', self.read('../secret.csv', 0, '-I', '..'))
        self.assertIn('<42>', self.read('../secret.csv', 0, '--allow-read', '..'))

    def test_not_through_a_link(self):
        self.write('secret.csv', '42')
        (self.folder / 'home').mkdir()
        os.symlink('../secret.csv', self.folder / 'home' / 'link.csv')
        self.assertIn('error[E0502]', self.read('link.csv', 1))
        self.assertIn('<42>', self.read('link.csv', 0, '--allow-read', '..'))

    def test_below_the_working_directory(self):
        self.write('data/a.csv', '42')
        self.write('home/scene.scn', '#fopen In "data/a.csv" read\n#read (In, A)\n' + SAY.format('str(A, 0, 0)'))
        self.assertIn('<42>', self.run_abbe('check', 'home/scene.scn').stderr)

    def test_no_file_that_a_scene_reads_lies_elsewhere(self):
        self.write('secret.txt', 'SECRET, 42\n')
        os.makedirs(self.folder / 'home')
        os.symlink('../secret.txt', self.folder / 'home' / 'link.txt')
        for name in ('../secret.txt', 'link.txt', str(self.folder / 'secret.txt')):
            for text in ('#include "{}"\n', '#declare V = array[1] {{ #include "{}" }}\n', 'glass_catalog "{}"\n',
                         '#fopen In "{}" read\n#read (In, A)\n#error A\n', '#if (file_exists("{}")) #error "SECRET" #end\n'
                         'no_such_thing\n'):
                with self.subTest(name=name, text=text):
                    self.write('home/scene.scn', text.format(name))
                    done = self.run_abbe('check', 'scene.scn', status=1, cwd='home')
                    self.assertNotIn('SECRET', done.stderr)
                    if 'file_exists' not in text:
                        self.assertIn('error[E0502]', done.stderr)
                        self.assertIn('--allow-read', done.stderr)

    def test_the_reason_is_the_systems(self):
        self.assertIn("cannot read the file 'none.scn': No such file or directory",
                      self.run_abbe('check', 'none.scn', status=3).stderr)
        self.assertIn("cannot read the file '.': Is a directory", self.run_abbe('check', '.', status=3).stderr)
        self.write('closed.scn', '').chmod(0)
        if not os.access(self.folder / 'closed.scn', os.R_OK):  # root reads everything
            self.assertIn('Permission denied', self.run_abbe('render', 'closed.scn', status=3).stderr)
        os.mkfifo(self.folder / 'pipe')
        self.assertIn('Not a regular file', self.run_abbe('dump', '--ast', 'pipe', status=3).stderr)


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
