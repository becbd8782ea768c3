#include "host/apps/gateway/web_origin.hpp"

#include <gtest/gtest.h>

namespace liana::gateway {
namespace {

TEST(Host, OnLoopbackIsOneOfItsNamesWithThePort) {
  for (const char* host : {"127.0.0.1:8765", "localhost:8765", "LOCALHOST:8765", "[::1]:8765"})
    EXPECT_TRUE(is_loopback_host(host, 8765)) << host;
  for (const char* host : {"", "localhost", "localhost:8766", "evil.example:8765", "localhost.evil.example:8765",
                           "127.0.0.1:87650", "127.0.0.1.evil.example:8765"})
    EXPECT_FALSE(is_loopback_host(host, 8765)) << host;
  EXPECT_TRUE(is_loopback_host("localhost", 80));
}

TEST(Origin, IsOursUnderTheSameNamePortAndScheme) {
  EXPECT_TRUE(is_own_origin("http://localhost:8765", "http", "localhost:8765"));
  EXPECT_TRUE(is_own_origin("https://Arm.lab:443", "https", "arm.lab:443"));
  for (const char* origin : {"null", "http://evil.example", "http://localhost:8766", "https://localhost:8765",
                             "http://localhost:8765.evil.example", "http://localhost"})
    EXPECT_FALSE(is_own_origin(origin, "http", "localhost:8765")) << origin;
}

TEST(Origin, IsMissingFromProgramsThatAreNoBrowsers) { EXPECT_TRUE(is_own_origin("", "http", "localhost:8765")); }

}  // namespace
}  // namespace liana::gateway
