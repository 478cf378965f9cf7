#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""docs/performance.md: what becomes of figures, and that it is made of those beside it. Measures nothing."""
import json
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import harness  # noqa: E402
import kinds  # noqa: E402
import report  # noqa: E402

DOCS = pathlib.Path(__file__).resolve().parents[2] / 'docs'
ABOUT = {'command': 'tests/bench/run', 'date': '2026-01-01', 'commit': 'abc1234', 'povray': 'POV-Ray 3.7', 'machine': 'M, 2 threads',
         'cores': 2, 'load': 0.1, 'runs': 5, 'quick': False}


def row(what: str, wanted: float, measured: float, at_most: bool) -> dict:
    return {'what': what, 'wanted': wanted, 'measured': measured, 'at_most': at_most, 'unit': 'times', 'how': 'of two',
            'met': measured <= wanted if at_most else measured >= wanted}


def measured(**changes) -> dict:
    return {'about': ABOUT, 'startup': {'abbe': {'cpu': 0.01, 'wall': 0.02, 'mb': 9.0, 'rays': 0}},
            'bars': {'a': [row('one', 2, 1.5, True), row('two', 1.9, 1.234, False)]}, 'kinds': [['kind', 'prism'], [['textures', '12']]],
            'curves': {'curve_bands': {'heading': 'Of bands', 'columns': ['bands', 's'], 'rows': [[8, 0.5]]}},
            'not_measured': {}, **changes}


def corpus(*rows: dict) -> dict:
    return {'about': {**ABOUT, 'width': 320, 'height': 240, 'limit': 120.0, 'only': ''}, 'startup': {'abbe': 0.1, 'povray': 0.2},
            'rows': list(rows)}


def scene(name: str, povray: float | None, abbe: float | None, searched: bool = False) -> dict:
    return {'path': f'{name}.pov', 'searched': searched, 'povray': povray, 'abbe': abbe}


class Page(unittest.TestCase):
    def test_bars_say_what_is_met(self) -> None:
        page = report.page(measured(), None)
        self.assertIn('| one | <= 2 | 1.5 times | yes | of two |', page)
        self.assertIn('| two | >= 1.9 | 1.23 times | **no** | of two |', page)
        self.assertIn('`tests/bench/run`, 2026-01-01: abbe abc1234, POV-Ray 3.7, M, 2 threads', page)

    def test_curves_and_kinds_are_tables(self) -> None:
        page = report.page(measured(), None)
        self.assertIn('### Bands\nOf bands.\n\n| bands | s |\n|---|---|\n| 8 | 0.5 |\n', page)
        self.assertIn('| kind | prism |\n|---|---|\n| textures | 12 |\n', page)

    def test_ratios_are_without_start_up_and_in_order(self) -> None:
        # Without what an empty scene takes: 8 / 1, 1 / 2, 2 / 1, and 1 / 10, which is searched.
        record = corpus(scene('fast', 8.2, 1.1), scene('slow', 1.2, 2.1), scene('twice', 2.2, 1.1),
                        scene('blob', 1.2, 10.1, searched=True))
        page = report.page(None, record)
        table = [line for line in page.splitlines() if '.pov |' in line]
        self.assertEqual(table, ['| blob.pov | 1.000 | 10.000 | 0.10 | yes |', '| slow.pov | 1.000 | 2.000 | 0.50 |  |',
                                 '| twice.pov | 2.000 | 1.000 | 2.00 |  |', '| fast.pov | 8.000 | 1.000 | 8.00 |  |'])
        self.assertIn('| all | 4 | 1.25 | 0.95 | 2 |', page)
        self.assertIn('| without shapes traced by search | 3 | 2.00 | 2.00 | 1 |', page)
        self.assertIn('| with such shapes | 1 | 0.10 | 0.10 | 1 |', page)

    def test_bars_of_the_corpus_are_of_scenes_without_search(self) -> None:
        record = corpus(scene('a', 8.2, 1.1), scene('b', 8.2, 1.1), scene('blob', 1.2, 10.1, searched=True))
        page = report.page(None, record)
        self.assertIn('| POV-Ray / abbe, median | >= 4 | 8 | yes |', page)
        self.assertIn('| POV-Ray / abbe, geometric mean | >= 4 | 8 | yes |', page)
        self.assertIn('| scenes that POV-Ray makes faster | <= 0 | 0 | yes |', page)
        record['rows'].append(scene('c', 1.2, 3.1))
        self.assertIn('| scenes that POV-Ray makes faster | <= 0 | 1 | **no** |', report.page(None, record))

    def test_what_takes_no_longer_than_an_empty_scene_counts_as_a_millisecond(self) -> None:
        self.assertIn('| a.pov | 1.000 | 0.001 | 1000.00 |  |', report.page(None, corpus(scene('a', 1.2, 0.09))))

    def test_scenes_that_one_could_not_make_are_named_and_not_counted(self) -> None:
        page = report.page(None, corpus(scene('a', 1.2, 1.1), scene('lost', None, 1.1), scene('gone', 3.0, None)))
        self.assertIn('Not made by one of them: lost.pov, gone.pov.', page)
        self.assertIn('| all | 1 |', page)

    def test_a_second_abbe_is_compared_with_the_first(self) -> None:
        record = corpus({**scene('a', 1.2, 1.1), 'other': 2.1}, {**scene('b', 1.2, 2.1), 'other': 1.1}, scene('c', 1.2, 1.1))
        record['startup']['other'] = 0.1
        self.assertEqual(report.Corpus(record).others(), 'other / abbe: 2 scenes: median 1.25, geometric mean 1.00, below 1 in 1')
        self.assertEqual(report.Corpus(corpus(scene('c', 1.2, 1.1))).others(), '')

    def test_a_look_is_no_record(self) -> None:
        self.assertNotIn('a look', report.page(measured(), None).lower())
        for change, why in (({'quick': True}, 'small sizes'), ({'only': 'csg'}, 'some scenes only'), ({'runs': 1}, 'one run'),
                            ({'load': 1.5}, 'other work on the machine')):
            self.assertIn(f'**A look, not a record**: {why}', report.page(measured(about={**ABOUT, **change}), None))

    def test_what_was_not_measured_is_told(self) -> None:
        self.assertIn('## Not measured\n\n- embree: there is none', report.page(measured(not_measured={'embree': 'embree: there is none'}), None))

    def test_without_figures_there_is_no_table(self) -> None:
        page = report.page(None, None)
        self.assertNotIn('|', page)
        self.assertIn('`tests/bench/run` measures everything', page)

    def test_the_page_is_made_of_the_figures_beside_it(self) -> None:
        records = (DOCS / 'performance' / name for name in ('bars.json', 'corpus.json'))
        made = report.page(*(json.loads(path.read_text(encoding='utf-8')) if path.exists() else None for path in records))
        self.assertEqual((DOCS / 'performance.md').read_text(encoding='utf-8'), made, 'tests/bench/run --page writes it')


