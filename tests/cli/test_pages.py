"""What is made from the option table: docs/command.md, the man page, the completions."""
import os
import pty
import re
import select
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


class Figures(CommandTest):
    """Tables that are measured: each that stands in a page has a function, and measuring works."""

    def figures(self, *words):
        return subprocess.run([os.path.join(SOURCE_ROOT, "scripts/figures"), "--command", COMMAND,
                               *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=True,
                              text=True, env={**os.environ, "XDG_CACHE_HOME": self.folder}).stdout

    def test_tables_of_pages_are_known(self):
        self.assertIn("equal-time\tdocs/measure.md", self.figures("--list"))

    def test_table_is_measured(self):
        lines = self.figures("--quick", "convergence").splitlines()
        self.assertEqual(lines[0], "|  |  | 1 | 4 |")
        raw = [float(cell) for cell in lines[2].split("|")[3:5]]
        self.assertLess(raw[1], raw[0])


class Completion(CommandTest):
    """What the shells propose for a line that ends here, in each shell that there is."""

    def check(self, complete):
        self.assertEqual(complete("lightsheaf ren"), ["render"])
        self.assertEqual(complete("lightsheaf render --backend e"), ["egl"])
        self.assertEqual(complete("lightsheaf plan --technique di"), ["direct"])
        self.assertEqual(complete("lightsheaf render -D shadow.t"), ["shadow.texels_per_pixel="])
        self.assertEqual(complete("lightsheaf plan --define shadow.filter=p"), ["shadow.filter=pcf"])
        self.assertEqual(complete("lightsheaf plan -D voxel.jitter=of"), ["voxel.jitter=off"])
        self.assertEqual(complete("lightsheaf render --aov albedo,no"), ["albedo,normal"])
        self.assertEqual(complete("lightsheaf render --tonemap ag"), ["agx"])
        self.assertEqual(complete("lightsheaf render --exposure a"), ["auto"])
        self.assertEqual(complete("lightsheaf render --background tr"), ["transparent"])
        self.assertEqual(complete("lightsheaf compare a b --threshold xyz"), [])
        self.assertEqual(complete("lightsheaf compare a b --threshold relm"), ["relmse="])
        self.assertEqual(complete("lightsheaf bench voxel"), ["voxel_path"])
        self.assertEqual(complete("lightsheaf help inf"), ["info"])
        self.assertEqual(complete("lightsheaf reference --halv"), ["--halves"])

    @unittest.skipUnless(shutil.which("bash"), "no bash")
    def test_bash(self):
        self.check(self.bash)
        self.check(lambda line: self.bash(line, breaks=True))
        self.assertEqual(self.bash("lightsheaf re"), ["render", "reference"])
        self.assertEqual(self.bash("lightsheaf render --camera-"), ["--camera-position", "--camera-target"])
        self.assertEqual(self.bash("lightsheaf render --technique=di"), ["--technique=direct"])
        self.assertEqual(self.bash("lightsheaf render --technique=di", breaks=True), ["--technique=direct"])
        self.assertEqual(self.bash("lightsheaf compare --exposure a"), [])
        self.assertNotIn("--halves", self.bash("lightsheaf render --"))

    def bash(self, line, breaks=False):
        """With `breaks`, as readline does: "=" is a word, and what comes back takes its place behind it."""
        words = re.split(r" |(=)" if breaks else " ", line)
        words = [word for at, word in enumerate(words) if word or (word == "" and at == len(words) - 1)]
        if len(words) > 1 and words[-1] == "" and words[-2] == "=":
            words.pop()
        script = (page("bash") + "\ncompopt() { :; }\nCOMP_WORDS=(" +
                  " ".join(f"'{word}'" for word in words) + f")\nCOMP_CWORD={len(words) - 1}\n" +
                  f"COMP_WORDBREAKS={'=' if breaks else ''}\n_lightsheaf '{COMMAND}'\n"
                  "printf '%s\\n' \"${COMPREPLY[@]}\"\n")
        done = subprocess.run(["bash", "-c", script], capture_output=True, check=True)
        self.assertEqual(done.stderr, b"")
        typed = line.rpartition(" ")[2]
        kept = typed.rpartition("=")[0] + "=" if breaks and "=" in typed else ""
        return [kept + word for word in done.stdout.decode().splitlines() if word]

    @unittest.skipUnless(shutil.which("fish"), "no fish")
    def test_fish(self):
        self.on_path()
        with open(self.path("lightsheaf.fish"), "w", encoding="utf-8") as file:
            file.write(page("fish"))
        self.check(self.fish)

    def fish(self, line):
        done = subprocess.run(["fish", "--no-config", "-c",
                               f"source lightsheaf.fish; complete -C '{line}'"],
                              cwd=self.folder, env=self.environment, capture_output=True, check=True)
        self.assertEqual(done.stderr, b"")
        words = [found.split("\t")[0] for found in done.stdout.decode().splitlines()]
        # fish knows no endings that ask for more, and names files where nothing else fits
        return [word + "=" if word == "relmse" else word for word in words if word not in self.files()]

    @unittest.skipUnless(shutil.which("zsh"), "no zsh")
    def test_zsh(self):
        """In a shell at a terminal, by the key: what the line is then, where one proposal is left."""
        self.on_path()
        with open(self.path("_lightsheaf"), "w", encoding="utf-8") as file:
            file.write(page("zsh"))
        with open(self.path(".zshrc"), "w", encoding="utf-8") as file:
            file.write("fpath=($ZDOTDIR $fpath)\nautoload -Uz compinit\ncompinit -u -D\nPROMPT=\nunsetopt beep\n"
                       "show() { print -r -- \"<<$BUFFER>>\"; BUFFER=; }\n"
                       "zle -N show\nbindkey '^X' show\nprint READY\n")
        mine, theirs = pty.openpty()
        shell = subprocess.Popen(["zsh", "-i"], cwd=self.folder, stdin=theirs, stdout=theirs, stderr=theirs,
                                 start_new_session=True,
                                 env={**self.environment, "ZDOTDIR": self.folder, "TERM": "dumb"})
        os.close(theirs)
        self.addCleanup(os.close, mine)
        self.addCleanup(shell.wait)
        self.addCleanup(shell.kill)
        self.until(mine, b"READY")

        def complete(line):
            os.write(mine, line.encode() + b"\t\x18")
            seen = re.search(rb"<<(.*?)>>", self.until(mine, b">>"), re.DOTALL).group(1)
            word = seen.decode().strip().rpartition(" ")[2].rstrip(",")  # of lists zsh types one
            return [] if word == line.rpartition(" ")[2] else [word]

        self.check(complete)

    def until(self, terminal, mark):
        seen = b""
        while mark not in seen:
            ready, _, _ = select.select([terminal], [], [], 30)
            self.assertTrue(ready, seen)
            seen += os.read(terminal, 65536)
        return seen

    def on_path(self):
        os.symlink(COMMAND, self.path("lightsheaf"))
        self.environment = {**os.environ, "PATH": self.folder + ":" + os.environ["PATH"],
                            "HOME": self.folder}

    def test_every_option_is_there(self):
        """In each shell's page, whether or not the shell is at hand."""
        pages = {name: page(name) for name in ("bash", "fish", "zsh")}
        for line in page("markdown").splitlines():
            option = re.match(r"\| `(?:-\w, )?--([\w-]+)", line)
            if option:
                self.assertIn(f"--{option[1]}", pages["bash"])
                self.assertIn(f"--{option[1]}", pages["zsh"])
                self.assertIn(f" -l {option[1]}", pages["fish"])


if __name__ == "__main__":
    main()
