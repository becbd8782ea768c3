#include "host/base/net/internet_address.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <stdexcept>

namespace liana::api {
namespace {

TEST(InternetAddress, TellsLoopbackFromTheRest) {
  for (const char* text : {"127.0.0.1:0", "localhost:8765", "[::1]:80", "127.1.2.3:65535"})
    EXPECT_TRUE(parse_internet_address("--listen", text).is_loopback()) << text;
  for (const char* text : {"0.0.0.0:1", "192.168.0.2:8765", "[::]:1", "[fe80::1]:2"})
    EXPECT_FALSE(parse_internet_address("--listen", text).is_loopback()) << text;
}

TEST(InternetAddress, StandsInBracketsWhereTheWebWantsIt) {
  EXPECT_EQ(parse_internet_address("--listen", "[::1]:80").web_host(), "[::1]");
  EXPECT_EQ(parse_internet_address("--listen", "localhost:80").web_host(), "127.0.0.1");
  EXPECT_EQ(parse_internet_address("--listen", "127.0.0.1:80").port, 80);
}

TEST(InternetAddress, IsRefusedWhenItIsNone) {
  for (const char* text : {"", ":", ":80", "127.0.0.1", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.1:-1",
                           "127.0.0.1:80x", "here:80", "::1:80", "[127.0.0.1]:80", "127.0.0.1:8 0"})
    EXPECT_THROW(parse_internet_address("--listen", text), std::runtime_error) << text;
}

TEST(InternetAddress, ListensWhereDeadEndsAreFound) {
  const UniqueFd listener = bind_at(Transport::kTcp, {"127.0.0.1", 0});
  int is_on = 0;
  socklen_t size = sizeof is_on;
  ASSERT_EQ(::getsockopt(listener.get(), SOL_SOCKET, SO_KEEPALIVE, &is_on, &size), 0);
  EXPECT_NE(is_on, 0);
}

}  // namespace
}  // namespace liana::api
