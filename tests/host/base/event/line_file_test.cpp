// The file of events: complete, readable, and no trouble of a disk reaches who notes an event.
#include "host/base/event/line_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "host/base/event/event_file.hpp"
#include "tests/message.hpp"

namespace liana::event {
namespace {

class File : public testing::Test {
 protected:
  File() : path_(testing::TempDir() + "liana_events_" + std::to_string(::getpid())) {}
  ~File() override {
    for (const char* part : {"", LineFile::kFirst, LineFile::kBefore}) std::filesystem::remove(path_ + part);
  }

  static Event numbered(std::uint64_t sequence) {
    return {.kind = EventKind::kTool, .text = "event", .sequence = sequence, .tick = sequence};
  }
  static std::string line(std::uint64_t sequence) { return event_line(numbered(sequence), 0.004); }
  std::vector<std::string> lines(const std::string& part = "") const {
    std::ifstream in(path_ + part);
    std::vector<std::string> out;
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
  }
  // What `file` says of itself, within 5 s.
  static std::optional<Event> change(LineFile& file) {
    for (int i = 0; i < 1000; ++i) {
      if (auto event = file.change()) return event;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return std::nullopt;
  }

  std::string path_;
};

TEST_F(File, EveryEventIsALineBelowTheHeading) {
  {
    LineFile file(path_, "--events", kEventLineHeading);
    for (std::uint64_t n = 1; n <= 2000; ++n) file.append(line(n));
    EXPECT_FALSE(file.change());
  }
  const std::vector<std::string> found = lines();
  ASSERT_EQ(found.size(), 2001u);
  EXPECT_EQ(found[0], "#" + std::string(kEventLineHeading));
  for (std::uint64_t n = 1; n <= 2000; ++n) EXPECT_EQ(found[n], line(n));
}

TEST_F(File, AFileOfAnEarlierRunIsReplaced) {
  std::ofstream(path_) << "old\n";
  { LineFile file(path_, "--events", kEventLineHeading); }
  EXPECT_EQ(lines(), (std::vector<std::string>{"#" + std::string(kEventLineHeading)}));
}

TEST_F(File, ItsPartsAreBoundedTheFirstStaysAndEachBeginsWithTheCause) {
  constexpr std::uint64_t kPart = 20'000;
  {
    EventFile file(path_, 0.004, kPart);
    file.append({.kind = EventKind::kFault, .number = 3002, .subject = "drive 3", .sequence = 1, .tick = 1});
    for (std::uint64_t n = 2; n <= 5000; ++n) {
      file.append({.kind = EventKind::kFault, .number = 3003, .text = "what followed", .sequence = n, .tick = n});
      if (n % 50 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // or all of it is one write
    }
  }
  const std::vector<std::string> first = lines(LineFile::kFirst), before = lines(LineFile::kBefore), newest = lines();
  ASSERT_GT(first.size(), 2u);
  EXPECT_EQ(std::stoull(first[1]), 1u);
  for (const auto& part : {before, newest}) {
    ASSERT_GT(part.size(), 3u);
    EXPECT_EQ(part[0], "#" + std::string(kEventLineHeading));
    EXPECT_EQ(part[2], first[1]) << "the cause";
  }
  EXPECT_EQ(std::stoull(newest.back()), 5000u);
  EXPECT_EQ(std::stoull(newest[3]), std::stoull(before.back()) + 1) << "none is missing between them";
  for (const char* part : {"", LineFile::kFirst, LineFile::kBefore})
    EXPECT_LT(std::filesystem::file_size(path_ + part), kPart + 1'000) << part;
  { LineFile again(path_, "--events", kEventLineHeading); }
  EXPECT_FALSE(std::filesystem::exists(path_ + LineFile::kFirst)) << "of an earlier run";
}

TEST_F(File, APathThatCannotBeWrittenIsRefusedByItsName) {
  for (const std::string bad : {"/nonexistent/folder/events.txt", "/"}) {
    try {
      LineFile file(bad, "--events", kEventLineHeading);
      ADD_FAILURE() << bad << " was not refused";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("'" + bad + "'"), std::string::npos) << error.what();
    }
  }
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_THROW(LineFile(path_, "--events", kEventLineHeading), std::runtime_error)
      << "a pipe that nobody reads is no wait";
}

TEST_F(File, AFullDiskIsSaidOnceAndHoldsNobodyUp) {
  LineFile file("/dev/full", "--events", kEventLineHeading);
  for (std::uint64_t n = 1; n <= 100; ++n) file.append(line(n));
  const auto trouble = change(file);
  ASSERT_TRUE(trouble);
  EXPECT_EQ(trouble->kind, EventKind::kHostWarning);
  EXPECT_EQ(trouble->number, number_of(HostTroubleEvent::kEventFile));
  EXPECT_TRUE(names(trouble->text, {"/dev/full", "No space left"}));
  for (std::uint64_t n = 1; n <= 100; ++n) file.append(line(n));
  EXPECT_FALSE(file.change());
}

// A limit of the file's size stands for the disk.
TEST_F(File, WhenThereIsRoomAgainTheFileSaysHowManyAreMissing) {
  ::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  std::uint64_t next = 0;
  {
    LineFile file(path_, "--events", kEventLineHeading);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    while (!file.change()) {
      file.append(line(++next));
      ASSERT_LT(next, 1000u);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    file.append(line(++next));
    const auto good = change(file);
    ASSERT_TRUE(good);
    EXPECT_EQ(good->number, number_of(HostTroubleEvent::kEventFileGood));
  }
  std::uint64_t whole = 0, missing = 0;
  for (const std::string& line : lines()) {
    if (line.starts_with("# ")) missing = std::stoull(line.substr(2));
    if (line.starts_with("#")) continue;
    EXPECT_EQ(line, event_line(numbered(std::stoull(line)), 0.004));
    ++whole;
  }
  EXPECT_GT(missing, 0u);
  EXPECT_EQ(whole + missing, next);
}

TEST_F(File, ADiskThatStandsStillCostsEventsButNoTime) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  const int reader = ::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);  // never read from
  const auto start = std::chrono::steady_clock::now();
  std::optional<Event> trouble;
  {
    LineFile file(path_, "--events", kEventLineHeading);
    for (std::uint64_t n = 1; n <= 40000; ++n) file.append(line(n));
    trouble = change(file);
  }
  ::close(reader);
  ASSERT_TRUE(trouble);
  EXPECT_EQ(trouble->number, number_of(HostTroubleEvent::kEventFile));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

}  // namespace
}  // namespace liana::event
