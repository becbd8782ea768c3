#include "hil/drive/data_sheet.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "hil/drive/object_names.hpp"

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

}  // namespace
}  // namespace liana::bench
