# SPDX-License-Identifier: MIT
"""docs/performance.md from what was measured. Tables hold figures only; words are here."""
import dataclasses


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
    return table(['bar', 'wanted', 'measured', 'met', 'made of'],
                 [[row.what, ('<= ' if row.at_most else '>= ') + number(row.wanted), f'{number(row.measured)} {row.unit}',
                   'yes' if row.met else '**no**', row.how] for row in rows])


def write(path, about: dict, startup: dict, bars: dict, curves: dict, failures: list) -> None:
    text = ['# Performance\n', '<!-- Written by tests/bench/run; the figures are also in performance.json. -->\n',
            f'`{about["command"]}` on {about["date"]}: abbe {about["commit"]}, {about["povray"]}, {about["machine"]}, '
            f'load {about["load"]} at the start. Times are CPU seconds (user and system) of one thread unless a table '
            f'says otherwise; medians of {about["runs"]} runs, programs in turn. Start-up is taken off ratios of renders:\n',
            table(['empty scene, 1 pixel', 'CPU s', 's', 'MB'],
                  [[name, taken.cpu, taken.wall, taken.mb] for name, taken in startup.items()])]
    if bars:
        text += ['## Bars\n', bars_table([row for rows in bars.values() for row in rows])]
    if curves:
        text.append('## Curves\n')
        for name, (heading, columns, rows) in curves.items():
            text += [f'### {name.removeprefix("curve_")}\n{heading}.\n', table(columns, rows)]
    if failures:
        text += ['## Not measured\n', *(f'- {failure}' for failure in failures), '']
    path.write_text('\n'.join(text).rstrip() + '\n', encoding='utf-8')


def as_json(about: dict, startup: dict, bars: dict, curves: dict, failures: list) -> dict:
    return {'about': about,
            'startup': {name: dataclasses.asdict(taken) for name, taken in startup.items()},
            'bars': {name: [dict(dataclasses.asdict(row), met=row.met) for row in rows] for name, rows in bars.items()},
            'curves': {name: {'heading': heading, 'columns': columns, 'rows': rows}
                       for name, (heading, columns, rows) in curves.items()},
            'not_measured': failures}
