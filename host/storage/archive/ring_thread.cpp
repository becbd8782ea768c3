#include "host/storage/archive/ring_thread.hpp"

#include <cstdio>
#include <stdexcept>

namespace liana::archive {
namespace {

constexpr std::size_t kMaxQueuedWrites = 2500;  // 10 s at 250 Hz, 5 MB

// Around which the Outputs are kept.
bool is_moment(const Json& message) {
  if (message.value("op", "") != "event") return false;
  const std::string kind = message.value("kind", "");
  return kind == "fault" || kind == "stop";
}

}  // namespace

Json gap_message(const Gap& gap) {
  return {{"op", "gap"},      {"first_tick", gap.first_tick}, {"last_tick", gap.last_tick},
          {"what", gap.what}, {"count", gap.count},           {"text", gap.text}};
}

Gap gap_from(const Json& message) {
  return {message.at("first_tick"), message.at("last_tick"), message.at("what").text(), message.at("count"),
          message.at("text").text()};
}

RingThread::RingThread(const std::string& folder, std::uint64_t life, const Life& about, Inbox& recorder)
    : waits_(about.time_mode != "real"),
      recorder_(recorder),
      inbox_(kMaxQueuedWrites),
      ring_(folder, life, about, {},
            [this](const Gap& gap) {
              recorder_.put({{}, gap_message(gap)});
            }),
      thread_([this] { write_until_closed(); }) {}

RingThread::~RingThread() { finish(); }

void RingThread::take(const std::string& packet, const Json& message) {
  if (!message.is_null() && !is_moment(message)) return;
  if (waits_) {
    inbox_.put({packet, message});
  } else {
    inbox_.try_put({packet, message});
  }
}

void RingThread::write(const Inbox::Letter& letter) {
  if (letter.message.is_null()) return ring_.take(letter.packet);
  ring_.keep_around(letter.message.at("tick"));
}

// What goes wrong ends the ring and nothing else; the archive says so.
void RingThread::write_until_closed() {
  try {
    while (const auto letter = inbox_.take()) write(*letter);
    ring_.finish();
    is_good_ = true;
  } catch (const std::runtime_error& error) {
    inbox_.close();
    recorder_.put({{}, gap_message({0, 0, "ticks", 0, std::string("the ring has ended: ") + error.what()})});
  }
}

void RingThread::finish() {
  inbox_.close();
  if (thread_.joinable()) thread_.join();
}

void RingThread::tell() const {
  std::printf("liana-archive: %llu ticks in the ring, %llu missing\n", static_cast<unsigned long long>(ring_.ticks()),
              static_cast<unsigned long long>(ring_.missing()));
}

}  // namespace liana::archive
