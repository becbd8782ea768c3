// Where Liana's own files lie: installed beside the programs (PREFIX/bin, PREFIX/share/liana), wherever the prefix was
// moved to, or in the source tree for the programs of a build folder.
#pragma once

#include <string>
#include <vector>

namespace liana::install_paths {

// Of the environment: folders of one's own tables and missions, separated by ':', searched before Liana's.
inline constexpr const char* kLuaPath = "LIANA_LUA_PATH";

// Folder of the running program; the other programs lie there, too. Throws std::runtime_error without /proc.
std::string program_folder();

// This program was installed; one of a build folder lies in a source tree, which has ./dev. Throws std::runtime_error
// without /proc.
bool is_installed();

// Liana's own Lua folder: robots, scenes, buses, missions, recordings and the modules of missions. Throws
// std::runtime_error when it is not there.
std::string shipped_lua_folder();

// Every folder in which a table or mission is looked up by its name, in turn: those of LIANA_LUA_PATH, then Liana's
// own. Throws std::runtime_error when one of them is no folder.
std::vector<std::string> lua_folders();

// Puts `folder` in front of LIANA_LUA_PATH, for this program and those that it starts. Throws std::runtime_error when
// it is no folder; `option` is what the message calls it.
void search_first(const std::string& option, const std::string& folder);

// A built page, such as "console.html"; it need not be there: npm builds it (./dev view).
std::string page_file(const std::string& name);

}  // namespace liana::install_paths
