# SPDX-License-Identifier: MIT
"""The page of a comparison: one file that holds all pictures."""
import base64
import html
import math
import pathlib

STYLE = '''
:root { color-scheme: light dark; font: 15px/1.5 system-ui, sans-serif; }
body { margin: 2rem auto; max-width: 70rem; padding: 0 1rem; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; padding: .2rem .6rem; border-bottom: 1px solid #8884; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
.pair { position: relative; display: inline-block; line-height: 0; }
.pair img { display: block; }
.pair .over { position: absolute; inset: 0; clip-path: inset(0 0 0 calc(var(--at, 50) * 1%)); }
.pair input { width: 100%; margin: .4rem 0 0; }
figure { display: inline-block; margin: .5rem 1rem .5rem 0; }
figcaption { font-size: 85%; opacity: .7; line-height: 1.4; }
'''
SCRIPT = '''
for (const input of document.querySelectorAll('.pair input'))
  input.addEventListener('input', () => input.parentElement.style.setProperty('--at', input.value));
'''


def picture(path: pathlib.Path, words: str, cls: str = '') -> str:
    data = base64.b64encode(path.read_bytes()).decode()
    return f'<img class="{cls}" alt="{html.escape(words)}" src="data:image/png;base64,{data}">'


def details(result: dict, keep: pathlib.Path) -> str:
    ours, theirs, apart = (keep / f'{result["id"]}.{kind}.png' for kind in ('abbe', 'povray', 'difference'))
    if 'psnr_db' not in result or not all(path.is_file() for path in (ours, theirs, apart)):
        return ''
    name = result['name']
    return (f'<figure class="pair">{picture(theirs, name + " by POV-Ray")}{picture(ours, name + " by abbe", "over")}'
            f'<input type="range" min="0" max="100" value="50" aria-label="POV-Ray left, abbe right: {html.escape(name)}">'
            '<figcaption>POV-Ray left, abbe right</figcaption></figure>'
            f'<figure>{picture(apart, "difference, 8 fold")}<figcaption>difference, 8 fold</figcaption></figure>')


def row(result: dict, keep: pathlib.Path) -> str:
    def number(value, form: str) -> str:
        return f'<td class="number">{"" if value is None else format(value, form)}</td>'
    why = ' '.join(f'{program}: {result[program]["why"]}' for program in ('povray', 'abbe') if 'why' in result[program])
    identical = 'psnr_db' in result and result['psnr_db'] is None
    shown = '<td class="number">identical</td>' if identical else number(result.get('psnr_db'), '.1f')
    cells = (f'<td>{html.escape(result["name"])}</td>{shown}{number(result.get("delta_e"), ".2f")}'
             + ''.join(number(result[program].get(key), form) for key, form in (('cpu_s', '.2f'), ('mib', '.0f'))
                       for program in ('abbe', 'povray')))
    below = details(result, keep) or html.escape(why)
    if below:
        cells += f'</tr><tr class="below"><td colspan="7">{below}</td>'
    return f'<tr class="scene">{cells}</tr>'


def order(result: dict) -> tuple:
    """Worst first: no picture of ours, then by PSNR; what POV-Ray does not render comes last."""
    psnr = result.get('psnr_db', -1.0)
    return ('why' in result['povray'], math.inf if psnr is None else psnr, result['name'])


def page(results: list, found: dict, keep: pathlib.Path, options) -> str:
    from folders import summary_lines
    lines = ''.join(f'<p>{html.escape(line)}.</p>' for line in summary_lines(found))
    rows = '\n'.join(row(result, keep) for result in sorted(results, key=order))
    return (f'<!doctype html>\n<html lang="en"><meta charset="utf-8"><title>abbe beside POV-Ray</title><style>{STYLE}</style>\n'
            f'<h1>abbe beside POV-Ray</h1>{lines}<p>{options.width}x{options.height}, one thread, no anti-aliasing, +Q8. '
            'Worst first.</p>\n<table><thead><tr><th>scene<th>PSNR, dB<th>CIEDE2000<th>abbe, s<th>POV-Ray, s<th>abbe, MB'
            f'<th>POV-Ray, MB</tr></thead><tbody>\n{rows}\n</tbody></table><script>{SCRIPT}</script></html>\n')
