#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "host/json/json.hpp"
#include "host/lua/bindings.hpp"
#include "tests/lua/program.hpp"

namespace liana {
namespace {

// Stub lines "function arm.NAME(fields) end" under "---@param fields { a: number, b?: string }", as "NAME a:number
// b?:string".
std::set<std::string> stubs() {
  std::istringstream in(read_file(LIANA_SOURCE_DIR "/lua/liana/arm_stubs.lua"));
  std::set<std::string> found;
  std::string fields;
  bool command = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("---@param fields {")) fields = line.substr(18, line.find('}') - 18);
    if (line.starts_with("---@return integer id")) command = true;
    if (!line.starts_with("function arm.")) continue;
    std::string plain;
    for (const char c : fields) plain += c == ',' ? std::string() : std::string(1, c);
    for (std::size_t at; (at = plain.find(": ")) != std::string::npos;) plain.erase(at + 1, 1);
    std::istringstream words(plain);
    std::string entry = line.substr(13, line.find('(') - 13);
    for (std::string word; words >> word;) entry += " " + word;
    if (command) found.insert(entry);
    fields.clear();
    command = false;
  }
  return found;
}

TEST(Stubs, DescribeExactlyTheRegisteredCommands) {
  std::set<std::string> registered;
  for (const Binding& binding : bindings()) {
    std::string entry = binding.name;
    for (const BindingField& field : binding.fields)
      entry += std::string(" ") + field.name + (field.required ? ":" : "?:") + field.type;
    registered.insert(entry);
  }
  EXPECT_EQ(stubs(), registered);
}

TEST(Bindings, PrintAsJsonForTools) {
  const Ended ended = run_program("bindings");
  ASSERT_EQ(ended.code, 0);
  EXPECT_EQ(Json::parse(ended.out).size(), bindings().size());
}

TEST(Bindings, EveryCommandIsOnTheApiPage) {
  const std::string page = read_file(LIANA_SOURCE_DIR "/docs/api.md");
  for (const Binding& binding : bindings()) {
    const std::string name = binding.name;
    const bool there =
        page.find("`" + name + "`") != std::string::npos || page.find("\"op\":\"" + name + "\"") != std::string::npos;
    EXPECT_TRUE(there) << name;
  }
}

TEST(Bindings, RefuseFieldsOfOtherTypesAndNames) {
  const auto refusal = [](const char* command, const char* fields) -> std::string {
    for (const Binding& binding : bindings()) {
      if (std::string(binding.name) != command) continue;
      try {
        check_fields(binding, Json::parse(fields));
      } catch (const std::runtime_error& error) {
        return error.what();
      }
    }
    return "";
  };
  EXPECT_EQ(refusal("move_jp", R"({"goal_deg":[0,1.5]})"), "");
  EXPECT_NE(refusal("move_jp", "{}").find("goal_deg: missing"), std::string::npos);
  EXPECT_NE(refusal("move_jp", R"({"goal_deg":["a"]})").find("allowed number[]"), std::string::npos);
  EXPECT_NE(refusal("use_device", R"({"device":"vr","node":1.5})").find("allowed integer"), std::string::npos);
  EXPECT_NE(refusal("hold", R"({"now":true})").find("unknown field: allowed none"), std::string::npos);
}

}  // namespace
}  // namespace liana
