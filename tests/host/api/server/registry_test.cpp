// Where systems are looked for, and what is believed.
#include "host/api/server/registry.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "host/base/net/connect.hpp"
#include "host/base/net/socket.hpp"

namespace liana::api {
namespace {

namespace fs = std::filesystem;

// A runtime folder and a folder for temporary files of its own. What others have on this machine is found, too.
class Places : public testing::Test {
 protected:
  Places() {
    fs::create_directories(folder_ + "/run");
    fs::create_directories(folder_ + "/tmp");
    ::setenv("XDG_RUNTIME_DIR", (folder_ + "/run").c_str(), 1);
    ::setenv("TMPDIR", (folder_ + "/tmp").c_str(), 1);
  }
  ~Places() override {
    ::unsetenv("XDG_RUNTIME_DIR");
    ::unsetenv("TMPDIR");
    fs::remove_all(folder_);
  }
  std::string links() const { return folder_ + "/run/liana-" + std::to_string(::getuid()); }
  void link(const std::string& socket, const std::string& name) const {
    fs::create_directories(links());
    fs::create_symlink(socket, links() + "/" + name);
  }
  UniqueFd listen(const std::string& path) const {
    fs::create_directories(fs::path(path).parent_path());
    return listen_at("--api", path);
  }
  // Those below our own folder.
  std::vector<std::string> found() {
    std::vector<std::string> sockets;
    unseen_ = look_everywhere([&](const std::string& api) {
      if (api.starts_with(folder_)) sockets.push_back(api.substr(folder_.size() + 1));
    });
    std::sort(sockets.begin(), sockets.end());
    return sockets;
  }

  std::string folder_ = testing::TempDir() + "liana_places_" + std::to_string(::getpid());
  std::vector<Unseen> unseen_;
};

using Names = std::vector<std::string>;

TEST_F(Places, LinksAndFoldersOfRunsAreFoundOnceEach) {
  const UniqueFd linked = listen(folder_ + "/a"), run = listen(folder_ + "/tmp/liana-run-x/api"),
                 dry = listen(folder_ + "/tmp/liana-run-y/dry"), other = listen(folder_ + "/tmp/other/api");
  link(folder_ + "/a", "1");
  link(folder_ + "/tmp/liana-run-x/api", "2");
  EXPECT_EQ(found(), (Names{"a", "tmp/liana-run-x/api"}));
}

TEST_F(Places, ALongPathIsFoundAndReachedAndADeadOneHindersNobody) {
  const std::string deep = folder_ + "/" + std::string(120, 'd'), before = fs::current_path();
  fs::create_directories(deep);
  fs::current_path(deep);
  UniqueFd far = listen_at("--api", "api");
  const UniqueFd near = listen(folder_ + "/a");
  fs::current_path(before);
  link(deep + "/api", "1");
  link(folder_ + "/a", "2");
  EXPECT_EQ(found(), (Names{"a", std::string(120, 'd') + "/api"}));
  EXPECT_GE(connect_to("--api", deep + "/api", 0.0).get(), 0);
  EXPECT_EQ(running_systems().size(), 2u);
  far = UniqueFd();
  EXPECT_EQ(found(), Names{"a"});
  EXPECT_TRUE(fs::is_symlink(links() + "/1")) << "a stop changes nothing";
  EXPECT_EQ(running_systems(), Names{folder_ + "/a"});
  EXPECT_FALSE(fs::is_symlink(links() + "/1"));
}

// kill -9 of a lianad, and another one at the same socket.
TEST_F(Places, TheLinkOfADeadSystemBesideALiveOneIsNoSecondSystem) {
  const UniqueFd socket = listen(folder_ + "/a"), other = listen(folder_ + "/b");
  fs::create_directory_symlink(folder_, folder_ + "/same");
  for (const char* number : {"1", "2"}) link(folder_ + "/a", number);
  link(folder_ + "/same/a", "3");
  link(folder_ + "/b", "4");
  EXPECT_EQ(running_systems().size(), 2u);
  EXPECT_EQ(std::distance(fs::directory_iterator(links()), fs::directory_iterator()), 2) << "it is removed";
}

TEST_F(Places, NonsenseAmongTheLinksHindersNobody) {
  const UniqueFd socket = listen(folder_ + "/a");
  link(folder_ + "/a", "1");
  link(links() + "/2", "2");
  link(std::string(4000, 'x'), "3");
  link("/", "4");
  fs::create_directories(links() + "/5");
  EXPECT_EQ(found(), Names{"a"});
}

TEST_F(Places, AFolderOfLinksThatIsNoFolderIsSaidToBeUnseen) {
  const UniqueFd run = listen(folder_ + "/tmp/liana-run-x/api");
  fs::create_symlink("/", links());
  EXPECT_EQ(found(), Names{"tmp/liana-run-x/api"});
  EXPECT_TRUE(
      std::any_of(unseen_.begin(), unseen_.end(), [&](const Unseen& u) { return u.place == links() && u.is_ours; }));
  EXPECT_THROW(running_systems(), std::runtime_error);
}

TEST_F(Places, AnotherRuntimeFolderHidesNoSystemOfATemporaryFolder) {
  const UniqueFd run = listen(folder_ + "/tmp/liana-run-x/api");
  ::setenv("XDG_RUNTIME_DIR", "/no/such", 1);
  EXPECT_EQ(found(), Names{"tmp/liana-run-x/api"});
  ::unsetenv("XDG_RUNTIME_DIR");
  EXPECT_EQ(found(), Names{"tmp/liana-run-x/api"});
}

}  // namespace
}  // namespace liana::api
