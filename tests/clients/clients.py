# SPDX-License-Identifier: MIT
"""Real programs that write scenes for POV-Ray or call it, with abbe under the name `povray`.

clients.py NAME: one of them; status 77 where it is not installed. Each makes a picture in a folder of its own, which is
read back: its size, and that it shows something in front of something. Where POV-Ray itself is installed and reads the
same file, the pictures are compared.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ABBE = os.environ.get('ABBE', 'abbe')
# Debian's modules are those of its own Python, whichever runs this.
PYTHON = '/usr/bin/python3'
SKIPPED = 77


class Bench:
    """A folder in which `povray` is abbe."""

    def __init__(self) -> None:
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix='abbe-client-'))
        programs = self.folder / 'bin'
        programs.mkdir()
        (programs / 'povray').symlink_to(ABBE)
        (self.folder / 'none.ini').write_text('', encoding='utf-8')
        self.environment = {**os.environ, 'PATH': f'{programs}:/usr/bin:/bin', 'HOME': str(self.folder),
                            'POVINI': str(self.folder / 'none.ini')}

    def run(self, *words: str, **more) -> subprocess.CompletedProcess:
        done = subprocess.run([*map(str, words)], cwd=self.folder, env=self.environment, capture_output=True,
                              timeout=200, check=False, **more)
        if done.returncode != 0:
            sys.exit(f'{" ".join(map(str, words))}: status {done.returncode}\n{done.stdout.decode(errors="replace")}\n'
                     f'{done.stderr.decode(errors="replace")}')
        return done

    def python(self, text: str) -> None:
        self.run(PYTHON, '-c', text)

    def compare(self, one: pathlib.Path, other: pathlib.Path) -> float:
        """PSNR of two pictures, dB."""
        report = json.loads(self.run(ABBE, 'compare', one, other, '--json').stdout)
        psnr = report['srgb']['psnr_db']
        return float('inf') if psnr is None else psnr

    def beside_povray(self, words: list, picture: str, least_db: float) -> None:
        """POV-Ray's own picture of the same command, where it is installed."""
        real = shutil.which('povray', path='/usr/bin:/usr/local/bin')
        ours = self.folder / picture
        if not real:
            return
        kept = ours.with_name('abbe_' + ours.name)
        ours.rename(kept)
        own = {name: value for name, value in self.environment.items() if name != 'POVINI'}  # where its includes are
        done = subprocess.run([real, *words, '-D'], cwd=self.folder, env=own, capture_output=True, check=False)
        if done.returncode != 0:
            sys.exit(f'POV-Ray: {done.stderr.decode(errors="replace")[-600:]}')
        reached = self.compare(kept, ours)
        print(f'{picture}: {reached:.1f} dB beside POV-Ray')
        if reached < least_db:
            sys.exit(f'{picture}: {reached:.1f} dB beside POV-Ray, at least {least_db} dB wanted')


def need(found: bool) -> None:
    if not found:
        sys.exit(SKIPPED)


def has_module(name: str) -> bool:
    return subprocess.run([PYTHON, '-c', f'import {name}'], capture_output=True, check=False).returncode == 0


def check_picture(data: bytes, width: int, height: int) -> None:
    """A PNG of that size whose bytes are not those of one colour."""
    size = (int.from_bytes(data[16:20], 'big'), int.from_bytes(data[20:24], 'big'))
    if data[:8] != b'\x89PNG\r\n\x1a\n' or size != (width, height):
        sys.exit(f'no PNG of {width} x {height}: {data[:8]!r}, {size}')
    if len(data) < 1500:
        sys.exit(f'the picture shows nothing: {len(data)} bytes')


def ase(bench: Bench) -> None:
    """The Atomic Simulation Environment: a scene and its ini file, with a fractional height and alpha."""
    need(has_module('ase'))
    bench.python("from ase.build import molecule\nfrom ase.io import write\na = molecule('C6H6')\na.center(vacuum=2)\n"
                 "write('benzene.pov', a, rotation='20x,30y', povray_settings=dict(canvas_width=200)).render()")
    check_picture((bench.folder / 'benzene.png').read_bytes(), 200, 184)
    bench.beside_povray(['benzene.ini'], 'benzene.png', 25)  # area light with jitter, anti-aliasing with jitter


