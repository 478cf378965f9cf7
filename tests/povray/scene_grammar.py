# SPDX-License-Identifier: MIT
"""Small scenes out of the grammar that abbe and POV-Ray share, for `differential`.

A scene is a tree: a Node has a kind and parts, which are nodes and tokens. Statements can be left out of it
and an expression can stand for a larger one of its kind; that is how `differential` makes a scene smaller.
What a scene computes is shown by #debug, in lines that begin with '|'.
"""
import random

MAX_DEPTH = 3


class Node:
    """A piece of a scene. Kinds: 'stmt' (may be left out), 'f' float, 'v2' .. 'v5' vectors, 's' string,
    'any' (anything else)."""
    __slots__ = ('kind', 'parts')

    def __init__(self, kind: str, *parts) -> None:
        self.kind = kind
        self.parts = list(parts)

    def tokens(self) -> list:
        found = []
        for part in self.parts:
            if isinstance(part, Node):
                found += part.tokens()
            else:
                found.append(part)
        return found


def comma_list(parts: list, comma: str = ',') -> list:
    listed = []
    for part in parts:
        listed += [comma, part] if listed else [part]
    return listed


class Names:
    """What is declared where a statement is written: name -> type."""

    def __init__(self, outer: 'Names' = None) -> None:
        self.types = dict(outer.types) if outer else {}

    def of(self, wanted) -> list:
        return sorted(name for name, kind in self.types.items() if wanted(kind))


FREE_NAMES = [letter + tail for letter in 'ABCDEFGHKLMNPQRSTW' for tail in ('', 'x', '_1')]
FIXED_NAMES = [letter + tail for letter in 'FGMNPQRST' for tail in ('f', 'g', 'h_2', 'k', '_3')]
LETTERS = 'abcxyzABCXYZ019 _-+.,:()<>#@{}&%$'
ONE_ARGUMENT = ['abs', 'ceil', 'cos', 'degrees', 'floor', 'int', 'radians', 'sin', 'tan', 'atan', 'tanh',
                'asinh']
COMPARISONS = ['<', '<=', '=', '>=', '>', '!=']
MEMBERS = {2: ['x', 'y', 'u', 'v', 'red', 'green'], 3: ['x', 'y', 'z', 'u', 'v', 'red', 'blue', 'gray'],
           4: ['x', 'y', 'z', 't', 'filter'], 5: ['x', 't', 'red', 'green', 'blue', 'filter', 'transmit', 'gray']}


