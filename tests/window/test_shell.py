"""The window with a client that knows no scenes: input, panels, replays, a lost context."""
import ctypes
import ctypes.util
import os
import subprocess
import sys
import time

from display import WindowTest, main, read_png

SHELL = os.path.abspath(sys.argv.pop(1))


class Shell(WindowTest):
    def replay(self, *lines, status=0):
        done = self.run_program(SHELL, "replay", self.write("script", "\n".join(lines) + "\n"),
                                status=status)
        return done.stdout.splitlines(), done.stderr

    def test_keys_and_buttons(self):
        said, _ = self.replay("2 key A", "3 key-up A", "3 key Control", "4 key S", "5 key-up Control",
                              "5 move 50 100", "6 button 0", "7 move 60 90", "7 button-up 0",
                              "8 button 0", "9 button-up 0", "10 scroll -2", "11 button 2",
                              "11 button-up 2", "12 drop /some folder/a.glb", "14 close")
        self.assertEqual(said, ["open 1 application", "size 320x240", "key 65 0", "key 341 2",
                                "key 83 2", "left 50,100", "drag 10,-10", "left 60,90",
                                "scroll -2", "middle 60,90", "drop /some folder/a.glb", "close"])

    def test_a_double_click(self):
        said, _ = self.replay("5 move 50 100", "6 button 0", "7 button-up 0", "8 button 0",
                              "9 button-up 0", "40 button 0", "41 button-up 0")
        self.assertEqual(said[2:-1], ["left 50,100", "left 50,100 twice", "left 50,100"])

    def test_panels_keep_what_they_take(self):
        said, _ = self.replay("2 press Lamp", "3 set Level = 0.5", "4 press Shape", "5 press ball",
                              "6 move 300 200", "7 button 0", "8 button-up 0", "8 scroll 1",
                              "9 set Shape = cube", "10 move 50 100", "11 button 0", "14 close")
        self.assertEqual(said[2:-1], ["lamp 1", "level 0.5", "shape ball", "shape cube",
                                      "left 50,100"])

    def test_a_capture_shows_canvas_and_panel(self):
        said, _ = self.replay("2 set Level = 0", "3 press File", "4 press Save picture", "9 close")
        self.assertIn("saved window.png", said)
        width, height, rows = read_png(self.path("window.png"))
        self.assertEqual((width, height), (320, 240))
        self.assertEqual((rows[42][2], rows[70][2]), ((0, 0, 255), (0, 0, 0)), "rows from the top")
        self.assertNotEqual(rows[100][300], (0, 0, 0), "the panel")

    def test_settle_waits_until_the_client_rests(self):
        said, _ = self.replay("2 press File", "3 press Work", "4 settle", "5 key A", "6 close")
        self.assertLess(said.index("worked"), said.index("key 65 0"))

    def test_sizes(self):
        said, _ = self.replay("2 size 400 300", "4 minimise", "6 key F11", "8 close")
        self.assertEqual(said[2:4], ["size 400x300", "key 300 0"])

    def test_lost_context_is_recreated(self):
        said, errors = self.replay("2 set Level = 0", "5 lose-context", "7 press File",
                                   "8 press Save picture", "12 close")
        self.assertEqual([line for line in said if "open" in line or line == "close"],
                         ["open 1 application", "close", "open 2 application", "close"])
        self.assertIn("was lost", errors)
        self.assertEqual(read_png(self.path("window.png"))[2][42][2], (0, 0, 255))

    def test_invalid_recordings(self):
        for line, words in (("2 press Nothing", "nothing of that label"),
                            ("2 set Level2 = 1", "is not shown"),
                            ("x key A", "script:1"), ("2 key Nokey", "script:1"),
                            ("2 move 1", "script:1"), ("2 drag 1 2", "script:1"), ("2 dance", "script:1")):
            with self.subTest(line=line):
                _, errors = self.replay(line, status=3)
                self.assertIn(words, errors)

    def test_a_client_that_fails(self):
        _, errors = self.replay("2 key Control", "3 key Q", status=1)
        self.assertEqual(errors, "asked to fail\n")

    def test_no_display(self):
        done = self.run_program(SHELL, status=4, environment={"PATH": "/usr/bin"})
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertIn("xvfb-run", done.stderr)

    def test_input_is_recorded_and_replayed(self):
        """Through the X server's own test of devices."""
        names = ctypes.util.find_library("X11"), ctypes.util.find_library("Xtst")
        if None in names:
            self.skipTest("libXtst is not installed")
        x11, xtest = (ctypes.CDLL(name) for name in names)
        x11.XOpenDisplay.restype = ctypes.c_void_p
        x11.XFlush.argtypes = x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
        for function in (xtest.XTestFakeMotionEvent, xtest.XTestFakeButtonEvent,
                         xtest.XTestFakeKeyEvent):
            function.argtypes = [ctypes.c_void_p] + 4 * [ctypes.c_ulong]
        xtest.XTestFakeMotionEvent.argtypes += [ctypes.c_ulong]
        display = x11.XOpenDisplay(self.display.name.encode())
        program = subprocess.Popen([SHELL, "record", "said"], cwd=self.folder, text=True,
                                   env=self.environment(), stdout=subprocess.PIPE)
        said = [program.stdout.readline().strip() for _ in range(2)]
        events = [(xtest.XTestFakeMotionEvent, 0, 60, 110, 0, 0), (xtest.XTestFakeButtonEvent, 1, 1, 0, 0),
                  (xtest.XTestFakeMotionEvent, 0, 80, 120, 0, 0), (xtest.XTestFakeButtonEvent, 1, 0, 0, 0),
                  (xtest.XTestFakeButtonEvent, 4, 1, 0, 0), (xtest.XTestFakeButtonEvent, 4, 0, 0, 0)]
        time.sleep(0.2)
        for call, *arguments in events:
            call(display, *arguments)
            x11.XFlush(display)
            time.sleep(0.1)
        said += [program.stdout.readline().strip() for _ in range(3)]
        program.terminate()
        program.communicate()
        x11.XCloseDisplay(display)
        self.assertTrue(said[2].startswith("left "), said)
        self.assertEqual(said[3:], ["drag 20,10", "scroll 1"])


if __name__ == "__main__":
    main()
