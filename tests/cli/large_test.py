# SPDX-License-Identifier: MIT
"""Pictures larger than memory should hold, whose rows go to the file as they are finished; and large scenes."""
import os
import pathlib
import subprocess
import unittest

import support
from support import CliTest, Running

TRIVIAL = 'camera { location <0, 0, -4> look_at 0 }\nbackground { rgb 0.3 }\n'


class Large(CliTest):
    def peak_mb(self, *words) -> float:
        command = [support.ABBE, *map(str, words)]
        process = subprocess.Popen(command, cwd=self.folder, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        return usage.ru_maxrss / 1024

    def test_memory_does_not_grow_with_the_height(self):
        # 32 million pixels are 384 MB of floats. In work are one strip of 32 MB (two with anti-aliasing,
        # which looks at the row below) and what tone mapping copies of it.
        self.write('trivial.scn', TRIVIAL)
        peak = self.peak_mb('render', 'trivial.scn', '-W', 16000, '-H', 2000, '-o', 'out.png', '--no-checkpoint')
        self.assertLess(peak, 200)
        (self.folder / 'out.png').unlink()

    def test_anti_aliasing_needs_neighbouring_rows_only(self):
        self.write('trivial.scn', TRIVIAL)
        peak = self.peak_mb('render', 'trivial.scn', '-W', 3000, '-H', 8000, '-o', 'out.exr', '--aa', 2,
                            '--no-checkpoint')
        self.assertLess(peak, 200)  # 288 MB of floats in one piece, and the marks

    def mesh(self, side: int) -> pathlib.Path:
        """So many vertices squared, and twice as many faces."""
        # Line by line: what this process holds would count as its children's peak.
        with (self.folder / 'mesh.scn').open('w', encoding='utf-8') as out:
            out.write('camera { location <0.5, 0.5, -2> look_at <0.5, 0.5, 0> }\n')
            out.write(f'mesh2 {{ vertex_vectors {{ {side * side}\n')
            for i in range(side):
                out.write(''.join(f', <{i / side:.15f}, {j / side:.15f}, {i * j % 7 / 10}>\n' for j in range(side)))
            out.write(f'}} face_indices {{ {2 * (side - 1) ** 2}\n')
            for a in (i * side + j for i in range(side - 1) for j in range(side - 1)):
                out.write(f', <{a}, {a + 1}, {a + side}>, <{a + 1}, {a + side + 1}, {a + side}>\n')
            out.write('} pigment { rgb 1 } }\n')
        return self.folder / 'mesh.scn'

    def test_the_text_of_a_scene_is_given_up_while_it_is_read(self):
        scene = self.mesh(600)
        # Per vertex and its two faces: 28 + 56 bytes for the lists as parsed and 24 + 24 as a mesh.
        lists = 600 * 600 * (28 + 56 + 24 + 24) / 2 ** 20
        self.assertGreater(scene.stat().st_size / 2 ** 20, 25)
        self.assertLess(self.peak_mb('check', 'mesh.scn'), lists + 25)

    def test_a_text_that_is_cut_short_while_it_is_read(self):
        scene = self.mesh(1000)
        with scene.open('a', encoding='utf-8') as out:
            for _ in range(200000):
                out.write('sphere { <0.25, 0.5, 0.75>, 0.125 pigment { rgb <0.1, 0.2, 0.3> } }\n')
        with Running(self.folder, 'check', 'mesh.scn') as running:
            running.wait_until_busy(0.05)
            os.truncate(scene, 100)
            _, messages = running.process.communicate(timeout=60)
        self.assertEqual(running.process.returncode, 3)
        self.assertIn('cut short while it was read: try again', messages.decode())

    def test_a_text_that_grows_while_it_is_read(self):
        scene = self.mesh(1000)
        with Running(self.folder, 'check', 'mesh.scn') as running:
            running.wait_until_busy(0.02)
            with scene.open('a', encoding='utf-8') as out:
                out.write('sphere { 0, 1 }')
            _, messages = running.process.communicate(timeout=60)
        self.assertEqual(running.process.returncode, 1)
        self.assertIn('error[E0507]: this file was written to while it was read: try again', messages.decode())


if __name__ == '__main__':
    unittest.main()
