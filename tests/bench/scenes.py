# SPDX-License-Identifier: MIT
"""Scenes of any size, which both programs read. All numbers come from a fixed generator."""
import math
import pathlib
import random

HEAD = '#version 3.7;\nglobal_settings { assumed_gamma 1 }\n'
EMPTY = HEAD + 'camera { location <0, 0, -4> look_at 0 }\n'
LIGHT = 'light_source { <-40, 60, -50>, rgb 1 }\n'
PLAIN = HEAD + '''camera { location <0, 1, -4> look_at 0 angle 40 right x * image_width / image_height }
light_source { <-5, 5, -5>, rgb 1 }
plane { y, -1 pigment { rgb 0.7 } }
sphere { 0, 1 pigment { rgb <1, 0.5, 0.2> } }
'''


def spheres(path: pathlib.Path, count: int) -> None:
    """In a cube, so many that about the same share of the picture is covered."""
    numbers = random.Random(1)
    radius = 0.6 * 10 / count ** (1 / 3) / 2
    with path.open('w', encoding='utf-8') as out:
        out.write(HEAD + LIGHT + 'camera { location <0, 0, -18> look_at 0 angle 40 '
                                 'right x * image_width / image_height }\n')
        for _ in range(count):
            x, y, z = (numbers.uniform(-5, 5) for _ in range(3))
            out.write(f'sphere {{ <{x:.5f}, {y:.5f}, {z:.5f}>, {radius:.5f} pigment {{ rgb <{numbers.random():.3f}, '
                      f'{numbers.random():.3f}, {numbers.random():.3f}> }} }}\n')


def sphere_loop(path: pathlib.Path, count: int) -> None:
    """spheres() out of a #while, all with one declared texture."""
    radius = 0.6 * 10 / count ** (1 / 3) / 2
    path.write_text(HEAD + LIGHT + f'''camera {{ location <0, 0, -18> look_at 0 angle 40 right x * image_width / image_height }}
#declare T = texture {{ pigment {{ rgb <1, 0.5, 0.2> }} finish {{ phong 0.5 }} }}
#declare S = seed(1);
#declare I = 0;
#while (I < {count})
  sphere {{ <rand(S) * 10 - 5, rand(S) * 10 - 5, rand(S) * 10 - 5>, {radius:.5f} texture {{ T }} }}
  #declare I = I + 1;
#end
''', encoding='utf-8')


def mesh(path: pathlib.Path, side: int, digits: int = 6, smooth: bool = False) -> None:
    """A height field as mesh2: side x side vertices, 2 (side - 1)^2 triangles; smooth: with the field's normals."""
    step = 10 / side
    with path.open('w', encoding='utf-8') as out:
        out.write(HEAD + LIGHT + 'camera { location <5, 8, -6> look_at <5, 0, 4> angle 60 '
                                 'right x * image_width / image_height }\n')
        out.write(f'mesh2 {{\n  vertex_vectors {{\n    {side * side},\n')
        for i in range(side):  # row by row: what this process holds would count as its children's peak
            out.write(',\n' * (i > 0) + ',\n'.join(
                f'    <{i * step:.{digits}f}, {math.sin(i * step * 5) * math.cos(j * step * 3):.{digits}f}, '
                f'{j * step:.{digits}f}>' for j in range(side)))
        if smooth:
            out.write(f'\n  }}\n  normal_vectors {{\n    {side * side},\n')
            for i in range(side):
                x = i * step * 5
                out.write(',\n' * (i > 0) + ',\n'.join(
                    f'    <{-5 * math.cos(x) * math.cos(j * step * 3):.{digits}f}, 1, '
                    f'{3 * math.sin(x) * math.sin(j * step * 3):.{digits}f}>' for j in range(side)))
        out.write(f'\n  }}\n  face_indices {{\n    {2 * (side - 1) ** 2},\n')
        for i in range(side - 1):
            a, b = i * side, i * side + side
            out.write(',\n' * (i > 0) + ',\n'.join(
                f'    <{a + j}, {a + j + 1}, {b + j}>,\n    <{a + j + 1}, {b + j + 1}, {b + j}>'
                for j in range(side - 1)))
        out.write('\n  }\n  pigment { rgb <0.8, 0.7, 0.5> }\n}\n')


def csg_wide(path: pathlib.Path, operands: int) -> None:
    """A slab with so many holes drilled into it."""
    side = math.ceil(operands ** 0.5)
    with path.open('w', encoding='utf-8') as out:
        out.write(HEAD + LIGHT + 'camera { location <0, 9, -11> look_at 0 angle 50 '
                                 'right x * image_width / image_height }\n')
        out.write('difference {\n  box { <-5, -1, -5>, <5, 0, 5> }\n')
        for k in range(operands):
            x, z = (((k % side) + 0.5) / side - 0.5) * 10, ((k // side + 0.5) / side - 0.5) * 10
            out.write(f'  sphere {{ <{x:.5f}, 0, {z:.5f}>, {4 / side:.5f} }}\n')
        out.write('  pigment { rgb <0.8, 0.5, 0.3> }\n}\n')


def csg_deep(path: pathlib.Path, depth: int) -> None:
    """Differences within differences: each level takes a ball from what the level below left."""
    with path.open('w', encoding='utf-8') as out:
        out.write(HEAD + LIGHT + 'camera { location <0, 9, -11> look_at 0 angle 50 '
                                 'right x * image_width / image_height }\n')
        out.write('difference { ' * depth + 'box { <-5, -1, -5>, <5, 0, 5> }\n')
        for k in range(depth):
            angle, r = 2.39996323 * k, 4.6 * math.sqrt((k + 0.5) / depth)
            out.write(f'  sphere {{ <{r * math.cos(angle):.5f}, 0, {r * math.sin(angle):.5f}>, '
                      f'{3 / math.sqrt(depth):.5f} }}')
            out.write(' }\n' if k < depth - 1 else ' pigment { rgb <0.8, 0.5, 0.3> } }\n')
