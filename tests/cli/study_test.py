# SPDX-License-Identifier: MIT
"""abbe study: what it writes, going on after an interruption, its budget, its page; render --stats and --cost-map."""
import csv
import io
import json
import time
import unittest

import browser
from support import CliTest, GLASS, QUICK, Running

PAPERS = 'none,deterministic,stochastic,faithful'
SMALL = ['-W', 32, '-H', 24, '--bands', '4,8', '--reference', 'bands=24', '--seeds', 2, '--quiet']


class RenderRecords(CliTest):
    def test_stats(self):
        self.write('glass.scn', GLASS)
        self.render('-o', 'a.png', '--stats', 'a.json', '--seed', 3, scene='glass.scn')
        stats = json.loads((self.folder / 'a.json').read_text())
        self.assertEqual((stats['width'], stats['height'], stats['bands'], stats['seed']), (24, 18, 4, 3))
        rays = stats['rays']
        self.assertEqual(rays['camera'], 24 * 18)
        self.assertEqual(rays['total'], sum(v for k, v in rays.items() if k != 'total'))

    def test_cost_map_adds_up_to_the_rays(self):
        """The grey of the map is the rays of each pixel: its mean, by the RMSE to black of one pixel, is the total."""
        self.write('glass.scn', GLASS)
        for region in ([], ['--region', '3,2,4,3']):
            self.render('-o', 'a.png', '--stats', 'a.json', '--cost-map', 'c.exr', '--aa', '2', *region, scene='glass.scn')
            self.assertTrue((self.folder / 'c.exr').exists())
        self.render('-o', 'black.exr', '--region', '3,2,4,3', scene=self.write('black.scn', 'camera { }').name)
        found = json.loads(self.run_abbe('compare', '--json', 'black.exr', 'c.exr').stdout)
        total = json.loads((self.folder / 'a.json').read_text())['rays']['total']
        self.assertAlmostEqual(found['linear']['rmse'], total, places=3)

    def test_cost_map_keeps_no_checkpoint(self):
        self.render('-o', 'a.png', '--cost-map', 'c.exr', '--checkpoint', status=2)
        self.render('-o', 'a.png', '--cost-map', 'c.exr', '--resume', status=2)
        self.render('-o', 'a.png', '--cost-map', 'c.webp', status=2)

    def test_max_trace_level(self):
        self.write('glass.scn', GLASS)
        rays = []
        for level in (1, 4, 8):
            self.render('-o', 'a.png', '--stats', 'a.json', '--max-trace-level', level, scene='glass.scn')
            rays.append(json.loads((self.folder / 'a.json').read_text())['rays']['total'])
        self.assertLess(rays[0], rays[1])
        self.render('-o', 'a.png', '--stats', 'a.json', scene='glass.scn')   # the scene says 8
        self.assertEqual(rays[2], json.loads((self.folder / 'a.json').read_text())['rays']['total'])


