// Programs that liana starts and watches.
#include "host/apps/launcher/process.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <string>

namespace liana::launcher {
namespace {

// Some supervisors leave SIGCHLD blocked in what they start.
TEST(ChildProcess, IsSeenToEndWhereSigchldWasBlocked) {
  sigset_t ends_only, before;
  sigemptyset(&ends_only);
  sigaddset(&ends_only, SIGCHLD);
  ASSERT_EQ(::pthread_sigmask(SIG_BLOCK, &ends_only, &before), 0);
  const std::string log = testing::TempDir() + "liana_process_" + std::to_string(::getpid());
  ChildProcess child("sh", {"/bin/sh", "-c", "exit 3"}, log);
  const auto end = child.wait(10.0);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::unlink(log.c_str());
  ASSERT_TRUE(end);
  EXPECT_EQ(end->code, 3);
}

// A program that waits for its signals by a descriptor has blocked them.
TEST(ChildProcess, IsAskedToEndWhereItsParentBlockedTheSignal) {
  sigset_t ending, before;
  sigemptyset(&ending);
  sigaddset(&ending, SIGTERM);
  ASSERT_EQ(::pthread_sigmask(SIG_BLOCK, &ending, &before), 0);
  const std::string log = testing::TempDir() + "liana_process_" + std::to_string(::getpid());
  ChildProcess child("sleep", {"/bin/sleep", "60"}, log);
  child.ask_to_end();
  const auto end = child.wait(10.0);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::unlink(log.c_str());
  ASSERT_TRUE(end);
  EXPECT_EQ(end->signal, SIGTERM);
}

}  // namespace
}  // namespace liana::launcher
