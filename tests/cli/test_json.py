"""What commands write by --json is what docs/lightsheaf.schema.json says, and to FILE and to - alike."""
import json
import os

import unittest

from command import DIFFERS, FILE, SOURCE_ROOT, CommandTest, main

with open(os.path.join(SOURCE_ROOT, "docs/lightsheaf.schema.json"), encoding="utf-8") as schema_file:
    SCHEMA = json.load(schema_file)
SMALL = ("-r", "8,6", "-s", "1")
KEYWORDS = {"$schema", "title", "description", "$defs", "$ref", "anyOf", "type", "properties", "required",
            "additionalProperties", "items", "minItems", "maxItems", "const"}


def type_of(value):
    return {dict: "object", list: "array", str: "string", bool: "boolean", int: "number", float: "number",
            type(None): "null"}[type(value)]


def faults(value, schema, where="$"):
    """What of the value is not as the schema says: those keywords of JSON Schema 2020-12 that it uses."""
    if "$ref" in schema:
        name = schema["$ref"].removeprefix("#/$defs/")
        yield from faults(value, SCHEMA["$defs"][name], where)
    if "anyOf" in schema:
        tries = [list(faults(value, each, where)) for each in schema["anyOf"]]
        if all(tries):
            yield from min(tries, key=len)
    if "const" in schema and value != schema["const"]:
        yield f"{where} is {value!r}, not {schema['const']!r}"
    types = schema.get("type", type_of(value))
    if type_of(value) not in ([types] if isinstance(types, str) else types):
        yield f"{where} is {type_of(value)}, not {types}"
    elif isinstance(value, dict):
        yield from member_faults(value, schema, where)
    elif isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            yield f"{where} has {len(value)} items"
        for i, item in enumerate(value):
            yield from faults(item, schema.get("items", {}), f"{where}[{i}]")


def member_faults(value, schema, where):
    for key in schema.get("required", ()):
        if key not in value:
            yield f"{where}.{key} is missing"
    others = schema.get("additionalProperties", True)
    for key, member in value.items():
        each = schema.get("properties", {}).get(key, others)
        if each is False:
            yield f"{where}.{key} is unknown"
        elif each is not True:
            yield from faults(member, each, f"{where}.{key}")


