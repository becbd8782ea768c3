#include <gtest/gtest.h>

#include <algorithm>

#include "host/apps/mission_runner/script.hpp"
#include "tests/lua/program.hpp"
#include "tests/message.hpp"

namespace liana::mission_runner {
namespace {

struct Attack {
  const char* file;
  Facts facts;
};

// Every attack ends with one message and exit code 2, whatever bound it meets: budget, cap, memory or watchdog.
TEST(Sandbox, EveryAttackEndsWithOneClearMessage) {
  const std::vector<Attack> attacks = {{"endless_loop", {"attacks/endless_loop.lua:1", "computes"}},
                                       {"endless_pcall", {"computes", "too long"}},
                                       {"endless_xpcall", {"killed"}},
                                       {"endless_pattern", {"killed"}},
                                       {"endless_coroutine", {"computes", "too long"}},
                                       {"finaliser", {"__gc"}},
                                       {"finaliser_hidden", {"the end is reached"}},
                                       {"memory_bomb", {"memory", "64 MiB"}},
                                       {"memory_bomb_caught", {"killed"}},
                                       {"long_text", {"string.rep", "too long"}},
                                       {"endless_sort", {"table.sort", "too long"}},
                                       {"syntax_error", {"attacks/syntax_error.lua:1", "unexpected symbol"}},
                                       {"bytecode", {"binary chunk"}},
                                       {"files", {"global 'io'"}},
                                       {"load", {"global 'load'"}},
                                       {"escape_require", {"modules", "folder"}},
                                       {"change_library", {"read-only"}},
                                       {"change_module", {"change_module.lua:1", "read-only"}},
                                       {"change_text_methods", {"index", "boolean"}},
                                       {"deep_recursion", {"memory"}},
                                       {"self_containing", {"contains itself"}},
                                       {"not_a_number", {"segments[1].modules", "nan"}},
                                       {"function_in_table", {"name", "function"}},
                                       {"mixed_keys", {"boxes", "lists", "1..n"}},
                                       {"error_value", {"raised", "table"}},
                                       {"nothing", {"named fields"}},
                                       {"json_bomb", {"16 MiB"}},
                                       {"same_text_many_times", {"16 MiB"}},
                                       {"address", {"%p"}},
                                       {"address_of_text", {"table               |function|  2.0"}},
                                       {"terminal", {"?[2Jgone? ?31m"}}};
  for (const Attack& attack : attacks) {
    const Ended ended =
        run_program("eval robot " LIANA_SOURCE_DIR "/tests/lua/attacks/" + std::string(attack.file) + ".lua");
    EXPECT_EQ(ended.code, 2) << attack.file << ": " << ended.error;
    EXPECT_EQ(ended.out, "") << attack.file;
    EXPECT_TRUE(names(ended.error, attack.facts)) << attack.file;
  }
}

TEST(Sandbox, WhatAScriptPrintsIsBoundedAndCannotSteerATerminal) {
  const TemporaryFolder folder;
  const std::string file = folder.write("printing.lua", R"(
    print("\27[31mred", nil, 7, {})
    for _ = 1, 200000 do print("more") end
    error("the end", 0))");
  const Ended ended = run_program("eval robot " + file);
  EXPECT_EQ(ended.error.substr(0, 26), "?[31mred\tnil\t7\ttable\nmore\n");
  EXPECT_LT(ended.error.size(), 257u << 10);
  EXPECT_NE(ended.error.find("print: over 256 KiB: the rest is left out\n"), std::string::npos);
  EXPECT_NE(ended.error.find("the end"), std::string::npos);
}

// A mission changes no check, and not what was checked: neither Liana's modules, nor their tables, nor the mission.
TEST(Sandbox, NoScriptReplacesACheckOrChangesWhatWasChecked) {
  const TemporaryFolder folder;
  const std::string begin = "local liana = require \"liana\"\n", hold = "local hold = { [9] = 0 }\n",
                    mission =
                        "liana.mission \"given\" { liana.step \"one\" { device = \"none\", hold = hold, exit = "
                        "liana.at_rest(), time_limit_s = 5, on_fail = \"hold\" } }\n";
  const auto eval = [&](const std::string& text) {
    return run_program("eval mission " + folder.write("given.lua", begin + hold + text));
  };
  for (const char* change :
       {"liana.mission = function() return {} end", "require(\"liana.refuse\")(1)",
        "require(\"liana.check\").opened = function(m) return m end",
        "require(\"liana.step_fields\")[1][1] = \"other\"", "require(\"liana.retired_names\").actions.push = nil"})
    EXPECT_EQ(eval(change + std::string("\nreturn ") + mission).code, 2) << change;
  EXPECT_EQ(eval("return { is_mission = true, name = \"given\", steps = {} }").code, 2);
  EXPECT_EQ(eval("local made = " + mission + "made.steps = {}\nreturn made").code, 2);
  const Ended later = eval("local made = " + mission + "hold[99] = 1\nreturn made");
  EXPECT_EQ(later.code, 0) << later.error;
  EXPECT_NE(later.out.find("\"held_theta\":[9]"), std::string::npos) << later.out;
}

// Keys of a table in the order of pairs, and some random numbers: both must not depend on the process.
TEST(Sandbox, RunsTheSameInEveryProcess) {
  const TemporaryFolder folder;
  const std::string file = folder.write("order.lua", R"(
    local text = ""
    for key in pairs { zeta = 1, alpha = 2, [3] = 1, [1] = 1, mid = 3 } do text = text .. key .. " " end
    for _ = 1, 3 do text = text .. math.random(1000) .. " " end
    error(text .. tostring({}) .. " " .. tostring(print), 0))");
  const Ended first = run_program("eval robot " + file);
  const Ended second = run_program("eval robot " + file);
  EXPECT_NE(first.error.find("1 3 alpha mid zeta "), std::string::npos) << first.error;
  EXPECT_NE(first.error.find(" table function"), std::string::npos) << first.error;
  EXPECT_EQ(first.error, second.error);
}

TEST(Sandbox, PairsAllowsRemovingWhileItRuns) {
  Activity activity;
  Script script(ScriptLimits{}, LIANA_SOURCE_DIR "/lua", activity);
  script.run(
      {"remove.lua",
       "local t, n = { a = 1, b = 2, c = 3 }, 0 for k in pairs(t) do n = n + 1 t.b = nil t[k] = nil end return n"});
  EXPECT_EQ(lua_tointeger(script.state(), -1), 2);
}

TEST(Sandbox, GivesEveryFileItsOwnGlobals) {
  Activity activity;
  Script script(ScriptLimits{}, LIANA_SOURCE_DIR "/lua", activity);
  script.run({"a.lua", "leak = 1 return leak"});
  script.run({"b.lua", "return leak"});
  EXPECT_TRUE(lua_isnil(script.state(), -1));
}

TEST(Sandbox, MemoryIsFreedAndCountedAcrossManyCalls) {
  Activity activity;
  Script script(ScriptLimits{.memory_bytes = 4u << 20}, LIANA_SOURCE_DIR "/lua", activity);
  script.run({"grow.lua", "return function() local s = ('x'):rep(1000000) return #s end"});
  for (int i = 0; i < 200; ++i) {
    lua_pushvalue(script.state(), -1);
    script.call(0, 1);
    EXPECT_EQ(lua_tointeger(script.state(), -1), 1000000);
    lua_pop(script.state(), 1);
  }
}

// luacheck must allow exactly what the sandbox gives.
TEST(Sandbox, GivesWhatLuacheckAllowsAndNoDoorOutside) {
  const std::string rules = read_file(LIANA_SOURCE_DIR "/.luacheckrc");
  Activity activity;
  Script script(ScriptLimits{}, LIANA_SOURCE_DIR "/lua", activity);
  ASSERT_NE(rules.find("stds.liana"), std::string::npos);
  script.run({"probe.lua", R"(
    local stds = { liana = nil }
    local missing = {}
    )" + rules.substr(rules.find("stds.liana"), rules.find("\nstd =") - rules.find("stds.liana")) +
                               R"(
    local env = { assert = assert, error = error, getmetatable = getmetatable, ipairs = ipairs, pairs = pairs, pcall = pcall,
      print = print, rawequal = rawequal, rawget = rawget, rawlen = rawlen, require = require, select = select,
      setmetatable = setmetatable, tonumber = tonumber, tostring = tostring, type = type, xpcall = xpcall,
      math = math, string = string, table = table, coroutine = coroutine }
    for key, value in pairs(stds.liana.read_globals) do
      if type(value) == "string" then
        if env[value] == nil then missing[#missing + 1] = value end
      else
        for _, field in ipairs(value.fields) do if env[key][field] == nil then missing[#missing + 1] = key .. "." .. field end end
      end
    end
    return table.concat(missing, " "))"});
  EXPECT_STREQ(lua_tostring(script.state(), -1), "");
  for (const char* name : {"io", "os", "debug", "load", "loadfile", "dofile", "collectgarbage", "package", "next",
                           "rawset", "_G", "utf8"}) {
    script.run({"absent.lua", "return " + std::string(name)});
    EXPECT_TRUE(lua_isnil(script.state(), -1)) << name;
  }
}

}  // namespace
}  // namespace liana::mission_runner
