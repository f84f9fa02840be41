"""What --view takes from a file."""
from command import FILE, USAGE, CommandTest, main


class ViewFile(CommandTest):
    def view(self, text, name="a.view"):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return name

    def render(self, *words):
        self.run_command("render", *words, "-q", "-o", "out.png")
        return self.pixels("out.png")

    def test_it_stands_for_what_it_says(self):
        scene = self.scene("a scene.gltf")
        options = ["--technique", "direct", "--resolution", "16,12", "--samples", "2", "--exposure", "1",
                   "--camera-position", "-0.5,0.25,2", "--raw", "--define", "shadow.filter=pcf"]
        typed = self.render(scene, *options)
        name = self.view(f"# A view.\nfile={scene}\ntechnique=direct\nresolution=16,12\nsamples=2\n"
                         "exposure=1\ncamera-position=-0.5,0.25,2\n\nraw\ndefine=shadow.filter=pcf\n")
        for words in (["--view", name], ["--view=" + name], ["--vie", name]):
            self.assertEqual(self.render(*words), typed)
        self.assertEqual(self.render(self.scene("same.gltf"), "--view", name), typed)
        once = self.render(scene, *options, "--samples", "1")
        self.assertNotEqual(once, typed)
        for words in (["--view", name, "--samples", "1"], ["--samples", "1", "--view", name]):
            self.assertEqual(self.render(*words), once)

    def test_a_picture_tells_what_was_meant(self):
        name = self.view(f"file={self.scene()}\ntechnique=direct\nresolution=8,8\nsamples=1\n")
        self.run_command("render", "--view", name, "-q", "-o", "out.png")
        text = self.run_command("info", "out.png").stdout.decode()
        self.assertIn("--technique direct --resolution 8,8 --samples 1", text)
        self.assertNotIn("--view", text)

    def test_edits_of_the_environment(self):
        """They do what the options do."""
        self.run_command("render", self.scene(), "-q", "-t", "direct", "-r", "16,8", "-s", "1", "-o", "sky.exr")
        scene = [self.scene(), "-e", "sky.exr", "-t", "bidirectional", "-r", "16,12", "-s", "1"]
        plain = self.render(*scene)
        options = self.render(*scene, "--environment-rotation", "80", "--environment-strength", "2")
        self.assertNotEqual(options, plain)
        self.assertEqual(options, self.render(*scene, "--edit", "environment/rotation=80", "--edit", "environment/strength=2"))

    def test_what_is_none(self):
        self.refuse("render", "--view", "no.view", "-o", "out.png", status=FILE, says=["no.view"])
        for text, status in (("no-such=1\n", USAGE), ("samples=x\n", USAGE), ("view=a.view\n", USAGE),
                             ("raw=1\n", USAGE)):
            self.refuse("render", "--view", self.view("# A view.\n" + text), "-o", "out.png",
                        status=status, says=["a.view: line 2"])
        self.refuse("render", "-o", "out.png", "--view", status=USAGE, says=["--view", "needs a value"])


if __name__ == "__main__":
    main()
