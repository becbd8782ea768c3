// What is written of the table of requests: a section of docs/reference/api.md and the stubs of the commands of `arm`.
#pragma once

#include <string>

#include "host/api/server/request_table.hpp"

namespace liana::api {

// A file with a section that is made, between the lines `begin` and `end`.
struct MadeSection {
  const char* file;  // in the source directory
  const char* begin;
  const char* end;
  std::string (*make)();
};

// Markdown: who may ask for what, and the fields of every request.
std::string request_section();

// What a field is in Lua: "number", "string", "number[]", "table[]" ...
std::string lua_type(const RequestField& field);

// Lua with annotations of LuaLS: the commands that missions can give.
std::string command_stubs();

constexpr MadeSection kRequestSection{"docs/reference/api.md", "<!-- requests, made by ./dev docs -->\n",
                                      "<!-- end of requests -->\n", request_section};
constexpr MadeSection kCommandStubs{"lua/liana/arm_stubs.lua", "-- ---- commanding, made by ./dev docs ----\n",
                                    "\nreturn arm\n", command_stubs};

// What stands between the two lines of `text`, and `text` with `made` there; throw std::runtime_error when a line is
// missing.
std::string section_of(const MadeSection& section, const std::string& text);
std::string with_section(const MadeSection& section, const std::string& text, const std::string& made);

}  // namespace liana::api
