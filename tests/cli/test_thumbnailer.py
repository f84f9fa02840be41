"""The entry by which file managers get small pictures of scenes."""
import configparser
import os
import shlex
import subprocess

from command import COMMAND, FILE, SOURCE_ROOT, CommandTest, main, png_size


class Thumbnailer(CommandTest):
    def entry(self):
        parser = configparser.ConfigParser(interpolation=None)
        parser.optionxform = str
        parser.read(os.path.join(SOURCE_ROOT, "data/lightsheaf.thumbnailer"), encoding="utf-8")
        return parser["Thumbnailer Entry"]

    def thumbnail(self, scene, picture, size):
        """As file managers do: split into words, then the fields of each are filled in."""
        fields = {"%i": scene, "%u": "file://" + scene, "%o": picture, "%s": str(size)}
        words = shlex.split(self.entry()["Exec"])
        for field, value in fields.items():
            words = [word.replace(field, value) for word in words]
        self.assertEqual(words[0], self.entry()["TryExec"])
        return subprocess.run([COMMAND, *words[1:]], cwd=self.folder, stdin=subprocess.DEVNULL,
                              capture_output=True, timeout=120, check=False)

    def test_kinds_of_files(self):
        self.assertEqual(self.entry()["MimeType"], "model/gltf-binary;model/gltf+json;")

    def test_picture(self):
        """Of that size and with alpha, under whatever name, and without a word."""
        scene = self.scene("-a scene.gltf", light=False)
        done = self.thumbnail(os.path.basename(scene), self.path("md5"), 64)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))
        picture = self.read("md5")
        self.assertEqual(png_size(picture), (64, 64))
        self.assertEqual(picture[25], 6)

    def test_files_that_are_no_scene(self):
        with open(self.path("a.glb"), "wb") as file:
            file.write(b"glTF")
        done = self.thumbnail(self.path("a.glb"), self.path("a.png"), 64)
        self.assertEqual(done.returncode, FILE)
        self.assertEqual(self.files(), ["a.glb"])


if __name__ == "__main__":
    main()
