// Mutation tests of the gate's comparisons: the tables below are judged by whether they tell the comparison from
// plausible wrong ones.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "firmware_like/safety/gate.hpp"
#include "tests/firmware_like/extremes.hpp"

namespace liana::cable {
namespace {

struct RangeCase {
  double value;
  bool outside;  // of [-2, 3]
};
const std::vector<RangeCase> kRangeCases{
    {0.0, false},
    {3.0, false},
    {-2.0, false},
    {std::nextafter(3.0, kInf), true},
    {std::nextafter(-2.0, -kInf), true},
    {kNan, true},
    {kInf, true},
    {-kInf, true},
    {2.5, false},
    {kDenormal, false},
};
using RangeCheck = bool (*)(double, double, double);
struct RangeMutant {
  const char* name;
  RangeCheck check;
};
const std::vector<RangeMutant> kRangeMutants{
    {"NaN passes", [](double v, double low, double high) { return v < low || v > high; }},
    {"upper bound exclusive", [](double v, double low, double high) { return !(v >= low && v < high); }},
    {"lower bound exclusive", [](double v, double low, double high) { return !(v > low && v <= high); }},
    {"upper bound forgotten", [](double v, double low, double) { return !(v >= low); }},
    {"lower bound forgotten", [](double v, double, double high) { return !(v <= high); }},
    {"or instead of and", [](double v, double low, double high) { return !(v >= low || v <= high); }},
    {"bounds swapped", [](double v, double low, double high) { return !(v >= high && v <= low); }},
    {"symmetric about zero", [](double v, double, double high) { return !(std::fabs(v) <= high); }},
    {"negated", [](double v, double low, double high) { return v >= low && v <= high; }},
    {"with tolerance", [](double v, double low, double high) { return !(v >= low - 1e-9 && v <= high + 1e-9); }},
    {"never", [](double, double, double) { return false; }},
    {"always", [](double, double, double) { return true; }},
};

bool agrees(RangeCheck check) {
  for (const RangeCase& one : kRangeCases) {
    if (check(one.value, -2.0, 3.0) != one.outside) return false;
  }
  return true;
}

TEST(GateMutation, TheRangeCheckFitsItsTableAndNoWrongVariantDoes) {
  EXPECT_TRUE(agrees(gate_compare::is_outside));
  for (const RangeMutant& mutant : kRangeMutants) EXPECT_FALSE(agrees(mutant.check)) << mutant.name;
}

struct StepCase {
  std::int32_t previous;
  std::int32_t next;
  std::int64_t limit;
  bool too_large;
};
const std::vector<StepCase> kStepCases{
    {0, 0, 0, false},
    {0, 50, 50, false},
    {0, -50, 50, false},
    {0, 51, 50, true},
    {0, -51, 50, true},
    {1000, 1050, 50, false},
    {1000, 949, 50, true},
    {-1000, -949, 50, true},
    {kIntMin, kIntMax, 50, true},
    {kIntMax, kIntMin, 50, true},
    {kIntMin, kIntMin + 1, 50, false},
    {kIntMin, kIntMax, 4294967295, false},
    {kIntMin, kIntMax, 4294967294, true},
};
using StepCheck = bool (*)(std::int32_t, std::int32_t, std::int64_t);
struct StepMutant {
  const char* name;
  StepCheck check;
};
std::int64_t step_of(std::int32_t previous, std::int32_t next) { return static_cast<std::int64_t>(next) - previous; }
const std::vector<StepMutant> kStepMutants{
    {"limit exclusive",
     [](std::int32_t p, std::int32_t n, std::int64_t l) { return step_of(p, n) >= l || step_of(p, n) <= -l; }},
    {"upper limit exclusive",
     [](std::int32_t p, std::int32_t n, std::int64_t l) { return step_of(p, n) >= l || step_of(p, n) < -l; }},
    {"lower limit exclusive",
     [](std::int32_t p, std::int32_t n, std::int64_t l) { return step_of(p, n) > l || step_of(p, n) <= -l; }},
    {"only growing steps", [](std::int32_t p, std::int32_t n, std::int64_t l) { return step_of(p, n) > l; }},
    {"only shrinking steps", [](std::int32_t p, std::int32_t n, std::int64_t l) { return step_of(p, n) < -l; }},
    {"and instead of or",
     [](std::int32_t p, std::int32_t n, std::int64_t l) { return step_of(p, n) > l && step_of(p, n) < -l; }},
    {"one count too generous",
     [](std::int32_t p, std::int32_t n, std::int64_t l) { return step_of(p, n) > l + 1 || step_of(p, n) < -l - 1; }},
    {"previous forgotten", [](std::int32_t, std::int32_t n, std::int64_t l) { return n > l || n < -l; }},
    {"sum instead of difference",
     [](std::int32_t p, std::int32_t n, std::int64_t l) {
       return step_of(-(p / 2) - p / 2, n) > l || step_of(-(p / 2) - p / 2, n) < -l;
     }},
    {"wraps at 32 bits",
     [](std::int32_t p, std::int32_t n, std::int64_t l) {
       const auto step = static_cast<std::int32_t>(static_cast<std::uint32_t>(n) - static_cast<std::uint32_t>(p));
       return step > l || step < -l;
     }},
    {"negated",
     [](std::int32_t p, std::int32_t n, std::int64_t l) { return !(step_of(p, n) > l || step_of(p, n) < -l); }},
    {"never", [](std::int32_t, std::int32_t, std::int64_t) { return false; }},
};

bool agrees(StepCheck check) {
  for (const StepCase& one : kStepCases) {
    if (check(one.previous, one.next, one.limit) != one.too_large) return false;
  }
  return true;
}

TEST(GateMutation, TheStepCheckFitsItsTableAndNoWrongVariantDoes) {
  EXPECT_TRUE(agrees(gate_compare::is_step_too_large));
  for (const StepMutant& mutant : kStepMutants) EXPECT_FALSE(agrees(mutant.check)) << mutant.name;
}

struct FiniteCase {
  double value;
  bool bad;
};
const std::vector<FiniteCase> kFiniteCases{
    {0.0, false},      {-0.0, false}, {kDenormal, false}, {1.7e308, false},
    {-1.7e308, false}, {kNan, true},  {kInf, true},       {-kInf, true},
};
using FiniteCheck = bool (*)(double);
struct FiniteMutant {
  const char* name;
  FiniteCheck check;
};
const std::vector<FiniteMutant> kFiniteMutants{
    {"NaN only", [](double v) { return v != v; }},
    {"positive infinity only", [](double v) { return v != v || v == kInf; }},
    {"infinities only", [](double v) { return std::fabs(v) == kInf; }},
    {"denormals too", [](double v) { return !std::isnormal(v); }},
    {"large numbers too", [](double v) { return !(std::fabs(v) < 1e300); }},
    {"negated", [](double v) { return v - v == 0.0; }},
    {"never", [](double) { return false; }},
};

bool agrees(FiniteCheck check) {
  for (const FiniteCase& one : kFiniteCases) {
    if (check(one.value) != one.bad) return false;
  }
  return true;
}

TEST(GateMutation, TheFinitenessCheckFitsItsTableAndNoWrongVariantDoes) {
  EXPECT_TRUE(agrees(gate_compare::is_not_finite));
  for (const FiniteMutant& mutant : kFiniteMutants) EXPECT_FALSE(agrees(mutant.check)) << mutant.name;
}

}  // namespace
}  // namespace liana::cable
