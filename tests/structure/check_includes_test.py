"""That check_includes.py finds what it has to find: each case plants one thing in a small tree."""

import pathlib
import tempfile
import unittest

import check_includes

TABLE = """
[includes]
firmware_like/math:
firmware_like/arm: firmware_like/math
host/planning/planner: firmware_like/arm
host/base/clock:
[against the order]
firmware_like/math/old.hpp: firmware_like/arm/arm.hpp
[libraries]
coin/: host/planning/planner
[clocks]
host/base/clock
"""
TREE = {
    "firmware_like/math/pose.hpp": "#pragma once\n",
    "firmware_like/math/old.hpp": '#include "firmware_like/arm/arm.hpp"\n',
    "firmware_like/arm/arm.hpp": '#include <array>\n#include "firmware_like/math/pose.hpp"\n',
    "host/planning/planner/plan.cpp": '#include "firmware_like/arm/arm.hpp"\n#include <coin/IpTNLP.hpp>\n',
    "host/base/clock/time.cpp": "auto now() { return std::chrono::steady_clock::now(); }\n",
}


def problems(planted=None, table=TABLE):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**TREE, **(planted or {})}.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return list(check_includes.problems(pathlib.Path(folder), table))


class CheckIncludes(unittest.TestCase):
    def test_a_tree_that_keeps_its_table_has_no_problems(self):
        self.assertEqual(problems(), [])

    def test_an_include_of_host_by_the_core_is_found_with_its_line_and_what_is_allowed(self):
        planted = {"firmware_like/arm/tip.cpp": '#include <array>\n\n#include "host/planning/planner/plan.hpp"\n'}
        allowed = "firmware_like/arm may include firmware_like/arm firmware_like/math"
        expected = f'firmware_like/arm/tip.cpp:3: includes "host/planning/planner/plan.hpp": {allowed}'
        self.assertEqual(problems(planted), [expected])

    def test_an_include_up_the_order_is_found_in_another_file_than_the_excepted_one(self):
        planted = {"firmware_like/math/new.hpp": '#  include "firmware_like/arm/arm.hpp"\n'}
        self.assertIn("firmware_like/math/new.hpp:1: includes", problems(planted)[0])

    def test_an_include_beside_the_file_stays_in_its_room_and_one_upwards_does_not(self):
        inside = {"host/planning/planner/a.cpp": '#include "b.hpp"\n', "host/planning/planner/b.hpp": "\n"}
        self.assertEqual(problems(inside), [])
        upwards = {"firmware_like/math/new.cpp": '#include "../arm/arm.hpp"\n'}
        self.assertIn("firmware_like/math/new.cpp:1: includes", problems(upwards)[0])

    def test_a_library_outside_its_room_is_found(self):
        planted = {"firmware_like/arm/solve.cpp": "#include <coin/IpTNLP.hpp>\n"}
        self.assertEqual(
            problems(planted),
            ["firmware_like/arm/solve.cpp:1: includes <coin/IpTNLP.hpp>: allowed in host/planning/planner"],
        )

    def test_a_header_of_ours_that_few_may_include_is_held_too(self):
        table = TABLE.replace(
            "coin/: host/planning/planner\n",
            "coin/: host/planning/planner\nfirmware_like/math/key.hpp: host/planning/planner\n",
        )
        planted = {"firmware_like/arm/maker.cpp": '#include "firmware_like/math/key.hpp"\n'}
        expected = (
            'firmware_like/arm/maker.cpp:1: includes "firmware_like/math/key.hpp": allowed in host/planning/planner'
        )
        self.assertIn(expected, problems(planted, table))

    def test_a_clock_outside_its_room_is_found_and_one_in_a_comment_is_not(self):
        planted = {"host/planning/planner/slow.cpp": "// steady_clock\nclock_gettime(CLOCK_MONOTONIC, &now);\n"}
        self.assertEqual(len(problems(planted)), 1)
        self.assertIn("host/planning/planner/slow.cpp:2: reads a clock (clock_gettime)", problems(planted)[0])

    def test_a_folder_without_a_row_is_found(self):
        self.assertEqual(problems({"hil/arm/arm.cpp": "\n"}), ["rooms.ini: [includes] has no row for hil/arm"])

    def test_a_table_that_goes_in_a_circle_is_found(self):
        table = TABLE.replace("firmware_like/math:\n", "firmware_like/math: firmware_like/arm\n")
        found = problems({"firmware_like/math/new.hpp": '#include "firmware_like/arm/arm.hpp"\n'}, table)
        self.assertIn("does not stand above it", found[0])

    def test_a_permission_that_nobody_uses_is_found(self):
        found = problems(table=TABLE.replace("host/planning/planner: ", "host/planning/planner: firmware_like/math "))
        self.assertEqual(
            found, ["rooms.ini: [includes] host/planning/planner: firmware_like/math: nobody does it; take it out"]
        )

    def test_folders_of_a_room_that_go_in_a_circle_are_found(self):
        planted = {
            "host/planning/planner/start/a.hpp": '#include "../check/b.hpp"\n',
            "host/planning/planner/check/b.hpp": '#include "host/planning/planner/start/a.hpp"\n',
        }
        folders = "host/planning/planner/check", "host/planning/planner/start"
        self.assertEqual(
            problems(planted), [f"{folder}: its includes lead back to it, within its room" for folder in folders]
        )

    def test_a_word_allows_a_folder_and_all_below_it(self):
        table = TABLE.replace("host/planning/planner: firmware_like/arm", "host/planning/planner: firmware_like")
        planted = {"host/planning/planner/pose.cpp": '#include "firmware_like/math/pose.hpp"\n'}
        self.assertEqual(problems(planted, table), [])


if __name__ == "__main__":
    unittest.main()
