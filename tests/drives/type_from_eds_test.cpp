// Drive types from electronic data sheets: small ones of our own, in the manners of a dozen makers. Each type boots the
// bench's drive that its table describes, or says what the drive lacks.
#include "host/drives/commissioning/type_from_eds.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "hil/config/scene_config.hpp"
#include "host/apps/mission_runner/evaluate.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/drive_types_of_buses.hpp"
#include "tests/drives/drive_channel.hpp"
#include "tests/message.hpp"

namespace liana {
namespace {

using commissioning::Eds;
using commissioning::parse_eds;
using commissioning::type_from_eds;
using commissioning::TypeFromEds;

// One object of a sheet.
struct Row {
  std::string type, access = "rw", value, mapped = "0";
};
using Rows = std::map<std::pair<int, int>, Row>;  // by index and sub-index; sub-index -1: a plain [INDEX]

// A drive with all that csp needs.
Rows good() {
  Rows rows;
  const auto add = [&](int index, int sub, const char* type, const char* access, const char* value,
                       const char* mapped = "0") {
    rows[{index, sub}] = {type, access, value, mapped};
  };
  add(0x1000, -1, "0x0007", "ro", "0x00020192");
  add(0x1016, 1, "0x0007", "rw", "0");
  add(0x1017, -1, "0x0006", "rw", "0");
  add(0x1018, 1, "0x0007", "ro", "0x00000123");
  add(0x1018, 2, "0x0007", "ro", "17");
  add(0x1018, 3, "0x0007", "ro", "0x00010002");
  for (int page : {0x1400, 0x1800}) {
    add(page, 1, "0x0007", "rw", page == 0x1400 ? "$NODEID+0x200" : "$NODEID+0x180");
    add(page, 2, "0x0005", "rw", "255");
    add(page + 0x200, 0, "0x0005", "rw", "0");
    for (int sub = 1; sub <= 4; ++sub) add(page + 0x200, sub, "0x0007", "rw", "0");
  }
  add(0x6040, -1, "0x0006", "rww", "0", "1");
  add(0x6041, -1, "0x0006", "ro", "0", "1");
  add(0x6060, -1, "0x0002", "rw", "1");
  add(0x6061, -1, "0x0002", "ro", "1", "1");
  add(0x6064, -1, "0x0004", "ro", "0", "1");
  add(0x6065, -1, "0x0007", "rw", "1000");
  add(0x6077, -1, "0x0003", "ro", "0", "1");
  add(0x607A, -1, "0x0004", "rw", "0", "1");
  add(0x6085, -1, "0x0007", "rw", "1000000");
  add(0x608F, 1, "0x0007", "ro", "65536");
  add(0x608F, 2, "0x0007", "ro", "1");
  add(0x60C2, 1, "0x0005", "rw", "2");
  add(0x60C2, 2, "0x0002", "rw", "-3");
  add(0x6502, -1, "0x0007", "ro", "0x3AD");
  return rows;
}

std::string hex4(int index) {
  char text[8];
  std::snprintf(text, sizeof text, "%04X", index);
  return text;
}

std::string text_of(const Rows& rows, const std::string& end = "\n", const std::string& head = "") {
  std::string out = "[FileInfo]" + end + "FileVersion=3" + end + "FileRevision=1" + end + "[DeviceInfo]" + end +
                    "VendorName=Somebody" + end + "ProductName=Small Drive 40" + end + head;
  for (const auto& [place, row] : rows) {
    const auto [index, sub] = place;
    out += "[" + hex4(index) + (sub < 0 ? "" : "sub" + std::to_string(sub)) + "]" + end + "ParameterName=x" + end +
           "ObjectType=0x7" + end + "DataType=" + row.type + end + "AccessType=" + row.access + end +
           "DefaultValue=" + row.value + end + "PDOMapping=" + row.mapped + end;
  }
  return out;
}

TypeFromEds made(const Rows& rows, bool is_cst = false) {
  return type_from_eds(parse_eds(text_of(rows), "small.eds"), is_cst, "small.eds");
}

bool tells(const std::vector<std::string>& lines, const Facts& facts) {
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) { return names(line, facts); });
}

std::string all_of(const TypeFromEds& type) {
  std::string text;
  for (const std::string& each : type.missing) text += "missing: " + each + "\n";
  for (const std::string& each : type.notes) text += "note: " + each + "\n";
  return text + type.table;
}

