#!/usr/bin/env python3
"""A type name that is planted twice is found; what looks like one is not."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import check_types  # noqa: E402


def twice(core, host):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in (("firmware_like", core), ("host", host)):
            (root / name).mkdir()
            (root / name / "a.hpp").write_text(text)
        return list(check_types.defined_twice(root))


class TypesDefinedTwice(unittest.TestCase):
    def test_a_planted_one_is_found(self):
        found = twice(
            "namespace liana {\nstruct Twin {\n  int a;\n};\n}", "namespace liana {\nclass Twin final : Base {};\n}"
        )
        self.assertEqual(found, ["liana::Twin"])

    def test_an_enum_after_a_nested_namespace_is_found(self):
        found = twice(
            "namespace liana::bus { struct A { void f() {} }; enum class Mode : int { kOn }; }",
            "namespace liana { namespace bus { enum Mode { kOff }; } }",
        )
        self.assertEqual(found, ["liana::bus::Mode"])

    def test_rooms_may_share_a_name(self):
        self.assertEqual(
            twice("namespace liana::bus { struct Role {}; }", "namespace liana::api { struct Role {}; }"), []
        )

    def test_what_one_file_keeps_to_itself_may_share_a_name(self):
        own = "namespace liana { namespace { struct Row { int a; }; } void f() { struct Local {}; } }"
        self.assertEqual(twice(own, own), [])

    def test_declarations_and_comments_define_nothing(self):
        self.assertEqual(
            twice("struct A;\n// struct A {\nstruct A {};", 'class A;\nconst char* text = "struct A {";'), []
        )


if __name__ == "__main__":
    unittest.main()
