// The newest runs of a user.
#include "host/apps/launcher/runs.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

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
    RunFolder made = record.empty() ? make_run_folder(runs_folder()) : RunFolder{record, nullptr};
    plan.directory = made.path;
    plan.lock = std::move(made.lock);
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
  // All in a folder was written so long from now.
  static void date(const std::string& folder, std::chrono::hours from_now) {
    for (const fs::directory_entry& file : fs::directory_iterator(folder))
      fs::last_write_time(file, fs::file_time_type::clock::now() + from_now);
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
  EXPECT_EQ(count(plan.directory), 7u);  // the lock, too
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
    date(newest, std::chrono::hours(i - 100));
  }
  remove_oldest_runs(runs_folder());
  const std::vector<std::string> kept = kept_runs(runs_folder());
  EXPECT_EQ(kept.size(), kKeptRuns);
  EXPECT_EQ(kept.front(), newest);
  EXPECT_FALSE(fs::exists(oldest));
}

TEST_F(Runs, AClockThatIsSetBackChangesNothing) {
  const std::string dated_later = run().directory;
  date(dated_later, std::chrono::hours(10'000));
  std::vector<std::string> newer;
  for (std::size_t i = 0; i < kKeptRuns; ++i) {
    newer.push_back(run().directory);
    date(newer.back(), std::chrono::hours(-100 * (static_cast<int>(i) + 1)));
  }
  remove_oldest_runs(runs_folder());
  EXPECT_FALSE(fs::exists(dated_later));
  for (const std::string& each : newer) EXPECT_TRUE(fs::exists(each));
}

TEST_F(Runs, OneThatIsHeldStaysWhateverItsDate) {
  SystemLayout going_on = run();
  date(going_on.directory, std::chrono::hours(-100'000));
  for (int i = 0; i < 25; ++i) clean_up(run(), true);
  EXPECT_TRUE(fs::exists(going_on.file("archive.db")));
  going_on.lock.reset();
  remove_oldest_runs(runs_folder());
  EXPECT_FALSE(fs::exists(going_on.directory));
}

TEST_F(Runs, WhatWasPutThereByHandStays) {
  const std::string copied = run().directory, by_hand = runs_folder() + "/liana-run-byhand",
                    copy = runs_folder() + "/liana-run-acopy0", link = runs_folder() + "/liana-run-alink0",
                    elsewhere = home_ + "/elsewhere";
  for (const std::string& each : {by_hand, elsewhere}) fs::create_directories(each);
  fs::copy(copied, copy, fs::copy_options::recursive);
  fs::create_directory_symlink(elsewhere, link);
  std::ofstream(elsewhere + "/lock") << "liana-run-alink0 0\n";
  for (const std::string& each : {by_hand, copy}) date(each, std::chrono::hours(-100'000));
  for (int i = 0; i < 25; ++i) clean_up(run(), true);
  for (const std::string& each : {by_hand, copy + "/archive.db", link, elsewhere + "/lock"})
    EXPECT_TRUE(fs::exists(each)) << each;
  EXPECT_FALSE(fs::exists(copied));
}

TEST_F(Runs, OneWhoseOwnerWasKilledIsHeldByTheProgramsThatItStarted) {
  std::array<int, 2> told{}, gate{};
  ASSERT_EQ(::pipe(told.data()) + ::pipe(gate.data()), 0);
  const pid_t owner = ::fork();
  if (owner == 0) {
    ::close(gate[1]);
    const RunFolder mine = make_run_folder(runs_folder());
    const pid_t program = ::fork();
    char nothing = 0;
    if (program == 0) _exit(static_cast<int>(::read(gate[0], &nothing, 1)));  // until the gate closes
    [[maybe_unused]] const ssize_t size = ::write(told[1], mine.path.data(), mine.path.size());
    ::raise(SIGKILL);
  }
  ::close(told[1]);
  int status = 0;
  ASSERT_EQ(::waitpid(owner, &status, 0), owner);
  std::array<char, 256> path{};
  ASSERT_GT(::read(told[0], path.data(), path.size() - 1), 0);
  for (int i = 0; i < 25; ++i) clean_up(run(), true);
  EXPECT_TRUE(fs::exists(path.data()));
  ::close(gate[1]);
  char end = 0;
  EXPECT_EQ(::read(told[0], &end, 1), 0);  // the program has ended: nobody writes any more
  remove_oldest_runs(runs_folder());
  EXPECT_FALSE(fs::exists(path.data()));
  ::close(told[0]);
  ::close(gate[0]);
}

TEST_F(Runs, ManyBesideEachOtherTakeNothingFromEachOther) {
  std::vector<pid_t> processes;
  for (int process = 0; process < 4; ++process) {
    processes.push_back(::fork());
    if (processes.back() != 0) continue;
    int lost = 0;
    for (int i = 0; i < 12; ++i) {
      const RunFolder mine = make_run_folder(runs_folder());
      std::ofstream(mine.path + "/archive.db") << "of this run\n";
      date(mine.path, std::chrono::hours(-i));
      remove_oldest_runs(runs_folder());
      lost += fs::exists(mine.path + "/archive.db") ? 0 : 1;
    }
    _exit(lost);
  }
  for (const pid_t each : processes) {
    int status = 0;
    ASSERT_EQ(::waitpid(each, &status, 0), each);
    EXPECT_EQ(status, 0);
  }
  remove_oldest_runs(runs_folder());
  EXPECT_EQ(kept_runs(runs_folder()).size(), kKeptRuns);
}

TEST_F(Runs, WhereNoneCanBeKeptTheReasonIsSaid) {
  std::ofstream(home_ + "/liana") << "no folder";
  EXPECT_THROW(make_run_folder(runs_folder()), std::runtime_error);
  EXPECT_THROW(make_run_folder(""), std::runtime_error);
  EXPECT_TRUE(kept_runs(runs_folder()).empty());
}

}  // namespace
}  // namespace liana::launcher