class Study(CliTest):
    def setUp(self) -> None:
        super().setUp()
        self.write('glass.scn', GLASS)

    def study(self, *words, **more):
        return self.run_abbe('study', 'glass.scn', *SMALL, '-o', 'S', *words, timeout=300, **more)

    def result(self) -> dict:
        return json.loads((self.folder / 'S/study.json').read_text())

    def test_figures(self):
        text = self.study('--modes', PAPERS).stdout
        self.assertIn('Pareto front', text)
        study = self.result()
        settings = {s['name']: s for s in study['settings']}
        self.assertEqual(set(settings), {f'{mode} {n}' for mode in PAPERS.split(',') for n in (4, 8)})
        # Dispersion left out is the largest error; more bands are closer.
        self.assertGreater(settings['none 8']['delta_e_mean'], settings['deterministic 8']['delta_e_mean'])
        self.assertGreater(settings['deterministic 4']['delta_e_mean'], settings['deterministic 8']['delta_e_mean'])
        self.assertEqual(settings['deterministic 8']['noise'], 0)
        self.assertGreater(settings['stochastic 8']['noise'], 0)
        self.assertAlmostEqual(settings['deterministic 8']['bias'] ** 2, settings['deterministic 8']['relative_mse'], places=9)
        self.assertEqual(settings['none 8']['ratio_to_none'], 1)
        self.assertTrue(any(s['on_front'] for s in settings.values()))
        self.assertTrue({p['depth'] for p in study['depth']} >= {2, 4, 8})
        self.assertEqual([r['seed'] for r in settings['stochastic 4']['runs']], [0, 1])
        rows = list(csv.DictReader(io.StringIO((self.folder / 'S/study.csv').read_text())))
        self.assertEqual(len(rows), sum(len(s['runs']) for s in settings.values()))
        self.assertEqual(rows[0]['processor'], study['machine']['processor'])

    def test_errors_are_those_of_compare(self):
        self.study('--modes', 'deterministic')
        found = json.loads(self.run_abbe('compare', '--json', 'S/reference.exr', 'S/runs/deterministic-4.s0.exr').stdout)
        setting = self.result()['settings'][0]
        self.assertAlmostEqual(setting['delta_e_mean'], found['ciede2000']['mean'])
        self.assertAlmostEqual(setting['flip'], found['flip']['mean'])

    def test_what_is_there_is_not_run_again(self):
        self.study('--modes', 'deterministic,none')
        before = {p.name: p.stat().st_mtime_ns for p in (self.folder / 'S/runs').iterdir()}
        self.study('--modes', 'deterministic,none,stochastic')
        after = {p.name: p.stat().st_mtime_ns for p in (self.folder / 'S/runs').iterdir()}
        self.assertEqual(before, {name: after[name] for name in before})
        self.write('glass.scn', GLASS.replace('0.1', '0.2'))   # another scene: all anew
        self.study('--modes', 'deterministic,none')
        anew = {p.name: p.stat().st_mtime_ns for p in (self.folder / 'S/runs').iterdir()}
        self.assertFalse([name for name in before if anew[name] == before[name]])

    def test_interrupted_and_gone_on_with(self):
        words = ['study', 'glass.scn', '-W', 200, '-H', 150, '--modes', 'deterministic,none', '--bands', '4,64', '--reference',
                 'bands=500,aa=5/0', '-o', 'S', '--quiet']
        with Running(self.folder, *words) as running:
            patience = 600
            while not (self.folder / 'S/runs/none-4.s0.json').exists() and patience:
                patience -= 1
                running.process.poll()
                time.sleep(0.05)
            running.signal()
            self.assertEqual(running.process.wait(30), 130)
        kept = (self.folder / 'S/runs/none-4.s0.json').stat().st_mtime_ns
        words[words.index('bands=500,aa=5/0')] = 'bands=66'
        self.run_abbe(*words, timeout=300)
        self.assertEqual(kept, (self.folder / 'S/runs/none-4.s0.json').stat().st_mtime_ns)

    def test_budget(self):
        self.assertIn('E0531', self.study('--budget', '0.001', status=1).stderr)
        self.assertIn('does not fit', self.run_abbe(
            'study', 'glass.scn', '-W', 2000, '-H', 2000, '--bands', 4, '--modes', 'none', '--reference', 'bands=400',
            '--budget', '4s', '--quiet', status=1).stderr)

    def test_wrong_words(self):
        self.assertRegex(self.study('--modes', 'stochastik', status=2).stderr, "did you mean 'stochastic'.*faithful")
        for words in (['--reference', 'bands=0'], ['--reference', 'colour=3'], ['--budget', '3 days'], ['--bands', '0'], ['--aa', '65'],
                      ['--seeds', '0']):
            with self.subTest(words):
                self.run_abbe('study', 'glass.scn', *words, status=2)
        self.write('bad.scn', 'sphere {')
        self.run_abbe('study', 'bad.scn', status=1)
        self.assertNotIn('bad-study', self.names())

    def test_a_scene_without_glass(self):
        self.write('plain.scn', QUICK)
        self.run_abbe('study', 'plain.scn', *SMALL, '-o', 'P')
        study = json.loads((self.folder / 'P/study.json').read_text())
        # Modes make no difference without glass, representations of light hardly any.
        families = {s['family'] if 'family' in s else s['name'].split()[0] for s in study['settings']}
        self.assertLessEqual({'adaptive', 'rays', 'clusters', 'hero', 'uniform', 'stratified', 'triangular', 'blue_noise',
                              'hall', 'composite', 'basis', 'subdivided', *PAPERS.split(',')}, families)
        for setting in study['settings']:
            if setting['skipped']:   # the picture of deterministic
                self.assertRegex(setting['name'] + ': ' + setting['skipped'], '^composite.*no lines')
                continue
            fitted = setting['name'].split()[0] in ('basis', 'subdivided', 'hall')
            self.assertLessEqual(setting['delta_e_mean'], 8 if fitted else 0, setting['name'])


@unittest.skipUnless(browser.find(), 'no chromium here')
class Page(CliTest):
    def test_page(self):
        self.write('glass.scn', GLASS)
        self.run_abbe('study', 'glass.scn', *SMALL, '--modes', PAPERS, '-o', 'S', timeout=300)
        with browser.Browser() as page:
            page.open(self.folder / 'S/report.html')
            for plot in ('front', 'growth', 'depth'):   # it draws: pixels that are not transparent
                self.assertGreater(page.js(
                    f'(() => {{const c = document.getElementById("{plot}");'
                    'const p = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;'
                    'let n = 0; for (let i = 3; i < p.length; i += 4) n += p[i] > 0; return n})()'), 2000, plot)
            place = ('(() => {const c = Chart.getChart("front"), d = c.getDatasetMeta(1).data[0], r = c.canvas.getBoundingClientRect();'
                     'return [r.left + d.x, r.top + d.y]})()')
            page.mouse(*page.js(place))
            page.wait('Chart.getChart("front").tooltip.opacity > 0')
            self.assertEqual(page.js('Chart.getChart("front").tooltip.title[0]'), 'deterministic 4')
            page.mouse(1, 1)
            page.js('document.getElementById("front").focus()')
            page.key('ArrowRight')
            self.assertRegex(page.js('document.getElementById("front-text").textContent'), r'^\w+ \d+: Processor seconds')
            page.js('document.getElementById("divider").focus()')
            page.key('ArrowRight')
            self.assertEqual(page.js('document.getElementById("wipe").style.getPropertyValue("--at")'), '51%')
            self.assertEqual(page.js('document.querySelectorAll("#all tbody tr").length'), 8)
            page.js('document.querySelectorAll("#all thead button")[4].click()')
            self.assertEqual(page.js('document.querySelectorAll("#all th")[4].getAttribute("aria-sort")'), 'ascending')
            for control in ('cost', 'error', 'target'):
                page.js(f'(() => {{const s = document.getElementById("{control}"); s.selectedIndex = s.options.length - 1;'
                        's.dispatchEvent(new Event("change"))})()')
            for width, dark in ((390, False), (390, True), (1280, True)):
                page.look(width, 900, dark)
                page.open(self.folder / 'S/report.html')
                self.assertLessEqual(page.js('document.documentElement.scrollWidth'), width)
            self.assertEqual(page.problems, [])
            self.assertEqual([url for url in page.requests if not url.startswith(('file:', 'data:'))], [])
            self.assertEqual(len({url for url in page.requests if url.startswith('file:')}), 1)


if __name__ == '__main__':
    unittest.main()
