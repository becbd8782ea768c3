#include "hil/drive/data_sheet.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "hil/drive/object_names.hpp"
#include "tests/message.hpp"

namespace liana::bench {
namespace {

DriveSettings shipped() {
  DriveSettings settings;
  settings.vendor = 0x4C49;
  settings.product = settings.revision = 1;
  return settings;
}

TEST(DataSheet, TheOneInTheTreeIsThatOfTheDrivesDictionary) {
  std::ostringstream file;
  file << std::ifstream(DATA_SHEET).rdbuf();
  EXPECT_EQ(file.str(), data_sheet(shipped())) << "make it anew: liana-bench --eds hil/drive/liana_bench_drive.eds";
}

// Two of one name could not be told apart by name.
TEST(DataSheet, EveryObjectHasANameOfItsOwn) {
  std::set<std::string> names;
  std::set<std::pair<std::uint16_t, std::string>> entries;
  std::uint16_t before = 0;
  const ObjectDictionary objects = make_objects(shipped());
  for (const Object& object : objects.all()) {
    const std::string name = name_of_index(object.index);
    EXPECT_EQ(name.find("Object "), std::string::npos) << name;
    if (object.index != before) {
      EXPECT_TRUE(names.insert(name).second) << name;
    }
    before = object.index;
    if (code_of(object.index) == ObjectCode::kVariable) continue;
    const std::string entry = name_of_entry(object.index, object.sub);
    EXPECT_EQ(entry.find("Entry "), std::string::npos) << name << ", " << entry;
    EXPECT_TRUE(entries.insert({object.index, entry}).second) << name << ", " << entry;
  }
  EXPECT_GT(names.size(), 45U);
}

TEST(DataSheet, WhatADriveOfAnotherTypeHasNotIsNotInIt) {
  DriveSettings settings = shipped();
  settings.dictionary.absent = {{0x6072, {}}, {0x608F, {}}};
  settings.dictionary.added = {{{0x3001, {}}, "i16", false, -7, -10, {}}};
  const std::string sheet = data_sheet(settings);
  EXPECT_EQ(sheet.find("[6072]"), std::string::npos);
  EXPECT_EQ(sheet.find("[608Fsub1]"), std::string::npos);
  EXPECT_NE(sheet.find("[ManufacturerObjects]\nSupportedObjects=1\n1=0x3001\n"), std::string::npos);
  EXPECT_NE(sheet.find("DataType=0x0003\nAccessType=rw\nDefaultValue=-7\nPDOMapping=0\nLowLimit=-10\n"),
            std::string::npos)
      << sheet.substr(sheet.find("[3001]"));
}

TEST(DataSheet, AnObjectThatADrivesDictionaryCannotChangeIsNamedWithTheDriveType) {
  const auto refusal = [](const DictionaryConfig& dictionary) -> std::string {
    DriveSettings settings = shipped();
    settings.dictionary = dictionary;
    settings.dictionary.drive_type = "made_up";
    try {
      make_objects(settings);
    } catch (const std::runtime_error& problem) {
      return problem.what();
    }
    return "accepted";
  };
  DictionaryConfig absent, twice, wide;
  absent.absent = {{0x60C6, {}}};
  twice.added = {{{0x6040, {}}, "u16", false, 0, {}, {}}};
  wide.added = {{{0x3001, 2}, "u64", false, 0, {}, {}}};
  EXPECT_TRUE(names(refusal(absent), {"made_up", "dictionary", "60C6", "added"}));
  EXPECT_TRUE(names(refusal(twice), {"made_up", "dictionary", "6040", "values", "read_only"}));
  EXPECT_TRUE(names(refusal(wide), {"made_up", "dictionary", "3001:2", "u64", "u8", "i8", "u16", "i16", "u32", "i32"}));
}

}  // namespace
}  // namespace liana::bench