class Writer:
    """Writes one scene. The same seed gives the same scene with every version of Python."""

    def __init__(self, seed: str, slips: float) -> None:
        self.share_of_slips = slips
        self.random = random.Random(seed)
        self.names = Names()
        self.loops = 0
        self.fixed = set()  # which of FIXED_NAMES are taken
        self.slips = 0.004 if self.chance(slips) else 0.0  # how often an expression has another type

    # ------------------------------------------------------------------------------------ chance
    def chance(self, share: float) -> bool:
        return self.random.random() < share

    def below(self, count: int) -> int:
        return int(self.random.random() * count)

    def pick(self, choices):
        return choices[self.below(len(choices))]

    def weighted(self, choices: list):
        """One of [(weight, value), ...]."""
        left = self.random.random() * sum(weight for weight, _ in choices)
        for weight, value in choices:
            left -= weight
            if left < 0:
                return value
        return choices[-1][1]

    def fresh(self) -> str:
        """A name, mostly a new one; an old one may get another type."""
        old = [name for name in sorted(self.names.types) if name in FREE_NAMES]
        if old and self.chance(0.1):
            return self.pick(old)
        unused = [name for name in FREE_NAMES if name not in self.names.types]
        return self.pick(unused or FREE_NAMES)

    def fixed_name(self) -> str:
        """A name of what POV-Ray gives no other type: a macro, a function, a spline, a block."""
        name = self.pick([name for name in FIXED_NAMES if name not in self.fixed])
        self.fixed.add(name)
        return name

    # ------------------------------------------------------------------------------------ floats
    def number(self) -> str:
        whole = str(self.pick([0, 1, 1, 2, 2, 3, 4, 5, 7, 10, 12, 100]))
        return self.weighted([
            (8, whole), (3, f'{whole}.5'), (1, f'{whole}.'), (1, '.25'), (2, f'{whole}.125'),
            (1, f'{whole}e1'), (0.5, f'{whole}.5E-1'), (0.5, '1e+2'), (0.3, f'0{whole}'), (0.3, '.5e1'),
            (0.3, '1e-9'), (0.3, '0.0000000001'), (0.3, '65536.5'), (0.2, '.1'), (0.2, f'{whole}.e0')])

    def float_atom(self) -> Node:
        names = self.names.of(lambda kind: kind == ('f',))
        if names and self.chance(0.55):
            return Node('f', self.pick(names))
        return Node('f', self.weighted([
            (12, self.number()), (1, 'pi'), (0.4, 'true'), (0.3, 'yes'), (0.3, 'on'), (0.3, 'false'),
            (0.3, 'no'), (0.3, 'off'), (0.2, 'version'), (0.1, 'clock')]))

    def float(self, depth: int = 0) -> Node:
        if self.chance(self.slips):
            return Node('f', self.pick([self.vector, lambda d: self.string(d)])(depth + 1))
        if depth >= MAX_DEPTH or self.chance(0.25):
            return self.float_atom()
        return self.weighted([
            (8, self.sum), (2, self.signed), (5, self.parenthesised), (5, self.call_of_floats), (4, self.member),
            (2, self.of_string), (3, self.element_float), (4, self.user_call), (1, self.of_vector),
            (0.7, self.asked)])(depth)

    def sum(self, depth: int) -> Node:
        parts = [self.float(depth + 1)]
        for _ in range(1 + self.below(2)):
            op = self.weighted([(4, '+'), (4, '-'), (4, '*'), (2, '/')])
            if op == '/' and not self.chance(0.02):
                parts += [op, Node('f', self.pick(['2', '4', '8', '0.5', '3', '-2', '+5', 'pi']))]
            else:
                parts += [op, self.float(depth + 1)]
        return Node('f', *parts)

    def signed(self, depth: int) -> Node:
        return Node('f', self.weighted([(4, '-'), (2, '+'), (2, '!')]), self.float(depth + 1))

    def comparison(self, depth: int) -> list:
        """What may stand in parentheses only."""
        if self.chance(0.12):
            return [self.string(depth + 1), self.pick(COMPARISONS), self.string(depth + 1)]
        parts = [self.float(depth + 1)]
        for _ in range(self.weighted([(6, 1), (2, 2), (1, 3)])):
            parts += [self.pick(COMPARISONS + ['&', '|', '&', '|']), self.float(depth + 1)]
        return parts

    def parenthesised(self, depth: int) -> Node:
        how = self.below(4)
        if how == 0:
            return Node('f', '(', self.float(depth + 1), ')')
        if how == 1:
            return Node('f', '(', *self.comparison(depth), '?', self.float(depth + 1), ':', self.float(depth + 1),
                        ')')
        return Node('f', '(', *self.comparison(depth), ')')

    def call_of_floats(self, depth: int) -> Node:
        def one():
            return self.float(depth + 1)

        def call(name, *arguments):
            return Node('f', name, '(', *comma_list(list(arguments)), ')')
        return self.weighted([
            (6, lambda: call(self.pick(ONE_ARGUMENT), one())),
            (1, lambda: call('sqrt', Node('f', 'abs', '(', one(), ')'))),
            (0.7, lambda: call('ln', Node('f', 'exp', '(', one(), ')'))),
            (0.7, lambda: call('log', Node('f', '1', '+', 'abs', '(', one(), ')'))),
            (0.5, lambda: call('asin', Node('f', 'sin', '(', one(), ')'))),
            (0.3, lambda: call('acos', one())), (0.2, lambda: call('sqrt', one())), (0.2, lambda: call('ln', one())),
            (0.2, lambda: call(self.pick(['acosh', 'atanh', 'sinh', 'cosh', 'exp']), one())),
            (1, lambda: call('atan2', one(), one())), (1, lambda: call('pow', one(), Node('f', self.pick(
                ['2', '3', '0.5', '-1', '0'])))), (0.2, lambda: call('pow', one(), one())),
            (1, lambda: call('mod', one(), Node('f', self.pick(['2', '3', '0.5', '-3'])))),
            (1, lambda: call('div', one(), Node('f', self.pick(['2', '3', '0.5', '-3'])))),
            (1.5, lambda: call(self.pick(['min', 'max']), *[one() for _ in range(1 + self.below(4))])),
            (0.7, lambda: call(self.pick(['bitwise_and', 'bitwise_or', 'bitwise_xor']),
                               *[one() for _ in range(2 + self.below(2))])),
            (1.5, lambda: call('select', *[one() for _ in range(3 + self.below(2))])),
            (0.4, lambda: call('rand', call('seed', Node('f', self.pick(['0', '1', '7', '12.5', '-3', '1e6']))))),
        ])()

    def member(self, depth: int) -> Node:
        size = self.weighted([(2, 2), (5, 3), (1, 4), (2, 5)])
        names = self.names.of(lambda kind: kind == ('v', size))
        operand = Node(f'v{size}', self.pick(names)) if names and self.chance(0.6) else self.bracketed(size, depth)
        members = MEMBERS[size] if not self.chance(self.slips) else MEMBERS[5]
        return Node('f', operand, '.', self.pick(members))

    def bracketed(self, size: int, depth: int) -> Node:
        """A vector that a member can follow."""
        if self.chance(0.4):
            return Node(f'v{size}', '(', self.vector(depth + 1, size), ')')
        return self.literal_vector(size, depth + 1) if size < 5 else self.colour_value(MAX_DEPTH)

    def of_string(self, depth: int) -> Node:
        def text():
            return self.string(depth + 1)
        return self.weighted([
            (3, lambda: Node('f', 'strlen', '(', text(), ')')),
            (2, lambda: Node('f', 'strcmp', '(', text(), ',', text(), ')')),
            (1, lambda: Node('f', 'asc', '(', Node('s', 'concat', '(', text(), ',', '"k"', ')'), ')')),
            (1, lambda: Node('f', 'val', '(', Node('s', self.pick(
                ['"12"', '" -3.5e1"', '"7abc"', '"1,5"', '".5"', '"+2"', '"1e2x"', '"  8"'])), ')')),
        ])()

    def of_vector(self, depth: int) -> Node:
        if self.chance(0.5):
            return Node('f', 'vlength', '(', self.vector(depth + 1, 3), ')')
        return Node('f', 'vdot', '(', self.vector(depth + 1, 3), ',', self.vector(depth + 1, 3), ')')

    def element_of(self, element: tuple, depth: int):
        """Tokens of an element, or None."""
        names = self.names.of(lambda kind: kind[0] == 'array' and kind[1] == element and kind[3])
        if not names:
            return None
        name = self.pick(names)
        tokens = [name]
        for size in self.names.types[name][2]:
            tokens += ['[', self.subscript(size, depth), ']']
        return tokens

    def subscript(self, size: int, depth: int) -> Node:
        if self.chance(0.03):
            return self.float(depth + 1)
        at = self.below(size)
        return Node('f', self.weighted([
            (6, str(at)), (1, f'{at}.5'), (1, Node('f', str(at + 1), '-', '1')),
            (1, Node('f', 'mod', '(', 'floor', '(', 'abs', '(', self.float(depth + 2), ')', ')', ',', str(size), ')')),
            (0.1, str(size)), (0.1, '-1')]))

    def element_float(self, depth: int) -> Node:
        tokens = self.element_of(('f',), depth)
        return Node('f', *tokens) if tokens else self.float_atom()

    def user_call(self, depth: int, kind: tuple = ('f',)) -> Node:
        """Of a function, spline or macro that gives this type."""
        def gives(declared):
            return (declared[0] == 'function' and kind == ('f',)
                    or declared[0] in ('macro', 'spline') and declared[2] == kind)
        names = self.names.of(gives)
        if not names:
            return self.atom(kind)
        name = self.pick(names)
        declared = self.names.types[name]
        if declared[0] == 'function':
            arguments = [self.float(depth + 1) for _ in range(declared[1])]
        elif declared[0] == 'spline':
            arguments = [self.float(depth + 1)]
        else:
            arguments = [self.argument(wanted, depth) for wanted in declared[1]]
        return Node(self.kind_of(kind), name, '(', *comma_list(arguments), ')')

    def asked(self, depth: int) -> Node:
        arrays = self.names.of(lambda kind: kind[0] == 'array')
        if arrays and self.chance(0.7):
            name = self.pick(arrays)
            if self.chance(0.3):
                return Node('f', 'dimensions', '(', name, ')')
            return Node('f', 'dimension_size', '(', name, ',', self.pick(['1', '2', '1', '3']), ')')
        return Node('f', 'defined', '(', self.pick(FIXED_NAMES), ')')

    # ------------------------------------------------------------------------------------ vectors
    def literal_vector(self, size: int, depth: int) -> Node:
        if self.chance(0.03):
            return Node(f'v{size}', '<', *[Node('f', self.number()) for _ in range(size)], '>')
        return Node(f'v{size}', '<', *comma_list([self.float(max(depth, 2)) for _ in range(size)]), '>')

    def vector(self, depth: int = 0, size: int = 0) -> Node:
        size = size or self.weighted([(2, 2), (6, 3), (1, 4), (1, 5)])
        if self.chance(self.slips):
            return self.string(depth + 1)
        if size == 5:
            return self.colour_value(depth)
        if depth >= MAX_DEPTH or self.chance(0.3):
            return self.vector_atom(size, depth)
        kind = f'v{size}'

        def smaller():
            """An operand that is promoted; POV-Ray forgets components of those that grow to four or five."""
            return self.weighted([(3, lambda: self.float(depth + 1)),
                                  (4, lambda: self.vector(depth + 1, size)),
                                  (1, lambda: self.vector(depth + 1, 2 + self.below(2) if size == 3 else size))])()

        def product():
            op = self.weighted([(3, '+'), (3, '-'), (3, '*'), (1, '/')])
            right = Node('f', self.pick(['2', '4', '0.5'])) if op == '/' else smaller()
            return Node(kind, self.vector(depth + 1, size), op, right)

        def three():
            return self.weighted([
                (1, lambda: Node(kind, 'vcross', '(', self.vector(depth + 1, 3), ',', self.vector(depth + 1, 3), ')')),
                (1, lambda: Node(kind, 'vnormalize', '(', self.vector(depth + 1, 3), ')')),
                (1, lambda: Node(kind, 'vrotate', '(', self.vector(depth + 1, 3), ',', self.angles(), ')')),
                (1, lambda: Node(kind, 'vaxis_rotate', '(', self.vector(depth + 1, 3), ',', self.angles(), ',',
                                 Node('f', self.pick(['30', '-80', '7.5', '400'])), ')')),
            ])()
        return self.weighted([
            (5, product), (2 if size == 3 else 0, three), (2, lambda: self.user_call(depth, ('v', size))),
            (1, lambda: Node(kind, self.pick(['-', '+', '!', '-']), self.vector(depth + 1, size))),
            (2, lambda: Node(kind, '(', self.vector(depth + 1, size), ')')),
            (1, lambda: Node(kind, '(', self.vector(depth + 1, size), self.pick(COMPARISONS + ['&', '|']),
                             self.vector(depth + 1, size), ')')),
            (0.7, lambda: Node(kind, '(', *self.comparison(depth), '?', self.vector(depth + 1, size), ':',
                               self.vector(depth + 1, size), ')')),
            (2, lambda: self.element_vector(size, depth)),
        ])()

    def angles(self) -> Node:
        """Degrees that do not make much of the last digits of what is turned."""
        return Node('v3', '<', *comma_list([self.pick(['20', '70', '-30', '45.5', '400', '1e1']) for _ in range(2)]), ',', '7', '>')

    def colour_value(self, depth: int) -> Node:
        """Five components, of which POV-Ray keeps some seven digits: numbers that these hold."""
        names = self.names.of(lambda kind: kind == ('v', 5))
        if names and self.chance(0.4):
            return Node('v5', self.pick(names))
        if depth < MAX_DEPTH and self.chance(0.3):
            right = self.pick([Node('f', self.pick(['2', '0.5', '-1'])), self.colour_value(depth + 1)])
            return Node('v5', self.colour_value(depth + 1), self.pick(['+', '-', '*']), right)
        numbers = [self.pick(['0', '1', '0.5', '.25', '-2', '3', '1.5']) for _ in range(5)]
        return Node('v5', '<', *comma_list(numbers), '>')

    def vector_atom(self, size: int, depth: int) -> Node:
        names = self.names.of(lambda kind: kind == ('v', size))
        if names and self.chance(0.5):
            return Node(f'v{size}', self.pick(names))
        axes = {2: ['u', 'v'], 3: ['x', 'y', 'z'], 4: ['t']}.get(size)
        if size == 5:
            return self.colour_value(MAX_DEPTH)
        if axes and self.chance(0.3) and (depth or size < 4):  # no value is `t` alone
            return Node(f'v{size}', self.pick(axes))
        return self.literal_vector(size, depth + 1)

    def element_vector(self, size: int, depth: int) -> Node:
        tokens = self.element_of(('v', size), depth)
        return Node(f'v{size}', *tokens) if tokens else self.vector_atom(size, depth)

    # ------------------------------------------------------------------------------------ strings
    def literal_string(self) -> str:
        letters = ''.join(self.pick(LETTERS) for _ in range(self.below(7)))
        if self.chance(0.06):
            letters += self.pick(['\\t', "\\'", '\\"', '\\\\', '\\u0041', '\\b'])
        return f'"{letters}"'

    def string(self, depth: int = 0) -> Node:
        if self.chance(self.slips):
            return self.float(depth + 1)
        names = self.names.of(lambda kind: kind == ('s',))
        if names and self.chance(0.4):
            return Node('s', self.pick(names))
        if depth >= MAX_DEPTH or self.chance(0.35):
            return Node('s', self.literal_string())

        def text():
            return self.string(depth + 1)

        def element():
            tokens = self.element_of(('s',), depth)
            return Node('s', *tokens) if tokens else Node('s', self.literal_string())
        return self.weighted([
            (3, lambda: self.shown_float(depth + 1)), (1, lambda: self.shown_vector(depth + 1)),
            (2, lambda: Node('s', 'concat', '(', *comma_list([text() for _ in range(1 + self.below(4))]), ')')),
            (1, lambda: Node('s', 'chr', '(', Node('f', self.pick(['65', '48', '97.9', '33+1', '126'])), ')')),
            (1, lambda: Node('s', self.pick(['strlwr', 'strupr']), '(', text(), ')')),
            (1, lambda: Node('s', 'substr', '(', Node('s', 'concat', '(', text(), ',', '"abcdef"', ')'), ',',
                             Node('f', self.pick(['1', '2', '3.7'])), ',', Node('f', self.pick(['0', '1', '2', '4'])), ')')),
            (0.1, lambda: Node('s', 'substr', '(', text(), ',', self.float(3), ',', self.float(3), ')')),
            (1, element), (1.5, lambda: self.user_call(depth, ('s',))),
        ])()

    def shown_float(self, depth: int) -> Node:
        width, digits = self.weighted([(6, ('0', '4')), (2, ('0', '7')), (1, ('0', '0')), (1, ('0', '-1')),
                                       (1, ('0', '12')), (1, ('6', '2')), (1, ('-8', '3')), (0.5, ('3.9', '1.5'))])
        return Node('s', 'str', '(', self.float(depth), ',', width, ',', digits, ')')

    def shown_vector(self, depth: int) -> Node:
        size = 2 + self.below(4)
        count, value = size, self.vector(depth, size)
        if self.chance(0.2):  # of other values POV-Ray shows what is in memory
            count, value = self.pick([0, 1, 2, 3, 4, 5, 6]), self.literal_vector(size, MAX_DEPTH)
        elif self.chance(0.1):
            value = Node('f', self.number())
        return Node('s', 'vstr', '(', str(count), ',', value, ',', self.pick(['","', '" "', '"/"', '""']), ',', '0', ',',
                    self.pick(['3', '5', '0']), ')')

    # ------------------------------------------------------------------------------------ by type
    @staticmethod
    def kind_of(kind: tuple) -> str:
        return f'v{kind[1]}' if kind[0] == 'v' else kind[0]

    def of_kind(self, kind: tuple, depth: int = 0) -> Node:
        if kind[0] == 'v':
            return self.vector(depth, kind[1])
        return self.string(depth) if kind[0] == 's' else self.float(depth)

    def atom(self, kind: tuple) -> Node:
        if kind[0] == 'v':
            return self.vector_atom(kind[1], 0)
        return Node('s', self.literal_string()) if kind[0] == 's' else self.float_atom()

    def some_kind(self) -> tuple:
        return self.weighted([(5, ('f',)), (1, ('v', 2)), (3, ('v', 3)), (0.6, ('v', 4)), (0.5, ('v', 5)), (3, ('s',))])

    def argument(self, kind: tuple, depth: int) -> Node:
        if self.chance(0.3):
            return self.atom(kind)
        return self.of_kind(kind, depth + 1)
