// What an arm has lost outlives lianad: read as it was written, of the same robot alone, gone when nothing is lost.
#include "host/control/server/loss_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace liana::server {
namespace {

using Cables = std::vector<std::size_t>;

class FileOfLosses : public testing::Test {
 protected:
  FileOfLosses() : path_(std::filesystem::path(testing::TempDir()) / "losses.json") { std::filesystem::remove(path_); }
  LossFile file(const std::string& robot = "an arm") const { return LossFile(path_, robot, 15); }
  std::string path_;
};

TEST_F(FileOfLosses, IsReadAsItWasWrittenAndGoneWhenNothingIsLost) {
  EXPECT_EQ(file().cables(), Cables{});
  for (const Cables& lost : {Cables{0}, Cables{14}, Cables{3, 7}}) {
    EXPECT_TRUE(file().note(lost));
    EXPECT_EQ(file().cables(), lost);
    EXPECT_EQ(file("another arm").cables(), Cables{});
  }
  EXPECT_TRUE(file().note({}));
  EXPECT_FALSE(std::filesystem::exists(path_));
  EXPECT_TRUE(file().note({})) << "nothing to remove";
  LossFile nowhere("/nowhere/losses.json", "an arm", 15);
  EXPECT_FALSE(nowhere.note({2}));
  EXPECT_EQ(nowhere.cables(), Cables{}) << "what is not written is tried again";
}

TEST_F(FileOfLosses, ThatSaysNothingIsNoWholeArm) {
  for (const char* content : {"", "5", "{}", R"({"robot":"an arm"})", R"({"robot":"an arm","lost_cables":[0]})",
                              R"({"robot":"an arm","lost_cables":[16]})", R"({"robot":"an arm","lost_cables":["a"]})",
                              R"({"robot":"an arm","lost_cables":[5)"}) {
    std::ofstream(path_, std::ios::trunc) << content;
    EXPECT_THROW(file(), std::runtime_error) << content;
  }
}

}  // namespace
}  // namespace liana::server
