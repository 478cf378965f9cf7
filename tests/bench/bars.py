# SPDX-License-Identifier: MIT
"""The bars of issue 4, each measured. A bar returns rows of (what, wanted, measured, met, how)."""
import dataclasses
import os
import pathlib
import statistics

import harness
import scenes

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / 'examples'
TWIN = pathlib.Path(__file__).resolve().parent / 'scenes/prism.pov'
FULL_BRILLIANT = TWIN.parent / 'brilliant_full.scn'


@dataclasses.dataclass
class Row:
    what: str
    wanted: float
    measured: float
    at_most: bool     # wanted is an upper bound
    unit: str
    how: str          # the figures that it is made of

    @property
    def met(self) -> bool:
        return self.measured <= self.wanted if self.at_most else self.measured >= self.wanted


def dispersion_price(bench, name, scene, mode, wanted, *words, size) -> Row:
    """What a mode of dispersion costs beside none at the same number of bands."""
    taken = bench.race({'none': bench.render(scene, '--dispersion', 'none', *words, size=size),
                        mode: bench.render(scene, '--dispersion', mode, *words, size=size)})
    none, with_it = (bench.net('abbe', taken[key]) for key in ('none', mode))
    return Row(f'{name}, 8 bands {mode} against none', wanted, with_it / none, True, 'times',
               f'{size[0]}x{size[1]}: {with_it:.3f} s, {taken[mode].rays:.0f} rays; none {none:.3f} s, '
               f'{taken["none"].rays:.0f} rays')


def prism_detail(bench) -> list:
    size = (180, 113) if bench.quick else (360, 226)
    scene = EXAMPLES / 'prism_detail.scn'
    return [dispersion_price(bench, 'prism_detail', scene, 'deterministic', 2.0, size=size),
            dispersion_price(bench, 'prism_detail', scene, 'stochastic', 2.2, size=size)]


def prism(bench) -> list:
    size = (180, 113) if bench.quick else (640, 480)
    return [dispersion_price(bench, 'whole prism.scn', EXAMPLES / 'prism.scn', 'deterministic', 1.5, '--bands', 8,
                             size=size)]


def brilliant(bench) -> list:
    size = (80, 60) if bench.quick else (160, 120)
    return [dispersion_price(bench, 'full-screen brilliant', FULL_BRILLIANT, 'deterministic', 2.5, '--bands', 8,
                             size=size)]


def against_povray(bench, name, scene, wanted, abbe_words, povray_words, size, agreement=True) -> Row:
    taken = bench.race({'abbe': bench.render(scene, *abbe_words, size=size),
                        'povray': bench.povray(scene, *povray_words, size=size)})
    ours, theirs = (bench.net(program, taken[program]) for program in ('abbe', 'povray'))
    shown = bench.agree()
    psnr = 'identical' if shown['psnr_db'] is None else f'{shown["psnr_db"]:.1f} dB'
    if agreement and shown['psnr_db'] is not None and shown['psnr_db'] < 35:
        raise harness.Failed(f'{name}: the two pictures are {psnr} apart: no fair race')
    return Row(name, wanted, theirs / ours, False, 'times faster',
               f'{size[0]}x{size[1]}, 1 thread: abbe {ours:.3f} s, {taken["abbe"].rays:.0f} rays, povray {theirs:.3f} s; '
               f'pictures {psnr} apart')


def plain(bench) -> list:
    size = (320, 240) if bench.quick else (800, 600)
    return [against_povray(bench, 'prism.scn without dispersion against POV-Ray', TWIN, 10, (), (), size),
            against_povray(bench, 'csg.scn against POV-Ray', EXAMPLES / 'csg.scn', 10, (), (), size)]


def samples(bench) -> list:
    size = (160, 120) if bench.quick else (320, 240)
    return [against_povray(bench, f'prism, {count} bands against dispersion_samples {count}', TWIN, wanted,
                           ('-D', f'Samples={count}', '--bands', count), (f'Declare=Samples={count}',), size,
                           agreement=False)
            for count, wanted in ((8, 25), (16, 40), (45, 60))]


