# SPDX-License-Identifier: MIT
"""The command line: help, statuses, and what a newcomer types wrongly at first."""
import unittest

from support import CliTest

COMMANDS = ('render', 'check', 'dump', 'explain', 'glass', 'compare', 'tonemap')


class Help(CliTest):
    def test_overview_names_every_command(self):
        text = self.run_abbe('--help').stdout
        for command in COMMANDS:
            self.assertIn(f'  {command} ', text)

    def test_subdivision_has_a_depth_of_nine_at_most(self):
        done = self.run_abbe('render', 'any.scn', '--aa', 10, '--aa-method', 2, status=2)
        self.assertEqual(done.stderr, 'abbe render: --aa 10 is too deep for --aa-method 2; the most is 9\n')

    def test_version(self):
        self.assertRegex(self.run_abbe('--version').stdout, r'^abbe \d+\.\d+\.\d+\n$')

    def test_each_command_has_help(self):
        for command in COMMANDS:
            with self.subTest(command):
                done = self.run_abbe(command, '--help')
                self.assertIn(f'abbe {command}', done.stdout)
                self.assertEqual(done.stderr, '')

    def test_help_of_render_names_its_options(self):
        text = self.run_abbe('render', '--help').stdout
        for option in ('SCENE', '-o', '-W', '-H', '-j', '--aa', '--seed', '--bands', '--dispersion',
                       '--spectral', '-D', '-I', '--region', '--quiet', '--allow-read', '--allow-write'):
            self.assertIn(option, text)


class NothingToSee(CliTest):
    """A picture that must be empty or black is made, with a warning."""

    def warned(self, text: str) -> str:
        self.write('scene.scn', '#version 3.7; global_settings { assumed_gamma 1 }\n' + text)
        return self.run_abbe('check', 'scene.scn').stderr

    def test_no_objects(self):
        self.write('empty.scn', '')
        says = 'the scene has no objects, no sky and no background\n'
        self.assertEqual(self.run_abbe('check', 'empty.scn').stderr, 'empty.scn: warning[E0256]: ' + says)
        self.assertIn(says, self.warned('light_source { 0, rgb 1 }'))
        self.assertEqual(self.warned('background { rgb 1 }'), '')
        self.assertEqual(self.warned('sky_sphere { pigment { rgb 1 } }'), '')

    def test_no_light(self):
        dark = 'sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 } }\n'
        self.assertIn('warning[E0256]: nothing gives light', self.warned(dark))
        self.assertIn('nothing gives light', self.warned('union { sphere { 0, 1 } box { 0, 1 } finish { ambient 0 } }'))
        self.assertIn('nothing gives light', self.warned('global_settings { ambient_light 0 } sphere { 0, 1 }'))
        for light in ('light_source { 0, rgb 1 }', 'background { rgb 0.1 }', 'sphere { 0, 1 }',
                      'union { box { 0, 1 } sphere { 0, 1 finish { emission 1 } } }',
                      'sphere { 0, 1 finish { ambient 0 } interior_texture { pigment { rgb 1 } } }'):
            with self.subTest(light):
                self.assertEqual(self.warned(dark + light), '')


class WrongCommandLine(CliTest):
    """Status 2, the reason on standard error, nothing on standard output, nothing written."""

    def refused(self, *words, says: str) -> None:
        done = self.run_abbe(*words, status=2)
        self.assertRegex(done.stderr, says)
        self.assertEqual(done.stdout, '')
        self.assertEqual(self.names(), ['quick.scn'])

    def test_nothing_given(self):
        self.refused(says='usage')

    def test_unknown_command(self):
        self.refused('rendr', 'quick.scn', says="unknown command 'rendr'; did you mean 'render'")

    def test_scene_in_the_place_of_a_command(self):
        for name in ('quick.scn', 'other.pov', './quick.scn'):
            self.refused(name, says=f'; to render a scene: abbe render {name}\n')

    def test_words_of_povray(self):
        self.refused('+Iquick.scn', '+W320', says=r'here it is abbe render quick\.scn')
        self.refused('render', 'quick.scn', '+W320', '+H240', says=r"'\+W320' .*here it is -W 320\n.*here it is -H 240\n")
        self.refused('render', 'quick.scn', '+A0.3', says=r"'\+A0\.3' is an option of POV-Ray: abbe povray takes it")
        self.refused('scene.ini', says='abbe povray scene.ini')
        for word, hint in (('scene.ini', 'ini file of POV-Ray'), ('+Iquick.scn', 'abbe render quick')):
            self.assertIn(hint, self.run_abbe('render', word, status=3).stderr)

    def test_scene_without_its_extension(self):
        done = self.run_abbe('render', 'quick', status=3)
        self.assertIn("abbe: did you mean 'quick.scn'?\n", done.stderr)

    def test_missing_scene(self):
        for command in ('render', 'check', 'explain'):
            with self.subTest(command):
                self.refused(command, says='SCENE')

    def test_unknown_option(self):
        self.refused('render', 'quick.scn', '--widht', 10, says='--widht')

    def test_two_scenes(self):
        self.refused('render', 'quick.scn', 'other.scn', says='other.scn')

    def test_wrong_extension(self):
        self.refused('render', 'quick.scn', '-o', 'out.webp', says=r'out\.webp.*\.png')
        self.refused('render', 'quick.scn', '-o', 'out', says='out')

    def test_values_out_of_range(self):
        for words in (['-W', '0'], ['-H', '-1'], ['-W', '1e3'], ['-W', '1000000000'], ['-j', '0'], ['--aa', '0'],
                      ['--aa', 'fine'], ['--bands', '0'], ['--bands', '1001'], ['--seed', 'x'],
                      ['--tile', '0'], ['--dispersion', 'rainbow'], ['--region', '1,2,3'],
                      ['--region', '0,0,9,9,9'], ['-D', 'Name'], ['-D', '=3'], ['-o', '']):
            with self.subTest(words):
                self.refused('render', 'quick.scn', *words, says='.')

    def test_names_that_a_scene_could_never_use(self):
        for word in ('2x=1', 'a b=1', 'sphere=1', 'x=1'):
            with self.subTest(word):
                self.refused('render', 'quick.scn', '-D', word, says='.')

    def test_region_outside_the_picture(self):
        for region in ('0,0,700,10', '5,5,5,9', '-1,0,4,4', '9,0,3,4'):
            with self.subTest(region):
                self.refused('render', 'quick.scn', f'--region={region}', says='--region')

    def test_stage_of_dump(self):
        self.refused('dump', 'quick.scn', says='stage|--tokens')
        self.refused('dump', '--tokens', '--ast', 'quick.scn', says='stage|--tokens')

    def test_glass_without_task(self):
        self.refused('glass', says='list|show|subcommand')
        self.refused('glass', 'show', says='NAME')


