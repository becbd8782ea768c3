// Tables that fit into one packet, and those that do not.
#include "host/api/server/welcome_size.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "host/base/net/socket.hpp"

namespace liana::api {
namespace {

TEST(WelcomeSize, TheTablesTogetherAreBoundedWhicheverIsLarge) {
  const std::string third(kMaxPacketBytes / 3 - 400, 'x'), most(kMaxPacketBytes - 1024, 'x');
  EXPECT_NO_THROW(require_fit_in_welcome(third, third, third));
  EXPECT_NO_THROW(require_fit_in_welcome("", most, ""));
  EXPECT_THROW(require_fit_in_welcome("x", most, ""), std::runtime_error);
  EXPECT_THROW(require_fit_in_welcome("", "x", most), std::runtime_error);
  EXPECT_THROW(require_fit_in_welcome(most, "", "x"), std::runtime_error);
}

}  // namespace
}  // namespace liana::api
