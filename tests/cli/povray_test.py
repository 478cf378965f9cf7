# SPDX-License-Identifier: MIT
"""`abbe povray`: POV-Ray's command line and ini files, and what programs that call it rely on."""
import os
import pathlib
import struct
import subprocess
import unittest
import zlib

from support import ABBE, CliTest

SCENE = '''#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> right x * image_width / image_height look_at 0 angle 40 }
light_source { <-5, 5, -5>, rgb 1 }
sphere { 0, 1 pigment { rgb <1, 0.5, 0.2> } }
#debug concat("clock ", str(clock, 0, 3), " frame ", str(frame_number, 0, 0), " of ", str(final_frame, 0, 0),
  " on ", str(clock_on, 0, 0), " delta ", str(clock_delta, 0, 3), "\\n")
'''


def png(path: pathlib.Path) -> tuple:
    """Width, height, bits, channels and the rows of codes of an 8-bit PNG."""
    data = path.read_bytes()
    at, idat = 8, b''
    while at < len(data):
        size, kind = struct.unpack('>I4s', data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b'IHDR':
            width, height, bits, colour = struct.unpack('>IIBB', body[:10])
        elif kind == b'IDAT':
            idat += body
        at += 12 + size
    channels = {2: 3, 6: 4}[colour]
    raw, stride, rows, last = zlib.decompress(idat), width * channels * bits // 8, [], None
    last = bytes(stride)
    bytes_a_pixel = channels * bits // 8
    for y in range(height):
        start = y * (stride + 1)
        kind, row = raw[start], bytearray(raw[start + 1:start + 1 + stride])
        for i in range(stride):
            left = row[i - bytes_a_pixel] if i >= bytes_a_pixel else 0
            row[i] = (row[i] + (0, left, last[i], (left + last[i]) // 2)[kind]) & 255
        rows.append(bytes(row))
        last = rows[-1]
    return width, height, bits, channels, rows


class PovrayTest(CliTest):
    def setUp(self) -> None:
        super().setUp()
        self.write('a.pov', SCENE)
        self.write('empty.ini', '')
        self.environment = {**os.environ, 'POVINI': str(self.folder / 'empty.ini'), 'HOME': str(self.folder)}

    def povray(self, *words, status: int = 0, **more) -> subprocess.CompletedProcess:
        return self.run_abbe('povray', *words, status=status, env=self.environment, **more)

    def refused(self, *words, says: str) -> None:
        self.assertIn(says, self.povray(*words, status=1).stderr)

    # What the picture is called and how large it is.

    def test_size_is_160_by_120_unless_asked_for(self) -> None:
        self.povray('+Ia.pov')
        self.assertEqual(png(self.folder / 'a.png')[:4], (160, 120, 8, 3))

    def test_sizes_may_have_fractions(self) -> None:
        self.povray('a.pov', '+W24', 'Height=18.7')
        self.assertEqual(png(self.folder / 'a.png')[:2], (24, 18))

    def test_names_get_the_extension_of_their_kind(self) -> None:
        for words, name in ((('+Oout',), 'out.png'), (('+Oout.png',), 'out.png'), (('+Oout.v1',), 'out.v1.png'),
                            (('+Oout.png', '+FT'), 'out.png.tga'), (('+FC',), 'a.tga'), (('+FP',), 'a.ppm'),
                            (('+FJ',), 'a.jpg'), (('+FB',), 'a.bmp'), (('+FE',), 'a.exr'), (('+FH',), 'a.hdr'),
                            (('+Osub/',), 'sub/a.png'), (('+Osub',), 'sub/a.png')):
            (self.folder / 'sub').mkdir(exist_ok=True)
            self.povray('a.pov', '+W8', '+H6', *words)
            self.assertTrue((self.folder / name).is_file(), f'{words}: {self.names()}')
            (self.folder / name).unlink()

    def test_kinds_are_what_they_say(self) -> None:
        beginnings = {'P': (b'P6\n', 'ppm'), 'J': (b'\xff\xd8\xff', 'jpg'), 'B': (b'BM', 'bmp'),
                      'E': (b'\x76\x2f\x31\x01', 'exr'), 'H': (b'#?RADIANCE\n', 'hdr'),
                      'N': (b'\x89PNG', 'png')}
        for letter, (beginning, extension) in beginnings.items():
            self.povray('a.pov', '+W8', '+H6', f'+F{letter}')
            self.assertTrue((self.folder / f'a.{extension}').read_bytes().startswith(beginning), letter)

    def test_kinds_hold_the_same_codes(self) -> None:
        for letter in 'NPTB':
            self.povray('a.pov', '+W9', '+H6', f'+F{letter}')
        width, height, _, _, rows = png(self.folder / 'a.png')
        codes = b''.join(rows)
        self.assertEqual((self.folder / 'a.ppm').read_bytes()[-len(codes):], codes)
        tga = (self.folder / 'a.tga').read_bytes()
        self.assertEqual(struct.unpack('<HHBB', tga[12:18]), (width, height, 24, 0x20))
        swapped = bytes(codes[i + 2 - 2 * (i % 3)] for i in range(len(codes)))
        self.assertEqual(tga[18:], swapped)
        bmp = (self.folder / 'a.bmp').read_bytes()[54:]
        self.assertEqual(b''.join(bmp[28 * y:28 * y + 27] for y in range(height)), swapped)
        self.povray('a.pov', '+W9', '+H6', '+FC')
        self.assertEqual(self.unpacked((self.folder / 'a.tga').read_bytes()[18:], 3), swapped)

    @staticmethod
    def unpacked(data: bytes, size: int) -> bytes:
        out, at = b'', 0
        while at < len(data):
            count, equal = (data[at] & 127) + 1, data[at] & 128
            out += data[at + 1:at + 1 + size] * count if equal else data[at + 1:at + 1 + size * count]
            at += 1 + size * (1 if equal else count)
        return out

    def test_sixteen_bits(self) -> None:
        self.povray('a.pov', '+W8', '+H6', '+FN16')
        self.assertEqual(png(self.folder / 'a.png')[2], 16)
        self.povray('a.pov', '+W8', '+H6', '+FP', 'Bits_Per_Color=16')
        self.assertIn(b'\n8 6\n65535\n', (self.folder / 'a.ppm').read_bytes())

    def test_standard_output(self) -> None:
        for words, beginning in ((('+O-', '+FP'), b'P6\n'), (('-O-',), b'\x89PNG')):
            done = subprocess.run([ABBE, 'povray', 'a.pov', '+W8', '+H6', *words], cwd=self.folder,
                                  env=self.environment, capture_output=True, check=True)
            self.assertTrue(done.stdout.startswith(beginning), done.stdout[:20])
        self.assertEqual([name for name in self.names() if name.startswith('a.')], ['a.pov'])

    def test_standard_input(self) -> None:
        done = subprocess.run([ABBE, 'povray', '+I-', '+W8', '+H6', '-O-', '+FP'], cwd=self.folder,
                              env=self.environment, input=SCENE.encode(), capture_output=True, check=True)
        self.assertTrue(done.stdout.startswith(b'P6\n'))

    def test_no_file(self) -> None:
        self.povray('a.pov', '+W8', '+H6', '-F')
        self.assertEqual([name for name in self.names() if name.startswith('a.')], ['a.pov'])

    def test_a_part_stands_at_its_place(self) -> None:
        self.povray('a.pov', '+W24', '+H18', '+Oall')
        self.povray('a.pov', '+W24', '+H18', '+SC7', '+EC18', '+SR0.5', '+ER15', '+Opart')
        whole, part = png(self.folder / 'all.png')[4], png(self.folder / 'part.png')[4]
        for y in range(18):
            for x in range(24):
                inside = 6 <= x < 18 and 9 <= y < 15
                expected = whole[y][3 * x:3 * x + 3] if inside else bytes(3)
                self.assertEqual(part[y][3 * x:3 * x + 3], expected, (x, y))

    # Series of pictures, and their clocks as POV-Ray has them.

    def clocks(self, *words) -> list:
        said = self.povray('a.pov', '+W4', '+H3', '-V', *words).stderr
        return [line for line in said.splitlines() if line.startswith('clock')]

    def test_one_picture(self) -> None:
        self.assertEqual(self.clocks(), ['clock 0.000 frame 0 of 0 on 0 delta 0.000'])
        self.assertEqual(self.clocks('+K.5'), ['clock 0.500 frame 0 of 0 on 1 delta 0.000'])
        self.assertIn('a.png', self.names())

    def test_series(self) -> None:
        self.assertEqual(self.clocks('+KFF3'), [f'clock {c} frame {n} of 3 on 1 delta 0.500'
                                                for n, c in ((1, '0.000'), (2, '0.500'), (3, '1.000'))])
        self.assertEqual([n for n in self.names() if n.endswith('.png')], ['a1.png', 'a2.png', 'a3.png'])

    def test_series_of_one(self) -> None:
        for words in (('+KFI1',), ('+KFF1',), ('+KFI5', '+KFF5'), ('+KFI5', '+KFF4')):
            self.assertEqual(len(self.clocks(*words)), 1, words)
        self.assertEqual([n for n in self.names() if n.endswith('.png')], ['a1.png', 'a5.png'])
        for words in (('+KFI1', '+KFF1'), ('+KFF0',), ('+KFI0', '+KFF0')):  # as POV-Ray has it
            self.assertEqual(self.clocks(*words), ['clock 0.000 frame 0 of 0 on 0 delta 0.000'], words)

    def test_subset_and_digits(self) -> None:
        self.assertEqual(len(self.clocks('+KFI8', '+KFF11', '+SF9', '+EF10')), 2)
        self.assertEqual([n for n in self.names() if n.endswith('.png')], ['a09.png', 'a10.png'])
        self.assertEqual([line.split()[3] for line in self.clocks('+KFF12', '+SF0.5', '+EF0.6')], ['6', '7'])

    def test_cyclic(self) -> None:
        self.assertEqual(self.clocks('+KFF3', '+KC', '+KI2', '+KF5'),
                         [f'clock {c} frame {n} of 4 on 1 delta 1.000'
                          for n, c in ((1, '2.000'), (2, '3.000'), (3, '4.000'))])

    def test_going_on_with_a_series(self) -> None:
        self.clocks('+KFF2')
        (self.folder / 'a2.png').unlink()
        self.assertEqual(len(self.clocks('+KFF2', '+C')), 1)

    # Where options come from.

    def test_ini_files(self) -> None:
        self.write('t.ini', '; sizes\nWidth = 20 ; across\n[Low]\nHeight=10\n[hi]\n+H80\n"a.pov"\n')
        self.povray('t.ini[LOW]', 'a.pov')
        self.assertEqual(png(self.folder / 'a.png')[:2], (20, 10))
        self.povray('t[hi]')
        self.assertEqual(png(self.folder / 'a.png')[:2], (20, 80))
        self.povray('t.ini', 'a.pov', '+H6')
        self.assertEqual(png(self.folder / 'a.png')[:2], (20, 6))

    def test_defaults_come_first(self) -> None:
        self.write('empty.ini', 'Width=12\nHeight=9\n')
        self.povray('a.pov', '+H6')
        self.assertEqual(png(self.folder / 'a.png')[:2], (12, 6))

    def test_environment_in_ini_files(self) -> None:
        self.write('t.ini', 'Output_File_Name="%HOME%/named.png"\n+W8 +H6\nInput_File_Name=a.pov\n')
        self.povray('t.ini')
        self.assertIn('named.png', self.names())

    def test_library_paths(self) -> None:
        self.write('lib/b.inc', '#declare Seen = 1;')
        self.write('lib/c.pov', '#include "b.inc"\n' + SCENE)
        self.povray('c', '+Lnowhere', 'Library_Path=lib', '+Ic', '+W8', '+H6', status=1)
        self.povray('+Ic', '+Lnowhere', 'Library_Path=lib', '+W8', '+H6')
        self.assertIn('c.png', self.names())

    def test_declarations(self) -> None:
        self.write('d.pov', SCENE + '#debug concat("[", str(Size * 2, 0, 1), Name, "]\\n")')
        said = self.povray('d.pov', '+W4', '+H3', 'Declare=Size=1.5', 'Declare=Name="x y"').stderr
        self.assertIn('[3.0x y]', said)

    def test_a_header_and_a_version_come_before_the_scene(self) -> None:
        self.write('h.inc', '#declare R = 0.5; #debug concat("header ", str(version, 0, 2), "\\n")')
        self.write('e.pov', 'sphere { 0, R }\n#debug concat("scene ", str(version, 0, 2), " ", str(R, 0, 2), "\\n")')
        said = self.povray('e.pov', '+HIh.inc', '+W4', '+H3').stderr
        self.assertIn('header 3.70\nscene 3.70 0.50\n', said)
        said = self.povray('e.pov', 'Include_Header=h.inc', 'Version=3.5', '+W4', '+H3').stderr
        self.assertIn('header 3.50\nscene 3.50 0.50\n', said)
        self.refused('e.pov', '+HInone.inc', '+W4', '+H3', says="cannot find the file 'none.inc'")
        self.refused('e.pov', '+MVold', says='expected a number')

    def test_called_by_the_name_of_povray(self) -> None:
        (self.folder / 'povray').symlink_to(ABBE)
        subprocess.run([self.folder / 'povray', 'a.pov', '+W8', '+H6'], cwd=self.folder, env=self.environment,
                       capture_output=True, check=True)
        self.assertIn('a.png', self.names())

    # What is told, and what is refused.

    def test_progress_is_told_as_povray_does(self) -> None:
        self.assertIn('Rendered 48 of 48 pixels (100%)', self.povray('a.pov', '+W8', '+H6').stderr)
        self.assertNotIn('Rendered', self.povray('a.pov', '+W8', '+H6', '-V').stderr)

    def test_switches_that_show_or_speed_up_change_nothing(self) -> None:
        self.povray('a.pov', '+W8', '+H6', '+Oa1')
        self.povray('a.pov', '+W8', '+H6', '+Oa2', '-D', '+P', '+SP32', '+UL', '-UV', '+MB3', '+BM2', '+BS16', '+WL0',
                    '+X', '-UR', '+SU', 'Display=off', 'Pause_When_Done=off', '+WT2', 'Palette=3', '+GW')
        self.assertEqual((self.folder / 'a1.png').read_bytes(), (self.folder / 'a2.png').read_bytes())

    def test_unknown_is_an_error_that_names_it(self) -> None:
        self.refused('a.pov', '+ZZ', says="unknown switch '+ZZ'")
        self.refused('a.pov', 'Widht=3', says="unknown option 'Widht'; did you mean 'Width'?")
        self.refused('a.pov', '+W', says="'+W' needs a value")
        self.refused('a.pov', '+Wx', says="expected a number, got 'x'")
        self.refused('a.pov', '+W0', says='expected a number from 1')
        self.refused('a.pov', '+FQ', says='expected a kind of picture')
        self.refused('a.pov', 'Antialias=perhaps', says='expected on or off')
        self.refused('+W8', says='no input file')
        self.refused('nofile.pov', says="cannot find the file 'nofile.pov'")
        self.refused('none.ini', says="cannot read the ini file 'none.ini'")
        self.refused('a.pov', '+SC9', '+W8', says='no part of 8 pixels')
        self.refused('a.pov', '+KFF3', '+SF5', says='no part of the series')
        self.refused('a.pov', '+Onowhere/x.png', says='E0510')
        self.write('t.ini', 'Width=8\n\nFoo=3\n')
        self.refused('t.ini', says="t.ini:3: unknown option 'Foo'")
        self.refused('t.ini[none]', says='unknown option')
        self.write('u.ini', 'u.ini\n')
        self.refused('u.ini', says='ini files name each other')

    def test_what_is_not_done_is_refused(self) -> None:
        for words in (('+GI',), ('All_File=x.txt',), ('+UF',), ('Dither=on',), ('+AG1',)):
            self.refused('a.pov', *words, says='not supported')
        self.assertIn('runs no other programs',
                      self.povray('a.pov', '+W4', '+H3', 'Post_Scene_Command=rm x').stderr)

    def test_a_wrong_scene_has_status_1_and_its_place(self) -> None:
        self.write('w.pov', 'shpere { 0, 1 }')
        self.assertIn("w.pov:1:1-6: error[E0202]", self.povray('w.pov', status=1).stderr)
        self.assertNotIn('w.png', self.names())

    # What changes the picture.

    def test_alpha(self) -> None:
        self.write('alpha.pov', SCENE + 'sphere { <1.2, 0, 0>, 0.4 pigment { rgbt <1, 1, 1, 0.75> }'
                                        ' finish { ambient 1 diffuse 0 } }')
        self.povray('alpha.pov', '+W80', '+H60', '+UA')
        width, _, _, channels, rows = png(self.folder / 'alpha.png')
        self.assertEqual(channels, 4)
        self.assertEqual(rows[0][:4], bytes(4))
        self.assertEqual(rows[30][4 * 40 + 3], 255)
        clear = rows[30][4 * 77:4 * 78] if width > 77 else b''
        self.assertEqual(clear, bytes((255, 255, 255, 112)), 'white that lets 0.75 through, twice')

    def test_quality(self) -> None:
        self.write('q.pov', SCENE.replace('sphere { 0, 1 pigment { rgb <1, 0.5, 0.2> } }', '''
          sphere { 0, 1 pigment { checker rgb 1, rgb 0 quick_color rgb <0, 1, 0> } }
          plane { z, 5 pigment { rgb 0 } finish { reflection 1 ambient 0 } }'''))
        pictures = []
        for quality in range(10):
            self.povray('q.pov', '+W24', '+H18', f'+Q{quality}')
            pictures.append(png(self.folder / 'q.png')[4])
        middle = [rows[9][36:39] for rows in pictures]
        self.assertEqual(middle[0], bytes((0, 255, 0)), 'the quick colour as it is')
        self.assertTrue(all(code[0] == code[2] == 0 < code[1] < 255 for code in middle[2:6]), middle)
        self.assertTrue(all(code[0] == code[1] == code[2] for code in middle[6:]), middle)
        self.assertEqual(pictures[8], pictures[9])
        self.write('f.pov', SCENE + 'fog { distance 2 rgb <0, 0, 1> }')
        self.povray('f.pov', '+W24', '+H18', '+Q8', '+Oclear')
        self.povray('f.pov', '+W24', '+H18', '+Q9', '+Ofog')
        self.povray('a.pov', '+W24', '+H18', '+Q9', '+Owithout')
        self.assertEqual(png(self.folder / 'clear.png')[4], png(self.folder / 'without.png')[4])
        self.assertNotEqual(png(self.folder / 'fog.png')[4], png(self.folder / 'clear.png')[4])
        self.assertEqual(pictures[6], pictures[7])
        self.assertEqual(pictures[4], pictures[5])


class RenderTest(CliTest):
    """What `abbe render` has of it."""

    def test_frames(self) -> None:
        self.write('a.pov', SCENE)
        said = self.run_abbe('render', 'a.pov', '-W', 4, '-H', 3, '--frames', '9..11').stderr
        self.assertEqual([line for line in said.splitlines() if line.startswith('clock')],
                         [f'clock {c} frame {n} of 11 on 1 delta 0.500'
                          for n, c in ((9, '0.000'), (10, '0.500'), (11, '1.000'))])
        self.assertEqual([n for n in self.names() if n.endswith('.png')], ['a09.png', 'a10.png', 'a11.png'])
        self.run_abbe('render', 'a.pov', '--frames', '3..2', status=2)
        self.run_abbe('render', 'a.pov', '--frames', '1..2', '--clock', '1', status=2)

    def test_clock(self) -> None:
        self.write('a.pov', SCENE)
        self.assertIn('clock 0.250 frame 0 of 0 on 1',
                      self.run_abbe('render', 'a.pov', '-W', 4, '-H', 3, '--clock', '0.25').stderr)

    def test_alpha_of_every_kind(self) -> None:
        for name in ('x.png', 'x.exr', 'x.tga', 'x.bmp'):
            self.render('--alpha', '-o', name)
        self.assertEqual(png(self.folder / 'x.png')[3], 4)
        self.assertEqual((self.folder / 'x.tga').read_bytes()[16], 32)

    def test_standard_input(self) -> None:
        done = subprocess.run([ABBE, 'render', '-', '-W', '4', '-H', '3'], cwd=self.folder, input=SCENE.encode(),
                              capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('stdin.png', self.names())
        done = subprocess.run([ABBE, 'check', '-'], cwd=self.folder, input=b'shpere { }', capture_output=True,
                              check=False)
        self.assertIn(b'standard input:1:1-6', done.stderr)


if __name__ == '__main__':
    unittest.main()
