# SPDX-License-Identifier: MIT
"""What the tests of the program share: where it is, how to run it, scenes to run it on.

The program under test is $ABBE (ctest sets it).
"""
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ABBE = os.environ.get('ABBE', 'abbe')

QUICK = '''camera { location <0, 0, -4> look_at 0 angle 40 }
light_source { <-5, 5, -5>, rgb 1 }
sphere { 0, 1 pigment { rgb <1, 0.5, 0.2> } }
'''

# Stochastic dispersion, inter-reflection and edges: what threads and tiles could disturb.
GLASS = '''global_settings { assumed_gamma 1 max_trace_level 8 spectral { bands 4 } }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <-5, 5, -5>, rgb 1 }
plane { y, -1 pigment { checker rgb 1, rgb 0.1 scale 0.4 } }
sphere { 0, 1 interior { glass { "N-SF11" } dispersion { stochastic } } }
box { -0.4, 0.4 rotate <20, 30, 0> translate <1.2, 0, -0.8>
  interior { glass { "N-BK7" } dispersion { deterministic } } }
'''

# Minutes of work at 2000 x 2000.
SLOW = GLASS.replace('bands 4', 'bands 200').replace('stochastic', 'deterministic')


class CliTest(unittest.TestCase):
    """A test with a folder of its own, self.folder, in which the program runs."""

    def setUp(self) -> None:
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix='abbe-cli-'))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.write('quick.scn', QUICK)

    def write(self, name: str, text: str) -> pathlib.Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding='utf-8')
        return path

    def names(self) -> list:
        """What lies in the folder, hidden files too."""
        return sorted(path.name for path in self.folder.iterdir())

    def run_abbe(self, *words, status: int = 0, timeout: float = 300, **more) -> subprocess.CompletedProcess:
        """Runs `abbe words...`; the exit status must be `status`."""
        command = [ABBE, *map(str, words)]
        folder = self.folder / more.pop('cwd', '.')
        done = subprocess.run(command, cwd=folder, capture_output=True, timeout=timeout,
                              check=False, stdin=subprocess.DEVNULL, **more)
        done.stdout = done.stdout.decode('utf-8', 'replace')
        done.stderr = done.stderr.decode('utf-8', 'replace')
        self.assertEqual(done.returncode, status,
                         f'{" ".join(command)}\nstdout:\n{done.stdout[-2000:]}\nstderr:\n{done.stderr[-2000:]}')
        return done

    def render(self, *words, scene: str = 'quick.scn', **more) -> subprocess.CompletedProcess:
        return self.run_abbe('render', scene, '-W', 24, '-H', 18, *words, **more)


class Running:
    """A program that was started and may be interrupted."""

    def __init__(self, folder: pathlib.Path, *words) -> None:
        self.process = subprocess.Popen([ABBE, *map(str, words)], cwd=folder, stdin=subprocess.DEVNULL,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def __enter__(self) -> 'Running':
        return self

    def __exit__(self, *_) -> None:
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()

    def wait_until_busy(self, cpu_seconds: float = 0.5, patience: float = 60) -> None:
        """Waits until the program has computed for a while: it is past its start on any machine."""
        ticks = os.sysconf('SC_CLK_TCK')
        end = time.monotonic() + patience
        while time.monotonic() < end and self.process.poll() is None:
            fields = pathlib.Path(f'/proc/{self.process.pid}/stat').read_text().rpartition(')')[2].split()
            if (int(fields[11]) + int(fields[12])) / ticks >= cpu_seconds:
                return
            time.sleep(0.02)
        raise AssertionError('the program did not get to work')

    def signal(self, number: int = signal.SIGINT) -> float:
        self.process.send_signal(number)
        return time.monotonic()


def have(tool: str) -> bool:
    return shutil.which(tool) is not None