class WrongPath(CliTest):
    def test_scene_that_does_not_exist(self):
        for command in ('render', 'check', 'explain'):
            with self.subTest(command):
                done = self.run_abbe(command, 'quik.scn', status=3)
                self.assertIn("cannot read the file 'quik.scn'", done.stderr)
        for stage in ('--tokens', '--ast', '--scene', '--plan'):
            with self.subTest(stage):
                self.assertIn("'quik.scn'", self.run_abbe('dump', stage, 'quik.scn', status=3).stderr)

    def test_scene_that_is_a_folder(self):
        for words in (['render'], ['check'], ['dump', '--ast'], ['dump', '--tokens']):
            with self.subTest(words):
                self.assertIn("'.'", self.run_abbe(*words, '.', status=3).stderr)

    def test_image_that_does_not_exist(self):
        self.assertIn('a.png', self.run_abbe('compare', 'a.png', 'b.png', status=3).stderr)
        self.assertIn('a.exr', self.run_abbe('tonemap', 'a.exr', 'b.png', status=3).stderr)

    def test_folder_of_the_output_does_not_exist(self):
        done = self.render('-o', 'no/such/folder/out.png', status=3)
        self.assertIn('no/such/folder/out.png', done.stderr)


class WrongScene(CliTest):
    def test_misspelt_shape(self):
        self.write('bad.scn', 'light_source { 0, 1 }\nshpere { 0, 1 }\n')
        for command in ('render', 'check', 'explain'):
            with self.subTest(command):
                done = self.run_abbe(command, 'bad.scn', status=1)
                self.assertRegex(done.stderr, r"(?m)^bad\.scn:2:1-6: error\[E\d{4}\]: .*'shpere'.*did you mean 'sphere'")
                self.assertIn('\nshpere { 0, 1 }\n^^^^^^', done.stderr.replace('  ', ''))
        self.assertEqual(self.names(), ['bad.scn', 'quick.scn'])

    def test_all_errors_are_reported(self):
        self.write('bad.scn', 'shpere { 0, 1 }\nsphere { 0, 1 pigmnt { rgb 1 } }\nsphere { 0, Radius }\n')
        done = self.run_abbe('check', 'bad.scn', status=1)
        for line in (1, 2, 3):
            self.assertRegex(done.stderr, rf'(?m)^bad\.scn:{line}:')
        self.assertIn('3 errors', done.stderr)

    def test_include_chain_is_shown(self):
        self.write('outer.scn', '#include "inner.inc"\n')
        self.write('inner.inc', '#macro Ball(R) sphere { 0, Rr } #end\nBall(2)\n')
        done = self.run_abbe('check', 'outer.scn', status=1)
        self.assertRegex(done.stderr, r'(?m)^inner\.inc:1:')
        self.assertRegex(done.stderr, r'inner\.inc:2:.*note')
        self.assertRegex(done.stderr, r'outer\.scn:1:.*note')

    def test_empty_scene_is_no_error(self):
        for text in ('', '// nothing yet'):
            self.write('empty.scn', text)
            self.run_abbe('check', 'empty.scn')
            for stage in ('--tokens', '--ast', '--scene', '--plan'):
                self.run_abbe('dump', stage, 'empty.scn')
            self.render('-o', 'e.png', scene='empty.scn')


if __name__ == '__main__':
    unittest.main()
