# SPDX-License-Identifier: MIT
"""Bad scenes: each of bad/*.scn ends with status 1 and at least one message that has a code and a place
(file:line:column), in seconds and without eating the machine."""
import os
import pathlib
import re
import resource
import shutil
import subprocess
import time
import unittest

from support import ABBE, CliTest, ROOT

BAD = pathlib.Path(__file__).resolve().parent / 'bad'
MESSAGE = re.compile(r'^[^\s:]+:\d+:\d+(?:-\d+)?(?::\d+)?: error\[E\d{4}\]: \S', re.MULTILINE)
MOST_SECONDS = 5.0
MOST_BYTES = 2 << 30


class BadScenes(CliTest):
    pass


class Truncated(CliTest):
    """Every example cut at 40 places: a status, never a crash; no error only where the rest is whole."""

    def test_examples(self):
        for scene in sorted((ROOT / 'examples').glob('*.scn')):
            text = scene.read_bytes()
            for include in (ROOT / 'examples').glob('*.inc'):
                shutil.copy(include, self.folder)
            for part in range(0, 40):
                end = len(text) * part // 40
                with self.subTest(scene=scene.name, bytes=end):
                    (self.folder / 'cut.scn').write_bytes(text[:end])
                    done = subprocess.run([ABBE, 'check', 'cut.scn'], cwd=self.folder, capture_output=True,
                                          timeout=30, check=False)
                    messages = done.stderr.decode('utf-8', 'replace')
                    self.assertIn(done.returncode, (0, 1), messages)
                    if done.returncode == 1:
                        self.assertRegex(messages, MESSAGE)


def limit_memory() -> None:
    # Stack and libraries are address space too: what is used is less.
    if 'ASAN_OPTIONS' not in os.environ:  # which maps the whole address space
        resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))


def check(test: unittest.TestCase, scene: pathlib.Path) -> None:
    started = time.monotonic()
    process = subprocess.Popen([ABBE, 'check', scene.name], cwd=scene.parent, stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, preexec_fn=limit_memory)
    messages = process.stderr.read().decode('utf-8', 'replace')
    process.stderr.close()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    seconds = min(time.monotonic() - started, usage.ru_utime + usage.ru_stime)  # a busy machine is no fault
    test.assertEqual(process.returncode, 1, messages[-2000:])
    test.assertRegex(messages[:100000], MESSAGE)
    if 'ASAN_OPTIONS' not in os.environ:
        test.assertLess(seconds, MOST_SECONDS)
        test.assertLess(usage.ru_maxrss * 1024, MOST_BYTES)


def add_test(scene: pathlib.Path) -> None:
    setattr(BadScenes, f'test_{scene.stem}', lambda self: check(self, scene))


for path in sorted(BAD.glob('*.scn')):
    add_test(path)

if __name__ == '__main__':
    unittest.main()
