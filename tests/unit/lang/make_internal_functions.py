#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes internal_functions.tsv: what the installed povray gives for the functions of functions.inc.

Run once, by hand, where povray is installed; the table is ground truth for internal_functions_test.cpp. A row is a
number n of `internal(n)`, its arguments, the value.
"""
import pathlib
import random
import re
import subprocess
import tempfile

# Numbers and how many parameters follow x, y and z.
EXTRA = {0: 5, 1: 5, 2: 5, 3: 5, 4: 2, 5: 2, 6: 5, 7: 4, 8: 2, 10: 4, 11: 1, 12: 1, 13: 1, 14: 1, 15: 6, 16: 6, 17: 3, 19: 4,
         20: 3, 21: 6, 22: 1, 23: 1, 25: 7, 26: 7, 27: 1, 28: 1, 29: 6, 30: 1, 31: 3, 32: 4, 33: 3, 34: 6, 35: 1, 36: 1, 37: 4,
         38: 1, 39: 6, 40: 5, 41: 1, 42: 1, 43: 1, 44: 4, 45: 1, 46: 3, 47: 0, 48: 1, 49: 1, 50: 7, 51: 5, 52: 6, 53: 1, 54: 1,
         55: 1, 56: 3, 57: 0, 58: 6, 59: 6, 60: 4, 61: 1, 62: 5, 63: 4, 64: 6, 65: 1, 66: 4, 67: 7, 68: 2, 69: 0, 70: 2, 71: 3,
         72: 1, 73: 1, 74: 2, 75: 6, 76: 0, 78: 1}
ROWS = 8


def arguments(number: int) -> list:
    point = [round(random.uniform(-1.3, 1.3), 3) for _ in range(3)]
    extra = [round(random.uniform(.2, 1.5), 3) for _ in range(EXTRA[number])]
    if number in (25, 52):
        extra[0] = random.choice([1, 2, 3, 5])
    if number in (25, 26):
        extra[5] = random.choice([0, .5, 1, 2, 3])
    if number == 64:
        extra[5] = random.choice([0, .5, 1, 2, 3])
    if number in (29, 59):
        extra[2:] = [random.choice([1, 2, 4]), round(random.uniform(.2, 1), 3), random.choice([0, 1, 2, .4]), random.choice([1, 2, 3])]
    if number == 58:
        extra[1], extra[5] = random.choice([1, 2, 4]), random.choice([1, 2, 3])
    if number == 78:
        extra = [random.choice([1, 2, 3])]
    if number < 4 or number in (15, 21, 34, 39, 50, 67, 75):
        extra[-3] = random.choice([-1, 0, 1])
        extra[-1] *= 30
    return [*point, *(round(value, 4) for value in extra)]


def main() -> None:
    random.seed(1)
    rows = [(number, arguments(number)) for number in EXTRA for _ in range(ROWS)]
    text = '#version 3.7;\nglobal_settings { assumed_gamma 1 }\n'
    for number, given in rows:
        text += f'#declare F = function {{ internal({number}) }}\n#debug concat("VALUE ", str(F({", ".join(map(str, given))}), 0, 12), "\\n")\n#undef F\n'
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder, 'values.pov')
        scene.write_text(text, encoding='ascii')
        done = subprocess.run(['povray', f'+I{scene}', '-D', '-F', '+W1', '+H1'], capture_output=True, text=True, check=True)
    values = re.findall(r'^VALUE (\S+)', done.stderr + done.stdout, re.MULTILINE)
    assert len(values) == len(rows), len(values)
    lines = ['\t'.join([str(number), ' '.join(map(str, given)), value]) for (number, given), value in zip(rows, values)]
    pathlib.Path(__file__).with_name('internal_functions.tsv').write_text('\n'.join(lines) + '\n', encoding='ascii')


if __name__ == '__main__':
    main()
