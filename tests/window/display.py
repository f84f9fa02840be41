"""What the tests of windows share: a display without a screen, and pictures of it."""
import ctypes
import ctypes.util
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

SKIPPED = 77


class Display:
    """An X server of one's own, which ends with the tests."""

    def __init__(self, size="640x480"):
        read_end, write_end = os.pipe()
        # While a server resets, as it does after its last client, it turns others away.
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write_end), "-screen", "0", size + "x24", "-nolisten", "tcp",
             "-noreset"],
            pass_fds=[write_end], stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read_end) as file:
            self.name = ":" + file.readline().strip()

    def set_density(self, density):
        """What a desktop tells programs by the resource Xft.dpi, in dots an inch."""
        x11 = ctypes.CDLL(ctypes.util.find_library("X11"))
        x11.XOpenDisplay.restype = ctypes.c_void_p
        x11.XDefaultRootWindow.restype = ctypes.c_ulong
        x11.XDefaultRootWindow.argtypes = x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
        x11.XChangeProperty.argtypes = [ctypes.c_void_p, *(3 * [ctypes.c_ulong]), ctypes.c_int, ctypes.c_int,
                                        ctypes.c_char_p, ctypes.c_int]
        resource_manager, string, replace = 23, 31, 0  # atoms and a mode of the X protocol
        display = x11.XOpenDisplay(self.name.encode())
        text = f"Xft.dpi:\t{density}\n".encode()
        x11.XChangeProperty(display, x11.XDefaultRootWindow(display), resource_manager, string, 8, replace, text, len(text))
        x11.XCloseDisplay(display)

    def close(self):
        self.server.terminate()
        self.server.wait()


class WindowTest(unittest.TestCase):
    """Each test has an empty folder of its own; all share a display."""

    @classmethod
    def setUpClass(cls):
        cls.display = Display()
        cls.addClassCleanup(cls.display.close)

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="lightsheaf-window-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        """Replaces the file in one step, because a program may read it at any time."""
        with open(self.path(name + ".new"), "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(file.name, self.path(name))
        return self.path(name)

    def environment(self):
        kept = {key: value for key, value in os.environ.items() if key != "WAYLAND_DISPLAY"}
        return {**kept, "DISPLAY": self.display.name, "LIBGL_ALWAYS_SOFTWARE": "1"}

    def run_program(self, *words, status=0, environment=None, timeout=100):
        done = subprocess.run(words, cwd=self.folder, env=environment or self.environment(), text=True,
                              capture_output=True, stdin=subprocess.DEVNULL, timeout=timeout)
        self.assertEqual(done.returncode, status, f"{' '.join(words)}\n{done.stdout}\n{done.stderr}")
        return done

    def replay_shots(self, *words, first=(), shot, environment=None):
        """A program whose replay does `first`, then takes a `shot` (steps) for as long as the test goes on.

        It looks at files that change by the replay's time, of which half a second is between two shots."""
        steps = [*shot, *(12 * ["step 0.05"]), "settle"]
        script = self.write("script", "".join(f"{1 + k} {line}\n" for k, line in enumerate([*first, *(2000 * steps)])))
        program = subprocess.Popen([*words, "--replay", script], cwd=self.folder, env=environment or self.environment(),
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(program.kill)
        return program

    def shown(self, program, what, good=lambda rows: True, ending=".png"):
        """Waits for a shot from now on whose rows are `good`: those rows."""
        def newest():
            """The shot before the last one, which may be half written; 0: there is none."""
            return max(sum(name.endswith(ending) for name in os.listdir(self.folder)) - 1, 0)

        number = newest()
        while True:
            while newest() <= number and program.poll() is None:
                time.sleep(0.01)
            self.assertIsNone(program.poll(), what)
            number = newest()
            rows = read_png(self.path(f"lightsheaf-{number:04}{ending}"))[2]
            if good(rows):
                return rows


def read_png(path, alpha=False):
    """Width, height and rows of (r, g, b) of an 8-bit PNG without interlacing; with `alpha`, of all its channels."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack_from(">IIBB", data, at + 8)
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += size + 12
    assert depth == 8 and color in (2, 6), (depth, color)
    step = 3 if color == 2 else 4
    raw, before, rows = zlib.decompress(packed), bytes(width * step), []
    for y in range(height):
        kind = raw[y * (width * step + 1)]
        row = bytearray(raw[y * (width * step + 1) + 1:(y + 1) * (width * step + 1)])
        for i in range(len(row)):
            a = row[i - step] if i >= step else 0
            b = before[i]
            c = before[i - step] if i >= step else 0
            if kind == 1:
                row[i] = row[i] + a & 255
            elif kind == 2:
                row[i] = row[i] + b & 255
            elif kind == 3:
                row[i] = row[i] + (a + b) // 2 & 255
            elif kind == 4:
                p = a + b - c
                nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
                row[i] = row[i] + nearest & 255
        rows.append([tuple(row[x * step:x * step + (step if alpha else 3)]) for x in range(width)])
        before = row
    return width, height, rows


def main():
    if not shutil.which("Xvfb"):
        print("skipped: Xvfb is not installed")
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)
