#!/usr/bin/env python3
"""The table of scripts/shader_mutations.py fits the code, and its shaders compile. Builds nothing else."""
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import shader_mutations  # noqa: E402


class Table(unittest.TestCase):
    def test_every_change_can_be_made(self):
        for mutation in shader_mutations.MUTATIONS:
            with self.subTest(mutation.name):
                text = (ROOT / "src" / "gpu" / mutation.file).read_text()
                self.assertNotEqual(shader_mutations.mutated(mutation, text), text)

    def test_every_barrier_of_a_shader_is_left_out_once(self):
        for shader in (ROOT / "src" / "gpu" / "shaders").glob("*.comp"):
            places = {m.place for m in shader_mutations.MUTATIONS if m.file == f"shaders/{shader.name}" and m.old == "barrier();"}
            count = shader.read_text().count("barrier();")
            self.assertEqual(places, set(range(1, count + 1)), f"{shader.name} has {count} barriers")

    def test_names_differ(self):
        names = [mutation.name for mutation in shader_mutations.MUTATIONS]
        self.assertEqual(sorted(names), sorted(set(names)))


if __name__ == "__main__":
    unittest.main()
