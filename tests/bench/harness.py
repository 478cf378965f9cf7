# SPDX-License-Identifier: MIT
"""Runs programs and measures them: CPU seconds, seconds, peak memory, rays, instructions.

CPU seconds (user and system, of one thread) are what ratios are made of: a busy machine disturbs them least.
Programs that are compared run in turn, so that both meet the same machine; figures are medians.
"""
import dataclasses
import datetime
import json
import os
import pathlib
import platform
import re
import shutil
import statistics
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Failed(Exception):
    """A program did not do what it was asked for."""


@dataclasses.dataclass(frozen=True)
class Taken:
    cpu: float      # seconds, user and system
    wall: float     # seconds
    mb: float       # peak resident
    rays: int = 0   # abbe only


@dataclasses.dataclass
class Bench:
    """What all measurements share."""
    abbe: str
    folder: pathlib.Path      # scratch
    runs: int
    quick: bool
    log: object               # callable: one line of progress
    startup: dict = dataclasses.field(default_factory=dict)

    def render(self, scene, *words, size=(320, 240), threads=1) -> list:
        return [self.abbe, 'render', str(scene), '-W', size[0], '-H', size[1], '-j', threads, '--aa', 'off',
                '--allow-read', ROOT / 'examples', '-o', self.folder / 'abbe.png', *words]

    def povray(self, scene, *words, size=(320, 240), threads=1) -> list:
        return ['povray', f'+I{scene}', f'+L{pathlib.Path(scene).parent}', f'+O{self.folder}/povray.png', f'+W{size[0]}', f'+H{size[1]}',
                f'+WT{threads}', '+FN8', '-A', '-J', '-D', '-P', '-GA', *words]

    def run(self, command: list) -> Taken:
        words = [str(word) for word in command]
        started = time.perf_counter()
        log = self.folder / 'messages'
        with log.open('wb') as out:
            process = subprocess.Popen(words, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=out,
                                       stderr=subprocess.STDOUT)
            _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - started
        process.returncode = os.waitstatus_to_exitcode(status)
        text = log.read_text(errors='replace')
        if process.returncode != 0:
            raise Failed(f'{" ".join(words)}\nended with status {process.returncode}:\n{text[-2000:]}')
        rays = re.search(r'(\d+) rays$', text, re.M)
        return Taken(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024, int(rays.group(1)) if rays else 0)

    def side_by_side(self, commands: list) -> float:
        """Seconds of the clock until all have ended, started together."""
        started = time.perf_counter()
        running = [subprocess.Popen([str(word) for word in command], cwd=self.folder, stdin=subprocess.DEVNULL,
                                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for command in commands]
        if any([process.wait() != 0 for process in running]):
            raise Failed(f'one of {len(commands)} side by side failed: {" ".join(str(word) for word in commands[0])}')
        return time.perf_counter() - started

    def race(self, commands: dict, runs: int = 0) -> dict:
        """Medians of each command, run in turn."""
        taken = {name: [] for name in commands}
        for _ in range(runs or self.runs):
            for name, command in commands.items():
                taken[name].append(self.run(command))
        return {name: Taken(*(statistics.median(column) for column in zip(*map(dataclasses.astuple, all_of))))
                for name, all_of in taken.items()}

    def net(self, program: str, taken: Taken) -> float:
        """CPU seconds without what an empty scene takes."""
        return max(1e-4, taken.cpu - self.startup[program].cpu)

    def agree(self) -> dict:
        """How far apart the pictures are that the two programs wrote last (`abbe compare`)."""
        done = subprocess.run([self.abbe, 'compare', self.folder / 'povray.png', self.folder / 'abbe.png', '--json'],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Failed(done.stderr)
        return json.loads(done.stdout)['srgb']

    def instructions(self, command: list) -> int:
        """Instructions that a run carries out, by callgrind; deterministic."""
        words = ['valgrind', '--tool=callgrind', f'--callgrind-out-file={self.folder}/callgrind',
                 *(str(word) for word in command)]
        done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, check=False)
        found = re.search(r'Collected : (\d+)', done.stderr)
        if done.returncode != 0 or not found:
            raise Failed(f'{" ".join(words)}\n{done.stderr[-2000:]}')
        return int(found.group(1))


def have(tool: str) -> bool:
    return shutil.which(tool) is not None


def first_line(command: list) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return ((done.stdout + done.stderr).strip().splitlines() or [''])[0]


def in_checkout(text: str) -> str:
    """With paths counted from the checkout."""
    return text.replace(f'{ROOT}/', '')


def about(program: str, **settings) -> dict:
    """What was run, where and when; `settings` are what figures of one record have in common."""
    cpu = re.search(r'model name\s*: (.*)', pathlib.Path('/proc/cpuinfo').read_text())
    povray = subprocess.run(['povray', '--version'], capture_output=True, text=True, check=False)
    version = re.search(r'POV-Ray (\S+)', povray.stdout + povray.stderr)
    # What the program is made of: figures that are written meanwhile do not count.
    clean = subprocess.run(['git', '-C', str(ROOT), 'diff', '--quiet', 'HEAD', '--', 'src', 'grammar', 'stdlib', 'CMakeLists.txt'],
                           capture_output=True, check=False).returncode == 0
    return {'command': in_checkout(' '.join([f'tests/bench/{program}', *sys.argv[1:]])),
            'date': datetime.date.today().isoformat(),
            'commit': first_line(['git', '-C', str(ROOT), 'describe', '--always']) + ('' if clean else '-dirty'),
            'povray': f'POV-Ray {version.group(1) if version else "?"}',
            'machine': f'{cpu.group(1) if cpu else platform.machine()}, {os.cpu_count()} threads',
            'cores': os.cpu_count(), 'load': round(os.getloadavg()[0], 1), **settings}


# Figures that differ in any of these do not belong in one record.
TOGETHER = 'commit', 'machine', 'runs', 'quick', 'width', 'height', 'limit'


def kept(path: pathlib.Path | None, facts: dict, empty: dict, anew: bool = False) -> dict:
    """The record of a run that was interrupted, which goes on; or a new one.
    @param anew also in place of one of another program, machine or size
    @throw Failed there is such a one"""
    if path is None or not path.exists():
        return {'about': facts, **empty}
    record = json.loads(path.read_text(encoding='utf-8'))
    other = [f'{name} {record["about"].get(name)}, not {facts[name]}' for name in TOGETHER
             if name in facts and record['about'].get(name) != facts[name]]
    if other and anew:
        return {'about': facts, **empty}
    if other:
        raise Failed(f'{path} holds figures of {"; ".join(other)}: give another file, or remove it')
    return record


def write_json(path: pathlib.Path, record: dict) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(record, indent=1) + '\n', encoding='utf-8')
