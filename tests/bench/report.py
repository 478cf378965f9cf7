# SPDX-License-Identifier: MIT
"""docs/performance.md from the figures that `run` and `corpus` keep. Figures are in the records; words are here."""
import statistics

# Of the scenes that are not traced by search: (what, wanted, of the ratios, at most).
CORPUS_BARS = (('POV-Ray / abbe, median', 4, statistics.median, False),
               ('POV-Ray / abbe, geometric mean', 4, statistics.geometric_mean, False),
               ('scenes that POV-Ray makes faster', 0, lambda ratios: sum(ratio < 1 for ratio in ratios), True))

MEASURED = '''Times are CPU seconds, user and system, of one thread unless a table says otherwise: medians of runs in turn, so that
programs that are compared meet the same machine. What an empty scene takes is taken off each render's. No anti-aliasing.
'''

LIMITS = '''- **Each wavelength has its own way** behind the first surface that splits light. So n bands cost up to n rays for each ray of *none*,
  however fast a ray is; what shares ways is `adaptive` ([dispersion](dispersion.md)).
- **A ray in glass** is a crossing of the solid that it is in, and Fresnel with Snell where it leaves, in doubles and with bounds of their
  rounding: the same bits everywhere and no lost surface ask for both. `bench_kernels` times them by themselves; division and square
  root are the floor.
- **What is gathered and sorted** between generations ([transport](transport.md)) is moved in memory: queues must fit the caches, so a
  batch is no larger than they are, and a generation of many rays waits in parts.
- **Textures and patterns** are evaluated point by point, not side by side.
- **Shapes traced by search** (isosurfaces, blobs, lathes, polynomials and their kin) take what proving takes that no root is missed;
  their scenes are counted apart. Isosurfaces with noise in their functions, and superellipsoids with an exponent above 2, are halved by interval
  arithmetic until rounding or `accuracy` ends it: some hundred evaluations a ray.
- **Small pictures** are start-up, reading the include files (330 instructions a byte) and PNG.
'''


def number(value) -> str:
    if isinstance(value, str):
        return value
    if value is None:
        return ''
    if isinstance(value, int) or abs(value) >= 1000:
        return f'{value:.0f}'
    return f'{value:.3g}'


def table(columns: list, rows: list) -> str:
    lines = ['| ' + ' | '.join(columns) + ' |', '|' + '---|' * len(columns)]
    return '\n'.join(lines + ['| ' + ' | '.join(map(number, row)) + ' |' for row in rows]) + '\n'


def bars_table(rows: list) -> str:
    """@param rows as dataclasses.asdict(bars.Row) with `met`"""
    return table(['bar', 'wanted', 'measured', 'met', 'made of'],
                 [[row['what'], ('<= ' if row['at_most'] else '>= ') + number(row['wanted']),
                   f'{number(row["measured"])} {row["unit"]}'.rstrip(), 'yes' if row['met'] else '**no**', row['how']]
                  for row in rows])


