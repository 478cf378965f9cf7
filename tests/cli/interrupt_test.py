# SPDX-License-Identifier: MIT
"""Ctrl-C and its kin: status 130 within two seconds, nothing half written; the progress bar."""
import os
import pty
import re
import signal
import subprocess
import time
import unittest

import support
from support import CliTest, Running, SLOW

LATEST = 2.0  # seconds from the signal to the end


class Interrupt(CliTest):
    def setUp(self) -> None:
        super().setUp()
        self.write('slow.scn', SLOW)

    def ends(self, running: Running, since: float, status: int = 130) -> str:
        _, messages = running.process.communicate(timeout=30)
        took = time.monotonic() - since
        self.assertEqual(running.process.returncode, status)
        self.assertLess(took, LATEST)
        return messages.decode()

    def render(self, number: int, *words) -> None:
        with Running(self.folder, 'render', 'slow.scn', '-W', 2000, '-H', 2000, '-o', 'out.png', '--no-checkpoint',
                     *words) as running:
            running.wait_until_busy()
            message = self.ends(running, running.signal(number))
        self.assertIn('interrupted', message)
        self.assertEqual(self.names(), ['quick.scn', 'slow.scn'])

    def test_interrupt_while_rendering(self):
        self.render(signal.SIGINT)

    def test_terminate_while_rendering(self):
        self.render(signal.SIGTERM)

    def test_interrupt_with_large_tiles(self):
        self.render(signal.SIGINT, '--tile', 2048)

    def test_interrupt_with_anti_aliasing(self):
        self.render(signal.SIGINT, '--aa', 9, '--aa-threshold', 0)

    def test_old_picture_survives(self):
        old = self.write('out.png', 'an older picture')
        with Running(self.folder, 'render', 'slow.scn', '-W', 2000, '-H', 2000, '-o', 'out.png',
                     '--no-checkpoint') as running:
            running.wait_until_busy()
            self.ends(running, running.signal())
        self.assertEqual(old.read_text(), 'an older picture')

    def test_second_interrupt_ends_at_once(self):
        with Running(self.folder, 'render', 'slow.scn', '-W', 2000, '-H', 2000, '-o', 'out.png',
                     '--no-checkpoint') as running:
            running.wait_until_busy()
            running.signal()
            self.ends(running, running.signal())
        self.assertEqual(self.names(), ['quick.scn', 'slow.scn'])

    def test_endless_loops_of_a_scene(self):
        loops = {'while': '#while (true) #end',
                 'for': '#for (I, 0, 1e300) #end',
                 'declare': '#declare I = 0; #while (I < 1) #declare J = sin(I); #end',
                 'macro': '#macro M() #end #while (true) M() #end',
                 'switch': '#while (true) #switch (1) #case (1) #break #end #end',
                 'string': '#while (true) #declare S = concat("a", "b") #end'}
        for name, text in loops.items():
            for command in (['check'], ['dump', '--scene'], ['explain']):
                with self.subTest(name=name, command=command):
                    self.write('loop.scn', text)
                    with Running(self.folder, *command, 'loop.scn') as running:
                        running.wait_until_busy(0.1)
                        self.ends(running, running.signal())

    def test_interrupt_while_reading_a_large_mesh(self):
        vertices = ', '.join(f'<{i}, {i * i % 7}, {i % 3}>' for i in range(300000))
        faces = ', '.join(f'<{i}, {i + 1}, {i + 2}>' for i in range(299998))
        self.write('mesh.scn', f'mesh2 {{ vertex_vectors {{ 300000, {vertices} }} '
                               f'face_indices {{ 299998, {faces} }} }}\n' * 16)
        with Running(self.folder, 'check', 'mesh.scn') as running:
            running.wait_until_busy(0.2)
            self.ends(running, running.signal())


class ProgressBar(CliTest):
    def setUp(self) -> None:
        super().setUp()
        self.write('slow.scn', SLOW)

    def on_terminal(self, *words) -> str:
        """What a terminal sees of a run, which is interrupted when it takes long."""
        master, slave = pty.openpty()
        process = subprocess.Popen([support.ABBE, 'render', 'slow.scn', '-W', '160', '-H', '120', '--bands', '100',
                                    *words], cwd=self.folder, stdin=slave, stdout=slave, stderr=slave)
        os.close(slave)
        text = b''
        while True:
            try:
                piece = os.read(master, 4096)
            except OSError:  # the terminal hangs up with its last writer
                break
            if not piece:
                break
            text += piece
        os.close(master)
        self.assertEqual(process.wait(), 0)
        return text.decode()

    def test_terminal_sees_share_speed_and_time_left(self):
        text = self.on_terminal()
        shares = [float(share) for share in re.findall(r'([\d.]+) %  [\d.]+ Mrays/s  \d+:\d\d left', text)]
        self.assertTrue(shares)
        self.assertEqual(shares, sorted(shares))
        self.assertLessEqual(shares[-1], 100)
        self.assertRegex(text, r'\r\x1b\[K[^\r]*slow\.png: 160 x 120')  # the bar is wiped

    def test_quiet_terminal_sees_nothing(self):
        self.assertEqual(self.on_terminal('--quiet'), '')

    def test_no_bar_in_a_file(self):
        done = self.run_abbe('render', 'slow.scn', '-W', 60, '-H', 40, '-o', 'out.png')
        self.assertNotIn('\r', done.stderr)
        self.assertNotIn('left', done.stderr)
        self.assertRegex(done.stderr, r'^out\.png: 60 x 40, ')

    def test_quiet_prints_nothing(self):
        self.write('chatty.scn', '#debug "hello\\n"\n#render "there\\n"\n' + support.QUICK)
        done = self.render('--quiet', '-o', 'out.png', scene='chatty.scn')
        self.assertEqual(done.stdout + done.stderr, '')
        self.assertIn('hello\nthere\n', self.render('-o', 'out.png', scene='chatty.scn').stderr)


if __name__ == '__main__':
    unittest.main()
