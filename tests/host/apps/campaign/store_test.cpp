// One file with a row for each run, whoever made it and in which order.
#include "host/apps/campaign/store.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "host/apps/campaign/slurm_engine.hpp"
#include "host/apps/launcher/errors.hpp"

namespace liana::campaign {
namespace {

namespace fs = std::filesystem;

class Stores : public testing::Test {
 protected:
  Stores() : path_(testing::TempDir() + "liana_store_" + std::to_string(::getpid()) + ".db") { remove(); }
  ~Stores() override { remove(); }
  void remove() const {
    for (const char* end : {"", ".lock", "-wal", "-shm"}) fs::remove(path_ + end);
  }
  static Campaign campaign(const char* mission = "a") {
    return {"trial", {{"mission", mission}, {"name", "trial"}}, "programs", 9};
  }
  static void put(Store& store, std::uint64_t number, const std::string& outcome = "success") {
    Row row;
    row.number = number;
    row.seed = 100 + number;
    row.values = {{"gravity", 0.25}};
    RowResult result;
    result.number = number;
    result.outcome = outcome;
    result.config_hash = "config" + std::to_string(number);
    result.report_hash = "report" + std::to_string(number);
    result.figures = {{"tip_error_m", 0.5}, {"tension.max", 3}};
    result.cpu_s = 1.5;
    store.put(row, "liana run it", result);
  }

  const std::string path_;
};

TEST_F(Stores, RefuseAPipe) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_THROW(Store(path_, campaign()), launcher::BadInput);
}

TEST_F(Stores, GiveBackWhatWasPutInWhateverTheOrder) {
  {
    Store store(path_, campaign());
    for (const std::uint64_t number : {4u, 0u, 2u}) put(store, number);
    store.finish();
  }
  const Stored stored = read_store(path_);
  ASSERT_EQ(stored.rows.size(), 3u);
  EXPECT_EQ(stored.campaign.rows, 9u);
  EXPECT_EQ(stored.rows[1].result.number, 2u);
  EXPECT_EQ(stored.rows[1].seed, 102u);
  EXPECT_EQ(stored.rows[1].values, Json::parse(R"({"gravity":0.25})"));
  EXPECT_EQ(stored.rows[1].result.report_hash, "report2");
  EXPECT_EQ(stored.rows[1].result.figures.at("tension.max").get<int>(), 3);
  EXPECT_EQ(stored.rows[1].result.cpu_s, 1.5);
  EXPECT_EQ(stored.rows[1].command, "liana run it");
  EXPECT_FALSE(fs::exists(path_ + "-wal"));
}

TEST_F(Stores, ThatWereKilledHaveEveryRowThatWasPut) {
  const pid_t killed = ::fork();
  if (killed == 0) {
    Store store(path_, campaign());
    put(store, 0);
    put(store, 1);
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(killed, &status, 0), killed);
  const Store again(path_, campaign());
  EXPECT_EQ(again.done().size(), 2u);
  EXPECT_EQ(again.done().at(1), "config1");
}

TEST_F(Stores, RefuseAnotherTableOtherProgramsAndASecondWriter) {
  {
    const Store store(path_, campaign());
    EXPECT_THROW(Store(path_, campaign()), launcher::BadInput);
  }
  EXPECT_THROW(Store(path_, campaign("b")), launcher::BadInput);
  Campaign rebuilt = campaign();
  rebuilt.programs = "others";
  EXPECT_THROW(Store(path_, rebuilt), launcher::BadInput);
  const Store same(path_, campaign());
}

TEST_F(Stores, LeaveFilesOfOthersAsTheyAre) {
  std::ofstream(path_) << "a letter that is longer than sixteen bytes";
  EXPECT_THROW(Store(path_, campaign()), launcher::BadInput);
  EXPECT_THROW(read_store(path_), launcher::BadInput);
  EXPECT_EQ(fs::file_size(path_), 42u);
  EXPECT_THROW(read_store(path_ + ".none"), launcher::BadInput);
}

TEST_F(Stores, NameTheFirstFailuresToKeepOnce) {
  Store store(path_, campaign());
  for (const std::uint64_t number : {1u, 3u, 5u}) put(store, number, "failed");
  put(store, 0, "refused");
  put(store, 2);
  EXPECT_EQ(store.failed_not_kept(2), (std::vector<std::uint64_t>{1, 3}));
  RowResult repeated;
  repeated.number = 1;
  repeated.report_hash = "report1";
  EXPECT_TRUE(store.put_kept(repeated, "/kept/row-000001"));
  EXPECT_EQ(store.failed_not_kept(2), (std::vector<std::uint64_t>{3}));
  repeated.number = 3;
  EXPECT_FALSE(store.put_kept(repeated, "/kept/row-000003"));
  EXPECT_TRUE(store.failed_not_kept(2).empty());
}

TEST(SlurmTasks, AreAtMostAsManyAsAnArrayHasAndHoldEveryRowOnce) {
  for (const std::size_t count : {1u, 1000u, 1001u, 1002u, 5000u}) {
    std::vector<std::uint64_t> rows(count);
    for (std::size_t i = 0; i < count; ++i) rows[i] = 3 * i;
    std::set<std::uint64_t> found;
    std::size_t least = count, most = 0;
    const auto tasks = tasks_of(rows);
    for (const auto& task : tasks) {
      found.insert(task.begin(), task.end());
      least = std::min(least, task.size());
      most = std::max(most, task.size());
    }
    EXPECT_LE(tasks.size(), kMaxArrayTasks);
    EXPECT_EQ(found.size(), count);
    EXPECT_LE(most - least, 1u);
  }
}

}  // namespace
}  // namespace liana::campaign