// The bus table whose node 1 is of this type, as a run evaluates it.
std::string bus_table(const TypeFromEds& type) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("liana-eds-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder / "drives");
  std::ofstream(folder / "drives" / (type.name + ".lua")) << type.table;
  const std::string file = folder / "bus.lua";
  std::ofstream(file) << "local t = require 'buses.embedded_micro'\nt.drives = { { type = '" << type.name
                      << "', nodes = { 1 } } }\nreturn t\n";
  mission_runner::Activity activity;
  const mission_runner::LuaFolders folders(std::vector<std::string>{folder.string(), LIANA_LUA_DIR});
  mission_runner::Script script(mission_runner::ScriptLimits{}, folders, activity);
  const std::string json = mission_runner::evaluate(script, folders, "buses", file);
  std::filesystem::remove_all(folder);
  return json;
}

// The type's boot of the bench's drive that the table describes.
void expect_boots(const TypeFromEds& type) {
  ASSERT_TRUE(type.missing.empty()) << all_of(type);
  const std::string buses = bus_table(type);
  canopen::ExpectedDrive drive = test::expectation();
  drive.type = config::drive_types(config::parse_buses(buses, "b")).at(1);
  const std::string file = std::filesystem::temp_directory_path() / ("liana-eds-buses-" + std::to_string(::getpid()));
  std::ofstream(file) << buses;
  bench::DriveSettings settings;
  settings.dictionary = bench::load_buses(file).dictionary_of(1);
  std::filesystem::remove(file);
  settings.vendor = settings.dictionary.vendor.value_or(0x4C49);
  settings.product = settings.dictionary.product.value_or(1);
  settings.revision = settings.dictionary.revision.value_or(1);
  settings.serial = 1001;
  test::BootedDrive bench(drive, settings);
  bench.run_boot();
  EXPECT_EQ(bench.boot.state(), canopen::BootState::kOperational) << bench.refusals() << "\n" << all_of(type);
}

// The manners: each of these is the same drive.
TEST(EdsText, ManyMannersSayTheSame) {
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
      text.replace(at, from.size(), to);
    return text;
  };
  const std::string plain = text_of(good());
  std::string upper = plain;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  const std::map<std::string, std::string> manners = {
      {"CRLF", text_of(good(), "\r\n")},
      {"CR", text_of(good(), "\r")},
      {"a byte order mark", "\xEF\xBB\xBF" + plain},
      {"comments",
       "; made by a tool\r\n# and another\n" + replaced(plain, "AccessType=rw\n", "AccessType=rw\n; [6040]\n;x=1\n")},
      {"comments behind values", replaced(plain, "DefaultValue=255\n", "DefaultValue=255 ; event\n")},
      {"upper case", upper},
      {"blanks", replaced(replaced(plain, "=", " = "), "[60", "  [ 60")},
      {"the node id behind", replaced(plain, "$NODEID+0x200", "0x200+$nodeid")},
      {"decimal and octal", replaced(replaced(plain, "0x3AD", "941"), "DefaultValue=17\n", "DefaultValue=021\n")},
      {"signed as bits", replaced(plain, "DefaultValue=-3", "DefaultValue=0xFD")},
      {"Latin-1", replaced(plain, "ParameterName=x",
                           "ParameterName=Gr\xF6\xDF"
                           "e \xB0")},
      {"no end of line", plain.substr(0, plain.size() - 1)},
      {"a value of a configuration", replaced(plain, "DefaultValue=0x3AD", "DefaultValue=0\nParameterValue=0x3AD")},
      {"dummy objects",
       "[DummyUsage]\nDummy0001=0\nDummy0005=1\n[0005]\nParameterName=dummy\nDataType=5\n"
       "AccessType=rw\nPDOMapping=1\n" +
           plain}};
  const TypeFromEds expected = made(good());
  ASSERT_TRUE(expected.missing.empty()) << all_of(expected);
  for (const auto& [manner, text] : manners) {
    const Eds eds = parse_eds(text, "small.eds");
    EXPECT_TRUE(eds.remarks.empty()) << manner << ": " << (eds.remarks.empty() ? "" : eds.remarks[0]);
    const TypeFromEds type = type_from_eds(eds, false, "small.eds");
    EXPECT_TRUE(type.missing.empty()) << manner << all_of(type);
    std::string table = type.table;
    if (manner == "upper case") table = replaced(replaced(table, "SOMEBODY", "Somebody"), "SMALL DRIVE", "Small Drive");
    EXPECT_EQ(table, expected.table) << manner;
  }
}

