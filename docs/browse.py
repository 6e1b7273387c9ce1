#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""browse.py SITE [-screenshots FOLDER]: reads a built site with headless
Chromium, as on a phone 390 pixels wide and on a desktop.

Each page has to load without an error, show all of its pictures and equations,
link only to what is there, and not scroll sideways. Ends with what is wrong, if
anything; exit status 1 then.
"""

import argparse
import base64
import contextlib
import functools
import http.server
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading

PHONE = dict(width=390, height=844, deviceScaleFactor=2, mobile=True)
DESKTOP = dict(width=1280, height=900, deviceScaleFactor=1, mobile=False)

# What a page says of itself when it has loaded
INSPECT = r"""
(() => {
// Is an element, or what it is in, one that scrolls by itself, is for readers
// aloud, or is cut off, as roots are?
const scrolls = e => e && (e.className == "katex-mathml"
  || e.className == "hide-tail"
  || /auto|scroll/.test(getComputedStyle(e).overflowX)
  && e.tagName != "BODY" && e.tagName != "HTML" || scrolls(e.parentElement));
return ({
  title: document.title,
  words: document.body.innerText.split(/\s+/).length,
  links: [...document.querySelectorAll("a[href]")].map(a => a.href),
  ids: [...document.querySelectorAll("[id]")].map(e => e.id),
  pictures: [...document.images].filter(i => i.complete && !i.naturalWidth)
    .map(i => i.src),
  equations: document.querySelectorAll(".arithmatex").length,
  drawn: document.querySelectorAll(".arithmatex .katex").length,
  wrong: [...document.querySelectorAll(".katex-error")].map(e => e.innerText),
  width: document.documentElement.scrollWidth,
  beyond: [...document.querySelectorAll("article *")].filter(
    e => e.getBoundingClientRect().right
      > document.documentElement.clientWidth + 1 && !scrolls(e))
    .map(e => e.outerHTML.slice(0, 120)).slice(0, 3),
});
})()
"""


class Browser:
    """Chromium by its debugging protocol, over a pipe."""

    def __init__(self, program, profile):
        out_read, self.to_browser = os.pipe()
        self.from_browser, in_write = os.pipe()

        # The browser reads commands from 3 and answers on 4. Neither end may
        # have either number before it is put there
        out_high, in_high = (
            os.dup2(fd, 100 + i, inheritable=True)
            for i, fd in enumerate((out_read, in_write))
        )
        self.process = subprocess.Popen(
            [
                "bash",
                "-c",
                'exec 3<&100 4>&101 100<&- 101>&-; exec "$@"',
                "bash",
                program,
                "--headless=new",
                "--remote-debugging-pipe",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-dev-shm-usage",
                "--hide-scrollbars",
                f"--user-data-dir={profile}",
            ],
            close_fds=False,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        for fd in (out_read, in_write, out_high, in_high):
            os.close(fd)
        self.answers = b""
        self.number = 0
        self.events = []
        target = self.call("Target.createTarget", url="about:blank")[
            "targetId"
        ]
        self.session = None
        self.session = self.call(
            "Target.attachToTarget", targetId=target, flatten=True
        )["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")

    def call(self, method, **parameters):
        self.number += 1
        command = dict(id=self.number, method=method, params=parameters)
        if getattr(self, "session", None):
            command["sessionId"] = self.session
        os.write(self.to_browser, json.dumps(command).encode() + b"\0")
        while True:
            message = self.receive()
            if message.get("id") == self.number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]
            self.events.append(message)

    def receive(self):
        while b"\0" not in self.answers:
            more = os.read(self.from_browser, 1 << 20)
            if not more:
                raise RuntimeError("the browser has ended")
            self.answers += more
        message, _, self.answers = self.answers.partition(b"\0")
        return json.loads(message)

    def open(self, url, **screen):
        """Loads a page; returns what it says and what went wrong."""
        self.call("Emulation.setDeviceMetricsOverride", **screen)
        self.events = []
        self.call("Page.navigate", url=url)
        while not any(
            e.get("method") == "Page.loadEventFired" for e in self.events
        ):
            self.events.append(self.receive())
        # Pictures below the first screen, and equations
        self.evaluate(
            """new Promise(done => { document.fonts.ready.then(() =>
            requestAnimationFrame(() => setTimeout(done, 100))) })"""
        )
        said = self.evaluate(INSPECT)
        return said, [w for w in map(wrong_with, self.events) if w]

    def evaluate(self, expression):
        result = self.call(
            "Runtime.evaluate",
            expression=expression,
            returnByValue=True,
            awaitPromise=True,
        )
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"]["text"])
        return result["result"].get("value")

    def screenshot(self, path, whole=False):
        data = self.call("Page.captureScreenshot", captureBeyondViewport=whole)
        pathlib.Path(path).write_bytes(base64.b64decode(data["data"]))

    def close(self):
        self.process.terminate()
        self.process.wait()
        os.close(self.to_browser)
        os.close(self.from_browser)


def wrong_with(event):
    """What an event of the browser complains of, if anything."""
    method, what = event.get("method"), event.get("params", {})
    if method == "Runtime.exceptionThrown":
        return (
            what["exceptionDetails"]
            .get("exception", {})
            .get("description", "an exception")
        )
    if (
        method == "Network.responseReceived"
        and what["response"]["status"] >= 400
        and not what["response"]["url"].endswith("/favicon.ico")
    ):
        return f"{what['response']['status']}: {what['response']['url']}"
    if method == "Network.loadingFailed" and not what.get("canceled"):
        return f"{what.get('errorText')}: a request failed"
    if method == "Network.requestWillBeSent":
        url = what["request"]["url"]
        if not url.startswith(
            ("http://127.0.0.1:", "data:", "blob:", "about:")
        ):
            return f"asks another host: {url}"
    return None


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@contextlib.contextmanager
def served(folder):
    server = http.server.ThreadingHTTPServer(
        ("127.0.0.1", 0), functools.partial(Quiet, directory=str(folder))
    )
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}/"
    server.shutdown()


@contextlib.contextmanager
def browser():
    program = shutil.which("chromium") or shutil.which("google-chrome")
    if not program:
        raise SystemExit("browse.py: there is no chromium")
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        one = Browser(program, profile)
        try:
            yield one
        finally:
            one.close()


def pages(site):
    """Pages that we write; those of Doxygen are its own."""
    return sorted(
        p.relative_to(site).as_posix()
        for p in site.rglob("*.html")
        if p.relative_to(site).parts[0] != "api" and p.name != "404.html"
    )


def look(site, screenshots=None):
    """What is wrong, as (page, what), and how much was seen."""
    wrong, seen, links, ids = [], {}, {}, {}
    with served(site) as root, browser() as one:
        for page in pages(site):
            for name, screen in (("phone", PHONE), ("desktop", DESKTOP)):
                said, errors = one.open(root + page, **screen)
                wrong += [(page, e) for e in errors]
                wrong += [(page, f"no picture {p}") for p in said["pictures"]]
                wrong += [(page, f"equation: {w}") for w in said["wrong"]]
                if said["drawn"] < said["equations"]:
                    wrong.append((page, "equations are not drawn"))
                if said["width"] > screen["width"] or said["beyond"]:
                    wrong.append(
                        (
                            page,
                            f"scrolls sideways on a {name}: "
                            f"{said['width']} pixels {said['beyond']}",
                        )
                    )
                if said["words"] < 20:
                    wrong.append((page, "is empty"))
                if screenshots:
                    screenshots.mkdir(parents=True, exist_ok=True)
                    one.screenshot(
                        screenshots / f"{page.replace('/', '.')}.{name}.png"
                    )
            seen[page] = said
            ids[page] = set(said["ids"])
            links[page] = {
                link[len(root) :]
                for link in said["links"]
                if link.startswith(root)
            }
        wrong += [
            (page, f"broken link {link}")
            for page in links
            for link in sorted(links[page])
            if not leads_somewhere(site, ids, link)
        ]
    return wrong, seen


def leads_somewhere(site, ids, link):
    path, _, anchor = link.partition("#")
    path = path.partition("?")[0] or "index.html"
    if (
        not (site / path).is_file()
        and not (site / path / "index.html").is_file()
    ):
        return False
    return (
        not anchor
        or path not in ids
        or anchor in ids[path]
        or anchor.startswith("__")
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("site", type=pathlib.Path)
    parser.add_argument("-screenshots", type=pathlib.Path)
    options = parser.parse_args()

    wrong, seen = look(options.site, options.screenshots)
    for page, what in wrong:
        print(f"{page}: {what}")
    print(
        f"{len(seen)} pages, "
        f"{sum(s['equations'] for s in seen.values())} equations, "
        f"{len(wrong)} faults"
    )
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
