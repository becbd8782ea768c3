// A disk that is full costs telemetry, and never a command or an event.
#include <fstream>
#include <random>

#include "host/storage/archive/check.hpp"
#include "host/storage/archive/reader.hpp"
#include "host/storage/archive/recorder.hpp"
#include "host/storage/archive/ring_files.hpp"
#include "tests/host/storage/archive/archive_folder.hpp"
#include "tests/host/storage/archive/small_disk.hpp"

namespace liana::archive {
namespace {

// A refused command and an event every second, and telemetry that no compression makes small: 40 kB a second.
class Feed {
 public:
  explicit Feed(Recorder& recorder) : recorder_(recorder) {}
  void go_on(std::uint64_t seconds) {
    for (const std::uint64_t end = tick_ + seconds * kSecond; tick_ < end; tick_ += kInterval) {
      Json state = state_at(tick_);
      for (int i = 0; i < 200; ++i) state["tension_N"].push_back(std::uniform_real_distribution<>()(generator_));
      if (tick_ % kSecond == 0) state["verdict"] = verdict(++told_, false);
      recorder_.take(state);
      if (tick_ % kSecond == 0) recorder_.take(event_of(told_, tick_));
    }
  }
  std::uint64_t told() const { return told_; }

 private:
  Recorder& recorder_;
  std::mt19937_64 generator_{1};
  std::uint64_t tick_ = kInterval, told_ = 0;
};

// Takes all that is left.
void fill(const std::string& file) {
  std::ofstream out(file, std::ios::app);
  const std::string block(4096, 'x');
  while (out.write(block.data(), static_cast<std::streamsize>(block.size())).flush()) {
  }
}

// 0 when every command and event is there and every file whole; else which of them is not.
int verdict_on(const std::string& folder, std::uint64_t told) {
  const Reader reader(folder);
  if (reader.commands(kAll, true).size() != told) return 2;
  if (reader.events().size() != told) return 3;
  if (reader.gaps().empty() || reader.gaps()[0].what != "telemetry") return 4;
  if (reader.gaps().size() > 30) return 6;  // a row for each second of a full disk would fill it
  return check(folder).problems.empty() ? 0 : 5;
}

class FullDisk : public ArchiveFolder {
 protected:
  // 20 s a file.
  Recorder recorder() {
    return {folder_,          life(), kInterval,
            {.file_s = 20.0}, 0,      [this](const std::string& text, std::uint64_t) {
              alarms_.push_back(text); }};
  }
  void expect_zero(const char* size, const std::function<int()>& act) const {
    const int code = on_small_disk(folder_, size, act);
    if (code == kNoDisk) GTEST_SKIP() << "no file system can be mounted here";
    EXPECT_EQ(code, 0);
  }
  std::vector<std::string> alarms_;
};

// req:A25
TEST_F(FullDisk, DropsTheOldestTelemetryAndKeepsTheNewest) {
  expect_zero("6m", [this] {
    Recorder recorder = this->recorder();
    Feed feed(recorder);
    feed.go_on(400);  // 16 MB
    recorder.finish();
    const auto recorded = Reader(folder_).recorded();
    if (!recorded || recorded->first < 200 * kSecond || recorded->last < 399 * kSecond) return 10;
    if (alarms_.empty() || alarms_[0].find("the disk is full") == std::string::npos) return 11;
    return recorder.lost() == 0 ? verdict_on(folder_, feed.told()) : 7;
  });
}

TEST_F(FullDisk, TakesTheRingBeforeTelemetry) {
  expect_zero("6m", [this] {
    for (std::uint64_t tick = 0; tick < 5; ++tick)
      std::ofstream(ring_path(folder_, RingKind::kInputs, 1, tick)) << std::string(700000, 'x');
    Recorder recorder = this->recorder();
    Feed feed(recorder);
    feed.go_on(80);  // 3.2 MB
    recorder.finish();
    if (ring_files(folder_).size() == 5) return 11;
    const auto recorded = Reader(folder_).recorded();
    return recorded && recorded->first <= kSecond && recorder.lost() == 0 ? 0 : 12;
  });
}

// req:A25
TEST_F(FullDisk, ThatOthersFillMakesCommandsWaitUntilThereIsRoomAgain) {
  expect_zero("6m", [this] {
    Recorder recorder = this->recorder();
    Feed feed(recorder);
    feed.go_on(30);
    for (int i = 0; i < 200; ++i) {
      fill(folder_ + "/others");
      feed.go_on(1);
    }
    if (!recorder.was_disk_full()) return 9;
    if (recorder.durable() >= 2 * feed.told()) return 8;  // it was never really full
    std::filesystem::remove(folder_ + "/others");
    feed.go_on(2);
    recorder.finish();
    return recorder.lost() == 0 ? verdict_on(folder_, feed.told()) : 7;
  });
}

}  // namespace
}  // namespace liana::archive
