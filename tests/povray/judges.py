# SPDX-License-Identifier: MIT
"""What `povray` and `abbe check` say of small scenes: for `differential`."""
import concurrent.futures
import pathlib
import re
import subprocess
import tempfile

from scene_grammar import FIXED_NAMES, FREE_NAMES

SECONDS = 10  # a program that needs longer hangs
POVRAYS = 12  # povray mostly sleeps: these take a third of one processor
DONE = 'the end of the scenes'


DIAGNOSTIC = re.compile(r'^  .*$|s\d+\.pov:.*$', re.MULTILINE)  # what belongs to a message of abbe's


class Verdict:
    """Is a scene read, what is said of it if not, and what #debug says."""

    def __init__(self, state: str, message: str = '', shown: tuple = ()) -> None:
        self.state = state  # 'reads', 'refuses', 'hangs', 'crashes'
        self.message = message
        self.shown = shown


def said(text: str) -> tuple:
    """The lines of #debug, which begin with '|', without blanks: povray breaks lines where it likes."""
    return tuple(''.join(part.split()) for part in text.split('|')[1:])


def unescaped(text: str) -> str:
    """With the control characters that abbe shows as "\\x08"."""
    return re.sub(r'\\x([0-9a-f]{2})', lambda found: chr(int(found.group(1), 16)), text)


def in_folder(texts: list, folder: str) -> list:
    paths = []
    for i, text in enumerate(texts):
        path = pathlib.Path(folder, f's{i}.pov')
        path.write_bytes(text.encode('latin-1'))
        paths.append(path)
    return paths


# ---------------------------------------------------------------------------------------- abbe
def ask_abbe(program: str, path: pathlib.Path) -> Verdict:
    try:
        done = subprocess.run([program, 'check', path.name], cwd=path.parent, capture_output=True, timeout=SECONDS,
                              check=False)
    except subprocess.TimeoutExpired:
        return Verdict('hangs')
    text = done.stderr.decode('latin-1').replace('\r', '\n')
    if done.returncode not in (0, 1):
        return Verdict('crashes', f'status {done.returncode}')
    if done.returncode == 1:
        found = re.search(r'error(?:\[(E\d+)\])?: (.*)', text)
        return Verdict('refuses', f'{found.group(1) or ""} {found.group(2)}' if found else text.strip()[:80])
    return Verdict('reads', '', said(unescaped(DIAGNOSTIC.sub('', text))))


# ---------------------------------------------------------------------------------------- povray
def undeclaring() -> str:
    names = FREE_NAMES + FIXED_NAMES + [f'I{i}' for i in range(1, 60)]
    return '#version 3.7;\n' + ''.join(f'#ifdef({name}) #undef {name} #end\n' for name in names)


class Povray:
    """Asks povray of many scenes at a time: each is included by one that shows where it is. The first that is refused
    ends the run; those after it are asked again."""

    def __init__(self, paths: list) -> None:
        self.paths = paths
        self.verdicts = [None] * len(paths)

    def ask_alone(self, i: int) -> None:
        """Of the scene itself, in which #local means another thing than in an included file."""
        hangs, status, _, fatal = self.start(str(self.paths[i]))
        if hangs or status < 0:
            self.verdicts[i] = Verdict('hangs' if hangs else 'crashes')
            return
        if status:
            self.verdicts[i] = Verdict('refuses', message_of(fatal))
            return
        ended = self.paths[i].with_suffix('.ended.pov')  # povray keeps the rest of a line to itself
        ended.write_bytes(self.paths[i].read_bytes() + b'\n#debug "\\n"\n')
        self.verdicts[i] = Verdict('reads', '', said(self.start(str(ended))[2]))

    @staticmethod
    def start(scene: str, text: str = '') -> tuple:
        """Does it hang, its status, the texts of its #debug and of its last message. @param text the scene, if new"""
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)  # povray writes these texts in no other than its own
            if text:
                (folder / scene).write_text(text)
                (folder / 'clean.inc').write_text(undeclaring())
            command = ['povray', f'+I{scene}', '+W1', '+H1', '-D', '-F', '-A', '-GA', '+GDdebug.txt', '+GFfatal.txt', '+WT1']
            hangs, status = False, 0
            try:
                status = subprocess.run(command, cwd=folder, capture_output=True, timeout=SECONDS, check=False).returncode
            except subprocess.TimeoutExpired:
                hangs = True

            def read(name):
                path = folder / name
                return path.read_bytes().decode('latin-1') if path.exists() else ''
            return hangs, status, read('debug.txt'), read('fatal.txt')

    def run(self, which: list) -> list:
        """Asks of these; @return those that are not answered yet."""
        text = 'global_settings { assumed_gamma 1 }\n'
        for i in which:
            text += f'#include "clean.inc"\n#debug "@{i}@\\n"\n#include "{self.paths[i]}"\n'
        hangs, status, debug, fatal = self.start('all.pov', text + f'#debug "@end@\\n"\n#error "{DONE}"\n')
        pieces = re.split(r'@(\d+|end)@', debug.replace('\n', ''))  # lines are broken anywhere
        names, shown = pieces[1::2], pieces[2::2]
        if names and names[-1] == 'end' and DONE in ' '.join(fatal.split()):
            names.pop()
            self.take(names, shown)
            return []
        if not names or hangs or status < 0:
            if len(which) > 1:  # one at a time tells which it is
                return which
            self.verdicts[which[0]] = Verdict('hangs' if hangs else 'crashes')
            return []
        self.take(names[:-1], shown)
        self.verdicts[int(names[-1])] = Verdict('refuses', message_of(fatal))
        return [i for i in which if self.verdicts[i] is None]

    def take(self, names: list, shown: list) -> None:
        for name, text in zip(names, shown):
            self.verdicts[int(name)] = Verdict('reads', '', said(text))

    def ask(self, which: list) -> None:
        left = self.run(which)
        if left == which and len(which) > 1:
            for i in which:
                self.run([i])
        elif left:
            self.ask(left)


