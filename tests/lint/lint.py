#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the rules of the house that a compiler does not.

    lint.py [--root DIR] RULE...     (no rule: all but `format`)

Prints offenders as `path:line: what is wrong` and returns 1 if there are any; 77: the rule could not be
checked here (ctest shows it as skipped).
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys

# What each folder may include besides itself: the direction of data through the house.
MAY_INCLUDE = {
    'base': set(),
    'simd': {'base'},
    'grammar': {'base'},
    'optics': {'base', 'simd'},
    'geometry': {'base', 'simd'},
    'texture': {'base', 'simd'},
    'field': {'base', 'simd'},
    'image': {'base'},
    'font': {'base'},
    'scene': {'base', 'simd', 'optics', 'geometry', 'texture'},
    'lang': {'base', 'simd', 'optics', 'geometry', 'texture', 'field', 'scene', 'grammar', 'image', 'font'},
    'plan': {'base', 'simd', 'optics', 'geometry', 'texture', 'scene', 'image'},
    'surface': {'base', 'simd', 'geometry', 'texture', 'scene'},
    'transport': {'base', 'simd', 'optics', 'geometry', 'texture', 'scene', 'surface'},
    'render': {'base', 'simd', 'optics', 'geometry', 'texture', 'scene', 'plan', 'surface', 'transport', 'image'},
    'job': {'base', 'simd', 'optics', 'geometry', 'texture', 'scene', 'plan', 'surface', 'transport', 'render', 'image'},
    'study': {'base', 'simd', 'optics', 'geometry', 'texture', 'scene', 'plan', 'surface', 'transport', 'render', 'image', 'job'},
}
MAY_INCLUDE['cli'] = set(MAY_INCLUDE)
MAY_INCLUDE['library'] = set(MAY_INCLUDE) - {'study', 'cli'}
MAY_INCLUDE['src'] = set()  # src/abbe.hpp, the public header: plain types only

# Hard limits; data tables (*_table.cpp) are exempt.
MOST_LINES = {'.cpp': 600, '.hpp': 300}

PRINTING = re.compile(r'std::(?:cout|cerr|clog|puts|print|println|perror)\b'
                      r'|(?<![\w:])(?:std::|::)?(?:v?f?printf|f?puts|f?putc|putchar|perror)\s*\('
                      r'|fmt::v?print\b')
# Printing that is no message to a user: path -> why it may.
MAY_PRINT = {'src/base/result.hpp': 'ABBE_ASSERT reports a bug of ours before it aborts'}

PICTURES = ('.png', '.jpg', '.jpeg', '.webp')


class House:
    """The files of the checkout."""

    def __init__(self, root: pathlib.Path) -> None:
        self.root = root

    def sources(self, *folders: str, endings: tuple = ('.cpp', '.hpp')) -> list:
        return sorted(path for folder in folders for path in (self.root / folder).rglob('*')
                      if path.is_file() and path.suffix in endings)

    def name(self, path: pathlib.Path) -> str:
        return path.relative_to(self.root).as_posix()

    def folder(self, path: pathlib.Path) -> str:
        """The folder of the house: src/optics/x.cpp -> optics, grammar/x.cpp -> grammar."""
        parts = path.relative_to(self.root).parts
        return parts[1] if parts[0] == 'src' and len(parts) > 2 else parts[0]


def blank(match: re.Match) -> str:
    return re.sub(r'[^\n]', ' ', match.group())


def code_lines(path: pathlib.Path, keep_strings: bool = False) -> list:
    """The lines of a C++ file with comments (and the content of literals) blanked out."""
    tokens = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"'
                        r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'", re.S)

    def replace(match: re.Match) -> str:
        comment = match.group().startswith(('//', '/*'))
        return blank(match) if comment or not keep_strings else match.group()

    return tokens.sub(replace, path.read_text(encoding='utf-8')).split('\n')


def matches(house: House, paths: list, pattern: re.Pattern, text: str) -> list:
    return [f'{house.name(path)}:{number}: {text}: {line.strip()}'
            for path in paths
            for number, line in enumerate(code_lines(path), 1) if pattern.search(line)]


def check_includes(house: House) -> list:
    """Includes go one way."""
    found = []
    for path in house.sources('src', 'grammar'):
        folder = house.folder(path)
        if folder not in MAY_INCLUDE:
            found.append(f'{house.name(path)}:1: no rule says what {folder} may include')
            continue
        for number, line in enumerate(code_lines(path, keep_strings=True), 1):
            include = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
            if not include:
                continue
            target, quoted = include.group(1).split('/')[0], '"' in line
            if target in MAY_INCLUDE and '/' in include.group(1):
                if target != folder and target not in MAY_INCLUDE[folder]:
                    found.append(f'{house.name(path)}:{number}: {folder} must not include {target}:'
                                 f' {line.strip()}')
            elif quoted and not include.group(1).endswith('.def'):
                found.append(f'{house.name(path)}:{number}: write the path from src/ or the root:'
                             f' {line.strip()}')
    return found