TEST(EdsText, ASubObjectMayStandInOneSectionForAll) {
  Rows rows = good();
  for (int sub = 0; sub <= 4; ++sub) {
    rows.erase({0x1600, sub});
    rows.erase({0x1A00, sub});
  }
  rows.erase({0x608F, 1});
  rows.erase({0x608F, 2});
  const std::string head =
      "[1600]\nParameterName=mapping\nObjectType=9\nCompactSubObj=8\nDataType=7\nAccessType=rw\nDefaultValue=0\n"
      "[1600Value]\nNrOfEntries=1\n1=0x60400010\n"
      "[608F]\nParameterName=encoder\nObjectType=8\nDataType=7\nAccessType=ro\nCompactSubObj=2\nDefaultValue=1\n"
      "[608FValue]\nNrOfEntries=1\n1=65536\n";
  const Eds eds = parse_eds(text_of(rows, "\n", "NrOfRXPDO=1\nNrOfTXPDO=1\nCompactPDO=0x0E\n" + head), "c.eds");
  EXPECT_EQ(eds.find(0x1600, 1)->value, 0x60400010);
  EXPECT_EQ(eds.find(0x1600, 8)->value, 0);
  EXPECT_EQ(eds.find(0x608F, 1)->value, 65536);
  EXPECT_EQ(eds.find(0x608F, 2)->value, 1);
  EXPECT_EQ(eds.find(0x608F, 3), nullptr);
  ASSERT_NE(eds.find(0x1A00, 3), nullptr) << "CompactPDO";
  EXPECT_EQ(eds.find(0x1801, 1), nullptr);
}

TEST(EdsText, WhatIsNoSheetIsRefusedAndWhatMeansNothingIsTold) {
  for (const std::string& text :
       {std::string(), std::string("\0\0\0", 3), std::string("return {}"), std::string("[6040]\nDataType=6\n"),
        std::string("<?xml version=\"1.0\"?>"), std::string(5000, '[')})
    EXPECT_THROW(parse_eds(text, "odd.eds"), std::runtime_error);
  Rows rows = good();
  rows[{0x6065, -1}].value = "many";
  const Eds eds = parse_eds("nothing here\n" + text_of(rows), "odd.eds");
  EXPECT_TRUE(tells(eds.remarks, {"nothing here"}));
  EXPECT_TRUE(tells(eds.remarks, {"6065", "many"}));
  EXPECT_EQ(eds.find(0x6065, 0)->value, std::nullopt);
  for (const std::string value : {"0x", "--1", "1+", "99999999999999999999", "$NODEID+"}) {
    rows[{0x6065, -1}].value = value;
    EXPECT_EQ(parse_eds(text_of(rows), "odd.eds").find(0x6065, 0)->value.has_value(),
              value == "1+" || value == "$NODEID+")
        << value;
  }
}

TEST(TypeFromEds, AGoodDriveHasATypeThatBootsIt) {
  const TypeFromEds type = made(good());
  EXPECT_EQ(type.name, "small_drive_40");
  expect_boots(type);
  EXPECT_TRUE(tells(type.notes, {"6072"})) << all_of(type);
}

// What csp cannot do without, one at a time.
TEST(TypeFromEds, WhatCspNeedsAndTheDriveLacksIsNamed) {
  for (const int index : {0x6040, 0x6041, 0x6060, 0x6064, 0x607A, 0x6502, 0x1017}) {
    Rows rows = good();
    rows.erase({index, -1});
    const TypeFromEds type = made(rows);
    EXPECT_TRUE(tells(type.missing, {hex4(index)})) << hex4(index) << all_of(type);
    EXPECT_TRUE(type.table.empty());
  }
  const std::vector<std::pair<std::function<void(Rows&)>, Facts>> cases = {
      {[](Rows& rows) {
         rows[{0x6502, -1}].value = "0x2D";
       },
       {"6502", "csp"}},
      {[](Rows& rows) {
         rows[{0x6064, -1}].type = "0x0003";
       },
       {"6064", "16", "32"}},
      {[](Rows& rows) {
         rows[{0x60C2, 1}].type = "0x0006";
       },
       {"60C2:1", "16", "8"}},
      {[](Rows& rows) {
         rows[{0x6060, -1}].access = "const";
       },
       {"6060"}},
      {[](Rows& rows) {
         rows[{0x1800, 2}].access = "ro";
       },
       {"1800:2", "255"}},
      {[](Rows& rows) {
         rows.erase({0x1A00, 3});
       },
       {"1A00"}},
      {[](Rows& rows) {
         rows[{0x1600, 2}].access = "const";
       },
       {"1600", "0x607A0020"}},
      {[](Rows& rows) {
         rows[{0x60A8, -1}] = {"0x0007", "ro", "0xFF410000"};
       },
       {"60A8", "0xFF410000"}}};
  for (const auto& [change, facts] : cases) {
    Rows rows = good();
    change(rows);
    const TypeFromEds type = made(rows);
    EXPECT_TRUE(tells(type.missing, facts)) << facts[0] << "\n" << all_of(type);
  }
}

