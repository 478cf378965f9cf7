# SPDX-License-Identifier: MIT
"""Makes scenes smaller on which two programs differ, and sorts what is left by kind: for `differential`."""
import concurrent.futures
import functools
import re

import judges
from scene_grammar import Node
from scene_statements import lines, plain

ATOMS = {'f': ['1', '2'], 'g': ['x', '2'], 'v2': ['u'], 'v3': ['x'], 'v4': ['t'], 's': ['"a"'], 'colour': ['rgb 1'],
         'v5': ['<1,0,0,0,0>']}
AT_A_TIME = 24
MOST_ROUNDS = 60


class Difference:
    """A scene on which the programs differ."""

    def __init__(self, seed: str, root: Node, pieces: list, theirs: judges.Verdict, ours: judges.Verdict) -> None:
        self.seed = seed
        self.root = root
        self.pieces = pieces
        self.theirs = theirs
        self.ours = ours

    @property
    def text(self) -> str:
        return ''.join(self.pieces)

    def same_ours(self, ours: judges.Verdict) -> bool:
        return ours.state == self.ours.state and general(ours.message) == general(self.ours.message)

    def signature(self) -> tuple:
        """What stays the same while the scene gets smaller."""
        return signature(self.theirs, self.ours)

    def kind(self) -> tuple:
        return (*self.signature(), shape(self.text) if self.ours.state == self.theirs.state else '')


def general(message: str) -> str:
    """A message without the names and numbers of its scene."""
    message = re.sub(r"; did you mean.*", '', message)
    message = re.sub(r"'[^']*'", "'_'", message)
    return re.sub(r'(?<!E)\b-?\d+(\.\d+)?', '0', message)


def signature(theirs: judges.Verdict, ours: judges.Verdict) -> tuple:
    return theirs.state, general(theirs.message), ours.state, general(ours.message)


TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|#\s*[a-z]+|[A-Za-z_][A-Za-z0-9_]*|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|<=|>=|!=|\S')
OWN_NAME = re.compile(r'[A-Z][a-z_0-9]*$')


def shape(text: str) -> str:
    """The scene without its comments and the spelling of its names, numbers and strings."""
    text = re.sub(r'/\*(?:[^*/]|/\*[^*/]*\*/)*\*/|//[^\r\n]*', ' ', text)
    names = {}
    tokens = []
    for token in TOKEN.findall(text):
        if OWN_NAME.match(token):
            token = names.setdefault(token, f'N{len(names) + 1}')
        elif token[0].isdigit() or token[0] == '.' and len(token) > 1:
            token = '1'
        elif token[0] == '"':
            token = '"|"' if token == '"|"' else '""'
        tokens.append(token)
    return ' '.join(tokens)


# ---------------------------------------------------------------------------------------- by the tree
def paths(node: Node, path: tuple = ()) -> list:
    """All nodes below the root, larger ones first."""
    found, level = [], [(node, path)]
    while level:
        below = []
        for part, at in level:
            for i, inner in enumerate(part.parts):
                if isinstance(inner, Node):
                    found.append((*at, i))
                    below.append((inner, (*at, i)))
        level = below
    return found


def at_path(node: Node, path: tuple) -> Node:
    for i in path:
        node = node.parts[i]
    return node


def replaced(node: Node, path: tuple, by) -> Node:
    """A copy with another part (or without it: None) in one place."""
    copy = Node(node.kind, *node.parts)
    i = path[0]
    if len(path) > 1:
        copy.parts[i] = replaced(copy.parts[i], path[1:], by)
    elif by is None:
        del copy.parts[i]
    else:
        copy.parts[i] = by
    return copy


def without(root: Node, statements: list) -> Node:
    """A copy without these, which are in the order of the text."""
    for path in reversed(statements):
        if not any(path[:len(other)] == other for other in statements if len(other) < len(path)):
            root = replaced(root, path, None)
    return root


def inner_of_kind(node: Node, kind: str) -> list:
    found = []
    for part in node.parts:
        if isinstance(part, Node):
            found += [part] if part.kind == kind else inner_of_kind(part, kind)
    return found


