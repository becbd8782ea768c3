// Of a program in a build folder; of installed ones see tests/install/prefix.
#include "host/base/install_paths/places.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "tests/message.hpp"

namespace liana::install_paths {
namespace {

namespace fs = std::filesystem;

const std::string kShipped = LIANA_SOURCE_DIR "/lua";

// Two folders of one's own, and no search path of whoever runs the test.
class Places : public testing::Test {
 protected:
  Places() {
    std::string name = (fs::temp_directory_path() / "liana-places-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be made");
    root = name;
    for (const char* folder : {"one", "two", "a:b"}) fs::create_directory(root / folder);
    ::unsetenv(kLuaPath);
  }
  ~Places() override {
    ::unsetenv(kLuaPath);
    fs::remove_all(root);
  }
  std::string at(const char* folder) const { return (root / folder).string(); }
  static void set_path(const std::string& path) { ::setenv(kLuaPath, path.c_str(), 1); }

  fs::path root;
};

template <typename Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST_F(Places, AProgramOfABuildFolderUsesTheSourceTree) {
  EXPECT_FALSE(is_installed());
  EXPECT_EQ(lua_folders(), std::vector<std::string>{kShipped});
  EXPECT_EQ(page_file("view.html"), LIANA_SOURCE_DIR "/build/page/view.html");
}

TEST_F(Places, FoldersOfTheSearchPathComeBeforeInTheirOrderAndEmptyOnesArePassedOver) {
  set_path(":" + at("two") + "::" + at("one") + ":");
  EXPECT_EQ(lua_folders(), (std::vector<std::string>{at("two"), at("one"), kShipped}));
}

TEST_F(Places, AFolderOfAnOptionComesBeforeTheSearchPath) {
  set_path(at("two"));
  search_first("--lua-dir", at("one"));
  EXPECT_EQ(lua_folders(), (std::vector<std::string>{at("one"), at("two"), kShipped}));
}

TEST_F(Places, WhatIsNoFolderIsRefusedWithWhereItWasSaid) {
  EXPECT_TRUE(names(refusal_of([&] { search_first("--lua-dir", at("three")); }), {"--lua-dir", at("three"), "folder"}));
  set_path(at("three"));
  EXPECT_TRUE(names(refusal_of([] { lua_folders(); }), {"LIANA_LUA_PATH", at("three"), "folder"}));
}

TEST_F(Places, AFolderThatTheSearchPathCannotHoldIsRefused) {
  EXPECT_NE(refusal_of([&] { search_first("--lua-dir", at("a:b")); }).find("has a ':'"), std::string::npos);
}

}  // namespace
}  // namespace liana::install_paths
