// Events of runs that keep nothing else.
#include "host/system/kept_events.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "host/system/system_layout.hpp"

namespace liana::system {
namespace {

namespace fs = std::filesystem;

class KeptEvents : public testing::Test {
 protected:
  KeptEvents() : home_(testing::TempDir() + "liana_kept_" + std::to_string(::getpid())) {
    fs::create_directories(home_);
    ::setenv("XDG_STATE_HOME", home_.c_str(), 1);
  }
  ~KeptEvents() override {
    ::unsetenv("XDG_STATE_HOME");
    fs::remove_all(home_);
  }
  std::string folder() const { return home_ + "/liana/events"; }
  // A run's folder as it is when the run ends.
  SystemLayout run(const std::string& name, bool keep_directory = false) const {
    SystemLayout plan;
    plan.directory = plan.socket_dir = home_ + "/" + name;
    plan.keep_directory = keep_directory;
    fs::create_directories(plan.directory);
    std::ofstream(plan.events_file()) << "events of " << name << "\n";
    return plan;
  }
  static std::string content(const std::string& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::size_t count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder()), fs::directory_iterator{}));
  }

  std::string home_;
};

TEST_F(KeptEvents, ASuccessfulRunWithoutRecordLeavesItsEventsAlone) {
  const SystemLayout plan = run("liana-run-a");
  clean_up(plan, true);
  EXPECT_FALSE(fs::exists(plan.directory));
  EXPECT_EQ(content(folder() + "/liana-run-a.txt"), "events of liana-run-a\n");
}

TEST_F(KeptEvents, AFailedRunKeepsThemInItsOwnFolder) {
  const SystemLayout plan = run("liana-run-b");
  clean_up(plan, false);
  EXPECT_EQ(content(plan.events_file()), "events of liana-run-b\n");
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(KeptEvents, ARunThatNeverStartedHasNone) {
  const SystemLayout plan = run("liana-run-c");
  fs::remove(plan.events_file());
  clean_up(plan, true);
  EXPECT_FALSE(fs::exists(plan.directory));
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(KeptEvents, TheOldestRunsGo) {
  for (int i = 0; i < 25; ++i) {
    const std::string name = "run" + std::to_string(i);
    clean_up(run(name), true);
    const auto age = std::chrono::hours(100 - i);
    fs::last_write_time(folder() + "/" + name + ".txt", fs::file_time_type::clock::now() - age);
  }
  clean_up(run("newest"), true);
  EXPECT_EQ(count(), kKeptRuns);
  EXPECT_TRUE(fs::exists(folder() + "/newest.txt"));
  EXPECT_TRUE(fs::exists(folder() + "/run24.txt"));
  EXPECT_FALSE(fs::exists(folder() + "/run5.txt"));
}

TEST_F(KeptEvents, WhereNothingCanBeKeptTheRunIsRemovedAllTheSame) {
  std::ofstream(home_ + "/liana") << "no folder";
  const SystemLayout plan = run("liana-run-d");
  EXPECT_THROW(keep_events(plan.events_file(), "d", folder()), std::runtime_error);
  EXPECT_THROW(keep_events(plan.events_file(), "d", ""), std::runtime_error);
  clean_up(plan, true);
  EXPECT_FALSE(fs::exists(plan.directory));
}

}  // namespace
}  // namespace liana::system
