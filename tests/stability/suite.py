#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds abbe to the criteria of a family of hard cases (families.py).

    suite.py --abbe PROGRAM [--full] [--povray] [FAMILY...]      no family: all

Prints what was measured; exit status 1 when a criterion is not met. --povray: measures POV-Ray instead.
"""
import argparse
import pathlib
import sys

sys.dont_write_bytecode = True
import families  # noqa: E402
import pictures  # noqa: E402


def failures(family: str, row: families.Row) -> list:
    return [v for v in row.variants if not v.passed and (family, v.label) not in families.UNMET]


def describe(family: str, row: families.Row) -> str:
    shown, failed = [], failures(family, row)
    for v in row.variants:
        value = 'none' if v.value is None else f'{v.value:.3g}'
        shown.append(f'{v.label}: {value}{"" if v.passed else " FAILED" if v in failed else " unmet"}')
    return f'  {"FAILED" if failed else "ok    " if row.passed else "unmet "} {row.name:<30} [{row.unit}] {"; ".join(shown)}'


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('families', nargs='*', choices=[[], *families.FAMILIES], metavar='FAMILY')
    parser.add_argument('--abbe', default='')
    parser.add_argument('--full', action='store_true')
    parser.add_argument('--povray', action='store_true')
    parser.add_argument('--list', action='store_true', help='print the names of the families')
    parser.add_argument('--keep', type=pathlib.Path, help='leave the pictures here')
    options = parser.parse_args()
    if options.list:
        print('\n'.join(families.FAMILIES))
        return 0
    failed = 0
    with pictures.workspace() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        if options.povray:
            render = pictures.PovRay(120, 90, folder)
        else:
            render = pictures.Abbe(pictures.find_abbe(options.abbe), 120, 90, folder)
        for name in options.families or families.FAMILIES:
            print(name)
            for row in families.FAMILIES[name](render, options.full):
                print(describe(name, row), flush=True)
                failed += bool(failures(name, row))
    return int(failed > 0)


if __name__ == '__main__':
    sys.exit(main())