def large(bench) -> list:
    count = 10 ** 5 if bench.quick else 10 ** 6
    rows = []
    for name, make in (('spheres', lambda path: scenes.spheres(path, count)),
                       ('spheres of a #while with one texture', lambda path: scenes.sphere_loop(path, count)),
                       ('triangles in a mesh2', lambda path: scenes.mesh(path, round((count / 2) ** 0.5) + 1))):
        scene = bench.folder / 'large.pov'
        make(scene)
        taken = bench.race({'abbe': bench.render(scene), 'povray': bench.povray(scene)},
                           runs=1 if bench.quick else 0)
        ours, theirs = taken['abbe'], taken['povray']
        agreed = bench.agree()['psnr_db']
        how = (f'{scene.stat().st_size / 1e6:.0f} MB of text, 320x240, 1 thread: abbe {ours.cpu:.2f} s {ours.mb:.0f} MB, '
               f'povray {theirs.cpu:.2f} s {theirs.mb:.0f} MB; pictures '
               f'{"identical" if agreed is None else f"{agreed:.1f} dB apart"}')
        rows += [Row(f'{count} {name}: parse, build, render', 5, theirs.cpu / ours.cpu, False, 'times faster', how),
                 Row(f'{count} {name}: memory', 0.5, ours.mb / theirs.mb, True, 'times POV-Ray\'s', how)]
        scene.unlink()
    return rows


def loading(bench) -> list:
    scene = bench.folder / 'mesh.pov'
    scenes.mesh(scene, 366 if bench.quick else 1037)
    taken = bench.race({'abbe': bench.render(scene, size=(1, 1)), 'povray': bench.povray(scene, size=(1, 1))},
                       runs=1 if bench.quick else 0)
    ours, theirs = taken['abbe'], taken['povray']
    size = scene.stat().st_size / 1e6
    scene.unlink()
    return [Row(f'loading a mesh2 of {size:.0f} MB', 10, theirs.cpu / ours.cpu, False, 'times faster',
                f'one pixel: abbe {ours.cpu:.2f} s {ours.mb:.0f} MB, povray {theirs.cpu:.2f} s {theirs.mb:.0f} MB')]


def threads(bench) -> list:
    scene = EXAMPLES / 'prism.scn'
    size = (240, 180) if bench.quick else (640, 480)
    taken = bench.race({n: bench.render(scene, size=size, threads=n) for n in (1, 2)})
    # What the machine's cores give together, whatever the program does about it.
    twice = [[bench.folder / f'{n}.png' if word == bench.folder / 'abbe.png' else word
              for word in bench.render(scene, size=size, threads=1)] for n in (1, 2)]
    both = statistics.median(bench.side_by_side(twice) for _ in range(bench.runs))
    return [Row('two threads against one', 1.9, taken[1].wall / taken[2].wall, False, 'times faster',
                f'prism.scn {size[0]}x{size[1]}: {taken[1].wall:.2f} s and {taken[2].wall:.2f} s of the clock; '
                f'CPU {taken[1].cpu:.2f} s and {taken[2].cpu:.2f} s; two processes of one thread side by side do '
                f'{2 * taken[1].wall / both:.2f} times the work of one; load of the machine {os.getloadavg()[0]:.1f}')]


def start(bench) -> list:
    scene = bench.folder / 'plain.pov'
    scene.write_text(scenes.PLAIN, encoding='utf-8')
    taken = bench.race({'abbe': bench.render(scene, threads=os.cpu_count()),
                        'povray': bench.povray(scene, threads=os.cpu_count())}, runs=max(5, bench.runs))
    return [Row('a plain scene, start to file, 320x240', 50, 1e3 * taken['abbe'].wall, True, 'ms',
                f'abbe {1e3 * taken["abbe"].wall:.0f} ms of the clock, {1e3 * taken["abbe"].cpu:.0f} ms CPU; povray '
                f'{1e3 * taken["povray"].wall:.0f} and {1e3 * taken["povray"].cpu:.0f}')]


BARS = {'prism_detail': prism_detail, 'prism': prism, 'brilliant': brilliant, 'plain': plain, 'samples': samples,
        'large': large, 'loading': loading, 'threads': threads, 'start': start}
