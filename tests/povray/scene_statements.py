# SPDX-License-Identifier: MIT
"""Statements of the small scenes that `differential` tries, and how a scene becomes text."""
import re

from scene_grammar import FREE_NAMES, Names, Node, Writer, comma_list

STRAY = ['(', ')', '<', '>', '{', '}', '[', ']', ',', ';', '.', '=', '!', '+', '-', '*', '/', '?', ':', '&', '|', '1',
         '0.5', '"s"', 'x', 'rgb', 'A', 'B', 'Undeclared', '#if', '#else', '#end', '#declare', '#local', '#break',
         'sphere', 'pigment', 'color', 'red', 'function', 'array', '#case', '#macro', '<1,2>', '..', '#undef']
COLOURS = [('rgb', 3), ('rgbf', 4), ('rgbt', 4), ('rgbft', 5)]


class StatementWriter(Writer):
    """Writes the statements of one scene."""

    def __init__(self, seed: str, slips: float) -> None:
        super().__init__(seed, slips)
        self.depth = 0

    # ------------------------------------------------------------------------------------ helpers
    def body(self, names: Names = None, count: int = 0) -> Node:
        """Statements of a block; what they declare is not counted on after it."""
        outer, self.names = self.names, names or Names(self.names)
        self.depth += 1
        node = Node('any', *[self.statement() for _ in range(count or 1 + self.below(3))])
        self.depth -= 1
        self.names = outer
        return node

    def target(self, kind: tuple) -> str:
        """A name that a value of this type is given to."""
        if self.depth and self.chance(0.7):
            names = self.names.of(lambda declared: declared == kind)
            if names:
                return self.pick(names)
        if not self.depth:
            return self.fresh()
        unused = [name for name in FREE_NAMES if name not in self.names.types]
        return self.pick(unused)

    def declaring(self) -> str:
        return '#local' if self.chance(0.4 if self.depth else 0.15) else '#declare'

    # ------------------------------------------------------------------------------------ statements
    def statement(self) -> Node:
        deep = self.depth >= 3
        return self.weighted([
            (9, self.declare_value), (9, self.debug), (1.5, self.debug_all), (2, self.declare_array), (2, self.set_element),
            (1.2, self.declare_colour), (1, self.undefine), (0.8, self.block), (0.3, self.noise),
            (0 if deep else 2.5, self.if_), (0 if deep else 1, self.ifdef), (0 if deep else 1.5, self.for_),
            (0 if deep else 1, self.while_), (0 if deep else 1.5, self.switch),
            (1.2 if not self.depth else 0.1, self.macro), (1 if not self.depth else 0, self.recursive_macro),
            (1.5, self.call_macro), (2 if not self.depth else 0.3, self.function),
            (1 if not self.depth else 0.2, self.spline),
        ])()

    def declare_value(self) -> Node:
        kind = self.some_kind()
        value = self.of_kind(kind)
        name = self.target(kind)
        how = self.declaring()
        parts = [how, name, '=', value, ';']
        if self.chance(0.01):
            parts = [how, 'deprecated', *(['once'] if self.chance(0.5) else []), '"old"', *parts[1:]]
        self.names.types[name] = kind
        return Node('stmt', *parts)

    def shown(self) -> Node:
        return self.weighted([(5, self.shown_float), (3, self.shown_vector), (2, self.string)])(0)

    def debug(self) -> Node:
        return Node('stmt', '#debug', 'concat', '(', '"|"', ',', self.shown(), ',', '"\\n"', ')')

    def debug_all(self) -> Node:
        """What some names hold by then."""
        shown = []
        for name in self.names.of(lambda kind: kind[0] in 'fvs')[:4]:
            kind = self.names.types[name]
            if kind[0] == 'f':
                shown.append(Node('s', 'str', '(', name, ',', '0', ',', '5', ')'))
            elif kind[0] == 'v':
                shown.append(Node('s', 'vstr', '(', str(kind[1]), ',', name, ',', '","', ',', '0', ',', '4', ')'))
            else:
                shown.append(Node('s', name))
        if not shown:
            return self.debug()
        return Node('stmt', '#debug', 'concat', '(', '"|"', ',', *comma_list(shown), ',', '"\\n"', ')')

    def declare_array(self) -> Node:
        element = self.some_kind()
        sizes = [1 + self.below(3) for _ in range(self.weighted([(6, 1), (3, 2), (1, 3)]))]
        filled = self.chance(0.7)
        name = self.target(('array',))
        parts = [self.declaring(), name, '=', 'array']
        for size in sizes:
            parts += ['[', Node('f', str(size)), ']']
        if filled:
            parts.append(self.elements(element, sizes))
        self.names.types[name] = ('array', element, tuple(sizes), filled)
        if self.chance(0.3):
            parts.append(';')
        return Node('stmt', *parts)

    def elements(self, element: tuple, sizes: list) -> Node:
        if len(sizes) > 1:
            rows = [self.elements(element, sizes[1:]) for _ in range(sizes[0])]
        else:
            rows = [self.of_kind(element, 2) for _ in range(sizes[0])]
        parts = comma_list(rows)
        if self.chance(0.1):
            parts.append(',')
        return Node('any', '{', *parts, '}')

    def set_element(self) -> Node:
        arrays = self.names.of(lambda kind: kind[0] == 'array' and len(kind) > 1)
        if not arrays:
            return self.declare_value()
        name = self.pick(arrays)
        _, element, sizes, _ = self.names.types[name]
        tokens = ['#declare' if self.chance(0.9) else '#local', name]
        for size in sizes:
            tokens += ['[', self.subscript(size, 2), ']']
        return Node('stmt', *tokens, '=', self.of_kind(element, 1), ';')

    def declare_colour(self) -> Node:
        name = self.target(('v', 5))
        self.names.types[name] = ('v', 5)
        value = self.colour()
        return Node('stmt', self.declaring(), name, '=', *(['color'] if self.chance(0.4) else []), value, ';')

    def colour(self) -> Node:
        word, size = self.pick(COLOURS)
        if self.chance(0.2):
            parts = []
            for _ in range(1 + self.below(3)):
                parts += [self.pick(['red', 'green', 'blue', 'filter', 'transmit']), self.pick(['0.5', '1', '.25', '2'])]
            return Node('colour', *parts)
        value = Node(f'v{size}', '<', *comma_list([self.pick(['0', '1', '0.5', '.25', '2']) for _ in range(size)]), '>')
        if self.chance(0.2):
            value = self.weighted([(1, Node('f', self.pick(['0', '1', '0.5']))), (1, Node('any', value, '*', '0.5'))])
        tail = [self.pick(['filter', 'transmit', 'red']), '0.25'] if self.chance(0.1) else []
        return Node('colour', word, value, *tail)

    def undefine(self) -> Node:
        names = sorted(self.names.types)
        if not names or self.depth:
            return self.debug()
        name = self.pick(names) if self.chance(0.9) else self.pick(FREE_NAMES)
        self.names.types.pop(name, None)
        return Node('stmt', '#undef', name)

    def condition(self) -> list:
        if self.chance(0.1):
            return [self.float(1)]
        return self.comparison(1)

    def if_(self) -> Node:
        parts = ['#if', '(', *self.condition(), ')', self.body()]
        for _ in range(self.weighted([(7, 0), (2, 1), (1, 2)])):
            parts += ['#elseif', '(', *self.condition(), ')', self.body()]
        if self.chance(0.6):
            parts += ['#else', self.body()]
        return Node('stmt', *parts, '#end')

    def ifdef(self) -> Node:
        names = sorted(self.names.types)
        name = self.pick(names) if names and self.chance(0.6) else self.pick(FREE_NAMES)
        tokens = [name]
        kind = self.names.types.get(name, ('none',))
        if kind[0] == 'array' and len(kind) > 1 and self.chance(0.5):
            for size in kind[2]:
                tokens += ['[', str(self.below(size)), ']']
        parts = [self.pick(['#ifdef', '#ifndef']), '(', *tokens, ')', self.body()]
        if self.chance(0.5):
            parts += ['#else', self.body()]
        return Node('stmt', *parts, '#end')

    def counter(self) -> tuple:
        """The names in a loop, with its counter, which nothing else may change."""
        self.loops += 1
        counter = f'I{self.loops}'
        names = Names(self.names)
        return counter, names

    def guarded_break(self) -> list:
        if not self.chance(0.25):
            return []
        return [Node('stmt', '#if', '(', *self.comparison(2), ')', '#break', '#end')]

    def loop_body(self, counter: str, names: Names) -> Node:
        shown = Node('stmt', '#debug', 'concat', '(', '"|"', ',', 'str', '(', counter, ',', '0', ',', '2', ')', ',',
                     self.shown(), ',', '"\\n"', ')')
        return Node('any', *([shown] if self.chance(0.6) else []), *self.guarded_break(), self.body(names))

    def for_(self) -> Node:
        counter, names = self.counter()
        first = self.pick(['0', '1', '-1', '0.5', '3'])
        step = self.pick(['', '', '', '1', '2', '0.5', '-1', '-0.5', '.1'])
        last = self.pick(['2', '3', '1', '0', '-1', '1.5'])
        head = [counter, ',', Node('f', first), ',', Node('f', last), *([',', Node('f', step)] if step else [])]
        return Node('stmt', '#for', '(', *head, ')', self.loop_body(counter, names), '#end')

    def while_(self) -> Node:
        counter, names = self.counter()
        start = Node('stmt', '#declare', counter, '=', '0', ';')
        step = Node('any', '#declare', counter, '=', counter, '+', self.pick(['1', '0.5', '2']), ';')
        more = ['&', '(', *self.comparison(2), ')'] if self.chance(0.2) else []
        loop = Node('stmt', '#while', '(', counter, '<', self.pick(['2', '3', '1']), *more, ')', step,
                    self.loop_body(counter, names), '#end')
        return Node('stmt', start, loop)

    def switch(self) -> Node:
        parts = ['#switch', '(', self.pick([self.float(2), Node('f', self.pick(['1', '2', '3']))]), ')']
        for _ in range(1 + self.below(3)):
            if self.chance(0.7):
                parts.append(Node('stmt', '#case', '(', Node('f', self.pick(['1', '2', '3', '0.5'])), ')', self.body(count=1)))
            else:
                parts.append(Node('stmt', '#range', '(', Node('f', self.pick(['0', '1', '-1'])), ',',
                                  Node('f', self.pick(['2', '3', '1'])), ')', self.body(count=1)))
            if self.chance(0.6):
                parts.append(Node('stmt', '#break'))
        if self.chance(0.5):
            parts += ['#else', self.body(count=1)]
        return Node('stmt', *parts, '#end')

    def parameters(self) -> list:
        chosen = []
        for _ in range(self.weighted([(2, 0), (4, 1), (3, 2), (1, 3)])):
            name = self.pick([name for name in FREE_NAMES if name not in [taken for taken, _ in chosen]])
            chosen.append((name, self.some_kind()))
        return chosen

    def macro(self) -> Node:
        parameters = self.parameters()
        names = Names(self.names)
        names.types.update(parameters)
        result = self.some_kind() if self.chance(0.65) else ('none',)
        statements = self.body(names, self.below(3) + (1 if result[0] == 'none' else 0)) \
            if result[0] == 'none' or self.chance(0.5) else Node('any')
        outer, self.names = self.names, names
        value = ['(', self.of_kind(result), ')'] if result[0] not in ('none', 's') else \
            [self.of_kind(result)] if result[0] == 's' else []
        if value and self.chance(0.15):
            value = ['#if', '(', *self.comparison(2), ')', *value, '#else', self.of_kind(result, 1), '#end']
        self.names = outer
        name = self.fixed_name()
        self.names.types[name] = ('macro', [kind for _, kind in parameters], result)
        return Node('stmt', '#macro', name, '(', *comma_list([taken for taken, _ in parameters]), ')', statements, *value,
                    '#end')

    def recursive_macro(self) -> Node:
        name = self.fixed_name()
        self.names.types[name] = ('recursive',)
        inner = self.pick([['N', '*', name, '(', 'N', '-', '1', ')'], ['(', name, '(', 'N', '-', '1', ')', '+', 'N', ')'],
                           [name, '(', 'N', '-', '1', ')', '+', name, '(', 'N', '-', '2', ')']])
        macro = Node('stmt', '#macro', name, '(', 'N', ')', '#if', '(', 'N', '<=', '1', ')', '1', '#else', *inner, '#end',
                     '#end')
        show = Node('stmt', '#debug', 'concat', '(', '"|"', ',', 'str', '(', name, '(', self.pick(['4', '5', '1', '3.5']), ')',
                    ',', '0', ',', '2', ')', ',', '"\\n"', ')')
        return Node('any', macro, show)

    def call_macro(self) -> Node:
        names = self.names.of(lambda kind: kind[0] == 'macro' and kind[2] == ('none',))
        if not names:
            return self.debug()
        name = self.pick(names)
        arguments = [self.argument(kind, 1) for kind in self.names.types[name][1]]
        return Node('stmt', name, '(', *comma_list(arguments), ')', *([';'] if self.chance(0.02) else []))

    def function(self) -> Node:
        parameters = self.weighted([(3, []), (2, ['x']), (2, ['x', 'y']), (2, ['Ga', 'Gb']), (1, ['u', 'v'])])
        body = self.function_value(parameters or ['x', 'y', 'z'], 0)
        name = self.fixed_name()
        self.names.types[name] = ('function', len(parameters) or 3)
        head = ['(', *comma_list(parameters), ')'] if parameters else []
        return Node('stmt', self.declaring(), name, '=', 'function', *head, '{', body, '}', *([';'] if self.chance(0.2) else []))

    def function_value(self, parameters: list, depth: int) -> Node:
        if depth >= 4 or self.chance(0.25):
            return self.pick([Node('g', self.pick(parameters)), Node('g', self.pick(parameters)), Node('g', self.number()),
                              self.float_atom_in_function()])

        def one():
            return self.function_value(parameters, depth + 1)

        def call(name, *arguments):
            return Node('g', name, '(', *comma_list(list(arguments)), ')')

        def other():
            names = self.names.of(lambda kind: kind[0] == 'function')
            if not names:
                return one()
            name = self.pick(names)
            return call(name, *[one() for _ in range(self.names.types[name][1])])
        return self.weighted([
            (8, lambda: Node('g', one(), self.weighted([(3, '+'), (3, '-'), (3, '*'), (1, '/')]), one())),
            (1, lambda: Node('g', self.pick(['-', '+']), '(', one(), ')')), (3, lambda: Node('g', '(', one(), ')')),
            (0 if depth else 2, lambda: Node('g', one(), self.pick(COMPARISONS_IN_FUNCTIONS), one())),
            (1.5, lambda: Node('g', '(', one(), self.pick(COMPARISONS_IN_FUNCTIONS), one(), ')')),
            (4, lambda: call(self.pick(['abs', 'ceil', 'cos', 'degrees', 'floor', 'int', 'radians', 'sin', 'tan', 'atan',
                                        'tanh', 'asinh', 'exp', 'sqrt']), one())),
            (1, lambda: call(self.pick(['min', 'max']), *[one() for _ in range(2 + self.below(2))])),
            (1, lambda: call(self.pick(['atan2', 'pow', 'mod']), one(), one())),
            (1, lambda: call('select', *[one() for _ in range(3 + self.below(2))])),
            (0.5, lambda: call(self.pick(['sum', 'prod']), 'i', '1', '3', Node('g', 'i', '*', one()))),
            (2, other),
        ])()

    def float_atom_in_function(self) -> Node:
        names = self.names.of(lambda kind: kind == ('f',))
        if names and self.chance(0.7):
            return Node('g', self.pick(names))
        return Node('g', self.pick(['pi', self.number()]))

    def spline(self) -> Node:
        size = self.pick([2, 3, 3, 4])
        name = self.fixed_name()
        kind = self.pick([[], ['linear_spline'], ['quadratic_spline'], ['cubic_spline'], ['natural_spline']])
        points = []
        for key in ['0', '1', '2', '3.5', '5'][:1 + self.below(5)]:
            points += [Node('stmt', Node('f', key), ',', self.vector(2, size), *([','] if self.chance(0.6) else []))]
        self.names.types[name] = ('spline', 1, ('v', size))
        return Node('stmt', self.declaring(), name, '=', 'spline', '{', *kind, *points, '}', *([';'] if self.chance(0.2) else []))

    # ------------------------------------------------------------------------------------ blocks
    def block(self) -> Node:
        name = self.fixed_name()
        what = self.weighted([(3, self.shape), (1, self.pigment), (1, self.texture), (1, self.finish), (1, self.transforms)])
        made = what()
        if what == self.transforms:
            made = Node('any', 'transform', '{', made, '}')
        if self.chance(0.3) and what == self.shape:
            return Node('stmt', made)
        self.names.types[name] = ('block',)
        shown = []
        if what == self.shape and 'cylinder' not in made.tokens():  # abbe's boxes of those are smaller
            shown = [Node('stmt', '#debug', 'concat', '(', '"|"', ',', 'vstr', '(', '3', ',', self.pick(['min_extent', 'max_extent']), '(', name, ')', '+', '50', ',', '","',
                          ',', '0', ',', '3', ')', ',', '"\\n"', ')')]
        return Node('stmt', Node('stmt', '#declare', name, '=', made, *([';'] if self.chance(0.3) else [])), *shown)

    def shape(self) -> Node:
        parts = self.weighted([
            (3, lambda: ['sphere', '{', self.small_vector(), ',', self.positive()]),
            (3, lambda: ['box', '{', self.small_vector(), ',', '<', '11', ',', '12', ',', '13', '>']),
            (1, lambda: ['cylinder', '{', '0', ',', self.pick(['x', 'y', '2', '<1,2,3>']), ',', self.positive()]),
            (1, lambda: ['torus', '{', '2', ',', self.positive()]),
            (1, lambda: ['union', '{', self.shape(), self.shape()])])()
        for _ in range(self.below(3)):
            parts.append(Node('stmt', self.weighted([(1, self.pigment), (1, self.texture), (1, self.finish), (3, self.transforms)])()))
        return Node('any', *parts, '}')

    def small_vector(self) -> Node:
        """Coordinates that single precision holds."""
        how = self.below(4)
        if how == 0:
            return Node('v3', self.pick(['x', 'y', 'z']))
        if how == 1:
            return Node('v3', '<', *comma_list([self.pick(['0', '1', '-2', '.5', '3']) for _ in range(3)]), '>')
        if how == 2:
            return Node('v3', self.pick(['x', 'y']), self.pick(['+', '-', '*']), self.pick(['2', '0.5', 'y', '<1,2,3>']))
        return Node('v3', '<', *comma_list([self.float(3) if self.chance(0.1) else self.pick(['0', '-1', '2*2'])
                                            for _ in range(3)]), '>')

    def positive(self) -> Node:
        return Node('f', self.pick(['1', '0.5', '.25', '2', '1e0', '1/2']))

    def transforms(self) -> Node:
        def scales():
            return self.pick([Node('f', '2'), Node('v3', '<', '1', ',', '2', ',', '.5', '>')])
        return Node('any', *[Node('stmt', *self.weighted([
            (2, lambda: ['translate', self.small_vector()]), (1, lambda: ['scale', scales()]),
            (1, lambda: ['rotate', self.pick(['90*x', '<90,0,90>', '0', '180*y', '<0,90,0>'])])])()) for _ in range(1 + self.below(2))])

    def pigment(self) -> Node:
        inside = self.weighted([
            (3, lambda: [self.colour()]),
            (1, lambda: ['color', self.colour()]),
            (1, lambda: ['checker', self.colour(), *([','] if self.chance(0.8) else []), self.colour()]),
            (1, lambda: [self.pick(['granite', 'bozo', 'gradient x', 'wood', 'marble']), 'color_map', '{', '[', '0', self.colour(), ']',
                         '[', '1', self.colour(), ']', '}'])])()
        return Node('any', 'pigment', '{', *inside, *([self.transforms()] if self.chance(0.2) else []), '}')

    def texture(self) -> Node:
        return Node('any', 'texture', '{', self.pigment(), *([self.finish()] if self.chance(0.5) else []), '}')

    def finish(self) -> Node:
        words = ['ambient', 'diffuse', 'phong', 'phong_size', 'specular', 'roughness', 'metallic', 'reflection', 'brilliance']
        return Node('any', 'finish', '{', *[Node('stmt', self.pick(words), self.pick(['0.5', '1', '.1'])) for _ in range(1 + self.below(3))],
                    '}')

    def noise(self) -> Node:
        return Node('stmt', *self.pick([['#version', '3.7', ';'], ['#version', 'version', ';'], ['#version', '3.6', ';'],
                                        ['#render', '"|r\\n"'], ['#statistics', '"|s\\n"'], ['#warning', '"w"']]))

    # ------------------------------------------------------------------------------------ the scene
    def scene(self) -> Node:
        root = Node('any', Node('stmt', '#version', '3.7', ';'))
        for _ in range(2 + self.below(6)):
            root.parts.append(self.statement())
        root.parts += [self.debug(), self.debug_all()]
        if self.chance(self.share_of_slips):
            for _ in range(1 + self.below(2)):
                self.slip(root)
        return root

    def slip(self, root: Node) -> None:
        """A slip of the pen: a token that is missing, doubled, changed or in the wrong place."""
        places = []

        def gather(node):
            for i, part in enumerate(node.parts):
                if isinstance(part, Node):
                    gather(part)
                else:
                    places.append((node, i))
        gather(root)
        if len(places) < 6:
            return
        at = 3 + self.below(len(places) - 3)
        if self.chance(0.4):  # what may be optional is most worth leaving out
            marks = [i for i in range(3, len(places)) if places[i][0].parts[places[i][1]] in (',', ';', '(', ')')]
            at = self.pick(marks) if marks else at
        node, i = places[at]
        how = self.below(4)
        if how == 0:
            node.parts[i] = self.pick(STRAY)
        elif how == 1:
            node.parts.insert(i, node.parts[i] if self.chance(0.5) else self.pick(STRAY))
        else:
            del node.parts[i]