def pymol(bench: Bench) -> None:
    """PyMOL: `ray` with the renderer of POV-Ray, whose picture it reads back."""
    need(shutil.which('pymol', path='/usr/bin') is not None)
    (bench.folder / 'water.xyz').write_text('3\nwater\nO 0 0 0.12\nH 0 0.76 -0.48\nH 0 -0.76 -0.48\n', encoding='utf-8')
    (bench.folder / 'a.pml').write_text('load water.xyz\nshow spheres\nray 120, 90, renderer=1\npng p.png\n', encoding='utf-8')
    bench.run('/usr/bin/pymol', '-cq', 'a.pml')
    check_picture((bench.folder / 'p.png').read_bytes(), 120, 90)


def graphviz(bench: Bench) -> None:
    """Graphviz: `dot -Tpov`, with text, fog and noise."""
    need(shutil.which('dot') is not None)
    scene = bench.run('dot', '-Tpov', input=b'digraph { a -> b [label="x"]; b -> c; }').stdout
    (bench.folder / 'graph.pov').write_bytes(scene)
    bench.run('povray', '+Igraph.pov', '+W200', '+H150')
    check_picture((bench.folder / 'graph.png').read_bytes(), 200, 150)


def openbabel(bench: Bench) -> None:
    """Open Babel: its own include file, by a library path."""
    need(shutil.which('obabel') is not None)
    folders = sorted(pathlib.Path('/usr/share/openbabel').glob('*/babel_povray3.inc'))
    need(bool(folders))
    bench.run('obabel', '-:CCO', '-opov', '--gen3d', '-O', 'ethanol.pov')
    words = ['+V', '+A', '+D0', '+Q9', '+W160', '+H120', f'+L{folders[-1].parent}', 'ethanol.pov']
    bench.run('povray', *words)
    check_picture((bench.folder / 'ethanol.png').read_bytes(), 160, 120)
    bench.beside_povray(words, 'ethanol.png', 35)  # anti-aliasing with jitter


def vtk(bench: Bench) -> None:
    """VTK's exporter, which ParaView uses too."""
    need(has_module('vtkmodules'))
    bench.python('''
import vtk
source = vtk.vtkSphereSource()
source.SetThetaResolution(24)
mapper = vtk.vtkPolyDataMapper()
mapper.SetInputConnection(source.GetOutputPort())
actor = vtk.vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetColor(1, .5, .2)
renderer = vtk.vtkRenderer()
renderer.AddActor(actor)
renderer.SetBackground(.1, .2, .3)
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.AddRenderer(renderer)
window.SetSize(160, 120)
renderer.ResetCamera()
exporter = vtk.vtkPOVExporter()
exporter.SetRenderWindow(window)
exporter.SetFileName('ball.pov')
exporter.Write()
''')
    words = ['ball.pov', '+W160', '+H120']
    bench.run('povray', *words)
    check_picture((bench.folder / 'ball.png').read_bytes(), 160, 120)
    bench.beside_povray(words, 'ball.png', 45)


def vapory(bench: Bench) -> None:
    """Vapory's call, by a small client of our own: a PPM through a pipe, and a numpy array is what comes of it."""
    scene = ('#version 3.7; global_settings { assumed_gamma 1 } camera { location <0, 2, -3> look_at <0, 1, 2> }\n'
             'light_source { <2, 4, -3> color <1, 1, 1> }\nbackground { color <1, 1, 1> }\n'
             'sphere { <0, 1, 2> 2 texture { pigment { color <1, 0, 1> } } }\n')
    (bench.folder / '__temp__.pov').write_text(scene, encoding='utf-8')
    words = ['__temp__.pov', '+W100', '+H75', 'Output_File_Type=P', '+O-', 'Display=off', 'Antialias=on',
             'Antialias_Threshold=0.01', 'Quality=11']
    picture = bench.run('povray', *words).stdout
    head = picture.split(b'\n255\n')[0].splitlines()
    if head[0] != b'P6' or head[-1] != b'100 75':
        sys.exit(f'no PPM of 100 x 75: {head!r}')
    codes = picture.split(b'\n255\n', 1)[1]
    middle = codes[3 * (37 * 100 + 50):][:3]
    if len(codes) != 3 * 100 * 75 or not (middle[0] > 100 and middle[1] == 0 and middle[2] > 100):
        sys.exit(f'the picture shows no magenta ball: {len(codes)} codes, {tuple(middle)} in the middle')


if __name__ == '__main__':
    clients = {f.__name__: f for f in (ase, pymol, graphviz, openbabel, vtk, vapory)}
    one = Bench()
    try:
        clients[sys.argv[1]](one)
    finally:
        shutil.rmtree(one.folder, ignore_errors=True)
