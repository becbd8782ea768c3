#include "host/apps/gateway/api_connection.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "host/apps/gateway/poller.hpp"

namespace liana::gateway {
namespace {

class Link : public testing::Test {
 protected:
  Link() : path_(testing::TempDir() + "liana_link_" + std::to_string(::getpid())) {}
  ~Link() override { ::unlink(path_.c_str()); }
  void accept_one() {
    peer_ = api::UniqueFd(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  }

  std::string path_;
  Poller poller_;
  std::vector<std::string> heard_;
  int lost_ = 0;
  ApiConnection link_{poller_, path_, [this](const std::string& packet) { heard_.push_back(packet); },
                      [this] { ++lost_; }};
  api::UniqueFd listener_, peer_;
};

TEST_F(Link, IsNotThereUntilSomebodyListens) {
  EXPECT_FALSE(link_.connect());
  EXPECT_FALSE(link_.send("x"));
  listener_ = api::listen_at("--api", path_);
  EXPECT_TRUE(link_.connect());
}

TEST_F(Link, PassesPacketsBothWaysAndTellsTheEndOnce) {
  listener_ = api::listen_at("--api", path_);
  ASSERT_TRUE(link_.connect());
  accept_one();
  EXPECT_TRUE(link_.send("question"));
  std::string packet;
  EXPECT_EQ(api::receive_packet(peer_.get(), packet), api::SocketResult::kDone);
  EXPECT_EQ(packet, "question");
  api::send_packet(peer_.get(), "one");
  api::send_packet(peer_.get(), "two");
  peer_ = api::UniqueFd();
  poller_.run_ready();
  poller_.run_ready();
  EXPECT_EQ(heard_, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(lost_, 1);
  EXPECT_FALSE(link_.is_open());
}

TEST_F(Link, KeepsWhatIsNotReadWithinBoundsAndRefusesTheRest) {
  listener_ = api::listen_at("--api", path_);
  ASSERT_TRUE(link_.connect());
  accept_one();
  std::size_t sent = 0;
  while (link_.send(std::string(1000, 'x')) && sent < 100000) ++sent;
  EXPECT_LT(sent, 100000u);
  std::size_t read = 0;
  std::string packet;
  for (int i = 0; i < 1000; ++i) {
    poller_.run_ready();
    while (api::receive_packet(peer_.get(), packet) == api::SocketResult::kDone) ++read;
  }
  EXPECT_EQ(read, sent);
  EXPECT_TRUE(link_.send("again"));
}

TEST_F(Link, MayBeClosedByWhatItTells) {
  listener_ = api::listen_at("--api", path_);
  ApiConnection* self = nullptr;
  int heard = 0;
  ApiConnection link(
      poller_, path_,
      [&](const std::string&) {
        ++heard;
        self->close();
      },
      [&] { ++lost_; });
  self = &link;
  ASSERT_TRUE(link.connect());
  accept_one();
  api::send_packet(peer_.get(), "one");
  api::send_packet(peer_.get(), "two");
  poller_.run_ready();
  EXPECT_EQ(heard, 1);
  EXPECT_EQ(lost_, 0);
}

}  // namespace
}  // namespace liana::gateway
