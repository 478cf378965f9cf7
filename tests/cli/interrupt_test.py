# SPDX-License-Identifier: MIT
"""Ctrl-C and its kin: an end within two seconds wherever a run is, nothing half written; the progress bar."""
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
            message = self.ends(running, running.signal(number), 128 + number)
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

    # What does not come back to look whether it shall end: one step of evaluation, one structure, one pixel.
    LONG = {
        'array': '#declare A = array[4096][4096] #declare B = array[1000000] #for (I, 0, 999999) #declare B[I] = A; #end',
        'function': '#declare F0 = function(x) { x }\n' + ''.join(
            f'#declare F{i} = function(x) {{ F{i - 1}(x) + F{i - 1}(x) }}\n' for i in range(1, 60))
            + '#declare A = F59(1);',
        'pigment': support.QUICK + '#declare P = pigment { rgb 1 }\n#for (I, 1, 40) '
            '#declare P = pigment { gradient y pigment_map { [0 P] [1 P] } } #end sphere { 0, 1 pigment { P } }',
        'coincident': support.QUICK + '#for (I, 1, 20000) sphere { 0, 1 pigment { rgbt 1 } interior { ior 1.5 } } #end',
        'mirrors': 'global_settings { max_trace_level 256 adc_bailout 0 }\n' + support.QUICK
            + '#for (I, 0, 7) sphere { <cos(I), sin(I), 0>, 1 pigment { rgbt 1 }'
              ' finish { reflection 0.99 diffuse 0 ambient 0 } interior { ior 1.5 } } #end',
    }

    def test_what_takes_long_in_one_step(self):
        for name, text in self.LONG.items():
            for number in (signal.SIGINT, signal.SIGTERM):
                with self.subTest(name=name, number=number):
                    self.write('long.scn', text)
                    with Running(self.folder, 'render', 'long.scn', '-W', 1000, '-H', 1000, '-j', 1, '-o',
                                 'out.png') as running:
                        running.wait_until_busy(0.3)
                        self.ends(running, running.signal(number), 128 + number)
                    self.assertEqual([name for name in self.names() if not name.endswith('.scn')], [])

    def test_a_run_with_a_limit_of_time(self):
        done = self.run_abbe('render', 'slow.scn', '-W', 2000, '-H', 2000, '-o', 'out.png', '--max-time', '0.5s',
                             '--checkpoint', status=124)
        self.assertIn('--resume', done.stderr)
        self.assertEqual(self.names(), ['out.png.abbe-checkpoint', 'quick.scn', 'slow.scn'])
        self.render_quick('--max-time', '1h')
        self.assertIn('expected a time', self.render_quick('--max-time', 'soon', status=2).stderr)

    def render_quick(self, *words, **more):
        return CliTest.render(self, '-o', 'quick.png', *words, **more)

    def test_a_run_with_a_limit_of_memory(self):
        self.write('large.scn', '#declare A = array[100000000] #for (I, 0, 99999999) #declare A[I] = I; #end')
        done = self.run_abbe('check', 'large.scn', '--max-memory', '300M', status=1)
        self.assertIn('E0706', done.stderr)
        self.render_quick('--max-memory', '1G')
        self.assertIn('expected a size', self.render_quick('--max-memory', '1X', status=2).stderr)

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
