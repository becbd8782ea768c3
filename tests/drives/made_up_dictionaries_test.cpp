// Dictionaries drawn by seed: objects missing, read-only, with other values; slow to answer, slow to start, late to get
// power. Each drive boots, or is refused with exactly the objects that are in the way, as counted here from CiA 301 and
// 402, not by the boot's own plan.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <set>

#include "tests/drives/drive_channel.hpp"

namespace liana {
namespace {

using Place = std::pair<std::uint16_t, std::uint8_t>;

constexpr std::uint32_t kCounts = 65536;

// What the boot wants of an object, said once more.
struct Wanted {
  std::int64_t value;     // that it must have, or at least, or is told to have
  bool is_told = false;   // written; else only read
  bool is_least = false;  // more is right, too
  bool must_exist = false;
};

const std::map<Place, Wanted>& wanted() {
  static const std::map<Place, Wanted> all = {{{0x6502, 0}, {0x80, false, false, true}},
                                              {{0x608F, 1}, {kCounts}},
                                              {{0x6076, 0}, {9000}},
                                              {{0x607E, 0}, {0}},
                                              {{0x60A8, 0}, {0x00B50000, true}},
                                              {{0x6080, 0}, {7, false, true}},
                                              {{0x607F, 0}, {7000, false, true}},
                                              {{0x60C5, 0}, {70000, false, true}},
                                              {{0x6085, 0}, {70000, false, true}},
                                              {{0x6060, 0}, {8, true, false, true}},
                                              {{0x60C2, 1}, {4, true, false, true}},
                                              {{0x60C2, 2}, {-3, true, false, true}},
                                              {{0x6072, 0}, {1000, true}},
                                              {{0x6065, 0}, {3476, true}},
                                              {{0x6066, 0}, {100, true}},
                                              {{0x605A, 0}, {2, true}},
                                              {{0x605E, 0}, {2, true}},
                                              {{0x6007, 0}, {3, true}},
                                              {{0x1017, 0}, {100, true, false, true}},
                                              {{0x1400, 5}, {12, true}}};
  return all;
}

bench::AddedObject added(std::uint16_t index, const char* type, std::int64_t value) {
  return {{index, {}}, type, false, value, {}, {}};
}

// One made-up drive, what its type allows it, and which objects are in its way.
struct MadeUp {
  bench::DriveSettings settings;
  config::DriveTimes allowed;
  double power_s = 0.0;  // before this it has no power
  std::set<Place> in_the_way;
};

// An answer may take 1 s, three times over since it is asked for three times, and the boot-up message 10 s, unless a
// type says more: among these some are slower than that.
constexpr int kAsked = 3;
constexpr std::array<double, 3> kAnswers_s{0.02, 0.3, 1.3}, kResets_s{0.6, 2.5, 6.5};
constexpr double kSlowAnswer_s = 3.5, kSlowReset_s = 11.5, kLatePower_s = 4.0;
constexpr Place kSilent{0xFFFF, 0}, kNoObject{0, 0};

std::uint64_t as_us(double seconds) { return static_cast<std::uint64_t>(std::llround(1e6 * seconds)); }

// How long the drive takes, and whether its type knows: what is too slow is all that is named.
template <typename OneIn>
void draw_times(std::mt19937& random, const OneIn& one_in, MadeUp& drive) {
  double answer_s = one_in(3) ? kAnswers_s[random() % 3] : 0.0, reset_s = one_in(3) ? kResets_s[random() % 3] : 0.0;
  if (one_in(5)) drive.power_s = kLatePower_s;
  if (one_in(8)) answer_s = kSlowAnswer_s;
  if (one_in(10)) reset_s = kSlowReset_s;
  if (one_in(3)) drive.allowed = {1.5, 20.0, 2.0};
  drive.settings.dictionary.sdo_us = as_us(answer_s);
  drive.settings.dictionary.reset_us = as_us(reset_s);
  if (answer_s > kAsked * drive.allowed.sdo_answer_s) drive.in_the_way = {kSilent};
  if (drive.power_s + reset_s > drive.allowed.boot_up_s) drive.in_the_way = {kNoObject};
}

MadeUp make_up(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto one_in = [&](unsigned count) { return random() % count == 0; };
  MadeUp drive;
  drive.settings.vendor = 0x4C49;
  drive.settings.product = drive.settings.revision = 1;
  drive.settings.serial = 1001;
  bench::DictionaryConfig& dictionary = drive.settings.dictionary;
  dictionary.added = {added(0x60A8, "u32", 0x00B50000), added(0x607E, "u8", 0), added(0x607F, "u32", 20000),
                      added(0x6080, "u32", 3000), added(0x60C5, "u32", 900000)};
  const bool is_by_the_book = one_in(3);  // then only its times are odd
  for (const auto& [place, want] : wanted()) {
    const bench::ObjectPlace there{place.first, place.second};
    if (is_by_the_book) {
      dictionary.values[there] = want.value;
      continue;
    }
    if (one_in(6)) {
      dictionary.absent.push_back(there);
      if (want.must_exist) drive.in_the_way.insert(place);
      continue;
    }
    const bool is_other = one_in(5);
    std::int64_t value = want.value;
    if (is_other) value = want.is_least ? want.value - 1 : (place.first == 0x607E ? 0x80 : want.value + 1);
    if (place.first == 0x6502 && is_other) value = 0x01;
    dictionary.values[there] = value;
    const bool is_fixed = one_in(4);
    if (is_fixed) dictionary.read_only.push_back(there);
    const bool stays_wrong = is_other && (!want.is_told || is_fixed);
    if (stays_wrong) drive.in_the_way.insert(place);
  }
  draw_times(random, one_in, drive);
  return drive;
}

canopen::ExpectedDrive expectation() {
  canopen::ExpectedDrive drive = test::expectation();
  drive.serial = 1001;
  return drive;
}

std::set<Place> named(const test::BootedDrive& bench) {
  std::set<Place> out;
  for (const canopen::BootMismatch& mismatch : bench.boot.mismatches(0)) {
    const bool is_silent = mismatch.failure == canopen::BootFailure::kNoAnswer;
    out.insert(is_silent ? kSilent : Place{mismatch.index, mismatch.sub});
  }
  return out;
}

TEST(MadeUpDictionaries, EachBootsOrIsRefusedWithEveryReasonNamed) {
  int booted = 0, slow = 0;
  std::set<Place> too_slow;
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    const MadeUp drive = make_up(seed);
    canopen::ExpectedDrive expected = expectation();
    expected.type.times = drive.allowed;
    test::BootedDrive bench(expected, drive.settings);
    bench.power_us = as_us(drive.power_s);
    bench.run_boot();
    EXPECT_EQ(named(bench), drive.in_the_way) << "seed " << seed << ": " << bench.refusals();
    EXPECT_EQ(bench.boot.state(),
              drive.in_the_way.empty() ? canopen::BootState::kOperational : canopen::BootState::kFailed)
        << "seed " << seed;
    booted += drive.in_the_way.empty() ? 1 : 0;
    for (const Place& place : {kSilent, kNoObject})
      if (drive.in_the_way.contains(place)) too_slow.insert(place);
    const bool is_slow = drive.power_s + 1e-6 * static_cast<double>(drive.settings.dictionary.reset_us) > 2.0 ||
                         drive.settings.dictionary.sdo_us > as_us(0.2);
    slow += drive.in_the_way.empty() && is_slow ? 1 : 0;
  }
  EXPECT_GT(slow, 5) << "the draw has to leave some that boot slowly";
  EXPECT_GT(booted, 10) << "the draw has to leave some that boot";
  EXPECT_LT(booted, 48) << "and some that do not";
  std::printf("%d of 50 booted, %d of them slow or late\n", booted, slow);
  EXPECT_EQ(too_slow.size(), 2U) << "among them some that never answer, and some that never start";
}

}  // namespace
}  // namespace liana
