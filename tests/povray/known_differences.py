# SPDX-License-Identifier: MIT
"""The differences that docs/compatibility.md has a row for: for `differential`."""
KNOWN = []


def row_of(difference) -> str:
    """The row that tells of this difference, or nothing."""
    for row, is_it in KNOWN:
        if is_it(difference):
            return row
    return ''
