"""That check_type_names.py finds what it has to find."""

import pathlib
import tempfile
import unittest

import check_type_names


def problems(files, known=()):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return list(check_type_names.problems(pathlib.Path(folder), set(known)))


def in_liana(text):
    return f"namespace liana {{\n{text}\n}}\n"


class CheckTypeNames(unittest.TestCase):
    def test_a_type_defined_in_two_rooms_is_found_until_it_is_known(self):
        files = {
            "host/planning/planner/a.hpp": in_liana("struct Range { double low; };"),
            "host/base/svg/b.hpp": in_liana("class Range final : Base {};"),
        }
        self.assertIn(
            "host/base/svg/b.hpp: liana::Range is also defined in host/planning/planner/a.hpp", problems(files)[0]
        )
        self.assertEqual(problems(files, ["liana::Range"]), [])

    def test_an_enum_and_a_struct_of_one_name_are_found(self):
        files = {
            "host/control/server/a.hpp": in_liana("enum class Refusal : int { kNone };"),
            "host/planning/planner/b.hpp": in_liana("struct Refusal {};"),
        }
        self.assertEqual(len(problems(files)), 1)

    def test_namespaces_of_rooms_keep_equal_names_apart(self):
        files = {
            "host/planning/planner/a.hpp": "namespace liana::planner { struct Range {}; }",
            "host/base/svg/b.hpp": in_liana("struct Range {};"),
        }
        self.assertEqual(problems(files), [])

    def test_types_of_one_file_alone_and_inside_others_are_not_counted(self):
        text = in_liana(
            'namespace { struct Row {}; }\nvoid f() { struct Row {}; }\n// struct Row {\nauto t = "struct Row {";'
        )
        self.assertEqual(problems({"host/a/a.cpp": text, "host/b/b.cpp": text}), [])
        files = {
            "host/a/a.hpp": in_liana("class One { struct Row {}; };"),
            "host/b/b.hpp": in_liana("class Two { struct Row {}; };"),
        }
        self.assertEqual(problems(files), [])

    def test_a_declaration_and_a_nested_definition_outside_do_not_count(self):
        files = {
            "host/a/a.hpp": in_liana("class Api { class Peer; };"),
            "host/a/a.cpp": in_liana("class Api;\nstruct Api::Peer { int x; };"),
        }
        self.assertEqual(problems(files), [])

    def test_a_known_name_that_is_defined_once_is_found(self):
        self.assertIn("take it out of KNOWN", problems({"host/a/a.hpp": in_liana("struct Row {};")}, ["liana::Row"])[0])


if __name__ == "__main__":
    unittest.main()