class Corpus:
    """The figures of tests/bench/corpus: scenes that both programs made, the one that abbe is slowest in first."""

    def __init__(self, record: dict) -> None:
        self.startup = record['startup']
        made = [row for row in record['rows'] if row.get('abbe') is not None and row.get('povray') is not None]
        self.rows = sorted(made, key=self.against_povray)
        self.failed = [row for row in record['rows'] if row not in made]

    def net(self, row: dict, program: str) -> float:
        return max(1e-3, row[program] - self.startup[program])

    def against_povray(self, row: dict) -> float:
        return self.net(row, 'povray') / self.net(row, 'abbe')

    def ratios(self, searched: bool | None = None) -> list:
        """@param searched of scenes with shapes traced by search, or of those without; None: of all"""
        return [self.against_povray(row) for row in self.rows if searched is None or row['searched'] == searched]

    def summary(self) -> str:
        rows = []
        for name, searched in (('all', None), ('without shapes traced by search', False), ('with such shapes', True)):
            if ratios := self.ratios(searched):
                rows.append([name, len(ratios), f'{statistics.median(ratios):.2f}', f'{statistics.geometric_mean(ratios):.2f}',
                             sum(ratio < 1 for ratio in ratios)])
        return table(['POV-Ray / abbe', 'scenes', 'median', 'geometric mean', 'POV-Ray is faster in'], rows)

    def scenes(self) -> str:
        return table(['scene', 'POV-Ray, s', 'abbe, s', 'POV-Ray / abbe', 'traced by search'],
                     [[row['path'], f'{self.net(row, "povray"):.3f}', f'{self.net(row, "abbe"):.3f}',
                       f'{self.against_povray(row):.2f}', 'yes' if row['searched'] else ''] for row in self.rows])

    def bars(self) -> list:
        ratios = self.ratios(searched=False)
        if not ratios:
            return []
        how = f'{len(ratios)} scenes without shapes traced by search'
        out = []
        for what, wanted, of, at_most in CORPUS_BARS:
            measured = of(ratios)
            out.append({'what': what, 'wanted': wanted, 'measured': measured, 'at_most': at_most, 'unit': '', 'how': how,
                        'met': measured <= wanted if at_most else measured >= wanted})
        return out

    def others(self) -> str:
        """A second abbe beside the first, if there was one."""
        ratios = [self.net(row, 'other') / self.net(row, 'abbe') for row in self.rows if row.get('other') is not None]
        if not ratios:
            return ''
        return (f'other / abbe: {len(ratios)} scenes: median {statistics.median(ratios):.2f}, geometric mean '
                f'{statistics.geometric_mean(ratios):.2f}, below 1 in {sum(ratio < 1 for ratio in ratios)}')


def origin(about: dict) -> str:
    look = ('. **A look, not a record**: ' + ', '.join(look_of(about))) if look_of(about) else ''
    return (f'`{about["command"]}`, {about["date"]}: abbe {about["commit"]}, {about["povray"]}, {about["machine"]}; '
            f'medians of {about["runs"]}; load at the start {about["load"]}{look}.\n')


def look_of(about: dict) -> list:
    """Why figures are no more than a look."""
    return [why for why, holds in (('small sizes', about.get('quick') or about.get('width', 320) < 320), ('some scenes only', about.get('only')),
                                   ('one run', about['runs'] < 3),
                                   ('other work on the machine', about['load'] > about['cores'] / 2)) if holds]


def page(measured: dict | None, corpus: dict | None) -> str:
    """@param measured what `run` keeps @param corpus what `corpus` keeps"""
    text = ['# Performance\n', '<!-- Written by tests/bench/run from the figures in docs/performance: do not edit. -->\n',
            '`tests/bench/run` measures everything and writes this page (some hours; one that was interrupted goes on where it stopped);\n'
            '`tests/bench/run --page` writes it from the figures in `docs/performance/`.\n', MEASURED]
    scenes = Corpus(corpus) if corpus else None
    rows = (scenes.bars() if scenes else []) + [row for of in (measured or {'bars': {}})['bars'].values() for row in of]
    if rows:
        text.append('## Bars\n')
        if measured:
            text.append(origin(measured['about']))
        text.append(bars_table(rows))
    if scenes:
        about = corpus['about']
        text += ['## Every scene that both programs read\n', origin(about),
                 f'{about["width"]}x{about["height"]}; a program is stopped after {number(about["limit"])} s, which then count.\n',
                 scenes.summary(), scenes.scenes()]
        if scenes.failed:
            text.append('Not made by one of them: ' + ', '.join(row['path'] for row in scenes.failed) + '.\n')
    text += ['## What limits it\n', LIMITS]
    if measured and measured.get('kinds'):
        text += ['Where the instructions go (`tests/bench/profile`: callgrind, the kernels of AVX2; all but files and start-up):\n',
                 table(*measured['kinds'])]
    if measured and measured['curves']:
        text.append('## How cost grows\n')
        for name, curve in measured['curves'].items():
            text += [f'### {name.removeprefix("curve_").capitalize()}\n{curve["heading"]}.\n', table(curve['columns'], curve['rows'])]
    if measured and measured['startup']:
        text += ['An empty scene, one pixel:\n', table(['', 'CPU s', 's', 'MB'],
                 [[name, taken['cpu'], taken['wall'], taken['mb']] for name, taken in measured['startup'].items()])]
    if measured and measured['not_measured']:
        text += ['## Not measured\n', *(f'- {" ".join(failure.splitlines()[:3])}' for failure in measured['not_measured'].values()), '']
    return '\n'.join(text).rstrip() + '\n'
