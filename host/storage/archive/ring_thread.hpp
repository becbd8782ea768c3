// The ring in a thread of its own: whatever its disk does, events and commands do not wait for it.
#pragma once

#include <cstdint>
#include <string>
#include <thread>

#include "host/storage/archive/inbox.hpp"
#include "host/storage/archive/ring.hpp"
#include "host/storage/archive/rows.hpp"

namespace liana::archive {

// A gap on its way to the recorder, and there: `{"op":"gap",...}`.
Json gap_message(const Gap& gap);
Gap gap_from(const Json& message);

class RingThread {
 public:
  // Gaps go to `recorder`, which must outlive this.
  RingThread(const std::string& folder, std::uint64_t life, const Life& about, Inbox& recorder);
  // Writes what waits, also where finish() was not called.
  ~RingThread();

  // Whatever came from lianad; ticks, faults and stops are taken. In virtual time waits for the thread, so that nothing
  // is lost; in real time ticks that find its inbox full are lost, and counted by the ring.
  // `message`: null for a packet that is no JSON.
  void take(const std::string& packet, const Json& message);
  // Writes what waits and ends the files. Nothing is taken any more.
  void finish();
  // It went on to the end; after finish().
  bool is_good() const { return is_good_; }
  // Says how many ticks were taken and lost; after finish().
  void tell() const;

 private:
  void write_until_closed();
  void write(const Inbox::Letter& letter);

  const bool waits_;
  Inbox& recorder_;
  Inbox inbox_;
  Ring ring_;
  bool is_good_ = false;
  std::thread thread_;
};

}  // namespace liana::archive