class Json(CommandTest):
    def check(self, *words, status=0, kind=None):
        """The same value in a file and at standard output, as the schema says."""
        self.run_command(*words, "--json", "result.json", "-q", status=status)
        value = self.read_json("result.json")
        schema = {"$ref": f"#/$defs/{kind}"} if kind else SCHEMA
        self.assertEqual(list(faults(value, schema)), [], " ".join(words))
        if not isinstance(value, list):
            self.assertEqual((value["lightsheaf"], value["command"]), (self.version(), words[0]))
        again = json.loads(self.run_command(*words, "--json", "-", "-q", status=status).stdout)
        self.assertEqual(type(again), type(value))
        self.assertEqual(list(again), list(value) if isinstance(value, dict) else again)
        return value

    def version(self):
        return self.run_command("--version").stdout.decode().split()[-1]

    def test_render_and_info(self):
        self.scene(animated=True)
        self.check("render", "scene.gltf", "-o", "a.exr", *SMALL, kind="render")
        self.check("render", "scene.gltf", "-o", "b.exr", *SMALL, "-t", "direct", "--aov", "all", "--camera", "0",
                   "--environment", "1,2,3", "--background", "1,0,0", "--fov-y", "30", kind="render")
        self.check("render", "scene.gltf", "-o", "c.png", "--time-limit", "0.1", "-r", "8,6", "--exposure", "auto",
                   "--background", "transparent", "-D", "shadow.filter=pcf", kind="render")
        self.check("render", "scene.gltf", "-o", "d%d.png", *SMALL, "--frames", "0-1")
        self.check("info", "scene.gltf", kind="scene")
        self.check("info", "a.exr", kind="picture")
        self.check("info", "a.exr", "c.png", "scene.gltf")

    def test_several_of_which_one_fails(self):
        self.scene("a.gltf")
        with open(self.path("bad.gltf"), "wb") as file:
            file.write(b"{}")
        for words in (("render", "-o", "%s.png", *SMALL), ("plan",), ("info",)):
            value = self.check(words[0], "a.gltf", "bad.gltf", *words[1:], status=FILE)
            self.assertEqual([list(each)[-1] == "error" for each in value], [False, True])

    @unittest.skipUnless(os.environ["LSF_MODULES"], "built without the path tracer")
    def test_reference_compare_and_measure(self):
        self.scene()
        self.check("reference", "scene.gltf", "-o", "r.exr", "--halves", *SMALL, kind="reference")
        self.check("reference", "scene.gltf", "-o", "r.png", *SMALL, kind="reference")
        self.check("compare", "r.exr", "r_a.exr", "r_b.exr", "--flip", kind="compare")
        self.check("compare", "r_a.exr", "r_b.exr", "--threshold", "rmse=0", "--mask", "r.exr", status=DIFFERS,
                   kind="compare")
        small = ("-r", "8,6", "--reference-samples", "1", "--cache", "none", "--seeds", "2")
        self.check("measure", "scene.gltf", "-t", "direct", "-s", "4", *small, "--prices", kind="measure")
        self.check("measure", "scene.gltf", "-t", "direct", "-s", "2", *small, "--budget-ms", "100",
                   "--turntable", "8", "--frames", "0-1", "--pictures", "pictures", kind="measure")

    def test_plan(self):
        self.scene(emissive=True)
        for technique in ("direct", "bidirectional", "voxel_path", "cone", "substitute_tree"):
            self.check("plan", "scene.gltf", "-t", technique, kind="plan")
        self.check("plan", "scene.gltf", "--time-limit", "1", kind="plan")
        self.check("plan", "scene.gltf", "--prices", kind="prices")
        with open(self.path("a.frag"), "w", encoding="utf-8") as file:
            file.write("void mainImage(out vec4 c, in vec2 p) { c = vec4(lsf_depth(p)); }")
        self.check("plan", "--sandbox", "a.frag", "scene.gltf", "--prices", kind="prices")

    @unittest.skipUnless(os.environ["LSF_MODULES"], "built without the path tracer")
    def test_bench(self):
        self.scene()
        for words in (("rays", "scene.gltf", "-r", "16,12", "-s", "1"),
                      ("bidirectional", "scene.gltf", "-r", "16,12", "-s", "1", "-D", "tessellation.factor=1",
                       "-D", "vpl.count=4", "-D", "interleave.size=2", "-D", "bundle.count=4"),
                      ("cone", "scene.gltf", "-r", "16,12", "-s", "1", "-D", "voxel.resolution=8"),
                      ("voxel_path", "scene.gltf", "-r", "16,12", "-s", "1", "-D", "voxel.resolution=8")):
            self.check("bench", *words, kind="bench")

    def test_the_check_finds_faults(self):
        """And the schema uses no word that it does not know."""
        self.scene()
        value = self.check("plan", "scene.gltf", kind="plan")
        schema = {"$ref": "#/$defs/plan"}
        for wrong in ({**value, "more": 1}, {**value, "bytes": "1"}, {**value, "resolution": [1]},
                      {**value, "passes": [{}]}, {key: value[key] for key in value if key != "notes"}):
            self.assertTrue(list(faults(wrong, schema)))
        unknown = set()

        def walk(part):
            unknown.update(set(part) - KEYWORDS)
            for name in ("properties", "$defs"):
                for each in part.get(name, {}).values():
                    walk(each)
            for each in [part.get("items"), part.get("additionalProperties"), *part.get("anyOf", ())]:
                if isinstance(each, dict):
                    walk(each)

        walk(SCHEMA)
        self.assertEqual(unknown, set())


if __name__ == "__main__":
    main()
