#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Installs a build into a folder, or packs it, and uses what comes out.

    install_test.py program|library|package BUILD     (77: what it needs is not installed)
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

SCENE = '''#include "colors.inc"
camera { location <0, 0, -4> look_at 0 }
light_source { <-5, 5, -5>, rgb 1 }
sphere { 0, 1 pigment { Red } interior { glass { "SCHOTT/N-BK7" } } }
'''


def run(*command, **more) -> str:
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False, **more)
    assert done.returncode == 0, f'{command}: status {done.returncode}\n{done.stdout}'
    return done.stdout


def render_with(program: pathlib.Path, folder: pathlib.Path) -> None:
    """The program finds its includes and glasses with no help from the environment."""
    (folder / 'scene.scn').write_text(SCENE, encoding='utf-8')
    run(program, 'render', 'scene.scn', '-W', 16, '-H', 12, '-o', 'picture.png', cwd=folder, env={})
    assert (folder / 'picture.png').read_bytes().startswith(b'\x89PNG')
    assert 'N-BK7' in run(program, 'glass', 'list', env={}, cwd=folder)


def check_program(build: pathlib.Path, folder: pathlib.Path) -> None:
    run('cmake', '--install', build, '--prefix', folder / 'there', '--component', 'program')
    moved = folder / 'moved'  # nothing remembers where it was installed
    (folder / 'there').rename(moved)
    render_with(moved / 'bin/abbe', folder)
    assert bytes(ROOT) not in (moved / 'bin/abbe').read_bytes(), 'the program names its sources'
    for name in ('copyright', 'README.md', 'docs/language.md'):
        assert list(moved.glob(f'share/doc/abbe/{name}')), f'{name} is not installed'


def check_library(build: pathlib.Path, folder: pathlib.Path) -> None:
    run('cmake', '--install', build, '--prefix', folder / 'there')
    header = (folder / 'there/include/abbe.hpp').read_text(encoding='utf-8')
    foreign = [name for name in re.findall(r'#include\s*[<"](.*)[>"]', header)
               if not re.fullmatch(r'[a-z_]+', name)]
    assert not foreign, f'the public header includes {foreign}'
    run('cmake', '-S', ROOT / 'tests/install/outside', '-B', folder / 'build',
        f'-DCMAKE_PREFIX_PATH={folder / "there"}', f'-DEXAMPLE={ROOT / "examples/render_to_memory.cpp"}')
    run('cmake', '--build', folder / 'build')
    stdlib = folder / 'there/share/abbe/stdlib'
    drawn = run(folder / 'build/render_to_memory', env={'ABBE_STDLIB': str(stdlib)}).splitlines()
    # A ball that is lit from the upper left: bright there, dark at the lower right, nothing around.
    assert len(drawn) == 16 and all(len(line) == 64 for line in drawn), drawn
    assert drawn[4][22] == '#' and drawn[11][33] == '.' and drawn[0][0] == ' ', drawn


def check_package(build: pathlib.Path, folder: pathlib.Path) -> None:
    if not all(shutil.which(tool) for tool in ('cpack', 'dpkg-deb', 'dpkg-shlibdeps')):
        sys.exit(77)
    run('cpack', '-G', 'DEB', '--config', build / 'CPackConfig.cmake', '-B', folder)
    packages = {path.name.split('_')[0]: path for path in folder.glob('*.deb')}
    assert sorted(packages) == ['abbe', 'libabbe-dev'], packages
    depends = run('dpkg-deb', '-f', packages['abbe'], 'Depends')
    for library in ('libc6', 'libstdc++6', 'libtbb', 'libpng', 'libtiff', 'libfreetype', 'libopenexr', 'libfmt'):
        assert library in depends, f'{library} is not among: {depends}'
    assert '-dev' not in depends, depends
    root = folder / 'root'
    (root / 'var/lib/dpkg').mkdir(parents=True)
    # What it depends on is the machine's; scripts there are none.
    run('dpkg', '--root', root, '--force-depends', '--force-not-root', '--force-bad-path', '-i', packages['abbe'])
    render_with(root / 'usr/bin/abbe', folder)
    assert 'share/abbe/stdlib/colors.inc' in run('dpkg', '--root', root, '-L', 'abbe')
    contents = run('dpkg-deb', '-c', packages['libabbe-dev'])
    for name in ('include/abbe.hpp', 'libabbe.a', 'abbe-config.cmake'):
        assert name in contents, contents


def main() -> None:
    part, build = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory(prefix='abbe-install-') as folder:
        {'program': check_program, 'library': check_library, 'package': check_package}[part](
            build, pathlib.Path(folder))


if __name__ == '__main__':
    main()
