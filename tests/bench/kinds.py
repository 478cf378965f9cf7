# SPDX-License-Identifier: MIT
"""Where the instructions of a render go, by kind of work: callgrind, deterministic."""
import collections
import json
import pathlib
import re
import subprocess
import tempfile

import bars

TOOLS = 'valgrind', 'callgrind_annotate'
EXAMPLES = bars.EXAMPLES
USUAL = [f'{EXAMPLES}/prism_detail.scn:90x56:none', f'{EXAMPLES}/prism_detail.scn:90x56:deterministic',
         f'{EXAMPLES}/prism_detail.scn:90x56:stochastic',
         f'{bars.FULL_BRILLIANT}:60x45:deterministic', f'{bars.TWIN}:160x120:none', f'{EXAMPLES}/csg.scn:160x120:none',
         f'{EXAMPLES}/lens.scn:60x45:deterministic']

# The first that fits a function's name (with that of the kernel where it is one; without arguments) or its library counts.
KINDS = {
    'files, start': r'libz|libOpenEXR|libpng|libIlm|libIex|ld-linux|Checkpoint|Exr|Png|image::|cli::|CLI::|lang::|grammar::|job::|plan::|'
                    r'adler|deflate|filesystem|nlohmann|fmt::|lib/valgrind|spirit|variant|_dl_|elf/|compile|Compiler|make_pattern|'
                    r'default_parameters|Bands::Bands|ColourBasis|uplift|DataLibrary',
    'textures': r'surface::|texture::|pigments_at|fmod|find_sky|::escape',
    'lamps and shadows': r'transport::Shader|Shadows::|[Gg]loss|[Gg]low|LightSurfaces|light_surfaces|transport::shade|'
                         r'Lamp::|Aim|FindCosines|FadeAway|transport::Raise|simd::pow|occluded',
    'Fresnel, Snell, media': r'transport::Refract|transport::Face|transport::Absorb|refract_|face_rays|find_indices|split_lanes|find_shares|'
                             r'face_of|Absorption::|Fade::|Way::|drop_displaced|MediaStacks::|::travel|simd::exp|fresnel',
    'wavelengths, film': r'WaveTables|SampleFilm|SampleKey|BandHats|rgb_density|xyz_density|GlassFormula|index_unchecked|Bands::index_of|CombLight|Captures|'
                         r'transport::Split|send_apart|AdaptiveSplits|LightSum|Emitter::(lose|cut|lost)|jitter_offset|meet_comb',
    'camera, pixels': r'Camera|FromOnePoint|SideBySide|PixelSampler|Frame::|for_each_group|tone_map|RandomKey|tbb|as_seen|Marks|Tracer::(trace|'
                      r'start_camera|inside_at|light_of)',
    'surfaces that rays cross': r'::ends|[Pp]ropose|roots|kernels::|crossings|passages|TracedSolid|ConvexCut|CsgProgram|HalfSpaces|FarPlanes|'
                                r'PlaneFilter|first_end|single_ahead|LaneTree|Stops|gather_|bracketed|shapes?::',
    'finding what is near': r'find_fan|[Ee]xtents|BoxProbe|FanProbe|NodeProbe|Bvh|each_solid|find_start|first_single|first_group|closest_group|'
                            r'diverge|walk|Walk',
    'points, normals': r'FindPoints|find_points|[Nn]ormal|closest_fan|closest_pair|settle|contacts|World::closest|World::flat|find_groups|'
                       r'to_object|Hits::',
    'queues, buckets, chunks': r'transport::|StartOrder|each_packet|World::intersect|memcpy|memmove|memset|mem.*(avx|sse)|Arena|malloc|free|'
                               r'operator new|operator delete|render::',
}


def work(command: list) -> str:
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f'{" ".join(map(str, command))}\n{done.stderr[-2000:]}')
    return done.stdout + done.stderr


