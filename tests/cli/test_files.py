"""What happens to files: nothing is torn, nothing good is lost, nothing is left behind."""
import json
import os
import resource
import unittest

from command import FILE, CommandTest, main

SMALL = ("--resolution", "8,8", "--samples", "1", "--quiet")


class Outputs(CommandTest):
    def test_missing_folder_is_found_before_rendering(self):
        self.refuse("render", "missing.gltf", "-o", "nowhere/a.exr", status=FILE,
                    says=["nowhere/a.exr"])

    def test_folder_in_place_of_a_file(self):
        os.mkdir(self.path("a.exr"))
        self.refuse("render", "missing.gltf", "-o", "a.exr", status=FILE, says=["a.exr", "folder"])
        os.mkdir(self.path("a.json"))
        for words in (["render", "-o", "b.exr"], ["info"], ["plan"], ["bench", "rays"]):
            self.refuse(*words, "missing.gltf", "--json", "a.json", status=FILE, says=["a.json"])
        self.refuse("compare", "a.exr", "b.exr", "--json", "a.json", status=FILE, says=["a.json"])

    def test_file_in_place_of_a_folder(self):
        self.scene()
        self.refuse("render", "scene.gltf", "-o", "scene.gltf/a.exr", status=FILE,
                    says=["scene.gltf/a.exr"])

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_folder_without_permission(self):
        os.mkdir(self.path("closed"), 0o500)
        self.refuse("render", "missing.gltf", "-o", "closed/a.exr", status=FILE, says=["closed/a.exr"])

    def test_full_device(self):
        self.refuse("render", self.scene(), "-o", "/dev/full", "--format", "exr", *SMALL,
                    status=FILE, says=["/dev/full"])

    def test_existing_file_survives_failures(self):
        with open(self.path("a.exr"), "wb") as file:
            file.write(b"precious")
        scene = self.scene()
        with open(self.path("bad.gltf"), "w", encoding="ascii") as file:
            file.write("{")
        for words in (["missing.gltf"], ["bad.gltf"], [scene, "--camera", "nobody"],
                      [scene, "-D", "shadow.filter=nothing"],
                      [scene, "--shader-dir", self.folder]):
            done = self.run_failing("render", *words, "-o", "a.exr", *SMALL)
            self.assertNotEqual(done.returncode, 0, words)
            self.assertEqual(self.read("a.exr"), b"precious")
        self.assertEqual(self.files(), ["a.exr", "bad.gltf", "scene.gltf"])

    def test_limit_on_file_sizes(self):
        """What is written aside is removed, and the cause is named."""
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (200, 200))
        done = self.run_command("render", self.scene(), "-o", "a.exr", *SMALL, status=FILE,
                                preexec_fn=limit, env=dict(os.environ, MESA_SHADER_CACHE_DISABLE="1"))
        self.assertIn("ulimit -f", done.text)
        self.assertEqual(self.files(), ["scene.gltf"])

    def run_failing(self, *words):
        import subprocess
        from command import COMMAND
        return subprocess.run([COMMAND, *words], cwd=self.folder, capture_output=True, timeout=60,
                              check=False)

    def test_existing_file_is_replaced(self):
        with open(self.path("a.exr"), "wb") as file:
            file.write(b"old")
        self.run_command("render", self.scene(), "-o", "a.exr", "--json", "a.json", *SMALL)
        self.assertTrue(self.read("a.exr").startswith(b"\x76\x2f\x31\x01"))
        self.assertEqual(self.files(), ["a.exr", "a.json", "scene.gltf"])

    def test_link_stays_a_link(self):
        os.mkdir(self.path("real"))
        with open(self.path("real/a.exr"), "wb") as file:
            file.write(b"old")
        os.symlink("real/a.exr", self.path("a.exr"))
        self.run_command("render", self.scene(), "-o", "a.exr", *SMALL)
        self.assertTrue(os.path.islink(self.path("a.exr")))
        self.assertTrue(self.read("real/a.exr").startswith(b"\x76\x2f\x31\x01"))


class Inputs(CommandTest):
    def test_missing(self):
        for words in (["info"], ["plan"], ["render", "-o", "a.exr"]):
            self.refuse(*words, "missing.gltf", status=FILE, says=["missing.gltf"])

    def test_other_files(self):
        for name, content, says in (("a.txt", b"hello", "this is neither"), ("a", b"\x7fELF", "this is neither"),
                                    ("a.gltf", b" \n", "an empty file"), ("a.glb", b"\x89PNG", "a PNG picture")):
            with open(self.path(name), "wb") as file:
                file.write(content)
            self.refuse("info", name, status=FILE, says=[name, "only .gltf and .glb are read", says])

    def test_wrong_kinds(self):
        os.mkfifo(self.path("fifo.gltf"))
        for path in ("fifo.gltf", "/dev/zero", "."):
            self.refuse("info", path, status=FILE, says=[path])

    def test_memory_limit(self):
        """A file of 3 MB, and vertices that no file holds but that take 12 MB."""
        with open(self.scene(), "a") as file:
            file.write(3000000 * " ")
        with open(self.path("zeros.gltf"), "w") as file:
            json.dump({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                       "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                       "accessors": [{"componentType": 5126, "count": 999999, "type": "VEC3",
                                      "min": [0, 0, 0], "max": [0, 0, 0]}]}, file)
        for name in ("scene.gltf", "zeros.gltf"):
            self.refuse("info", name, "--memory-limit", "0.001", status=FILE, says=[name, "raise the"])
            self.run_command("info", name, "--memory-limit", "0.5")
        self.refuse("info", "scene.gltf", "--memory-limit", "0", says=["--memory-limit 0"])

    def test_missing_environment(self):
        self.refuse("info", self.scene(), "--environment", "sky.hdr", status=FILE, says=["sky.hdr"])

    def test_missing_shaders(self):
        done = self.run_failing_render("--shader-dir", "nowhere")
        self.assertIn("nowhere", done.text)

    def run_failing_render(self, *words):
        import subprocess
        from command import COMMAND
        done = subprocess.run([COMMAND, "render", self.scene(), "-o", "a.exr", *words],
                              cwd=self.folder, capture_output=True, timeout=60, check=False)
        done.text = done.stderr.decode()
        self.assertNotEqual(done.returncode, 0)
        return done


if __name__ == "__main__":
    main()
