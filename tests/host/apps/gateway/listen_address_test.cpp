#include "host/apps/gateway/listen_address.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace liana::gateway {
namespace {

TEST(ListenAddress, TellsLoopbackFromTheRest) {
  for (const char* text : {"127.0.0.1:0", "localhost:8765", "[::1]:80", "127.1.2.3:65535"})
    EXPECT_TRUE(parse_listen_address(text).is_loopback()) << text;
  for (const char* text : {"0.0.0.0:1", "192.168.0.2:8765", "[::]:1", "[fe80::1]:2"})
    EXPECT_FALSE(parse_listen_address(text).is_loopback()) << text;
}

TEST(ListenAddress, StandsInBracketsWhereTheWebWantsIt) {
  EXPECT_EQ(parse_listen_address("[::1]:80").web_host(), "[::1]");
  EXPECT_EQ(parse_listen_address("localhost:80").web_host(), "127.0.0.1");
  EXPECT_EQ(parse_listen_address("127.0.0.1:80").port, 80);
}

TEST(ListenAddress, IsRefusedWhenItIsNone) {
  for (const char* text : {"", ":", ":80", "127.0.0.1", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.1:-1",
                           "127.0.0.1:80x", "here:80", "::1:80", "[127.0.0.1]:80", "127.0.0.1:8 0"})
    EXPECT_THROW(parse_listen_address(text), std::runtime_error) << text;
}

}  // namespace
}  // namespace liana::gateway
