// A cluster whose squeue does not answer.
#include "host/apps/campaign/slurm_engine.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace liana::campaign {
namespace {

namespace fs = std::filesystem;

class Cluster : public testing::Test {
 protected:
  Cluster() : folder_(testing::TempDir() + "liana_slurm_" + std::to_string(::getpid())) {
    fs::create_directories(folder_ + "/bin");
    ::setenv("PATH", (folder_ + "/bin:" + path_).c_str(), 1);
  }
  ~Cluster() override {
    ::setenv("PATH", path_.c_str(), 1);
    fs::remove_all(folder_);
  }
  // A job is there, and squeue runs `script`; each call is a line of the file asked.
  void squeue(const std::string& script) const {
    std::ofstream(folder_ + "/job") << "7\n";
    const std::string file = folder_ + "/bin/squeue";
    std::ofstream(file) << "#!/bin/sh\necho >> " << folder_ << "/asked\n" << script << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }
  int asked() const {
    std::ifstream file(folder_ + "/asked");
    int count = 0;
    for (std::string line; std::getline(file, line);) ++count;
    return count;
  }
  void run() {
    Rows rows({}, folder_);
    const launcher::InterruptGuard interrupts;
    const Say say = [this](const std::string& text) { said_.push_back(text); };
    SlurmEngine engine(folder_, Json::object(), rows, interrupts, say, std::chrono::milliseconds(0));
    engine.run({{0}, ""}, [](const RowResult&) {});
  }

  const std::string path_ = std::getenv("PATH");
  const std::string folder_;
  std::vector<std::string> said_;
};

TEST_F(Cluster, WhoseSqueueFailsForEverEndsTheCampaignAndIsNamedBefore) {
  squeue("echo no controller >&2; exit 3");
  try {
    run();
    FAIL() << "squeue has never answered";
  } catch (const std::runtime_error& problem) {
    const std::string text = problem.what();
    for (const char* part : {"squeue", "900", "job 7", "code 3", "no controller"})
      EXPECT_NE(text.find(part), text.npos) << text;
  }
  EXPECT_EQ(asked(), kMaxUnanswered);
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_NE(said_[0].find("no controller"), std::string::npos) << said_[0];
  EXPECT_TRUE(fs::exists(folder_ + "/job")) << "the next campaign waits for it";
}

TEST_F(Cluster, WhoseSqueueAnswersNowAndThenIsWaitedFor) {
  squeue("n=$(wc -l < " + folder_ +
         "/asked)\n[ $n -ge 1000 ] && exit 0\n[ $((n % 500)) -eq 0 ] && echo 7 && exit 0\nexit 3");
  std::ofstream(folder_ + "/bin/sbatch") << "#!/bin/sh\nexit 9\n";  // the job is over, and the row is asked for again
  fs::permissions(folder_ + "/bin/sbatch", fs::perms::owner_all);
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_EQ(asked(), 1000);
  EXPECT_EQ(said_.size(), 2u) << "once for each outage";
}

}  // namespace
}  // namespace liana::campaign
