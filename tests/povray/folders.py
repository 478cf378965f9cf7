# SPDX-License-Identifier: MIT
"""Whole folders of POV-Ray scenes by abbe and by povray, with the same command line: figures, a table and a page.

Both programs get POV-Ray's options (`abbe povray` reads them), one thread, no anti-aliasing and quality 8: without media,
radiosity, photons and subsurface light, which abbe leaves out, and without fog, which tests/povray/scenes compares. A scene that asks for `frame_number` is the first frame of
one. Programs are ended after a time, and may crash: the others go on, and a second call with the same folder of results
goes on where the first stopped.
"""
import argparse
import concurrent.futures
import hashlib
import json
import math
import os
import pathlib
import shutil
import statistics
import subprocess
import tempfile
import threading
import time

import page

KEPT = 'results.json'
# What a result depends on beside the scene: another version of these lines renders anew.
VERSION = 1


def scenes_of(places: list) -> list:
    """(root, scene) for each .pov below the folders, each scene once."""
    found, seen = [], set()
    for place in places:
        for scene in sorted(place.rglob('*.pov')) if place.is_dir() else [place]:
            real = scene.resolve()
            if real not in seen:
                seen.add(real)
                found.append((place.resolve() if place.is_dir() else scene.resolve().parent, real))
    return found


class Run:
    """One program's run: its status, seconds of CPU and MiB of memory (not less than this script's own, some 28)."""

    def __init__(self, command: list, folder: pathlib.Path, seconds: float, environment: dict) -> None:
        started = time.monotonic()
        self.timed_out = False
        with tempfile.TemporaryFile() as said:
            process = subprocess.Popen([str(word) for word in command], cwd=folder, env=environment,
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=said)
            timer = threading.Timer(seconds, self.end, [process])
            timer.start()
            _, status, usage = os.wait4(process.pid, 0)
            timer.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            said.seek(0, os.SEEK_END)
            said.seek(max(0, said.tell() - 4000))
            self.said = said.read().decode('utf-8', 'replace')
        self.status = process.returncode
        self.cpu_s = usage.ru_utime + usage.ru_stime
        self.mib = usage.ru_maxrss / 1024
        self.wall_s = time.monotonic() - started

    def end(self, process: subprocess.Popen) -> None:
        self.timed_out = True
        process.kill()

    def why(self) -> str:
        """Why there is no picture, in a line."""
        if self.timed_out:
            return 'not done in time'
        lines = [line.strip() for line in self.said.replace('\r', '\n').splitlines()]
        errors = [line for line in lines if 'error' in line.lower() and not line.startswith('abbe: ')]
        if self.status < 0:
            return f'ended by signal {-self.status}'
        return (errors or lines or [f'status {self.status}'])[0][:300]


