"""That check_namespaces.py finds what it has to find."""

import pathlib
import tempfile
import unittest

import check_namespaces

TABLE = "[namespaces]\nhost/base/clock: liana::timing  # time() is the C library's\n"
TIME = {"host/base/clock/clock.hpp": "namespace liana::timing { struct Clock {}; }"}


def problems(files, table=TABLE):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**TIME, **files}.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return list(check_namespaces.problems(pathlib.Path(folder), table))


class CheckNamespaces(unittest.TestCase):
    def test_what_a_room_declares_in_its_namespace_and_within_is_in_order(self):
        text = (
            "namespace liana::config {\nstruct Path {};\nnamespace rows { int count(); }\nnamespace { int own; }\n}\n"
        )
        self.assertEqual(problems({"host/model/config/a.hpp": text, "host/model/config/follow/b.hpp": text}), [])

    def test_types_functions_constants_and_aliases_flat_in_liana_are_found_with_their_line(self):
        for text in (
            "struct Path {\n};",
            "int count(const Path& path);",
            "double f() { return 1.0; }",
            "constexpr double kMargin_m = 0.02;",
            "using Path = std::vector<int>;",
            "template <class T>\nconcept Row = true;",
        ):
            found = problems({"host/model/config/a.hpp": "#pragma once\nnamespace liana {\n\n" + text + "\n}\n"})
            self.assertEqual(
                found,
                ["host/model/config/a.hpp:4: declares in liana; host/model/config declares in liana::config"],
                text,
            )

    def test_another_rooms_namespace_is_found_and_so_is_the_rooms_name_where_the_table_has_another(self):
        files = {
            "host/model/config/a.cpp": "namespace liana::workspace { int f() { return 0; } }",
            "host/base/clock/b.hpp": "namespace liana::clock { struct Tick {}; }",
        }
        self.assertEqual(len(problems(files)), 2)

    def test_a_namespace_whose_name_only_begins_alike_is_found(self):
        self.assertEqual(
            len(problems({"host/model/config/a.hpp": "namespace liana::configured { struct Path {}; }"})), 1
        )

    def test_another_rooms_type_may_be_named_before_it_is_defined_but_not_defined(self):
        self.assertEqual(
            problems({"host/model/config/a.hpp": "namespace liana::api { class Client; enum class Way : int; }"}), []
        )
        self.assertEqual(len(problems({"host/model/config/a.hpp": "namespace liana::api { class Client {}; }"})), 1)

    def test_outside_all_namespaces_stand_only_main_names_and_unnamed_namespaces(self):
        main = "namespace fs = std::filesystem;\nusing liana::config::Path;\nnamespace { struct Row {}; }\n"
        main += "int main(int argc, char** argv) try {\n  return 0;\n} catch (...) {\n  return 1;\n}\n"
        self.assertEqual(problems({"host/model/config/main.cpp": main}), [])
        found = problems({"host/model/config/a.hpp": "struct Path {};"})
        self.assertEqual(
            found, ["host/model/config/a.hpp:1: declares in no namespace; host/model/config declares in liana::config"]
        )

    def test_comments_texts_and_macros_declare_nothing(self):
        text = "// namespace liana { struct Row {}; }\n#define ROW \\\n  struct Row {};\n/* int f(); */\n"
        text += 'namespace { const char* k = R"x(}; int f();)x"; }\nextern "C" {\nvoid* malloc(size_t size);\n}\n'
        self.assertEqual(problems({"host/model/config/a.cpp": text}), [])

    def test_a_row_that_nobody_needs_is_found(self):
        unused = TABLE + "host/model/config: liana::config liana::wire\n"
        files = {"host/model/config/a.hpp": "namespace liana::config { struct Path {}; }"}
        self.assertEqual(len(problems(files, unused)), 1)
        self.assertIn("needs no row", problems(files, TABLE + "host/model/config: liana::config\n")[0])


if __name__ == "__main__":
    unittest.main()
