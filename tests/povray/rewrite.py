# SPDX-License-Identifier: MIT
"""A scene of abbe as POV-Ray can read it: the blocks that only abbe has are rewritten or dropped.

| abbe                                  | POV-Ray |
|---------------------------------------|---------|
| `glass {...}` / `glass "X"` in an interior | `ior` and `dispersion` with the same nd and nF - nC |
| `#declare X = glass {...}`            | dropped; used where `glass { X }` stands |
| `dispersion {...}`                    | dropped; `{ none }` leaves the `dispersion` number out |
| `spectral {...}`, `effects {...}`, `caustics {...}` | dropped |
| `radiosity`, `media`, `subsurface` blocks | dropped: abbe does not render them yet |
| `photons` blocks                      | dropped: abbe is called without thrown light |
| `spectrum {...}`, `metal`, `glass_catalog` | cannot be rewritten: an error |

Absorption of glasses is lost. An object of glass without a texture is clear in abbe and black in POV-Ray:
scenes to be compared give it one. Files that a scene includes are not rewritten.
"""
import dataclasses
import re
import typing

# What abbe reads and does not render yet. Where one is declared it stays: it does nothing there.
NOT_RENDERED = ('radiosity', 'photons', 'media', 'subsurface')

# Fraunhofer lines in micrometres: F and C of hydrogen, d of helium.
LINE_F, LINE_D, LINE_C = 0.48613270, 0.58756180, 0.65627250


class CannotRewrite(Exception):
    """The scene says what POV-Ray cannot."""


@dataclasses.dataclass(frozen=True)
class GlassConstants:
    """Index at the d line and principal dispersion nF - nC."""
    nd: float
    principal_dispersion: float


# Looks a catalogue name up: `abbe glass show NAME --json`.
Catalogue = typing.Callable[[str], GlassConstants]

TOKEN = re.compile(r'(?P<blank>\s+|//[^\n]*|/\*.*?\*/)|(?P<string>"(?:\\.|[^"\\])*")'
                   r'|(?P<word>#?\s*[A-Za-z_]\w*)|(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)'
                   r'|(?P<other>.)', re.S)


@dataclasses.dataclass
class Token:
    kind: str
    text: str


def tokens_of(text: str) -> list:
    return [Token(match.lastgroup, match.group()) for match in TOKEN.finditer(text)]


def text_of(tokens: list) -> str:
    return ''.join(token.text for token in tokens)


def pov_dispersion(glass: GlassConstants) -> tuple:
    """`ior` and `dispersion` of POV-Ray's law n(l) = ior D^((555 - l) / 350), l in nm, through nd and
    nF - nC. The difference grows with D, so D is found by bisection."""
    power = {line: (555 - 1000 * line) / 350 for line in (LINE_F, LINE_D, LINE_C)}

    def difference(ratio: float) -> float:
        scale = glass.nd / ratio ** power[LINE_D]
        return scale * (ratio ** power[LINE_F] - ratio ** power[LINE_C])

    low, high = 1.0, 2.0
    if not 0 <= glass.principal_dispersion <= difference(high):
        raise CannotRewrite(f'nF - nC = {glass.principal_dispersion} is beyond POV-Ray\'s law')
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if difference(middle) < glass.principal_dispersion else (low, middle)
    return glass.nd / low ** power[LINE_D], low


def constants_of_formula(n: typing.Callable[[float], float]) -> GlassConstants:
    return GlassConstants(n(LINE_D), n(LINE_F) - n(LINE_C))


def glass_of_formula(kind: str, c: list) -> GlassConstants:
    """The formulas of scene-language that take literal coefficients; wavelengths in um."""
    if kind == 'abbe' and len(c) == 2:
        return GlassConstants(c[0], (c[0] - 1) / c[1])
    if kind == 'sellmeier' and len(c) == 6:
        return constants_of_formula(lambda w: (1 + sum(c[i] * w * w / (w * w - c[3 + i])
                                                       for i in range(3))) ** .5)
    if kind == 'schott' and len(c) == 6:
        return constants_of_formula(lambda w: (c[0] + c[1] * w ** 2 + sum(
            c[i] * w ** (2 - 2 * i) for i in range(2, 6))) ** .5)
    if kind == 'cauchy' and len(c) == 3:
        return constants_of_formula(lambda w: c[0] + c[1] / w ** 2 + c[2] / w ** 4)
    raise CannotRewrite(f'glass {{ {kind} ... }} with {len(c)} coefficients')


