// Whom the kernel says is at the other end, and who of them may talk to us.
#include "host/base/net/peer.hpp"

#include <grp.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "host/base/net/socket.hpp"

namespace liana::api {
namespace {

constexpr uid_t kNobody = 65534;
constexpr gid_t kGroup = 4711;

TEST(Peer, IsTheProcessThatConnected) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends.data()), 0);
  const UniqueFd one(ends[0]), other(ends[1]);
  const auto peer = peer_of(one.get());
  ASSERT_TRUE(peer);
  EXPECT_EQ(peer->process, ::getpid());
  EXPECT_EQ(peer->user, ::geteuid());
  EXPECT_TRUE(is_admitted(one.get()));
}

TEST(Peer, OfNoSocketIsNobodyAndNotAdmitted) {
  EXPECT_FALSE(peer_of(-1));
  EXPECT_FALSE(is_admitted(-1));
}

TEST(Peer, AGroupThatDoesNotExistIsNamed) {
  EXPECT_THROW(group_named("--group", "no such group"), std::runtime_error);
  EXPECT_EQ(group_named("--group", "root"), 0u);
}

// Only root can be somebody else.
class AnotherUser : public testing::Test {
 protected:
  void SetUp() override {
    if (::geteuid() != 0) GTEST_SKIP() << "needs root, to connect as another user";
    std::snprintf(address_.sun_path + 1, sizeof address_.sun_path - 1, "liana_peer_%d", ::getpid());
    listener_ = UniqueFd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
    ASSERT_EQ(::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&address_), sizeof address_), 0);
    ASSERT_EQ(::listen(listener_.get(), 1), 0);
  }

  // Whether a connection of this user, with this further group, is admitted by a server of yet another user.
  bool admitted(uid_t user, gid_t further, std::optional<gid_t> group) {
    const pid_t child = ::fork();
    if (child == 0) connect_as(user, further);
    wait_readable(listener_.get(), 10.0);
    const UniqueFd accepted(::accept(listener_.get(), nullptr, nullptr));
    EXPECT_EQ(::seteuid(kNobody - 1), 0);
    const bool result = is_admitted(accepted.get(), group);
    EXPECT_EQ(::seteuid(0), 0);
    int status = 0;
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    return result;
  }

 private:
  [[noreturn]] void connect_as(uid_t user, gid_t further) const {
    const UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET, 0));
    if (::setgroups(1, &further) != 0 || ::setresuid(user, user, user) != 0) ::_exit(1);
    if (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address_), sizeof address_) != 0) ::_exit(1);
    for (;;) ::pause();
  }

  sockaddr_un address_{AF_UNIX, {}};  // abstract, so that no folder is in the way
  UniqueFd listener_;
};

TEST_F(AnotherUser, IsNotAdmittedButRootIs) {
  EXPECT_FALSE(admitted(kNobody, kGroup, std::nullopt));
  EXPECT_TRUE(admitted(0, kGroup, std::nullopt));
}

TEST_F(AnotherUser, IsAdmittedAsAMemberOfTheGroup) {
  EXPECT_TRUE(admitted(kNobody, kGroup, kGroup));
  EXPECT_FALSE(admitted(kNobody, kGroup, kGroup + 1));
}

}  // namespace
}  // namespace liana::api
