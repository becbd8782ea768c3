// What lianad is told of a full disk.
#include "host/storage/archive/alarms.hpp"

#include <gtest/gtest.h>

#include <string>

namespace liana::archive {
namespace {

TEST(Alarms, AreUtf8WhereverTheirTextIsCut) {
  for (std::size_t before = 250; before < 258; ++before) {
    Alarms alarms;
    alarms.add(std::string(before, 'x') + "\u00fc\u20ac", 1);
    const auto alarm = alarms.take();
    ASSERT_TRUE(alarm);
    EXPECT_NO_THROW((void)alarm->dump()) << before;
    EXPECT_LE(alarm->at("text").text().size(), 256u);
  }
}

TEST(Alarms, ShowWhatIsNoUtf8) {
  Alarms alarms;
  alarms.add("/run/\xff: a write failed", 2);
  const auto alarm = alarms.take();
  ASSERT_TRUE(alarm);
  EXPECT_EQ(alarm->at("text").text(), "/run/?: a write failed");
}

}  // namespace
}  // namespace liana::archive
