#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Renders a scene small and judges the picture.

check.py ABBE small SCENE REFERENCE   against the reference that was looked at when it was made
check.py ABBE bands SCENE LIMIT       in r g b against the same in 16 bands: mean CIEDE2000 below LIMIT
check.py ABBE update SCENE REFERENCE  makes the reference anew (then look at it)
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

WIDTH, HEIGHT = 64, 48


def render(abbe, scene, output, *options):
    command = [abbe, "render", scene, "-W", str(WIDTH), "-H", str(HEIGHT), "--quiet", "-o", output, *options]
    subprocess.run(command, check=True)


def compare(abbe, a, b):
    done = subprocess.run([abbe, "compare", a, b, "--json"], check=True, stdout=subprocess.PIPE)
    return json.loads(done.stdout)


def judge(name, value, limit):
    print(f"{name}: {value:.4f} (limit {limit})")
    return value <= limit


def main():
    abbe, mode, scene, argument = sys.argv[1:5]
    if mode == "update":
        render(abbe, scene, argument, "--half")
        return 0
    with tempfile.TemporaryDirectory() as folder:
        a, b = str(Path(folder, "a.exr")), str(Path(folder, "b.exr"))
        if mode == "small":
            render(abbe, scene, a)
            metrics = compare(abbe, argument, a)
            # The reference is stored in half floats; a changed picture is far beyond these.
            good = judge("mean CIEDE2000", metrics["ciede2000"]["mean"], 0.05)
            return 0 if good and metrics["nan_values"] == 0 else 1
        render(abbe, scene, a)
        render(abbe, scene, b, "--bands", "16")
        return 0 if judge("mean CIEDE2000", compare(abbe, a, b)["ciede2000"]["mean"], float(argument)) else 1


if __name__ == "__main__":
    sys.exit(main())