def smaller_trees(root: Node) -> list:
    """How to make scenes with fewer statements, then with one expression made smaller."""
    all_paths = paths(root)
    statements = sorted(path for path in all_paths if at_path(root, path).kind == 'stmt')
    found, size = [], len(statements) // 2
    while size:
        found += [functools.partial(without, root, statements[at:at + size]) for at in range(0, len(statements), size)]
        size //= 2
    for path in all_paths:
        node = at_path(root, path)
        instead = []
        if node.kind == 'stmt':
            instead = [Node('stmt', inner) for inner in inner_of_kind(node, 'stmt')[:4]]
        if node.kind in ATOMS and len(node.tokens()) > 1:
            instead = [Node(node.kind, atom) for atom in ATOMS[node.kind]]
            instead += [inner for inner in inner_of_kind(node, node.kind) if len(inner.tokens()) > 1]
        found += [functools.partial(replaced, root, path, by) for by in instead]
    return found


class Shrinker:
    def __init__(self, ask: judges.Judges) -> None:
        self.ask = ask

    def first(self, difference: Difference, candidates: list, start: int = 0) -> tuple:
        """The first of some functions that give (root, pieces) which shows the same difference, and where it is."""
        at, count = start, 4
        while at < len(candidates):
            some = [make() for make in candidates[at:at + count]]
            # abbe is asked first: it is the faster one.
            answers = self.ask.ask_abbe([''.join(pieces) for _, pieces in some])
            some = [(i, root, pieces) for i, ((root, pieces), ours) in enumerate(zip(some, answers), at)
                    if difference.same_ours(ours)]
            verdicts = self.ask.ask([''.join(pieces) for _, _, pieces in some])
            for (i, root, pieces), (theirs, ours) in zip(some, verdicts):
                if judges.differ(theirs, ours) and signature(theirs, ours) == difference.signature():
                    return Difference(difference.seed, root, pieces, theirs, ours), i
            at += count
            count = min(2 * count, AT_A_TIME)
        return None, 0

    def smaller(self, difference: Difference) -> Difference:
        root = difference.root
        plain_one, _ = self.first(difference, [lambda: (root, lines(root, 'plain', None))])
        return self.by_tokens(self.by_tree(plain_one) if plain_one else difference)

    def by_tree(self, difference: Difference) -> Difference:
        start = 0
        for _ in range(MOST_ROUNDS):
            def made(make):
                tree = make()
                return tree, lines(tree, 'plain', None)
            trees = [functools.partial(made, make) for make in smaller_trees(difference.root)]
            found, at = self.first(difference, trees, min(start, len(trees)))
            if not found and not start:
                break
            difference, start = found or difference, at  # what was tried before is tried again in the end
        return difference

    def by_tokens(self, difference: Difference) -> Difference:
        """Without runs of tokens, as long as any can be left out."""
        size = max(len(difference.pieces) // 2, 1)
        while size:
            root, pieces = difference.root, difference.pieces
            runs = [(at, at + size) for at in range(0, len(pieces), max(size // 2, 1))]
            if size <= 2:  # commas are left where they are: scenes are to be read
                runs = [(low, high) for low, high in runs if not set(pieces[low:high]) <= {',', ' ', '', '\n'}]
            shorter = [functools.partial(lambda low, high: (root, pieces[:low] + pieces[high:]), *run) for run in runs]
            found, _ = self.first(difference, shorter)
            if found:
                difference = found
                size = min(size, max(len(difference.pieces) // 2, 1))
            else:
                size //= 2
        return difference


def all_smaller(found: list, ask: judges.Judges, most: int) -> dict:
    """The differences by kind. Of each pair of messages only so many are made smaller."""
    by_signature = {}
    for difference in found:
        by_signature.setdefault(difference.signature(), []).append(difference)
    chosen, rest = [], []
    for group in by_signature.values():
        group.sort(key=lambda difference: len(difference.text))
        # Texts that differ have no message to tell them apart.
        count = most if group[0].theirs.state != group[0].ours.state else 8 * most
        chosen += group[:count]
        rest += group[count:]
    shrinker = Shrinker(ask)
    with concurrent.futures.ThreadPoolExecutor(judges.POVRAYS) as threads:
        small = list(threads.map(shrinker.smaller, chosen))
    kinds = {}
    for difference in small + rest:
        kinds.setdefault(difference.kind(), []).append(difference)
    return kinds
