// What a disk refuses is said with the disk's own reason.
#include "host/base/file/out_file.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "tests/message.hpp"

namespace liana::file {
namespace {

namespace fs = std::filesystem;

std::string reason(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(OutFile, AFullDiskIsSaidToBeFullWhateverElseFailedMeanwhile) {
  const Facts full{"/dev/full", "No space left"};
  EXPECT_TRUE(names(reason([] {
                      OutFile out("/dev/full");
                      out.write("a line");
                      errno = ENOENT;
                      out.finish();
                    }),
                    full));
  EXPECT_TRUE(names(reason([] { OutFile("/dev/full").write(std::string(1 << 20, 'x')); }), full));
}

TEST(OutFile, AFolderThatIsNotThereIsSaidToBeMissing) {
  EXPECT_TRUE(names(reason([] { OutFile("/no/such/folder/file"); }), {"/no/such/folder/file", "No such file"}));
}

class OutFileIn : public testing::Test {
 protected:
  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static std::string text_of(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void SetUp() override { ASSERT_TRUE(fs::create_directory(folder_)); }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_ = fs::path(testing::TempDir()) / ("out_file_" + std::to_string(::getpid()));
};

TEST_F(OutFileIn, AnEarlierFileStaysUntilTheNewOneIsWhole) {
  std::ofstream(path("plan")) << "earlier";
  fs::permissions(path("plan"), fs::perms::owner_read | fs::perms::owner_write);
  {
    OutFile cut(path("plan"));
    cut.write("half of the n");
    EXPECT_EQ(text_of(path("plan")), "earlier");
  }
  EXPECT_EQ(text_of(path("plan")), "earlier");
  EXPECT_EQ(files(), 1u) << "what was not finished is removed";
  OutFile whole(path("plan"));
  whole.write("new");
  whole.finish();
  EXPECT_EQ(text_of(path("plan")), "new");
  EXPECT_EQ(fs::status(path("plan")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutFileIn, AFileThatIsNotFinishedHasNoName) {
  { OutFile(path("new")).write("something"); }
  EXPECT_EQ(files(), 0u);
}

TEST_F(OutFileIn, AProcessThatEndsAtOnceLeavesNoPartBehind) {
  OutFile cut(path("export.csv"));
  cut.write("a line");
  EXPECT_EQ(files(), 1u);
  remove_unfinished();
  EXPECT_EQ(files(), 0u);
}

TEST_F(OutFileIn, BehindALinkItIsTheFileThatIsReplaced) {
  std::ofstream(path("real")) << "earlier";
  fs::create_symlink(path("real"), path("link"));
  OutFile out(path("link"));
  out.write("new");
  out.finish();
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(text_of(path("real")), "new");
}

}  // namespace
}  // namespace liana::file
