"""Every allocation of a run fails in its turn: an error and its status, or the same output."""
import os
import re
import signal

from command import DONE, FILE, RENDERING, CommandTest, COMMAND, main

import subprocess

STRIDE = 3  # of the allocations, so that the test takes seconds


class Allocations(CommandTest):
    def run_info(self, scene, **variables):
        environment = dict(os.environ, LD_PRELOAD=os.environ["LSF_FAIL_ALLOCATION"], **variables)
        return subprocess.run([COMMAND, "info", scene], cwd=self.folder, env=environment,
                              capture_output=True, timeout=60, check=False)

    def test_info(self):
        scene = self.scene()
        whole = self.run_info(scene)
        self.assertEqual(whole.returncode, DONE)
        count = int(re.search(rb"allocations: (\d+)", whole.stderr)[1])
        self.assertGreater(count, 100)
        aborts = 0
        for at in range(0, count, STRIDE):
            done = self.run_info(scene, FAIL_AT=str(at))
            if done.returncode == -signal.SIGABRT:
                # tinygltf's own document: its library's destructor allocates, and cannot fail.
                self.assertIn(b"bad_alloc", done.stderr)
                aborts += 1
                continue
            self.assertIn(done.returncode, (DONE, RENDERING, FILE), (at, done.stderr))
            if done.returncode == DONE:
                self.assertEqual(done.stdout, whole.stdout, at)
            else:
                self.assertIn(b"error: ", done.stderr)
        self.assertLessEqual(aborts, 3)


if __name__ == "__main__":
    main()
