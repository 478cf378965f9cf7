# SPDX-License-Identifier: MIT
"""Pictures larger than memory should hold: rows go to the file as they are finished."""
import os
import subprocess
import unittest

import support
from support import CliTest

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


if __name__ == '__main__':
    unittest.main()