class Kept(unittest.TestCase):
    def test_figures_of_one_program_machine_and_size_go_on(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / 'new/figures.json'
            self.assertEqual(harness.kept(path, ABOUT, {'rows': []}), {'about': ABOUT, 'rows': []})
            harness.write_json(path, {'about': ABOUT, 'rows': [1]})
            later = {**ABOUT, 'date': '2026-01-02', 'load': 7.0}
            self.assertEqual(harness.kept(path, later, {'rows': []}), {'about': ABOUT, 'rows': [1]})
            for name, value in (('commit', 'def'), ('machine', 'N'), ('runs', 3), ('quick', True)):
                with self.assertRaisesRegex(harness.Failed, f'{name} {ABOUT[name]}, not {value}'):
                    harness.kept(path, {**ABOUT, name: value}, {'rows': []})
                self.assertEqual(harness.kept(path, {**ABOUT, name: value}, {'rows': []}, anew=True)['rows'], [])


class Kinds(unittest.TestCase):
    def test_a_function_is_of_its_own_kind_not_of_its_arguments(self) -> None:
        program = ' [/home/free/share/abbe]'
        for kind, name in (
                ('queues, buckets, chunks', 'abbe::transport::Emitter::send(abbe::transport::Chunk const&, abbe::transport::Departing const&)'),
                ('queues, buckets, chunks', 'abbe::transport::Buckets::sort(std::span<abbe::transport::BucketKey const, 18446744073709551615ul>)'),
                ('wavelengths, film', 'abbe::transport::Emitter::lose(unsigned int, double const*, unsigned long)'),
                ('wavelengths, film', 'abbe::transport::SampleFilm::size_of(unsigned int, abbe::transport::WaveTables&) const'),
                ('camera, pixels', 'abbe::transport::Tracer::start_camera(abbe::transport::PicturePoints const&)'),
                ('lamps and shadows', 'abbe::transport::Shadows::pass(abbe::transport::Rays&, unsigned long, abbe::geometry::Groups&)'),
                ('Fresnel, Snell, media', 'abbe::simd::Native<abbe::transport::(anonymous namespace)::Refract, 8ul, void (abbe::transport::Chunk&, '
                                          'double*)>::avx2(abbe::transport::Chunk&, double*)'),
                ('textures', 'abbe::transport::Shader<1>::pigments_at(abbe::transport::Shader<1>::Layer const&, unsigned long)'),
                ('points, normals', 'abbe::transport::Tracer::find_normals()'),
                ('other', 'main')):
            self.assertEqual(kinds.kind_of(f'???:{name}{program}'), kind, name)
        self.assertEqual(kinds.kind_of('???:0x0000000000005d80 [/usr/lib/x86_64-linux-gnu/libz.so.1.2.13]'), 'files, start')


if __name__ == '__main__':
    unittest.main()
