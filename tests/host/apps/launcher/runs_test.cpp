// The newest runs of a user.
#include "host/apps/launcher/runs.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "host/apps/launcher/system_layout.hpp"

namespace liana::launcher {
namespace {

namespace fs = std::filesystem;

class Runs : public testing::Test {
 protected:
  Runs() : home_(testing::TempDir() + "liana_runs_" + std::to_string(::getpid())) {
    fs::create_directories(home_);
    ::setenv("XDG_STATE_HOME", home_.c_str(), 1);
  }
  ~Runs() override {
    ::unsetenv("XDG_STATE_HOME");
    fs::remove_all(home_);
  }
  // A run's folder as it is when the run ends.
  SystemLayout run(const std::string& record = "") const {
    SystemLayout plan;
    plan.directory = record.empty() ? make_run_folder(runs_folder()) : record;
    plan.socket_dir = home_ + "/sockets";
    plan.keep_directory = !record.empty();
    fs::create_directories(plan.socket_dir);
    fs::create_directories(plan.directory);
    for (const char* name :
         {"events.txt", "archive.db", "archive.db-wal", "telemetry-1-000000000000.db", "can0.log", "lianad.log"})
      std::ofstream(plan.file(name)) << "of this run\n";
    return plan;
  }
  static std::size_t count(const std::string& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}));
  }

  const std::string home_;
};

TEST_F(Runs, AreInTheFolderForStateOfThisUser) {
  EXPECT_EQ(runs_folder(), home_ + "/liana/runs");
  ::unsetenv("XDG_STATE_HOME");
  EXPECT_TRUE(runs_folder().ends_with("/.local/state/liana/runs"));
}

TEST_F(Runs, OneThatSucceedsLeavesWhatLastsAndNothingElse) {
  const SystemLayout plan = run();
  clean_up(plan, true);
  EXPECT_FALSE(fs::exists(plan.socket_dir));
  for (const char* name : {"events.txt", "archive.db", "archive.db-wal", "telemetry-1-000000000000.db"})
    EXPECT_TRUE(fs::exists(plan.file(name))) << name;
  for (const char* name : {"can0.log", "lianad.log"}) EXPECT_FALSE(fs::exists(plan.file(name))) << name;
}

TEST_F(Runs, OneThatFailsKeepsItsLogsToo) {
  const SystemLayout plan = run();
  clean_up(plan, false);
  EXPECT_EQ(count(plan.directory), 6u);
  EXPECT_FALSE(fs::exists(plan.socket_dir));
}

TEST_F(Runs, OneWithRecordKeepsAllInItsOwnFolderAndNothingElsewhere) {
  const SystemLayout plan = run(home_ + "/record");
  clean_up(plan, true);
  EXPECT_EQ(count(plan.directory), 6u);
  EXPECT_FALSE(fs::exists(runs_folder()));
}

TEST_F(Runs, OneThatIsDiscardedLeavesNothing) {
  const SystemLayout plan = run();
  discard(plan);
  EXPECT_FALSE(fs::exists(plan.directory));
  EXPECT_FALSE(fs::exists(plan.socket_dir));
}

TEST_F(Runs, TheOldestGoAndTheNewestAreListedFirst) {
  std::string oldest, newest;
  for (int i = 0; i < 25; ++i) {
    newest = run().directory;
    if (i == 0) oldest = newest;
    for (const fs::directory_entry& file : fs::directory_iterator(newest))
      fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(100 - i));
  }
  remove_oldest_runs(runs_folder());
  const std::vector<std::string> kept = kept_runs(runs_folder());
  EXPECT_EQ(kept.size(), kKeptRuns);
  EXPECT_EQ(kept.front(), newest);
  EXPECT_FALSE(fs::exists(oldest));
}

TEST_F(Runs, OneThatStillWritesIsNotOldHoweverLongAgoItBegan) {
  const SystemLayout going_on = run();
  for (const fs::directory_entry& file : fs::directory_iterator(going_on.directory))
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(100));
  fs::last_write_time(going_on.file("archive.db"), fs::file_time_type::clock::now() + std::chrono::hours(1));
  for (int i = 0; i < 25; ++i) clean_up(run(), true);
  EXPECT_TRUE(fs::exists(going_on.directory));
}

TEST_F(Runs, WhereNoneCanBeKeptTheReasonIsSaid) {
  std::ofstream(home_ + "/liana") << "no folder";
  EXPECT_THROW(make_run_folder(runs_folder()), std::runtime_error);
  EXPECT_THROW(make_run_folder(""), std::runtime_error);
  EXPECT_TRUE(kept_runs(runs_folder()).empty());
}

}  // namespace
}  // namespace liana::launcher
