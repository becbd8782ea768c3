// SDO client for one node (CiA 301, 7.2.4): expedited and segmented transfers. Never waits; time is counted in ticks.
//
// A transfer always ends: each request has `timeout_ticks` for its answer, whatever else is heard meanwhile, and an
// object has at most kSdoBufferBytes, of which every segment brings one at least. What comes on the node's COB-ID but
// answers nothing that was asked (another tool's transfer, an answer after its time) is ignored.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "host/drives/bus/can_frame.hpp"

namespace liana::canopen {

constexpr std::size_t kSdoBufferBytes = 64;  // longest object that can be read or written

// Abort codes the client itself uses; a server may send any.
constexpr std::uint32_t kAbortToggle = 0x05030000;
constexpr std::uint32_t kAbortTimeout = 0x05040000;
constexpr std::uint32_t kAbortCommand = 0x05040001;
constexpr std::uint32_t kAbortMemory = 0x05040005;
constexpr std::uint32_t kAbortNoObject = 0x06020000;
constexpr std::uint32_t kAbortNoSubIndex = 0x06090011;
constexpr std::uint32_t kAbortGeneral = 0x08000000;

// Text of an abort code as CiA 301 defines it; "unknown abort code" for others.
const char* abort_text(std::uint32_t code) noexcept;

enum class SdoStatus : std::uint8_t {
  kIdle,     // no transfer was started
  kBusy,     // waiting for the server
  kDone,     // finished; data() holds what was read
  kAborted,  // the server (or this end, for protocol errors) aborted: abort_code()
  kTimeout   // the server did not answer
};

class SdoClient {
 public:
  // Talks to `node` 1..127; gives up `timeout_ticks` (at least 1) ticks after a request without its answer.
  SdoClient(std::uint8_t node, std::uint32_t timeout_ticks) noexcept : node_(node), timeout_ticks_(timeout_ticks) {}

  // Begins to read an object; the request is ready in take_request().
  void start_upload(std::uint16_t index, std::uint8_t sub) noexcept;
  // Begins to write 1..kSdoBufferBytes bytes (more are refused with kAborted, kAbortMemory).
  void start_download(std::uint16_t index, std::uint8_t sub, std::span<const std::uint8_t> bytes) noexcept;
  // The next frame to send, if there is one: of a transfer that was given up first the abort, which frees the server.
  bool take_request(bus::CanFrame& frame) noexcept;
  // A frame with COB-ID 0x580 + node.
  void on_response(const bus::CanFrame& frame) noexcept;
  // One tick has passed.
  void tick() noexcept;

  SdoStatus status() const noexcept { return status_; }
  std::uint32_t abort_code() const noexcept { return abort_code_; }
  // What was read.
  std::span<const std::uint8_t> data() const noexcept { return {buffer_.data(), size_}; }
  // How many bytes the server said that the object has; 0: it did not say, or nothing was read.
  std::size_t said_bytes() const noexcept { return is_sized_ ? size_ : 0; }
  // Bytes of an answer for this object that is none, since it has not 8 (CiA 301, 7.2.4.3); nothing: none came.
  std::optional<std::uint8_t> odd_length() const noexcept { return odd_length_; }
  // The first four bytes of it (or fewer) as a little-endian number.
  std::uint32_t value() const noexcept;
  std::uint8_t node() const noexcept { return node_; }

 private:
  enum class Phase : std::uint8_t { kInitiate, kSegments };
  void begin(bool download, std::uint16_t index, std::uint8_t sub) noexcept;
  void request(std::uint8_t command) noexcept;
  void on_upload_initiated(const bus::CanFrame& frame) noexcept;
  void on_upload_segment(const bus::CanFrame& frame) noexcept;
  void on_download_answer(const bus::CanFrame& frame) noexcept;
  void request_upload_segment() noexcept;
  void request_download_segment() noexcept;
  bool answers_this_object(const bus::CanFrame& frame) const noexcept;
  bool answers_request(std::uint8_t command) const noexcept;
  bool is_late(const bus::CanFrame& frame) noexcept;
  void put_object(bus::CanFrame& frame) const noexcept;
  void fail(std::uint32_t code) noexcept;

  std::uint8_t node_;
  std::uint32_t timeout_ticks_;
  std::uint32_t waited_ticks_ = 0;
  std::uint16_t index_ = 0;
  std::uint8_t sub_ = 0;
  bool download_ = false;
  bool toggle_ = false;
  bool last_segment_sent_ = false;
  bool pending_ = false;            // request_ is waiting to be taken
  bool abort_pending_ = false;      // abort_ is, before it
  std::uint32_t late_answers_ = 0;  // to requests for this object that were given up, and may still come
  bool late_download_ = false;      // what those requests were
  Phase phase_ = Phase::kInitiate;
  SdoStatus status_ = SdoStatus::kIdle;
  std::uint32_t abort_code_ = 0;
  std::optional<std::uint8_t> odd_length_;
  std::array<std::uint8_t, kSdoBufferBytes> buffer_{};
  std::size_t size_ = 0;       // bytes in buffer_
  bool is_sized_ = false;      // the server said how many they are
  std::size_t announced_ = 0;  // upload: size the server announced, 0 = none
  std::size_t at_ = 0;         // download: bytes already sent
  bus::CanFrame request_;
  bus::CanFrame abort_;
};

}  // namespace liana::canopen
