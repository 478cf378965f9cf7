# SPDX-License-Identifier: MIT
"""Headless Chromium for tests, spoken to by its DevTools protocol over a pipe. Python's own library only."""
import base64
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time


def find() -> str | None:
    return next((path for name in ('chromium', 'chromium-browser', 'google-chrome') if (path := shutil.which(name))), None)


class Browser:
    """One page. What went wrong on it is in `problems`, what it asked for in `requests`."""

    def __init__(self, width: int = 1280, height: int = 900, dark: bool = False) -> None:
        self.problems, self.requests = [], []
        self.folder = tempfile.mkdtemp(prefix='abbe-chromium-')
        self.number, self.answers, self.buffer = 0, {}, b''
        from_us, self.to_browser = os.pipe()
        self.from_browser, to_us = os.pipe()

        def wire() -> None:  # the browser reads descriptor 3 and writes 4
            reading, writing = os.dup(from_us), os.dup(to_us)
            os.dup2(reading, 3)
            os.dup2(writing, 4)

        self.process = subprocess.Popen(
            [find(), '--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run', '--hide-scrollbars',
             f'--user-data-dir={self.folder}', '--remote-debugging-pipe', 'about:blank'],
            preexec_fn=wire, close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(from_us)
        os.close(to_us)
        self.session = None
        target = self.ask('Target.createTarget', url='about:blank')['targetId']
        self.session = self.ask('Target.attachToTarget', targetId=target, flatten=True)['sessionId']
        for domain in ('Page', 'Runtime', 'Log', 'Network'):
            self.ask(f'{domain}.enable')
        self.look(width, height, dark)

    def __enter__(self) -> 'Browser':
        return self

    def __exit__(self, *_) -> None:
        self.process.kill()
        self.process.wait()
        os.close(self.to_browser)
        os.close(self.from_browser)
        shutil.rmtree(self.folder, ignore_errors=True)

    def look(self, width: int, height: int, dark: bool = False) -> None:
        self.ask('Emulation.setDeviceMetricsOverride', width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.ask('Emulation.setEmulatedMedia', features=[
            {'name': 'prefers-color-scheme', 'value': 'dark' if dark else 'light'}, {'name': 'prefers-reduced-motion', 'value': 'reduce'}])

    def ask(self, method: str, **parameters) -> dict:
        self.number += 1
        message = {'id': self.number, 'method': method, 'params': parameters}
        if self.session:
            message['sessionId'] = self.session
        data = json.dumps(message).encode() + b'\0'
        while data:
            data = data[os.write(self.to_browser, data):]
        end = time.monotonic() + 60
        while self.number not in self.answers:
            self._receive(end)
        answer = self.answers.pop(self.number)
        if 'error' in answer:
            raise RuntimeError(f'{method}: {answer["error"]}')
        return answer['result']

    def _receive(self, end: float) -> None:
        if not select.select([self.from_browser], [], [], max(0, end - time.monotonic()))[0]:
            raise TimeoutError('the browser does not answer')
        data = os.read(self.from_browser, 1 << 16)
        if not data:
            raise RuntimeError('the browser has ended')
        *whole, self.buffer = (self.buffer + data).split(b'\0')
        for text in whole:
            message = json.loads(text)
            if 'id' in message:
                self.answers[message['id']] = message
                continue
            method, given = message['method'], message['params']
            if method == 'Runtime.exceptionThrown':
                details = given['exceptionDetails']
                self.problems.append(details.get('exception', {}).get('description') or details['text'])
            elif method == 'Runtime.consoleAPICalled' and given['type'] in ('error', 'warning', 'assert'):
                self.problems.append(' '.join(str(a.get('value', a.get('description'))) for a in given['args']))
            elif method == 'Log.entryAdded' and given['entry']['level'] in ('error', 'warning'):
                self.problems.append(given['entry']['text'])
            elif method == 'Network.requestWillBeSent':
                self.requests.append(given['request']['url'])

    def open(self, path: pathlib.Path) -> None:
        self.ask('Page.navigate', url=path.resolve().as_uri())
        self.wait('document.readyState === "complete"')
        time.sleep(0.5)

    def js(self, expression: str):
        done = self.ask('Runtime.evaluate', expression=expression, returnByValue=True, awaitPromise=True)
        if 'exceptionDetails' in done:
            raise RuntimeError(done['exceptionDetails'])
        return done['result'].get('value')

    def wait(self, expression: str, patience: float = 30) -> None:
        end = time.monotonic() + patience
        while not self.js(expression):
            if time.monotonic() > end:
                raise TimeoutError(expression)
            time.sleep(0.05)

    def mouse(self, x: float, y: float, click: bool = False) -> None:
        self.ask('Input.dispatchMouseEvent', type='mouseMoved', x=x, y=y)
        if click:
            for kind in ('mousePressed', 'mouseReleased'):
                self.ask('Input.dispatchMouseEvent', type=kind, x=x, y=y, button='left', clickCount=1)

    def key(self, name: str) -> None:
        code = {'ArrowRight': 39, 'ArrowLeft': 37, 'Enter': 13, 'Tab': 9}[name]
        for kind in ('rawKeyDown', 'keyUp'):
            self.ask('Input.dispatchKeyEvent', type=kind, key=name, code=name, windowsVirtualKeyCode=code)

    def screenshot(self, path: pathlib.Path, whole: bool = True) -> None:
        data = self.ask('Page.captureScreenshot', format='png', captureBeyondViewport=whole)['data']
        pathlib.Path(path).write_bytes(base64.b64decode(data))