def message_of(fatal: str) -> str:
    found = re.search(r'(?:Parse|Fatal)? ?[Ee]rror:(.*)', fatal, re.DOTALL)
    return ' '.join((found.group(1) if found else fatal).split())[:200]


# ---------------------------------------------------------------------------------------- both
def groups(likely: list, unlikely: list) -> list:
    """Runs of povray: many scenes that are likely read, then at most one that is likely refused."""
    runs = [[i] for i in unlikely] or [[]]
    while len(runs) * 40 < len(likely):
        runs.append([])
    for at, i in enumerate(likely):
        runs[at % len(runs)].insert(0, i)
    return [run for run in runs if run]


class Judges:
    """Both programs. What they said of a text is kept."""

    def __init__(self, abbe: str) -> None:
        self.abbe = abbe
        self.kept, self.ours = {}, {}
        self.povrays = concurrent.futures.ThreadPoolExecutor(POVRAYS)
        self.abbes = concurrent.futures.ThreadPoolExecutor(2)

    def ask_abbe(self, texts: list) -> list:
        new = [text for text in dict.fromkeys(texts) if text not in self.ours]
        with tempfile.TemporaryDirectory() as folder:
            for text, verdict in zip(new, self.abbes.map(lambda path: ask_abbe(self.abbe, path), in_folder(new, folder))):
                self.ours[text] = verdict
        return [self.ours[text] for text in texts]

    def ask(self, texts: list) -> list:
        """Pairs of verdicts, povray's first."""
        new = [text for text in dict.fromkeys(texts) if text not in self.kept]
        ours = self.ask_abbe(new)
        with tempfile.TemporaryDirectory() as folder:
            povray = Povray(in_folder(new, folder))
            likely = [i for i, verdict in enumerate(ours) if verdict.state == 'reads']
            unlikely = [i for i, verdict in enumerate(ours) if verdict.state != 'reads']
            list(self.povrays.map(povray.ask, groups(likely, unlikely)))
            # A difference may come from the scenes before it in the run, which may also swallow a scene: those are
            # asked alone.
            alone = [i for i, verdict in enumerate(ours)
                     if povray.verdicts[i] is None or len(new) > 1 and differ(povray.verdicts[i], verdict)]
            list(self.povrays.map(povray.ask_alone, alone))
        for text, theirs, our in zip(new, povray.verdicts, ours):
            self.kept[text] = (theirs, our)
        return [self.kept[text] for text in texts]


def differ(theirs: Verdict, ours: Verdict) -> bool:
    if theirs.state in ('hangs', 'crashes') and ours.state in ('reads', 'refuses'):
        return False  # nothing to compare with
    if theirs.state != ours.state:
        return True
    return theirs.state == 'reads' and theirs.shown != ours.shown