def number(text: str) -> int:
    return int(text.replace(',', ''))


def kind_of(function: str) -> str:
    """@param function as callgrind_annotate says it: file:name(arguments) [library]"""
    name, _, library = function.partition(' [')
    name = name.replace('(anonymous namespace)::', '').replace('operator()', 'operator').removeprefix('???:')
    while (without := re.sub(r'\([^()]*\)', '', name)) != name:
        name = without
    if '/lib' in library:
        name += library
    return next((kind for kind, pattern in KINDS.items() if re.search(pattern, name)), 'other')


def profile(abbe: str, scene: str, folder: pathlib.Path) -> dict:
    """Instructions by kind, and rays."""
    path, size, *mode = scene.split(':')
    width, height = size.split('x')
    made, stats = folder / 'callgrind', folder / 'stats.json'
    work(['valgrind', '--tool=callgrind', f'--callgrind-out-file={made}', abbe, 'render', path, '-W', width, '-H', height,
          '--aa', 'off', '-j', 1, '--allow-read', EXAMPLES, '--no-checkpoint', '-o', folder / 'out.exr', '--quiet', '--stats', stats,
          *(['--dispersion', mode[0]] if mode else [])])
    kinds = collections.Counter()
    for line in work(['callgrind_annotate', '--threshold=100', made]).splitlines():
        found = re.match(r'\s*([\d,]+) \([^)]*\)\s+(.*)', line)
        if found and 'PROGRAM TOTALS' not in line:
            kinds[kind_of(found.group(2))] += number(found.group(1))
    return {'rays': json.loads(stats.read_text())['rays']['total'], 'kinds': kinds,
            'pixels': int(width) * int(height)}


def povray_per_pixel(path: str, folder: pathlib.Path) -> float:
    counts = []
    for width, height in ((80, 60), (160, 120)):
        text = work(['valgrind', '--tool=callgrind', f'--callgrind-out-file={folder}/callgrind', 'povray', f'+I{path}',
                     f'+L{pathlib.Path(path).parent}', f'+O{folder}/povray.png', f'+W{width}', f'+H{height}', '+WT1', '-A', '-J',
                     '-D', '-P', '-GA'])
        counts.append(number(re.search(r'Collected : (\d+)', text).group(1)))
    return (counts[1] - counts[0]) / (160 * 120 - 80 * 60)


def table(abbe: str, scenes: list, log) -> tuple:
    """Columns and rows: instructions a ray of each kind, scene by scene."""
    columns, povray = [], {}
    with tempfile.TemporaryDirectory() as name:
        for scene in scenes:
            log(scene)
            columns.append((scene, profile(abbe, scene, pathlib.Path(name))))
            path = scene.split(':')[0]
            if path.endswith('.pov') or path.endswith('csg.scn'):
                povray[scene] = povray_per_pixel(path, pathlib.Path(name))
    heads = ['instructions a ray',
             *(f'{pathlib.Path(scene.split(":")[0]).stem} {" ".join(scene.split(":")[1:])}' for scene, _ in columns)]
    rows = [[kind, *(f'{of["kinds"][kind] / of["rays"]:,.0f}' for _, of in columns)]
            for kind in [*KINDS, 'other'] if kind != 'files, start']
    all_of = [sum(count for kind, count in of['kinds'].items() if kind != 'files, start') for _, of in columns]
    rows += [['**all**', *(f'**{count / of["rays"]:,.0f}**' for count, (_, of) in zip(all_of, columns))],
             ['rays a pixel', *(f'{of["rays"] / of["pixels"]:.1f}' for _, of in columns)],
             ['instructions a pixel', *(f'{count / of["pixels"]:,.0f}' for count, (_, of) in zip(all_of, columns))]]
    if povray:
        rows.append(['POV-Ray, instructions a pixel', *(f'{povray[scene]:,.0f}' if scene in povray else '' for scene, _ in columns)])
    return heads, rows
