#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Does lint find what it is for, and nothing else?"""
import pathlib
import tempfile
import unittest

import lint

SPDX = '// SPDX-License-Identifier: MIT\n'


class LintTest(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        for folder in ('src', 'grammar', 'tests', 'examples'):
            (self.root / folder).mkdir()

    def write(self, name: str, text: str) -> None:
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def offenders(self, rule: str) -> list:
        return [':'.join(line.split(':')[:2]) for line in lint.RULES[rule](lint.House(self.root))]

    def test_includes_against_the_direction(self) -> None:
        self.write('src/optics/a.cpp', SPDX + '#include "optics/a.hpp"\n#include "geometry/b.hpp"\n')
        self.write('src/render/a.cpp', '#include "lang/a.hpp"\n#include <grammar/b.hpp>\n')
        self.write('grammar/a.cpp', '#include "scene/scene.hpp"\n')
        self.write('src/lang/a.cpp', '#include "grammar/parse.hpp"\n#include "reader.hpp"\n')
        self.write('src/attic/a.cpp', '')
        self.assertEqual(self.offenders('includes'),
                         ['grammar/a.cpp:1', 'src/attic/a.cpp:1', 'src/lang/a.cpp:2',
                          'src/optics/a.cpp:3', 'src/render/a.cpp:1', 'src/render/a.cpp:2'])

    def test_includes_along_the_direction(self) -> None:
        self.write('src/cli/a.cpp', '#include "lang/a.hpp"\n#include <fmt/format.h>\n')
        self.write('src/scene/a.hpp', '// #include "lang/a.hpp"\n#include "texture/pattern.hpp"\n')
        self.write('src/lang/b.cpp', '#include "lang/words.def"\n')
        self.assertEqual(self.offenders('includes'), [])

    def test_sizes(self) -> None:
        self.write('src/a/long.cpp', '\n' * 601)
        self.write('src/a/just.cpp', '\n' * 600)
        self.write('src/a/long.hpp', '\n' * 301)
        self.write('src/a/cie_table.cpp', '\n' * 9000)
        self.assertEqual(self.offenders('sizes'), ['src/a/long.cpp:601', 'src/a/long.hpp:301'])

    def test_pragma_once(self) -> None:
        self.write('src/a/with.hpp', '#pragma once\n')
        self.write('src/a/without.hpp', '// #pragma once\n')
        self.write('src/a/a.cpp', '#pragma once\n')
        self.assertEqual(self.offenders('pragma_once'), ['src/a/a.cpp:1', 'src/a/without.hpp:1'])

    def test_spdx(self) -> None:
        self.write('src/a/with.hpp', SPDX)
        self.write('src/a/late.hpp', '\n' + SPDX)
        self.write('tests/a.py', '#!/usr/bin/env python3\n# SPDX-License-Identifier: MIT\n')
        self.write('tests/empty.py', '')
        self.assertEqual(self.offenders('spdx'), ['src/a/late.hpp:1', 'tests/empty.py:1'])

    def test_using_namespace(self) -> None:
        self.write('src/a/a.cpp', '// using namespace std;\nusing  namespace std;\n"using namespace";\n')
        self.assertEqual(self.offenders('using_namespace'), ['src/a/a.cpp:2'])

    def test_printing(self) -> None:
        self.write('src/cli/a.cpp', 'std::cout << 1;\n')
        self.write('src/base/result.hpp', 'std::fprintf(stderr, "x");\n')
        self.write('src/a/a.cpp', 'std::cerr << 1;\nstd::snprintf(b, 1, "x");\nprintf("x");\n'
                                  'fmt::print("x");\nauto s = "printf(";\nstd::fprintf(f, "");\n'
                                  'in.print(x);\nfmt::format("x");\n')
        self.assertEqual(self.offenders('printing'),
                         [f'src/a/a.cpp:{line}' for line in (1, 3, 4, 6)])

    def test_gallery(self) -> None:
        self.write('examples/seen.scn', '')
        self.write('examples/unseen.scn', '')
        self.write('docs/gallery/seen.png', '')
        self.assertEqual(self.offenders('gallery'), ['examples/unseen.scn:1'])

    def test_readmes(self) -> None:
        self.write('src/a/README.md', 'x')
        self.write('src/b/b.cpp', '')
        self.write('grammar/README.md', 'x')
        self.assertEqual(self.offenders('readmes'), ['src/b:1'])


if __name__ == '__main__':
    unittest.main()
