// What a disk refuses is said with the disk's own reason.
#include "host/archive/out_file.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace liana::archive {
namespace {

std::string reason(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(OutFile, AFullDiskIsSaidToBeFullWhateverElseFailedMeanwhile) {
  const std::string full = "/dev/full: cannot be written: No space left on device";
  EXPECT_EQ(reason([] {
              OutFile out("/dev/full");
              out.write("a line");
              errno = ENOENT;
              out.finish();
            }),
            full);
  EXPECT_EQ(reason([] { OutFile("/dev/full").write(std::string(1 << 20, 'x')); }), full);
}

TEST(OutFile, AFolderThatIsNotThereIsSaidToBeMissing) {
  EXPECT_EQ(reason([] { OutFile("/no/such/folder/file"); }),
            "/no/such/folder/file: cannot be made: No such file or directory");
}

}  // namespace
}  // namespace liana::archive
