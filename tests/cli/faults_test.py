# SPDX-License-Identifier: MIT
"""One call to the system fails (fail_kth.c), whichever: the program goes on, or ends with an error. It is never ended by a signal,
and a picture that it says it has written is the right one."""
import os
import pathlib
import shutil
import subprocess
import unittest

from support import ABBE, CliTest, GLASS

SOURCE = pathlib.Path(__file__).with_name('fail_kth.c')
# The first calls of each kind one by one, then ever fewer.
SOME = sorted({*range(1, 13), *(int(12 * 1.23 ** i) for i in range(25))})
CALLS = {'memory': SOME, 'write': [*range(1, 9), 12, 20], 'sync': [1, 2, 3], 'thread': [1, 2, 3]}
SIZE = ('-W', '24', '-H', '18', '-j', '2')


@unittest.skipUnless(shutil.which('cc'), 'no C compiler here')
class Faults(CliTest):
    def setUp(self) -> None:
        super().setUp()
        self.library = self.folder / 'fail_kth.so'
        subprocess.run(['cc', '-O1', '-shared', '-fPIC', SOURCE, '-o', self.library, '-ldl'], check=True)

    def faulty(self, kind: str, at: int, *words) -> subprocess.CompletedProcess:
        return subprocess.run([ABBE, *words], cwd=self.folder, capture_output=True, timeout=120, check=False,
                              stdin=subprocess.DEVNULL,
                              env={**os.environ, 'LD_PRELOAD': str(self.library), 'ABBE_FAIL_KIND': kind,
                                   'ABBE_FAIL_AT': str(at)})

    def all_faults(self, words: tuple, wanted: pathlib.Path, output: pathlib.Path, prepare=lambda: None) -> None:
        whole, failed = wanted.read_bytes(), 0
        for kind, numbers in CALLS.items():
            for at in numbers:
                with self.subTest(kind=kind, at=at):
                    output.unlink(missing_ok=True)
                    prepare()
                    done = self.faulty(kind, at, *words)
                    self.assertIn(done.returncode, (0, 1, 2, 3), done.stderr[-2000:])
                    if done.returncode == 0:
                        self.assertEqual(output.read_bytes(), whole)
                    else:
                        failed += 1
                        self.assertIn(b'error', done.stderr)
                        self.assertFalse(output.exists())
        self.assertGreater(failed, 10)  # else nothing was made to fail

    def test_render(self):
        self.run_abbe('render', 'quick.scn', *SIZE, '-o', 'whole.png')
        self.all_faults(('render', 'quick.scn', *SIZE, '-o', 'out.png', '--checkpoint'), self.folder / 'whole.png',
                        self.folder / 'out.png')

    def test_study(self):
        self.write('glass.scn', GLASS)
        words = ('study', 'glass.scn', '-W', '12', '-H', '9', '--modes', 'deterministic', '--bands', '4', '--reference',
                 'bands=8,aa=2', '-j', '2')
        failed = 0
        for kind, numbers in CALLS.items():
            for at in numbers[::3]:
                with self.subTest(kind=kind, at=at):
                    done = self.faulty(kind, at, *words)
                    self.assertIn(done.returncode, (0, 1, 2, 3), done.stderr[-2000:])
                    failed += done.returncode != 0
        self.assertGreater(failed, 5)

    def test_resume(self):
        self.write('glass.scn', GLASS)
        words = ('render', 'glass.scn', '-W', '40', '-H', '30', '--tile', '4', '-j', '2', '-o', 'out.png', '--checkpoint')
        self.run_abbe(*words)
        shutil.move(self.folder / 'out.png', self.folder / 'whole.png')
        kept, copy = self.folder / 'out.png.abbe-checkpoint', self.folder / 'copy'
        # A write that fails late: what was finished before it is in the checkpoint.
        self.faulty('sync', 1, *words)
        if not kept.exists():
            self.skipTest('nothing was kept to go on from')
        shutil.copy(kept, copy)
        self.all_faults((*words, '--resume'), self.folder / 'whole.png', self.folder / 'out.png',
                        lambda: shutil.copy(copy, kept))


if __name__ == '__main__':
    unittest.main()
