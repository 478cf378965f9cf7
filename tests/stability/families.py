# SPDX-License-Identifier: MIT
"""The families of the stability suite: which pictures, and when they are right.

A family is a function of a renderer and of `full` (all variants: for the report; else those of ctest).
It yields one Row for each row of its table. The renderer is abbe's or POV-Ray's: both are held to the
same criterion, only abbe must meet it.
"""
import typing

from pictures import Picture, Renderer

SHAPES = {0: 'full scene', 1: 'sphere', 2: 'box', 3: 'cylinder', 4: 'cone', 5: 'torus', 6: 'disc',
          7: 'quadric', 8: 'prism', 9: 'mesh', 10: 'triangle', 11: 'difference', 12: 'intersection, merge',
          13: 'glass sphere', 14: 'glass lens (intersection)', 15: 'glass prism',
          16: 'glass difference of a torus', 17: 'open cylinder', 18: 'quadric in a box'}


class Variant(typing.NamedTuple):
    label: str
    value: typing.Optional[float]  # None: no picture was made
    passed: bool
    picture: typing.Optional[Picture] = None


class Row(typing.NamedTuple):
    name: str
    variants: list
    unit: str = '%'  # of the values
    reference: typing.Optional[Picture] = None

    @property
    def passed(self) -> bool:
        return all(variant.passed for variant in self.variants)


def share(pixels, picture: Picture) -> float:
    return 100.0 * len(pixels) / (picture.width * picture.height)


def against(reference: Picture, label: str, picture, most: float, only_edges: bool) -> Variant:
    """Share of pixels that are off by more than 1/255; `only_edges`: and none away from silhouettes."""
    if picture is None or reference is None:
        return Variant(label, None, False)
    wrong = reference.differing(picture)
    value = share(wrong, picture)
    inner = wrong - reference.silhouettes() if only_edges and wrong else set()
    return Variant(label, value, value <= most and not inner, picture)


def check_object(name: str, reference) -> None:
    """A picture of nothing compares well with anything."""
    if reference is None:
        return
    corner = reference.pixel(0, 0)
    if share(range(reference.covered(corner)), reference) < 5:
        raise ValueError(f'{name}: the object covers less than 5 % of its picture')


def sweep(render: Renderer, scene: str, rows: dict, parameter: str, values, most, only_edges, **fixed):
    """A row a shape, a variant a value of the parameter; each against the same shape without it."""
    wanted = [(scene, dict(fixed, Row=row, **({} if v is None else {parameter: v})))
              for row in rows for v in (None, *values)]
    pictures = iter(render.pictures(wanted))
    for row, name in rows.items():
        reference = next(pictures)
        check_object(name, reference)
        yield Row(name, [against(reference, str(v), next(pictures), most(v), only_edges) for v in values],
                  reference=reference)


def scale_by_ten(render, full):
    values = [k for k in range(-9, 10) if k] if full else [-9, -4, 5, 9]
    yield from sweep(render, 'scale.pov', SHAPES, 'Exp10', values, lambda k: 0.05, True)


def scale_by_ten_placed(render, full):
    values = [k for k in range(-9, 10) if k] if full else [-7, 8]
    yield from sweep(render, 'scale.pov', SHAPES, 'Exp10', values, lambda k: 0.05, True, Placed=1)


def translation(render, full):
    values = range(1, 10) if full else [6, 9]
    yield from sweep(render, 'scale.pov', SHAPES, 'Move', values, lambda t: 0.1 if t <= 6 else 1, False)


def scale_by_two(render, full):
    """The same bytes of linear floating-point pixels; the value: differing files of two (literal, placed)."""
    del full
    if render.name != 'abbe':
        return
    ks = (0, -60, -30, 30, 60)
    for row in SHAPES:
        for k in ks:
            for placed in (0, 1):
                render.render('scale.pov', '.exr', Row=row, Exp2=k, Placed=placed)
    for row, name in SHAPES.items():
        first = render.render('scale.pov', '.exr', Row=row, Exp2=0, Placed=0).result().read_bytes()
        variants = []
        for k in ks:
            same = [render.render('scale.pov', '.exr', Row=row, Exp2=k, Placed=placed).result().read_bytes()
                    == first for placed in (0, 1)]
            variants.append(Variant(f'{k}', float(same.count(False)), all(same)))
        yield Row(name, variants, unit='files')


PLACEMENTS = {'unit': {}, 'x 1000': {'Exp10': 3}, 'x 0.01': {'Exp10': -2}, 'moved by 1000': {'Move': 3}}
COINCIDENCES = {0: 'box minus box, 2 faces shared', 1: 'notch, 3 faces shared', 2: 'A minus A', 3: 'A and A',
                4: 'union of 2 glass boxes sharing a face', 5: 'merge of 2 glass boxes sharing a face',
                6: 'merge of 2 overlapping glass boxes, flush', 7: 'merge of 4x4x4 glass cubes',
                8: 'union of 4x4x4 glass cubes', 9: 'glass sphere twice', 10: 'glass box and its half again'}


def coincident(render, full):
    """Against the same solid without coincidences; pixels within one pixel of an edge do not count."""
    del full
    cases = [(row, turn, placement) for row in COINCIDENCES for turn in (0, 1) for placement in PLACEMENTS]
    wanted = []
    for row, turn, placement in cases:
        wanted += [('coincident.pov', dict(PLACEMENTS[placement], Row=row, Turn=turn, Clean=clean))
                   for clean in (1, 0)]
    made = iter(render.pictures(wanted))
    rows = {}
    for row, turn, placement in cases:
        reference, picture = next(made), next(made)
        label = ('rotated, ' if turn else '') + placement
        if reference is None or picture is None:
            variant = Variant(label, None, False)
        else:
            wrong = reference.differing(picture)
            inner = wrong - reference.silhouettes() if wrong else wrong
            variant = Variant(label, float(len(wrong)), not inner, picture)
        rows.setdefault(row, []).append((variant, reference))
    for row, name in COINCIDENCES.items():
        yield Row(name, [variant for variant, _ in rows[row]], 'pixels', rows[row][0][1])


MEDIA = {0: 'water in a tumbler', 1: 'two glasses side by side', 2: 'one glass in two boxes'}


def touching_media(render, full):
    """Contact, overlap and a gap are the same picture."""
    gaps = (1e-12, -1e-12, 1e-9, -1e-9, 1e-7, -1e-7, 1e-5, -1e-5) if full else (1e-7, -1e-7)
    for turn in (0, 1):
        rows = {row: name + (', rotated' if turn else '') for row, name in MEDIA.items()}
        yield from sweep(render, 'media.pov', rows, 'Gap', gaps, lambda gap: 0.1, False, Turn=turn)


FAMILIES = {
    'scale_by_two': scale_by_two,
    'scale_by_ten': scale_by_ten,
    'scale_by_ten_placed': scale_by_ten_placed,
    'translation': translation,
    'coincident': coincident,
    'touching_media': touching_media,
}
