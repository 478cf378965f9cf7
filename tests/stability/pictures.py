# SPDX-License-Identifier: MIT
"""Pictures of the stability suite: made by abbe or by POV-Ray, read, and compared."""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import threading
import zlib

SCENES = pathlib.Path(__file__).resolve().parent / 'scenes'


class Failed(Exception):
    """A program did not make the picture."""


class Picture:
    """An 8-bit RGB picture: rows of bytes, three a pixel."""

    def __init__(self, path: pathlib.Path) -> None:
        data = path.read_bytes()
        at, packed = 8, b''
        while at < len(data):
            length, kind = struct.unpack('>I4s', data[at:at + 8])
            body = data[at + 8:at + 8 + length]
            if kind == b'IHDR':
                self.width, self.height, depth, colour = struct.unpack('>IIBB', body[:10])
                if depth != 8 or colour not in (2, 6):
                    raise Failed(f'{path}: {depth} bits, colour type {colour}')
                size = 3 if colour == 2 else 4
            elif kind == b'IDAT':
                packed += body
            at += length + 12
        self.path = path
        self.rows = [bytes(byte for i, byte in enumerate(row) if size == 3 or i % 4 < 3)
                     for row in self._rows(zlib.decompress(packed), self.width * size, size)]

    @staticmethod
    def _rows(data: bytes, stride: int, size: int) -> list:
        rows, above = [], bytearray(stride)
        for start in range(0, len(data), stride + 1):
            kind, row = data[start], bytearray(data[start + 1:start + 1 + stride])
            for i in range(stride):
                a = row[i - size] if i >= size else 0
                b, c = above[i], above[i - size] if i >= size else 0
                if kind == 1:
                    row[i] = row[i] + a & 255
                elif kind == 2:
                    row[i] = row[i] + b & 255
                elif kind == 3:
                    row[i] = row[i] + (a + b) // 2 & 255
                elif kind == 4:
                    p = a + b - c
                    pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
                    row[i] = row[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c) & 255
            rows.append(bytes(row))
            above = row
        return rows

    def pixel(self, x: int, y: int) -> bytes:
        return self.rows[y][3 * x:3 * x + 3]

    def differing(self, other: 'Picture', codes: int = 1) -> set:
        """Pixels with a channel that is off by more than `codes` of 255."""
        assert (self.width, self.height) == (other.width, other.height)
        out = set()
        for y, (mine, theirs) in enumerate(zip(self.rows, other.rows)):
            if mine != theirs:
                out.update((i // 3, y) for i, (a, b) in enumerate(zip(mine, theirs))
                           if abs(a - b) > codes)
        return out

    def silhouettes(self, codes: int = 8) -> set:
        """Pixels within one pixel of an edge: a jump of more than `codes` to a neighbour."""
        edge = set()
        for y in range(self.height):
            for x in range(self.width):
                here = self.pixel(x, y)
                for i, j in ((x + 1, y), (x, y + 1)):
                    if i < self.width and j < self.height:
                        there = self.pixel(i, j)
                        if here != there and any(abs(a - b) > codes for a, b in zip(here, there)):
                            edge.update(((x, y), (i, j)))
        return {(x + i, y + j) for x, y in edge for i in (-1, 0, 1) for j in (-1, 0, 1)}

    def covered(self, background: bytes) -> int:
        """Number of pixels that are not of this colour."""
        return sum(self.pixel(x, y) != background
                   for y in range(self.height) for x in range(self.width))


class Renderer:
    """Makes pictures, each once; several at a time when asked for a list."""
    name = ''
    suffix = '.png'

    def __init__(self, width: int, height: int, folder: pathlib.Path, jobs: int = 2) -> None:
        self.width, self.height, self.folder = width, height, folder
        self.pool = concurrent.futures.ThreadPoolExecutor(jobs)
        self.made, self.lock = {}, threading.Lock()

    def render(self, scene: str, suffix: str = '.png', options: tuple = (), **declared):
        """A future of the path of the picture."""
        key = json.dumps([scene, self.width, self.height, suffix, list(options), sorted(declared.items())])
        with self.lock:
            if key not in self.made:
                stem = hashlib.sha256(key.encode()).hexdigest()[:16]
                out = self.folder / f'{pathlib.Path(scene).stem}-{self.name}-{stem}{suffix}'
                self.made[key] = self.pool.submit(self._run, SCENES / scene, out, options, declared)
            return self.made[key]

    def picture(self, scene: str, options: tuple = (), **declared):
        """The picture, or None when the program made none."""
        try:
            return Picture(self.render(scene, '.png', options, **declared).result())
        except Failed:
            return None

    def pictures(self, wanted: list) -> list:
        """wanted: pairs (scene, declarations)."""
        for scene, declared in wanted:
            self.render(scene, **declared)
        return [self.picture(scene, **declared) for scene, declared in wanted]

    def command(self, scene, out, options, declared) -> list:
        raise NotImplementedError

    def _run(self, scene, out, options, declared) -> pathlib.Path:
        done = subprocess.run(self.command(scene, out, options, declared), cwd=SCENES, text=True,
                              capture_output=True, check=False, timeout=600)
        if done.returncode != 0 or not out.exists():
            raise Failed(f'{self.name}: {scene.name} {declared}: {done.stderr[-800:]}')
        return out


class Abbe(Renderer):
    name = 'abbe'

    def __init__(self, program: str, *arguments) -> None:
        super().__init__(*arguments)
        self.program = program

    def sized(self, width: int, height: int) -> 'Abbe':
        return Abbe(self.program, width, height, self.folder)

    def command(self, scene, out, options, declared) -> list:
        command = [self.program, 'render', str(scene), '-o', str(out), '-W', str(self.width), '-H',
                   str(self.height), '--quiet']
        if '-j' not in options:
            command += ['-j', '1']
        for name, value in declared.items():
            command += ['-D', f'{name}={value}']
        return command + [str(option) for option in options]

    def differences(self, a: pathlib.Path, b: pathlib.Path) -> dict:
        done = subprocess.run([self.program, 'compare', str(a), str(b), '--json'], text=True,
                              capture_output=True, check=False)
        if done.returncode != 0:
            raise Failed(done.stderr)
        return json.loads(done.stdout)

    def metadata(self, exr: pathlib.Path, key: str) -> str:
        """A text of the file's header."""
        data = exr.read_bytes()
        at = data.find(key.encode() + b'\0string\0')
        if at < 0:
            raise Failed(f'{exr}: no {key}')
        at += len(key) + 8
        length = struct.unpack('<I', data[at:at + 4])[0]
        return data[at + 4:at + 4 + length].decode()


class PovRay(Renderer):
    name = 'povray'

    def command(self, scene, out, options, declared) -> list:
        return ['povray', f'+I{scene}', f'+O{out}', f'+W{self.width}', f'+H{self.height}', '+FN8',
                '-A', '-J', '-D', '-P', '-GA', '+WT1'] + [f'Declare={n}={v}' for n, v in declared.items()]


def find_abbe(given: str) -> str:
    program = shutil.which(given or os.environ.get('ABBE', ''))
    if not program:
        raise SystemExit(f'there is no {given}: build abbe, give --abbe or set ABBE')
    return str(pathlib.Path(program).resolve())


def workspace() -> tempfile.TemporaryDirectory:
    return tempfile.TemporaryDirectory(prefix='abbe-stability-')