class Rewriter:
    """Rewrites one scene; glasses that it declares are remembered."""

    def __init__(self, text: str, catalogue: Catalogue) -> None:
        self.tokens = tokens_of(text)
        self.catalogue = catalogue
        self.declared = {}
        self.no_dispersion = False  # the scene's default mode is `none`
        self.changed = False

    def following(self, at: int) -> int:
        """The next token that is not blank."""
        at += 1
        while at < len(self.tokens) and self.tokens[at].kind == 'blank':
            at += 1
        return at

    def is_text(self, at: int, text: str) -> bool:
        return at < len(self.tokens) and self.tokens[at].text == text

    def close_of(self, opening: int) -> int:
        depth = 0
        for at in range(opening, len(self.tokens)):
            depth += {'{': 1, '}': -1}.get(self.tokens[at].text, 0)
            if depth == 0:
                return at
        raise CannotRewrite('a brace is not closed')

    def words_in(self, begin: int, end: int) -> list:
        return [token.text for token in self.tokens[begin:end] if token.kind != 'blank']

    def glass_at(self, at: int) -> tuple:
        """The glass whose word stands at `at`, and the first token behind it."""
        value = self.following(at)
        if not self.is_text(value, '{'):
            return self.glass_named(self.words_in(value, value + 1)), value + 1
        close = self.close_of(value)
        return self.glass_named(self.words_in(value + 1, close)), close + 1

    def glass_named(self, words: list) -> GlassConstants:
        if not words:
            raise CannotRewrite('an empty glass')
        first = words[0]
        if first.startswith('"'):
            return self.catalogue(first[1:-1])
        if first in self.declared:
            return self.declared[first]
        numbers, sign, depth = [], 1, 0
        for word in words[1:]:
            depth += {'<': 1, '>': -1}.get(word, 0)
            if re.match(r'[\d.]', word):
                numbers.append(sign * float(word))
            elif re.match(r'[A-Za-z_]', word):
                if depth:
                    raise CannotRewrite(f'glass {{ {first} ... {word} ... }} is no list of numbers')
                break  # range, transmittance: not for POV-Ray
            sign = -1 if word == '-' else 1
        return glass_of_formula(first, numbers)

    def dropped(self, at: int) -> typing.Optional[int]:
        """The first token behind a block at `at` that abbe does not render yet; None: there is none."""
        after = self.following(at)
        if self.tokens[at].text not in NOT_RENDERED or not self.is_text(after, '{'):
            return None
        before = at - 1
        while before >= 0 and self.tokens[before].kind == 'blank':
            before -= 1
        if before >= 0 and self.tokens[before].text == '=':
            return None
        self.changed = True
        return self.close_of(after) + 1

    def interior(self, begin: int, end: int, out: list) -> None:
        """The content of an interior block."""
        none = self.no_dispersion
        for at in range(begin, end):
            if self.is_text(at, 'dispersion') and self.is_text(self.following(at), '{'):
                block = self.following(at)
                none = 'none' in self.words_in(block, self.close_of(block))
        at = begin
        while at < end:
            token = self.tokens[at]
            behind = self.dropped(at)
            if behind is not None:
                at = behind
            elif token.kind == 'word' and token.text == 'glass':
                glass, at = self.glass_at(at)
                ior, ratio = pov_dispersion(glass)
                out.append(f'ior {glass.nd:.9f}' if none else f'ior {ior:.9f} dispersion {ratio:.9f}')
                self.changed = True
            elif token.text == 'dispersion' and self.is_text(self.following(at), '{'):
                at = self.close_of(self.following(at)) + 1
                self.changed = True
            else:
                out.append(token.text)
                at += 1

    def declaration(self, at: int) -> typing.Optional[int]:
        """Takes `#declare X = glass {...}` at `at`; returns the first token behind it."""
        name = self.following(at)
        equals = self.following(name)
        word = self.following(equals)
        if not (self.is_text(equals, '=') and self.is_text(word, 'glass')):
            return None
        self.declared[self.tokens[name].text], end = self.glass_at(word)
        self.changed = True
        semicolon = self.following(end - 1)
        return semicolon + 1 if self.is_text(semicolon, ';') else end

    def spectral(self, block: int) -> int:
        close = self.close_of(block)
        words = self.words_in(block, close)
        for i, word in enumerate(words[:-2]):
            if word == 'dispersion':
                self.no_dispersion = words[i + 2] == 'none'
        self.changed = True
        return close + 1

    def run(self) -> str:
        out, at = [], 0
        while at < len(self.tokens):
            token, after = self.tokens[at], self.following(at)
            if token.kind == 'word':
                behind = self.dropped(at)
                if behind is not None:
                    at = behind
                    continue
                if re.fullmatch(r'#\s*(declare|local)', token.text):
                    end = self.declaration(at)
                    if end is not None:
                        at = end
                        continue
                elif token.text == 'interior' and self.is_text(after, '{'):
                    close = self.close_of(after)
                    out.append(text_of(self.tokens[at:after + 1]))
                    self.interior(after + 1, close, out)
                    at = close
                    continue
                elif token.text in ('effects', 'caustics') and self.is_text(after, '{'):
                    self.changed = True
                    at = self.close_of(after) + 1
                    continue
                elif token.text == 'spectral' and self.is_text(after, '{'):
                    at = self.spectral(after)
                    continue
                elif (token.text in ('spectrum', 'glass', 'metal', 'glass_catalog')
                      and after < len(self.tokens)
                      and (self.is_text(after, '{') or self.tokens[after].kind == 'string')):
                    raise CannotRewrite(f'{token.text} has no counterpart in POV-Ray here')
            out.append(token.text)
            at += 1
        return ''.join(out)


def rewrite(text: str, catalogue: Catalogue) -> typing.Optional[str]:
    """The scene for POV-Ray; None when it can read the scene as it is."""
    rewriter = Rewriter(text, catalogue)
    result = rewriter.run()
    return result if rewriter.changed else None
