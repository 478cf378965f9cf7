#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""`compare FOLDER`: figures of good, wrong and slow scenes, going on after an interruption, and the page in a browser.

The program in $ABBE, POV-Ray from the path; status 77 without it."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / 'cli'))
import browser  # noqa: E402

BALL = '''#version 3.7;
global_settings { assumed_gamma 1 }
#include "colour.inc"
camera { location <0, 0, -4> look_at 0 angle 40 }
light_source { <-5, 5, -5>, rgb 1 }
sphere { 0, 1 pigment { rgb Warm } }
'''


class Folders(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix='abbe-folders-test-'))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        scenes = cls.folder / 'scenes'
        (scenes / 'sub').mkdir(parents=True)
        (scenes / 'colour.inc').write_text('#declare Warm = <1, 0.5, 0.2>;\n', encoding='utf-8')
        (scenes / 'ball.pov').write_text(BALL, encoding='utf-8')
        (scenes / 'sub/frames.pov').write_text(BALL + 'sphere { frame_number * x, 0.5 pigment { rgb 1 } }\n'
                                               '#fopen F "note.txt" write #write (F, "x") #fclose F\n', encoding='utf-8')
        (scenes / 'both_refuse.pov').write_text('sphere { 0, }', encoding='utf-8')
        (scenes / 'endless.pov').write_text(BALL + '#while (1) #end', encoding='utf-8')
        cls.first = cls.compare()

    @classmethod
    def compare(cls, *words: str) -> subprocess.CompletedProcess:
        return subprocess.run([sys.executable, '-B', HERE / 'compare', cls.folder / 'scenes', '-o', cls.folder / 'out', '-W', '80',
                               '-H', '60', '--limit', '8', '--abbe', os.environ['ABBE'], *words], capture_output=True, text=True,
                              check=False)

    def results(self) -> dict:
        kept = json.loads((self.folder / 'out/results.json').read_text(encoding='utf-8'))
        return {result['name']: result for result in kept['results']}

    def test_figures_of_each(self) -> None:
        found = self.results()
        self.assertEqual(sorted(found), ['ball.pov', 'both_refuse.pov', 'endless.pov', 'sub/frames.pov'])
        for name in ('ball.pov', 'sub/frames.pov'):
            self.assertGreater(found[name]['psnr_db'] or 99, 60, self.first.stdout)
            self.assertGreater(found[name]['abbe']['mib'], 1)
        self.assertIn('why', found['both_refuse.pov']['povray'])
        self.assertIn('error[E', found['both_refuse.pov']['abbe']['why'])
        self.assertEqual(found['endless.pov']['abbe']['why'], 'not done in time')
        self.assertIn('4 scenes; povray renders 2, abbe 2 of these', self.first.stdout)
        self.assertEqual(self.first.returncode, 0, 'what POV-Ray does not render counts for nothing')

    def test_scenes_write_into_copies(self) -> None:
        self.assertFalse((self.folder / 'scenes/sub/note.txt').exists())

    def test_a_second_run_goes_on(self) -> None:
        path = self.folder / 'out/results.json'
        kept = json.loads(path.read_text(encoding='utf-8'))
        kept['results'] = [result for result in kept['results'] if result['name'] != 'ball.pov']
        path.write_text(json.dumps(kept), encoding='utf-8')
        said = self.compare().stdout
        self.assertIn('ball.pov', said)
        self.assertNotIn('frames.pov', said)
        self.assertEqual(len(self.results()), 4)

    @unittest.skipUnless(browser.find(), 'no Chromium')
    def test_the_page(self) -> None:
        with browser.Browser() as page:
            page.open(self.folder / 'out/index.html')
            self.assertEqual(page.js('document.querySelectorAll("tr.scene").length'), 4)
            self.assertEqual(page.js('document.querySelectorAll(".pair").length'), 2)
            self.assertEqual(page.js('[...document.images].every(i => i.complete && i.naturalWidth === 80)'), True)
            page.js('(() => { const i = document.querySelector(".pair input"); i.value = 20;'
                     ' i.dispatchEvent(new Event("input")); })()')
            self.assertEqual(page.js('getComputedStyle(document.querySelector(".pair .over")).clipPath'),
                             'inset(0px 0px 0px 20%)')
            self.assertEqual(page.problems, [])


if __name__ == '__main__':
    if not shutil.which('povray'):
        sys.exit(77)
    unittest.main()