COMPARISONS_IN_FUNCTIONS = ['<', '<=', '=', '>=', '>', '!=', '&', '|']
WORD = re.compile(r'[A-Za-z0-9_."#]')
STYLES = [(14, 'plain'), (2, 'tight'), (2, 'wide'), (1, 'crlf'), (0.5, 'cr')]


def merge(left: str, right: str) -> bool:
    """Would the tokens be read as others without a blank?"""
    if WORD.match(left[-1]) and WORD.match(right[0]) and '"' not in (left[-1], right[0]):
        return True
    return left[-1] + right[0] in ('//', '/*', '*/', '<=', '>=', '!=')


def plain_gap(left: str, right: str) -> str:
    if merge(left, right):
        return ' '
    if right in (',', ';', ')', ']', '.', '[') or left in ('(', '[', '.'):
        return ''
    if right == '(' and left[0] != '#':
        return ''
    return ' '


def lines(node: Node, style: str, writer: Writer) -> list:
    """The scene as tokens and gaps in turn."""
    pieces = []
    newline = {'crlf': '\r\n', 'cr': '\r'}.get(style, '\n')

    def gap(right):
        left = pieces[-1]
        if style == 'tight':
            return ' ' if merge(left, right) else ''
        if style in ('wide', 'crlf', 'cr') and right != '[' and writer.chance(0.25):  # no comment before '['
            return writer.pick([' ', '  ', newline, '\t', newline + '  ', ' /* c */ ', f' // c{newline}', f'/**/{newline}',
                                ' /* a /* b */ c */ ', newline + newline])
        return plain_gap(left, right)

    def walk(part):
        starts = isinstance(part, Node) and part.kind == 'stmt'
        if starts and pieces and style != 'tight':
            pieces.append(newline)
            pieces.append('')
        if not isinstance(part, Node):
            if pieces and pieces[-1] != '':
                pieces.append(gap(part))
                pieces.append(part)
            elif pieces:
                pieces[-1] = part
            else:
                pieces.append(part)
            return
        for inner in part.parts:
            walk(inner)
    walk(node)
    return pieces


def write(seed: str, slips: float) -> tuple:
    """A scene: its tree and, in the style it is written in, its tokens and gaps.
    @param slips the share of scenes that have one or two"""
    writer = StatementWriter(seed, slips)
    root = writer.scene()
    return root, lines(root, writer.weighted(STYLES), writer)


def plain(node: Node) -> str:
    return ''.join(lines(node, 'plain', None)) + '\n'
