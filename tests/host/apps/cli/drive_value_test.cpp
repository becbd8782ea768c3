// Values of a drive's objects, as they come over the bus and as people write them.
#include "host/apps/cli/drive_value.hpp"

#include <gtest/gtest.h>

#include "host/apps/launcher/errors.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

commissioning::Answer answer_of(const std::string& bytes) {
  commissioning::Answer answer;
  answer.bytes.assign(bytes.begin(), bytes.end());
  return answer;
}

TEST(DriveValue, NumbersAreHexadecimalAndDecimalAndLongValuesTextOnlyWhereTheyAreOne) {
  using namespace std::string_literals;
  const std::pair<std::string, const char*> rows[] = {
      {"\xD2\x04\0\0"s, "0x000004D2  1234  (32 bits)"},
      {"\xFE"s, "0xFE  254  -2  (8 bits)"},
      {"\xFF\x7F"s, "0x7FFF  32767  (16 bits)"},
      {"Liana bench drive"s, "\"Liana bench drive\""},
      {"EPOS4\0\0\0"s, "\"EPOS4\""},
      {"ab\0cd"s, "bytes 61 62 00 63 64"},
      {"\x1B[2Jx"s, "bytes 1B 5B 32 4A 78"},
      {"\xFF\xFE\0\x01\x02"s, "bytes FF FE 00 01 02"},
  };
  for (const auto& [bytes, said] : rows) {
    EXPECT_EQ(value_text(answer_of(bytes)), said);
    const Json json = value_json(answer_of(bytes));
    EXPECT_EQ(json.at("bytes").size(), bytes.size());
    EXPECT_EQ(json.contains("unsigned"), bytes.size() <= 4);
    EXPECT_EQ(json.contains("text"), said[0] == '"');
    EXPECT_NO_THROW((void)json.dump()) << said;
  }
}

TEST(DriveValue, WhatIsWrittenFitsInItsBitsAndMayBeHexadecimal) {
  struct Row {
    const char* text;
    std::int64_t bits, value;
  };
  for (const Row& row : {Row{"0", 8, 0}, Row{"-128", 8, -128}, Row{"255", 8, 255}, Row{"0xff", 8, 255},
                         Row{"0X1F", 16, 31}, Row{"0xFFFFFFFF", 32, 4294967295}, Row{"-2147483648", 32, -2147483648}})
    EXPECT_EQ(value_of(row.text, row.bits), row.value) << row.text;
  for (const Row& row : {Row{"256", 8, 0}, Row{"-129", 8, 0}, Row{"0x100", 8, 0}, Row{"0x", 16, 0}, Row{"0x-1", 16, 0},
                         Row{"0x10000", 16, 0}, Row{"1e3", 32, 0}, Row{"0x1FFFFFFFF", 32, 0}, Row{"", 32, 0},
                         Row{"0xFFFFFFFFFFFFFFFFFF", 32, 0}, Row{"12 ", 32, 0}})
    EXPECT_THROW(value_of(row.text, row.bits), launcher::BadInput) << row.text;
}

}  // namespace
}  // namespace liana::cli
