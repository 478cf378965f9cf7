# SPDX-License-Identifier: MIT
"""Killed renders go on to the same bytes; checkpoints of anything else are refused."""
import random
import resource
import signal
import time
import unittest

import support
from support import CliTest, GLASS, Running

SIZE = ('-W', 80, '-H', 60, '--tile', 8)
KEPT = 'out.png.abbe-checkpoint'


class Resume(CliTest):
    def setUp(self) -> None:
        super().setUp()
        self.write('glass.scn', GLASS.replace('bands 4', 'bands 12'))
        self.seconds = 2.0  # that the whole takes; measured

    def whole(self, *words) -> bytes:
        started = time.monotonic()
        self.run_abbe('render', 'glass.scn', *SIZE, '-o', 'whole.png', *words, timeout=300)
        self.seconds = time.monotonic() - started
        data = (self.folder / 'whole.png').read_bytes()
        (self.folder / 'whole.png').unlink()
        return data

    def kill_until_done(self, *words, output='out.png') -> int:
        """Kills the render at random moments until it gets through; the number of kills."""
        moments, kills = random.Random(7), 0
        for _ in range(40):
            with Running(self.folder, 'render', 'glass.scn', *SIZE, '-o', output, '--checkpoint', '--resume',
                         *words) as running:
                try:
                    running.process.wait(timeout=0.05 + moments.uniform(0, self.seconds / 4) * (1 + kills / 10))
                except support.subprocess.TimeoutExpired:
                    running.signal(signal.SIGKILL)
                    running.process.wait()
                    kills += 1
                    continue
                self.assertEqual(running.process.returncode, 0, running.process.stderr.read())
                return kills
        self.fail('the render does not get on')

    def test_killed_at_any_moment(self):
        for words in (('--aa', 'off'), ('--aa', 2), ('--aa', 2, '--aa-method', 2), ('--samples', '1..8'),
                      ('--aa', 2, '--aa-jitter', 1, '--passes', 2)):
            with self.subTest(words):
                whole = self.whole(*words)
                kills = self.kill_until_done(*words)
                self.assertEqual((self.folder / 'out.png').read_bytes(), whole, f'after {kills} kills')
                self.assertEqual([name for name in self.names() if 'checkpoint' in name], [])
                (self.folder / 'out.png').unlink()

    def test_spectral_film_too(self):
        self.run_abbe('render', 'glass.scn', *SIZE, '-o', 'whole.exr', '--spectral')
        self.kill_until_done('--spectral', output='out.exr')
        self.assertEqual((self.folder / 'out.exr').read_bytes(), (self.folder / 'whole.exr').read_bytes())

    def interrupted(self, *words) -> str:
        with Running(self.folder, 'render', 'glass.scn', '-W', 1500, '-H', 1500, '-o', 'out.png', '--checkpoint',
                     *words) as running:
            deadline = time.monotonic() + 60
            while not (self.folder / KEPT).exists() and time.monotonic() < deadline:
                time.sleep(0.02)
            time.sleep(0.2)
            running.signal()
            return running.process.communicate(timeout=30)[1].decode()

    def test_next_render_removes_what_a_killed_one_left(self):
        # 64 million pixels are 24 strips: the file is begun long before the end.
        words = ('-W', 8000, '-H', 8000, '-o', 'out.png', '--no-checkpoint')

        def begun() -> list:
            return [name for name in self.names() if name.endswith('.tmp')]

        self.write('.out.png.backup.tmp', 'of somebody else')
        self.write('.out.png.exr.1-2.tmp', 'of another picture')
        kept = begun()

        def streaming(running, *old) -> str:
            deadline = time.monotonic() + 60
            while time.monotonic() < deadline:
                for name in begun():
                    if name not in (*kept, *old):
                        return name
                self.assertIsNone(running.process.poll())
                time.sleep(0.01)
            self.fail('no picture was begun')

        with Running(self.folder, 'render', 'quick.scn', *words) as running:
            left = streaming(running)
            running.signal(signal.SIGKILL)
            running.process.wait()
        self.assertIn(left, begun())
        with Running(self.folder, 'render', 'quick.scn', *words) as running:
            alive = streaming(running, left)
            self.assertNotIn(left, begun(), 'the next render removes what is left')
            self.run_abbe('render', 'quick.scn', '-W', 8, '-H', 8, '-o', 'out.png')
            self.assertIn(alive, begun(), 'what a living process writes is not touched')
            running.signal(signal.SIGKILL)
            running.process.wait()
        self.run_abbe('render', 'quick.scn', '-W', 8, '-H', 8, '-o', 'out.png')
        self.assertEqual(begun(), kept)

    def test_interrupt_says_how_to_go_on(self):
        message = self.interrupted()
        self.assertIn('--resume', message)
        self.assertIn(KEPT, self.names())
        self.assertNotIn('out.png', self.names())

    def test_scenes_that_ask_the_clock_or_files_too(self):
        # What they were told is part of what the tiles belong to; here it is the same again.
        self.write('size.txt', '0.5\n')
        self.write('glass.scn', '// now\n#fopen F "size.txt" read #read (F, Size) #fclose F\n'
                                + (self.folder / 'glass.scn').read_text() + 'sphere { 9*y, Size }\n')
        whole = self.whole()
        self.assertGreater(self.kill_until_done(), 0)
        self.assertEqual((self.folder / 'out.png').read_bytes(), whole)
        self.interrupted()
        self.write('size.txt', '0.25\n')
        resume = ['render', 'glass.scn', '-o', 'out.png', '--resume', '-W', 1500, '-H', 1500]
        self.assertIn('E0520', self.run_abbe(*resume, status=1).stderr)

    def test_other_scene_or_options_are_refused(self):
        self.interrupted()
        resume = ['render', 'glass.scn', '-o', 'out.png', '--resume']
        same = [*resume, '-W', 1500, '-H', 1500]
        for more in (['--aa', 2], ['--samples', 2], ['--seed', 1], ['--passes', 2], ['--bands', 3], ['-D', 'X=1'], ['--tile', 8]):
            with self.subTest(more):
                self.assertIn('E0520', self.run_abbe(*same, *more, status=1).stderr)
        self.assertIn('E0520', self.run_abbe(*resume, '-W', 1501, '-H', 1500, status=1).stderr)
        self.write('glass.scn', (self.folder / 'glass.scn').read_text() + ' ')
        self.assertIn('E0520', self.run_abbe(*same, status=1).stderr)
        self.write(KEPT, 'not a checkpoint at all, but long enough for a header')
        self.assertIn('E0521', self.run_abbe(*same, status=3).stderr)

    def test_threads_may_differ(self):
        whole = self.whole()
        self.assertGreaterEqual(self.kill_until_done('-j', 1), 0)
        self.assertEqual((self.folder / 'out.png').read_bytes(), whole)

    def test_nothing_to_resume_begins_at_the_beginning(self):
        self.assertIn('from the beginning', self.render('-o', 'a.png', '--resume').stderr)

    def test_short_renders_leave_nothing(self):
        self.render('-o', 'a.png')
        self.render('-o', 'b.png', '--checkpoint')
        self.assertEqual(self.names(), ['a.png', 'b.png', 'glass.scn', 'quick.scn'])

    def test_full_disk_ends_the_checkpoint_not_the_render(self):
        done = self.run_abbe('render', 'glass.scn', '-W', 60, '-H', 40, '-o', 'out.png', '--checkpoint', '--tile', 4,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000)))
        self.assertIn('no checkpoint could be kept', done.stderr)
        self.assertIn('out.png', self.names())


if __name__ == '__main__':
    unittest.main()
