"""What the rules make of a function, and that one build behaves as the bug that is switched on."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import mutants

SOURCE = """\
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
namespace {
constexpr int kMost = 3;
constexpr std::array<double, 4> kTable{1.0, -2.0, 3.0, -4.0};
double sum = 0.0;
bool is_far(double value, bool counts) { return std::fabs(value) > 2.0 && counts; }
void add(int count) {
  for (int i = 0; i < std::min(count, kMost); ++i) {
    if (is_far(kTable[static_cast<std::size_t>(i)], true)) sum += -kTable[static_cast<std::size_t>(i)];
  }
}
}  // namespace
int main() {
  add(4);
  std::printf("%g\\n", sum);
}
"""
MUST_BE_THERE = {
    ("comparison", "std::fabs(value) >= 2.0"): "-1",
    ("fabs", "value"): "-3",
    ("dropped condition", "bool(counts)"): "-2",
    ("last index", "(i) + 1 < std::min(count, kMost)"): "0",
    ("size of a limit", "kMost - 1"): "0",
    ("size of a limit", "kMost + 1"): "1",
    ("sign", "kTable[static_cast<std::size_t>(i)]"): "3",
    ("dropped statement", ""): None,  # which of three, is looked at below
    ("index", "0"): "-1",  # the second of two
    ("dropped bound", "count"): "1",
    ("off by one", "0 + 1"): "-3",
}


class Rules(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.root = pathlib.Path(cls.folder)
        (cls.root / "sum.cpp").write_text(SOURCE)
        cls.mutants = mutants.all_mutants(cls.root, ["sum.cpp"], ["-std=c++20"])
        (cls.root / "lm.hpp").write_text(mutants.header(len(cls.mutants)))
        (cls.root / "sum.cpp").write_bytes(mutants.rewritten(cls.root, cls.mutants)["sum.cpp"])
        call = ["g++", "-std=c++20", "-w", "-include", "lm.hpp", "sum.cpp", "-o", "sum"]
        subprocess.run(call, cwd=cls.root, check=True)

    def said(self, number, **more):
        environment = {**os.environ, mutants.SWITCH: str(number), **more}
        done = subprocess.run([self.root / "sum"], env=environment, capture_output=True, text=True, check=True)
        return done.stdout.strip()

    def test_without_one_the_program_is_what_it_was(self):
        self.assertEqual(self.said(0), "-3")

    def test_each_rule_finds_its_place_and_the_switch_turns_the_bug_on(self):
        made = {(mutant.kind, mutant.becomes): number for number, mutant in enumerate(self.mutants, 1)}
        for (kind, becomes), said in MUST_BE_THERE.items():
            with self.subTest(kind=kind, becomes=becomes):
                self.assertIn((kind, becomes), made)
                if said is not None:
                    self.assertEqual(self.said(made[kind, becomes]), said)

    def test_a_dropped_statement_is_one_whose_value_nobody_uses(self):
        dropped = {mutant.was.split("(")[0].split(" ")[0] for mutant in self.mutants if not mutant.becomes}
        self.assertEqual(dropped, {"sum", "add", "std::printf"})

    def test_what_was_reached_is_told(self):
        file = self.root / "reached"
        self.said(0, **{mutants.REACHED: str(file)})
        self.assertEqual(set(file.read_bytes()[1:]), {1})


if __name__ == "__main__":
    unittest.main()