TEST(TypeFromEds, AFixedMappingThatIsRightIsTakenAsItIs) {
  Rows rows = good();
  const std::map<std::pair<int, int>, std::string> entries = {
      {{0x1600, 0}, "2"},          {{0x1600, 1}, "0x60400010"}, {{0x1600, 2}, "0x607A0020"}, {{0x1A00, 0}, "3"},
      {{0x1A00, 1}, "0x60410010"}, {{0x1A00, 2}, "0x60640020"}, {{0x1A00, 3}, "0x60770010"}};
  for (const auto& [place, value] : entries) rows[place] = {place.second == 0 ? "5" : "7", "const", value};
  const TypeFromEds type = made(rows);
  EXPECT_NE(type.table.find("mapping = \"fixed\""), std::string::npos) << all_of(type);
  expect_boots(type);
  rows[{0x1A00, 3}].value = "0x60780010";
  EXPECT_TRUE(tells(made(rows).missing, {"1A00", "0x60780010", "0x60770010"}));
}

TEST(TypeFromEds, UnitsLimitsAndConstantsAreTaken) {
  Rows rows = good();
  rows[{0x60A9, -1}] = {"0x0007", "ro", "0x00B44700"};
  rows[{0x607E, -1}] = {"0x0005", "rw", "0xC0"};
  rows[{0x607F, -1}] = {"0x0007", "rw", "5000"};
  rows[{0x6066, -1}] = {"0x0006", "const", "7"};
  rows[{0x60A8, -1}] = {"0x0007", "rw", "0xFF410000"};
  const TypeFromEds type = made(rows);
  for (const char* part : {"velocity = 0xB44700", "speeds = \"rpm\"", "polarity = 192", "[\"6066\"] = 7",
                           "vendor = 0x123", "product = 0x11"})
    EXPECT_NE(type.table.find(part), std::string::npos) << part << "\n" << all_of(type);
  EXPECT_EQ(type.table.find("revision ="), std::string::npos) << "firmware is the robot table's matter";
  rows[{0x607F, -1}].value = "6000";
  rows[{0x6085, -1}].value = "100000";
  rows[{0x607E, -1}].value = "0";
  expect_boots(made(rows));
  rows[{0x60A9, -1}].value = "0xFDB44700";  // thousandths of a turn a minute
  const TypeFromEds odd = made(rows);
  EXPECT_TRUE(tells(odd.notes, {"60A9", "0xFDB44700", "607F"})) << all_of(odd);
  EXPECT_NE(odd.table.find("\"6085\""), std::string::npos) << "left out";
}

TEST(TypeFromEds, WithoutTorqueTheTypeSaysSo) {
  Rows rows = good();
  rows.erase({0x6077, -1});
  const TypeFromEds type = made(rows);
  EXPECT_NE(type.table.find("torque = \"none\""), std::string::npos) << all_of(type);
  EXPECT_TRUE(tells(type.notes, {"6077"}));
  expect_boots(type);
}

TEST(TypeFromEds, WhatCstNeedsIsNamedAndTwoAxesAreTold) {
  Rows rows = good();
  rows[{0x6840, -1}] = {"0x0006", "rw", "0", "1"};
  const TypeFromEds type = made(rows, true);
  for (const char* object : {"6071", "60B1", "606C", "1A01"})
    EXPECT_TRUE(tells(type.missing, {object})) << object << all_of(type);
  EXPECT_TRUE(tells(made(rows).notes, {"6840"}));
}

}  // namespace
}  // namespace liana
