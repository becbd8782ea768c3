// Checked request fields.
#include "host/api/fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "host/api/request_error.hpp"
#include "host/json/json.hpp"

namespace liana {
namespace {

std::string code_of(const std::function<void()>& read) {
  try {
    read();
  } catch (const RequestError& error) {
    EXPECT_NE(std::string(error.what()), "");
    return error.code();
  }
  return "accepted";
}

TEST(Fields, NumbersOutsideTheirRangeAreNamed) {
  const Json object{{"a", 1.5}, {"b", "text"}, {"c", nullptr}};
  EXPECT_EQ(code_of([&] { number_field(object, "a", 0, 2); }), "accepted");
  EXPECT_EQ(code_of([&] { number_field(object, "a", 0, 1); }), "out_of_range");
  EXPECT_EQ(code_of([&] { number_field(object, "b", 0, 1); }), "bad_request");
  EXPECT_EQ(code_of([&] { number_field(object, "c", 0, 1); }), "bad_request");
  EXPECT_EQ(code_of([&] { number_field(object, "missing", 0, 1); }), "bad_request");
}

TEST(Fields, NotANumberAndInfinityNeverPass) {
  const Json object{{"nan", std::nan("")}, {"inf", HUGE_VAL}};
  EXPECT_EQ(code_of([&] { number_field(object, "nan", -1e300, 1e300); }), "out_of_range");
  EXPECT_EQ(code_of([&] { number_field(object, "inf", -1e300, 1e300); }), "out_of_range");
}

TEST(Fields, APoseNeedsAUnitQuaternionWithinReach) {
  const auto pose = [](Json list) { return code_of([&] { pose_field({{"p", list}}, "p", 4.0); }); };
  EXPECT_EQ(pose({1, 0, 0, 1, 0, 0, 0}), "accepted");
  EXPECT_EQ(pose({1, 0, 0, 0.9, 0, 0, 0}), "out_of_range");
  EXPECT_EQ(pose({1, 0, 0, 1 + 2e-6, 0, 0, 0}), "out_of_range");
  EXPECT_EQ(pose({3, 3, 3, 1, 0, 0, 0}), "out_of_range") << "beyond reach though each coordinate is within";
  EXPECT_EQ(pose({1, 0, 0, 1, 0, 0}), "bad_request");
  EXPECT_EQ(pose("here"), "bad_request");
}

TEST(Fields, ARefusedEntryOfAListIsNamedWithItsNumberAndTheUnit) {
  const Json object{{"held", {{{"target_deg", 1}}, {{"target_deg", 30}}}}};
  const auto read = [](std::size_t, const Json& entry) { number_field(entry, "target_deg", -20, 20); };
  try {
    read_entries(object, "held", 10, read);
    FAIL() << "accepted";
  } catch (const RequestError& error) {
    EXPECT_EQ(error.code(), "out_of_range");
    EXPECT_STREQ(error.what(), "entry 2 of held: target_deg = 30.0: allowed -20.0 to 20.0 deg");
  }
}

}  // namespace
}  // namespace liana
