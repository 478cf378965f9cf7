# SPDX-License-Identifier: MIT
"""The differences that docs/compatibility.md has a row for: for `differential`.

Each is told by what both programs say and by the scene, in which names are N1, N2, numbers 1 and strings ""
(shrink.shape()): the one program reads it, so that what the other says is all that differs.
"""
import pathlib
import re

PAGE = pathlib.Path(__file__).resolve().parents[2] / 'docs/compatibility.md'
ANY = ''

# Beginning of the row; what povray and abbe say of the scene ('': it is read); the scene.
KNOWN = [
    ('| `acosh(0.5)`, `atanh(2)`', r'', r'E0306 (acosh|atanh|asin|acos|pow|mod|div|vaxis_rotate|atan2): '
     r'(not defined|division by zero|0 to the power|the axis has no).*', ANY),
    ('| `substr` from character 0 or before |', r'', r'E0306 substr: .* characters from number -?0 on .*', ANY),
    ('| `t` as a value alone', r"Expected 'RValue to declare', t found instead", r'', r'.*= t .*'),
    ('| `t` as a value alone', r'Insufficent number of initializers', r'', r'.*array(?: \[ 1 \])+ \{(?:.*[{,])? t .*'),
    ('| `t` as a value alone', r'Expected \d parameters but only \d found\.', r'', r'.*N\d+ \((?:.*,)? t [,)].*'),
    ('| `#local A = A + 1;` in a macro', r'Cannot assign uninitialized identifier\.', r'', r'.*#local (N\d+) = \1 .*'),
    ('| `#local A = A + 1;` in a macro', r"Expected '.*', undeclared identifier '\w+' found instead", r'',
     r'.*#local (N\d+) = .*\b\1\b.*'),
    ('| `#local A[0] = 1;` of an outer', r"Expected '=', \[ found instead", r'', r'.*#local N\d+ \[.*'),
    ("| a macro's name for a value", r"Expected 'undeclared identifier', .* found instead", r'',
     r'.*(?:#declare|#local|#macro) .*'),
    ("| a macro's name for a value", r'Attempted to redefine .* identifier as .* identifier\.', r'', ANY),
    ("| a parameter of the macro's own name", r"Can't invoke a macro while declaring its parameters", r'',
     r'.*#macro (N\d+) \(.*\b\1\b.*'),
    ('| one comma too many', r".*, , found instead", r'', ANY),
    ('| one comma too many', r'All #declares of float, .*', r'', r'.*, ;.*'),
    ('| one comma too many', r"Expected '.*', [)>] found instead", r'', r'.*, [)>].*'),
    ('| one comma too many', r'#switch not followed by #case or #range\.', r'', r'.*#switch \(.*\) ,.*'),
    ('| a `;` too many', r"Expected 'object or directive', ; found instead", r'', r'.*[;)}] ;.*'),
    ('| a string in parentheses', r"Expected 'string expression', \( found instead", r'', r'.*\(.*".*'),
    ('| a string in parentheses', r"Expected 'string comparison operator', \) found instead", r'', ANY),
    ('| branches in a macro', r"Expected '\)', # found instead", r'', r'.*#macro .*#(?:if|elseif|while) .*'),
    ('| `>=` where', r"Expected '>', >= found instead", r'', r'.*>= .*'),
    ('| `#else` and `#end`', r"Mis-matched '#(?:else|end)'\.", r'', r'.*#if .*'),
    ('| branches in a macro', r'All #declares of float, .*', r'', r'.*#macro .*#(?:if|ifdef|ifndef|switch) .*'),
    ('| a macro as an element', r'Insufficent number of initializers', r'', r'.*#macro .*array .*'),
    ('| `#else`, `#case` in the body of a loop', r'', r"E0111 expected '#end' to close the directive, found '#\w+'",
     r'.*#(?:for|while) .*'),
    ('| an infinite value', r'', r'E0303 .* is not a finite number but .*', ANY),
    ('| division by 0 in a `function { }` by constants', r'Division by zero\.', r'', r'.*function .*/.*'),
]


# Beginning of the row; the scene; what of the texts that both show tells nothing, and what stands for it.
SHOWN = [
    ('| `str` of more than', ANY, r'-?(?:\d{40}|\d(?:\.\d+)?e[+-]\d|<invalid>).*', 'long'),
    ('| `int` and `div` beyond', r'.*(?:int|div) .*', r'-?\d{10,}(?:\.\d*)?', 'int'),
    ('| the sign of what is not a number', ANY, r'-?nan', 'nan'),
    ('| turning by `vrotate`', r'.*v(?:axis_)?rotate .*', r'-(0(?:\.0*)?)(?![\d.])', r'\1'),
]


def missing_rows() -> list:
    page = PAGE.read_text(encoding='utf-8')
    return [row for row, *_ in KNOWN + SHOWN if f'\n{row}' not in page]


def row_of_shown(theirs, ours, shape: str) -> str:
    """The last of the rows that tell of the differences in the texts, or nothing."""
    texts = [list(theirs.shown), list(ours.shown)]
    for row, scene, pattern, stands in SHOWN:
        if scene != ANY and not re.fullmatch(scene, shape):
            continue
        texts = [[re.sub(pattern, stands, line) for line in text] for text in texts]
        if texts[0] == texts[1]:
            return row
    return ''


def row_of(theirs, ours, shape: str) -> str:
    """The row that tells of a difference, or nothing. @param theirs, ours the verdicts"""
    if theirs.state == ours.state:
        return row_of_shown(theirs, ours, shape)
    for row, povray, abbe, scene in KNOWN:
        if (re.fullmatch(povray, theirs.message) and re.fullmatch(abbe, ours.message)
                and (scene == ANY or re.fullmatch(scene, shape))):
            return row
    return ''