def check_sizes(house: House) -> list:
    """Files stay small enough to be read."""
    found = []
    for path in house.sources('src', 'grammar', 'tests'):
        if path.name.endswith('_table.cpp'):
            continue
        lines = path.read_text(encoding='utf-8').count('\n')
        if lines > MOST_LINES[path.suffix]:
            found.append(f'{house.name(path)}:{lines}: {lines} lines, at most '
                         f'{MOST_LINES[path.suffix]} are allowed')
    return found


def check_pragma_once(house: House) -> list:
    """Headers begin with #pragma once, and only headers."""
    found = []
    for path in house.sources('src', 'grammar', 'tests'):
        count = sum(bool(re.match(r'\s*#\s*pragma\s+once\b', line)) for line in code_lines(path))
        if count != (path.suffix == '.hpp'):
            found.append(f'{house.name(path)}:1: {count} times #pragma once')
    return found


def check_spdx(house: House) -> list:
    """The first line (after #!) of each source file names the licence."""
    found = []
    for path in house.sources('src', 'grammar', 'tests', endings=('.cpp', '.hpp', '.def', '.py')):
        lines = path.read_text(encoding='utf-8').split('\n') + ['']
        line = lines[1] if lines[0].startswith('#!') else lines[0]
        if line not in ('// SPDX-License-Identifier: MIT', '# SPDX-License-Identifier: MIT'):
            found.append(f'{house.name(path)}:1: no line "SPDX-License-Identifier: MIT"')
    return found


def check_using_namespace(house: House) -> list:
    """No using namespace."""
    return matches(house, house.sources('src', 'grammar', 'tests'),
                   re.compile(r'\busing\s+namespace\b'), 'using namespace')


def check_printing(house: House) -> list:
    """Nothing prints outside src/cli."""
    paths = [path for path in house.sources('src', 'grammar')
             if house.folder(path) != 'cli' and house.name(path) not in MAY_PRINT]
    return matches(house, paths, PRINTING, 'prints outside src/cli')


def check_gallery(house: House) -> list:
    """Every example has its picture."""
    gallery = house.root / 'docs' / 'gallery'
    return [f'{house.name(path)}:1: no picture docs/gallery/{path.stem}.png'
            for path in house.sources('examples', endings=('.scn',))
            if not any((gallery / (path.stem + ending)).is_file() for ending in PICTURES)]


def check_readmes(house: House) -> list:
    """Every folder says what it is for."""
    folders = [path for path in (house.root / 'src').iterdir() if path.is_dir()]
    return [f'{house.name(folder)}:1: no README.md'
            for folder in sorted(folders) + [house.root / 'grammar']
            if any(folder.iterdir()) and not (folder / 'README.md').is_file()]


def check_format(house: House) -> list:
    """clang-format has nothing to change."""
    program = shutil.which('clang-format-14') or shutil.which('clang-format')
    version = subprocess.run([program, '--version'], capture_output=True, text=True,
                             check=True).stdout if program else ''
    if ' version 14.' not in version:
        print('skipped: clang-format 14 is not installed')
        sys.exit(77)
    paths = house.sources('src', 'grammar', 'tests')
    run = subprocess.run([program, '--dry-run', '--style=file', *map(str, paths)],
                         capture_output=True, text=True, cwd=house.root, check=False)
    warnings = re.findall(r'^(.+?):(\d+):\d+: warning:', run.stderr, re.M)
    return [f'{house.name(pathlib.Path(path))}:{line}: not formatted (clang-format -i)'
            for path, line in dict(reversed(warnings)).items()]


RULES = {name.removeprefix('check_'): function for name, function in list(globals().items())
         if name.startswith('check_')}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--root', type=pathlib.Path, default=pathlib.Path(__file__).parents[2])
    parser.add_argument('rules', nargs='*', metavar='RULE', help=', '.join(RULES))
    arguments = parser.parse_args()
    unknown = set(arguments.rules) - set(RULES)
    if unknown:
        parser.error(f'no such rule: {", ".join(sorted(unknown))}; there are {", ".join(RULES)}')
    house = House(arguments.root.resolve())
    found = [offender for rule in arguments.rules or [r for r in RULES if r != 'format']
             for offender in RULES[rule](house)]
    print('\n'.join(found) if found else 'nothing to complain about')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
