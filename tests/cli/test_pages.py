"""What is made from the option table: docs/command.md, the man page, the completions."""
import os
import shutil
import subprocess
import unittest

from command import COMMAND, SOURCE_ROOT, CommandTest, main

PAGES = os.environ["LSF_PAGES"]
BEGIN, END = "<!-- options: begin -->\n", "<!-- options: end -->"


def page(name):
    return subprocess.run([PAGES, name], stdout=subprocess.PIPE, check=True).stdout.decode()


class Pages(CommandTest):
    def test_documentation_lists_the_options(self):
        """LSF_UPDATE=1 in the environment brings docs/command.md up to date instead."""
        path = os.path.join(SOURCE_ROOT, "docs/command.md")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        before, rest = text.split(BEGIN)
        options, after = rest.split(END)
        if os.environ.get("LSF_UPDATE"):
            with open(path, "w", encoding="utf-8") as file:
                file.write(before + BEGIN + page("markdown") + END + after)
        else:
            self.assertEqual(options, page("markdown"))

    def test_man_page(self):
        text = page("man")
        for word in (".TH LIGHTSHEAF 1", "\\-\\-camera\\-position", "EXIT STATUS"):
            self.assertIn(word, text)
        if shutil.which("groff"):
            done = subprocess.run(["groff", "-man", "-ww", "-Tutf8"], input=text.encode(),
                                  capture_output=True, check=True)
            self.assertEqual(done.stderr, b"")

    @unittest.skipUnless(shutil.which("bash"), "no bash")
    def test_bash_completion(self):
        self.assertEqual(self.complete("lightsheaf", "re"), ["render", "reference"])
        self.assertEqual(self.complete("lightsheaf", "render", "--camera-"),
                         ["--camera-position", "--camera-target"])
        self.assertEqual(self.complete("lightsheaf", "render", "--backend", "e"), ["egl"])
        self.assertIn("direct", self.complete("lightsheaf", "plan", "--technique", ""))
        self.assertIn("shadow.filter=", self.complete("lightsheaf", "render", "-D", "shadow."))
        self.assertEqual(self.complete("lightsheaf", "help", "in"), ["info"])
        self.assertNotIn("--halves", self.complete("lightsheaf", "render", "--"))

    def complete(self, *words):
        script = (page("bash") + "\ncompopt() { :; }\nCOMP_WORDS=(" +
                  " ".join(f"'{word}'" for word in words) +
                  f")\nCOMP_CWORD={len(words) - 1}\n_lightsheaf '{COMMAND}'\n"
                  "printf '%s\\n' \"${COMPREPLY[@]}\"\n")
        done = subprocess.run(["bash", "-c", script], capture_output=True, check=True)
        self.assertEqual(done.stderr, b"")
        return [line for line in done.stdout.decode().splitlines() if line]


if __name__ == "__main__":
    main()
