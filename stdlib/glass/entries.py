# SPDX-License-Identifier: MIT
"""What the generators share: reading the TSV data, writing *.inc files with one entry a line and index.txt."""
import os


def read_tsv(path):
    """The rows as dictionaries; '#' lines are comments and the first other line names the columns."""
    lines = [line.rstrip("\n") for line in open(path, encoding="utf-8") if not line.startswith("#")]
    names = lines[0].split("\t")
    return [dict(zip(names, line.split("\t"))) for line in lines[1:] if line]


def group(rows, *keys):
    """Rows with equal keys together, in the order of first appearance."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return groups.items()


def table(rows, *columns):
    """[a, b] [c, d] .. sorted by the first column; equal rows once."""
    seen = {}
    for row in rows:
        values = [row[column] for column in columns]
        assert all(value not in ("-", "") for value in values), row
        previous = seen.setdefault(float(values[0]), values)
        assert previous == values, (previous, values)
    return " ".join("[" + ", ".join(values) + "]" for _, values in sorted(seen.items()))


class Library:
    """Files of entries below one folder and their index."""

    def __init__(self, folder):
        self.folder, self.files, self.index, self.current = folder, {}, {}, None

    def file(self, name, header):
        self.current = name
        self.files[name] = bytearray(("// SPDX-License-Identifier: CC0-1.0\n" + header.strip("\n") + "\n").encode())

    def entry(self, kind, name, body, aliases=()):
        assert '"' not in name and "\\" not in name and "\t" not in name, name
        text = ('%s "%s" { %s }' % (kind, name, body)).encode()
        data = self.files[self.current]
        for key in [name, *aliases]:
            assert key not in self.index, key
            self.index[key] = (self.current, len(data), len(text))
        data += text + b"\n"

    def write(self):
        for name, data in self.files.items():
            with open(os.path.join(self.folder, name), "wb") as out:
                out.write(data)
        with open(os.path.join(self.folder, "index.txt"), "wb") as out:
            for name, place in sorted(self.index.items(), key=lambda item: item[0].encode()):
                out.write(("%s\t%s\t%d\t%d\n" % (name, *place)).encode())
