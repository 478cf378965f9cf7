# SPDX-License-Identifier: MIT
"""The bars, each measured: a bar returns rows of what was wanted, what was measured, and what that is made of."""
import dataclasses
import os
import pathlib
import re
import statistics
import subprocess

import harness
import scenes

ROOT = harness.ROOT
EXAMPLES = ROOT / 'examples'
TWIN = pathlib.Path(__file__).resolve().parent / 'scenes/prism.pov'
FULL_BRILLIANT = TWIN.parent / 'brilliant_full.scn'
GLASSY = TWIN.parent / 'glassy.pov'


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


def ns_a_ray(bench, taken) -> float:
    return 1e9 * bench.net('abbe', taken) / taken.rays


def glassy(bench) -> list:
    size = (160, 120) if bench.quick else (320, 240)
    rows = []
    for name, words in (('perspective', ()), ('orthographic', ('-D', 'Ortho=1'))):
        taken = bench.race({'abbe': bench.render(GLASSY, *words, size=size)})['abbe']
        rows.append(Row(f'glassy scene, {name}', 60, ns_a_ray(bench, taken), True, 'ns a ray',
                        f'{size[0]}x{size[1]}: {bench.net("abbe", taken):.3f} s, {taken.rays:.0f} rays'))
    return rows


MODES = 'hero 4', 'clusters 4 degrade', 'adaptive tolerance 0.5', 'stochastic fanout 2', 'stochastic'


def modes(bench) -> list:
    """What a ray of each mode of dispersion takes, in turn with the deterministic one."""
    size = (180, 113) if bench.quick else (360, 226)
    taken = bench.race({mode: bench.render(EXAMPLES / 'prism_detail.scn', '--bands', 8, '--dispersion', mode, size=size)
                        for mode in ('deterministic', *MODES)})
    each = {mode: ns_a_ray(bench, of) for mode, of in taken.items()}

    def how(mode: str) -> str:
        return f'{size[0]}x{size[1]}: {bench.net("abbe", taken[mode]):.3f} s, {taken[mode].rays:.0f} rays'

    return [Row('prism_detail, 8 bands, deterministic', 45, each['deterministic'], True, 'ns a ray', how('deterministic')),
            *(Row(f'the same, {mode}, a ray', 1.6, each[mode] / each['deterministic'], True, 'times deterministic',
                  f'{each[mode]:.0f} ns; {how(mode)}') for mode in MODES)]


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


def samples(bench) -> list:
    size = (160, 120) if bench.quick else (320, 240)
    return [against_povray(bench, f'prism, {count} bands against dispersion_samples {count}', TWIN, 9,
                           ('-D', f'Samples={count}', '--bands', count), (f'Declare=Samples={count}',), size,
                           agreement=False)
            for count in (8, 16, 45)]


def embree(bench) -> list:
    """The program is built where libembree-dev is: ninja bench_hierarchy."""
    program = pathlib.Path(bench.abbe).parent / 'tests/bench/bench_hierarchy'
    if not program.exists():
        raise harness.Failed(f'there is no {program.name}: ninja -C {program.parents[2].name} bench_hierarchy')
    text = subprocess.run([program, 'waves'], capture_output=True, text=True, check=True).stdout
    found = re.search(r'Embree: (.*): abbe takes ([\d.]+) times that', text)
    if not found:
        raise harness.Failed('bench_hierarchy was built without Embree (apt-get install libembree-dev)')
    ours = re.search(r'camera rays .*? (\d+) ns, .*? shadow rays .*? (\d+) ns; mean (\d+) ns', text)
    return [Row("camera and shadow rays against 10^6 triangles, beside Embree's", 2, float(found.group(2)), True, 'times',
                f'abbe: camera {ours.group(1)} ns, shadow {ours.group(2)} ns, mean {ours.group(3)}; Embree: {found.group(1)}')]


def smooth(bench) -> list:
    side = 101 if bench.quick else 317
    taken = {}
    for name in ('flat', 'smoothed'):
        scene = bench.folder / f'{name}.pov'
        scenes.mesh(scene, side, smooth=name == 'smoothed')
        taken.update({(name, size): bench.render(scene, size=size) for size in ((1, 1), (640, 480))})
    taken = bench.race(taken)
    flat, smoothed = (max(1e-4, taken[name, (640, 480)].cpu - taken[name, (1, 1)].cpu) for name in ('flat', 'smoothed'))
    return [Row('smoothed normals over flat', 1.1, smoothed / flat, True, 'times',
                f'{2 * (side - 1) ** 2} triangles, 640x480 without reading: flat {flat:.3f} s, smoothed {smoothed:.3f} s')]


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


BARS = {'glassy': glassy, 'modes': modes, 'samples': samples, 'embree': embree, 'smooth': smooth, 'threads': threads,
        'start': start, 'loading': loading, 'large': large}