class Folders:
    def __init__(self, options: argparse.Namespace, keep: pathlib.Path) -> None:
        self.options, self.keep = options, keep
        keep.mkdir(parents=True, exist_ok=True)
        self.lock = threading.Lock()
        self.results = {}
        digest = hashlib.sha256(pathlib.Path(options.abbe).read_bytes()).hexdigest()[:16]
        self.key = f'{VERSION} {digest} {options.width}x{options.height}'
        if (keep / KEPT).is_file():
            kept = json.loads((keep / KEPT).read_text(encoding='utf-8'))
            if kept.get('key') == self.key:
                self.results = {result['scene']: result for result in kept['results']}
        # POV-Ray needs its ini file to find its includes; what that says of size and kind the words say again.
        (keep / 'none.ini').write_text('', encoding='utf-8')
        self.environments = {'povray': {name: value for name, value in os.environ.items() if name != 'POVINI'},
                             'abbe': {**os.environ, 'POVINI': str(keep / 'none.ini')}}

    def words(self, root: pathlib.Path, scene: pathlib.Path, picture: pathlib.Path) -> list:
        size = [f'+W{self.options.width}', f'+H{self.options.height}']
        words = [f'+I{scene.name}', f'+O{picture}', *size, f'+L{root}', '+WT1', '+FN8', '-A', '-D', '-P', '+Q8', '-V']
        if 'frame_number' in scene.read_text(encoding='latin-1'):
            words += ['+KFI1']
        return words

    def compare(self, root: pathlib.Path, scene: pathlib.Path) -> dict:
        name = hashlib.sha256(str(scene).encode()).hexdigest()[:12]
        result = {'scene': str(scene), 'name': str(scene.relative_to(root)), 'id': name}
        pictures = {}
        # Scenes write files beside themselves: each program gets a copy of the folder of its own.
        for program in ('povray', 'abbe'):
            with tempfile.TemporaryDirectory(prefix='abbe-folders-') as temporary:
                folder = pathlib.Path(temporary, 'scene')
                shutil.copytree(scene.parent, folder, symlinks=True,
                                ignore=lambda _, names: [n for n in names if n.endswith('.pov') and n != scene.name])
                picture = pathlib.Path(temporary, 'picture')
                start = ['povray'] if program == 'povray' else [self.options.abbe, 'povray']
                words = self.words(root, scene, picture)
                run = Run([*start, *words], folder, self.options.limit, self.environments[program])
                made = sorted(pathlib.Path(temporary).glob('picture*.png'))
                result[program] = {'cpu_s': round(run.cpu_s, 3), 'mib': round(run.mib, 1)}
                if run.status == 0 and made:
                    pictures[program] = self.keep / f'{name}.{program}.png'
                    shutil.move(made[-1], pictures[program])
                else:
                    result[program]['why'] = run.why()
        if len(pictures) == 2:
            self.measure(result, pictures, name)
        return result

    def measure(self, result: dict, pictures: dict, name: str) -> None:
        difference = self.keep / f'{name}.difference.png'
        done = subprocess.run([self.options.abbe, 'compare', pictures['povray'], pictures['abbe'], '--json', '--diff',
                               difference, '--gain', '8'], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            result['abbe']['why'] = done.stderr.strip()[:300]
            return
        shown = json.loads(done.stdout)
        result['psnr_db'] = shown['srgb']['psnr_db']  # null: identical
        result['delta_e'] = shown['ciede2000']['mean']

    def one(self, root: pathlib.Path, scene: pathlib.Path) -> None:
        if str(scene) in self.results:
            return
        try:
            result = self.compare(root, scene)
        except OSError as error:
            result = {'scene': str(scene), 'name': scene.name, 'id': '', 'abbe': {'why': str(error)}, 'povray': {}}
        with self.lock:
            self.results[str(scene)] = result
            self.save()
        if not self.options.json:
            print(as_line(result), flush=True)

    def save(self) -> None:
        text = json.dumps({'key': self.key, 'results': list(self.results.values())}, indent=1)
        new = self.keep / (KEPT + '.new')
        new.write_text(text, encoding='utf-8')
        new.replace(self.keep / KEPT)

    def run(self, scenes: list) -> list:
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            list(pool.map(lambda item: self.one(*item), scenes))
        results = [self.results[str(scene)] for _, scene in scenes]
        (self.keep / 'index.html').write_text(page.page(results, summary(results), self.keep, self.options), encoding='utf-8')
        return results


def psnr_of(result: dict) -> float:
    return math.inf if result['psnr_db'] is None else result['psnr_db']


def as_line(result: dict) -> str:
    if 'psnr_db' not in result:
        program = 'povray' if 'why' in result['povray'] else 'abbe'
        return f'{result["name"]:<44} {program}: {result[program].get("why", "")}'
    psnr = 'identical' if result['psnr_db'] is None else f'{result["psnr_db"]:.1f} dB'
    return (f'{result["name"]:<44} {psnr:>9}  CIEDE2000 {result["delta_e"]:.2f}  abbe {result["abbe"]["cpu_s"]:.2f} s  '
            f'povray {result["povray"]["cpu_s"]:.2f} s')


def summary(results: list) -> dict:
    """Counts and ratios over all scenes that POV-Ray renders."""
    theirs = [result for result in results if 'why' not in result['povray']]
    both = [result for result in theirs if 'psnr_db' in result]
    ratios = [max(result['povray']['cpu_s'], 0.001) / max(result['abbe']['cpu_s'], 0.001) for result in both]
    return {
        'scenes': len(results), 'povray': len(theirs), 'abbe': len(both),
        'identical': sum(result['psnr_db'] is None for result in both),
        'above_40': sum(psnr_of(result) >= 40 for result in both),
        'above_30': sum(psnr_of(result) >= 30 for result in both),
        'ratio': statistics.geometric_mean(ratios) if ratios else None,
        'slower': sum(ratio < 1 for ratio in ratios),
        'more_memory': sum(result['abbe']['mib'] > result['povray']['mib'] + 32 for result in both),
    }


def summary_lines(found: dict) -> list:
    lines = [f'{found["scenes"]} scenes; povray renders {found["povray"]}, abbe {found["abbe"]} of these',
             f'{found["identical"]} identical, {found["above_40"]} at 40 dB or more, {found["above_30"]} at 30 dB or more']
    if found['ratio'] is not None:
        lines.append(f'CPU seconds, start-up included: POV-Ray / abbe {found["ratio"]:.2f} (geometric mean), abbe slower in '
                     f'{found["slower"]}; memory above POV-Ray\'s + 32 MB in {found["more_memory"]}')
    return lines
