# SPDX-License-Identifier: MIT
"""How cost grows: a curve is a heading, column names and rows of figures."""
import os

import bars
import harness
import scenes


def objects(bench) -> tuple:
    counts = (10, 100, 1000, 10 ** 4) + (() if bench.quick else (10 ** 5, 10 ** 6))
    rows = []
    for count in counts:
        scene = bench.folder / 'spheres.pov'
        scenes.spheres(scene, count)
        taken = bench.race({'abbe': bench.render(scene), 'check': [bench.abbe, 'check', scene],
                            'povray': bench.povray(scene), 'parse': bench.povray(scene, size=(1, 1))},
                           runs=1 if bench.quick else 3)
        scene.unlink()
        ours, theirs = taken['abbe'], taken['povray']
        rows.append([count, ours.cpu, taken['check'].cpu, theirs.cpu, taken['parse'].cpu,
                     (ours.mb - bench.startup['abbe'].mb) * 2 ** 20 / count,
                     (theirs.mb - bench.startup['povray'].mb) * 2 ** 20 / count])
    return ('Spheres at random in a cube, 320x240, one thread; CPU s and bytes an object beyond an empty scene',
            ['objects', 'abbe', 'of it check', 'povray', 'of it parse', 'abbe bytes', 'povray bytes'], rows)


def triangles(bench) -> tuple:
    rows = []
    for side in (8, 72, 225) + (() if bench.quick else (708,)):
        scene = bench.folder / 'mesh.pov'
        scenes.mesh(scene, side)
        taken = bench.race({'abbe': bench.render(scene), 'povray': bench.povray(scene)}, runs=1 if bench.quick else 3)
        scene.unlink()
        count = 2 * (side - 1) ** 2
        rows.append([count, taken['abbe'].cpu, taken['povray'].cpu,
                     *((taken[name].mb - bench.startup[name].mb) * 2 ** 20 / count for name in ('abbe', 'povray'))])
    return ('A height field as mesh2, 320x240, one thread; CPU s and bytes a triangle beyond an empty scene',
            ['triangles', 'abbe', 'povray', 'abbe bytes', 'povray bytes'], rows)


def bands(bench) -> tuple:
    size = (120, 75) if bench.quick else (180, 113)
    counts = (1, 8, 16, 45) if bench.quick else (1, 2, 4, 8, 16, 32, 45, 64, 100, 200, 450)
    rows = []
    for count in counts:
        taken = bench.race({mode: bench.render(bars.EXAMPLES / 'prism_detail.scn', '--bands', count, '--dispersion',
                                               mode, size=size) for mode in ('none', 'deterministic', 'stochastic')},
                           runs=1 if bench.quick else 3)
        rows.append([count] + [bench.net('abbe', taken[mode]) for mode in taken]
                    + [bench.net('abbe', taken['deterministic']) / bench.net('abbe', taken['none'])])
    return (f'prism_detail, {size[0]}x{size[1]}, one thread; CPU s',
            ['bands', 'none', 'deterministic', 'stochastic', 'deterministic / none'], rows)


def threads(bench) -> tuple:
    rows = []
    for count in sorted({1, 2, *(n for n in (4, 8, 16) if n <= os.cpu_count())}):
        taken = bench.race({'abbe': bench.render(bars.EXAMPLES / 'prism.scn', threads=count),
                            'povray': bench.povray(bars.TWIN, 'Declare=Samples=16', threads=count)},
                           runs=1 if bench.quick else 0)
        rows.append([count, taken['abbe'].wall, taken['abbe'].cpu, taken['povray'].wall, taken['povray'].cpu])
    return ('prism in 16 bands, 320x240; the clock and CPU s. povray keeps a thread for tiles of its own size',
            ['threads', 'abbe', 'CPU', 'povray', 'CPU'], rows)


def image_size(bench) -> tuple:
    rows = []
    for width in (160, 320, 640) + (() if bench.quick else (1280, 2560)):
        size = (width, width * 3 // 4)
        scene = bench.folder / 'plain.pov'
        scene.write_text(scenes.PLAIN, encoding='utf-8')
        taken = bench.race({'abbe': bench.render(scene, size=size), 'povray': bench.povray(scene, size=size)},
                           runs=1 if bench.quick else 3)
        rows.append([f'{size[0]}x{size[1]}', bench.net('abbe', taken['abbe']), bench.net('povray', taken['povray']),
                     taken['abbe'].mb, taken['povray'].mb])
    return ('A sphere on a plane, one thread; CPU s and peak MB', ['size', 'abbe', 'povray', 'abbe MB', 'povray MB'],
            rows)


def csg(bench) -> tuple:
    rows = []
    for shape, make in (('wide', scenes.csg_wide), ('deep', scenes.csg_deep)):
        # Depth is limited by the languages (limits.md), width is not.
        counts = (1, 10, 100) if bench.quick or shape == 'deep' else (1, 10, 100, 1000, 10000)
        for count in counts:
            scene = bench.folder / 'csg.pov'
            make(scene, count)
            row = [shape, count]
            for name, command in (('abbe', bench.render(scene)), ('povray', bench.povray(scene))):
                try:
                    row.append(bench.net(name, bench.race({name: command}, runs=1 if bench.quick else 3)[name]))
                except harness.Failed as failed:
                    row.append('cannot')
                    bench.log(f'csg {shape} {count} {name}: {str(failed).splitlines()[-1]}')
            rows.append(row)
    return ('Balls taken from a slab, in one difference (wide) or each from the one below (deep); 320x240, one '
            'thread, CPU s', ['shape', 'operands', 'abbe', 'povray'], rows)


def rays(bench) -> tuple:
    """The step from one size to a larger one, so that reading the scene does not count."""
    rows = []
    plain = bench.folder / 'plain.pov'
    plain.write_text(scenes.PLAIN, encoding='utf-8')
    for name, scene, words in (('plain', plain, ()), ('csg', bars.EXAMPLES / 'csg.scn', ()),
                               ('prism, no dispersion, r g b', bars.TWIN, ()),
                               ('prism, no dispersion, 8 bands', bars.EXAMPLES / 'prism.scn',
                                ('--bands', 8, '--dispersion', 'none')),
                               ('prism, 8 bands', bars.EXAMPLES / 'prism.scn', ('--bands', 8)),
                               ('prism_detail, 8 bands', bars.EXAMPLES / 'prism_detail.scn', ()),
                               ('lens', bars.EXAMPLES / 'lens.scn', ())):
        taken = bench.race({'abbe': bench.render(scene, *words)}, runs=1 if bench.quick else 3)['abbe']
        row = [name, taken.rays, taken.rays / bench.net('abbe', taken) / 1e6]
        if harness.have('valgrind'):
            small, wide = ((48, 36), (96, 72))
            counts = [bench.run(bench.render(scene, *words, size=size)).rays for size in (small, wide)]
            steps = [bench.instructions(bench.render(scene, *words, size=size)) for size in (small, wide)]
            row.append((steps[1] - steps[0]) / (counts[1] - counts[0]))
        else:
            row.append('no valgrind')
        rows.append(row)
    return ('320x240, one thread. Instructions by callgrind: the difference of 96x72 and 48x36 over that of their '
            'rays', ['scene', 'rays', 'million rays a CPU s', 'instructions a ray'], rows)


CURVES = {'curve_objects': objects, 'curve_triangles': triangles, 'curve_bands': bands, 'curve_threads': threads,
          'curve_size': image_size, 'curve_csg': csg, 'rays': rays}
