#include "host/drives/canopen/sdo_client.hpp"

#include <algorithm>

#include "host/drives/canopen/messages.hpp"

namespace liana::canopen {
namespace {

constexpr std::size_t kSegmentBytes = 7;
constexpr std::uint8_t kToggleBit = 0x10;
constexpr std::uint8_t kAbortCommandByte = 0x80;
constexpr std::uint8_t kSpecifierMask = 0xE0;

// Server command specifiers (CiA 301, 7.2.4.3), in their place in the command byte.
constexpr std::uint8_t kUploadSegmentAnswer = 0x00;
constexpr std::uint8_t kDownloadSegmentAnswer = 0x20;
constexpr std::uint8_t kUploadAnswer = 0x40;
constexpr std::uint8_t kDownloadAnswer = 0x60;

std::uint8_t toggle_bit(bool toggle) noexcept { return toggle ? kToggleBit : std::uint8_t{0}; }

}  // namespace

void SdoClient::begin(bool download, std::uint16_t index, std::uint8_t sub) noexcept {
  if (index != index_ || sub != sub_) late_answers_ = 0;  // answers name their object: none is taken for another's
  download_ = download;
  index_ = index;
  sub_ = sub;
  toggle_ = false;
  last_segment_sent_ = false;
  phase_ = Phase::kInitiate;
  status_ = SdoStatus::kBusy;
  abort_code_ = 0;
  announced_ = 0;
  is_sized_ = false;
  odd_length_.reset();
  at_ = 0;
}

void SdoClient::request(std::uint8_t command) noexcept {
  request_ = {};
  request_.id = kSdoRequestBase + node_;
  request_.length = 8;
  request_.data[0] = command;
  if (phase_ == Phase::kInitiate) put_object(request_);
  pending_ = true;
  waited_ticks_ = 0;
}

void SdoClient::start_upload(std::uint16_t index, std::uint8_t sub) noexcept {
  begin(false, index, sub);
  size_ = 0;
  request(0x40);
}

void SdoClient::start_download(std::uint16_t index, std::uint8_t sub, std::span<const std::uint8_t> bytes) noexcept {
  begin(true, index, sub);
  pending_ = false;
  if (bytes.empty() || bytes.size() > kSdoBufferBytes) {
    status_ = SdoStatus::kAborted;
    abort_code_ = kAbortMemory;
    return;
  }
  size_ = bytes.size();
  std::copy(bytes.begin(), bytes.end(), buffer_.begin());
  if (size_ <= 4) {  // expedited: 0x23, 0x27, 0x2B, 0x2F for 4, 3, 2, 1 bytes
    request(static_cast<std::uint8_t>(0x23 | ((4 - size_) << 2)));
    std::copy(bytes.begin(), bytes.end(), request_.data.begin() + 4);
    return;
  }
  request(0x21);
  put_u32(&request_.data[4], 4, static_cast<std::uint32_t>(size_));
}

bool SdoClient::take_request(bus::CanFrame& frame) noexcept {
  if (abort_pending_) {
    frame = abort_;
    abort_pending_ = false;
    return true;
  }
  if (!pending_) return false;
  frame = request_;
  pending_ = false;
  return true;
}

bool SdoClient::answers_this_object(const bus::CanFrame& frame) const noexcept {
  return get_u32(&frame.data[1], 2) == index_ && frame.data[3] == sub_;
}

bool SdoClient::answers_request(std::uint8_t command) const noexcept {
  const bool initiate = phase_ == Phase::kInitiate;
  const std::uint8_t wanted = download_ ? (initiate ? kDownloadAnswer : kDownloadSegmentAnswer)
                                        : (initiate ? kUploadAnswer : kUploadSegmentAnswer);
  return (command & kSpecifierMask) == wanted;
}

// A server answers in order, so that a write's answer after its time comes before that of the read-back. An abort does
// not say which of the two it answers.
bool SdoClient::is_late(const bus::CanFrame& frame) noexcept {
  const std::uint8_t given_up = late_download_ ? kDownloadAnswer : kUploadAnswer;
  const bool fits = frame.data[0] == kAbortCommandByte || (frame.data[0] & kSpecifierMask) == given_up;
  if (late_answers_ == 0 || late_download_ == download_ || !fits) return false;
  --late_answers_;
  return true;
}

void SdoClient::on_response(const bus::CanFrame& frame) noexcept {
  if (status_ != SdoStatus::kBusy || pending_) return;
  if (frame.length != 8) {
    if (frame.length < 4 || answers_this_object(frame)) odd_length_ = frame.length;
    return;
  }
  const bool names_object = phase_ == Phase::kInitiate || frame.data[0] == kAbortCommandByte;
  if (names_object && (!answers_this_object(frame) || is_late(frame))) return;
  if (frame.data[0] == kAbortCommandByte) {
    status_ = SdoStatus::kAborted;
    abort_code_ = get_u32(&frame.data[4], 4);
    return;
  }
  if (!answers_request(frame.data[0])) return;
  if (download_) return on_download_answer(frame);
  if (phase_ == Phase::kInitiate) return on_upload_initiated(frame);
  on_upload_segment(frame);
}

void SdoClient::on_upload_initiated(const bus::CanFrame& frame) noexcept {
  const std::uint8_t command = frame.data[0];
  const bool sized = is_sized_ = (command & 1) != 0;
  if ((command & 2) != 0) {
    size_ = sized ? 4U - ((command >> 2) & 3U) : 4U;
    std::copy_n(frame.data.begin() + 4, size_, buffer_.begin());
    status_ = SdoStatus::kDone;
    return;
  }
  announced_ = sized ? get_u32(&frame.data[4], 4) : 0;
  if (announced_ > kSdoBufferBytes) return fail(kAbortMemory);
  phase_ = Phase::kSegments;
  request_upload_segment();
}

void SdoClient::request_upload_segment() noexcept { request(static_cast<std::uint8_t>(0x60 | toggle_bit(toggle_))); }

void SdoClient::on_upload_segment(const bus::CanFrame& frame) noexcept {
  const std::uint8_t command = frame.data[0];
  if ((command & kToggleBit) != toggle_bit(toggle_)) return fail(kAbortToggle);
  const std::size_t count = kSegmentBytes - ((command >> 1) & 7U);
  const bool last = (command & 1) != 0;
  if (count == 0 && !last) return fail(kAbortCommand);  // it would go on for ever
  if (size_ + count > kSdoBufferBytes) return fail(kAbortMemory);
  std::copy_n(frame.data.begin() + 1, count, buffer_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ += count;
  toggle_ = !toggle_;
  if (!last) return request_upload_segment();
  if (announced_ != 0 && announced_ != size_) return fail(kAbortGeneral);
  status_ = SdoStatus::kDone;
}

void SdoClient::on_download_answer(const bus::CanFrame& frame) noexcept {
  const std::uint8_t command = frame.data[0];
  if (phase_ == Phase::kInitiate) {
    if (size_ <= 4) {
      status_ = SdoStatus::kDone;
      return;
    }
    phase_ = Phase::kSegments;
    return request_download_segment();
  }
  if ((command & kToggleBit) != toggle_bit(toggle_)) return fail(kAbortToggle);
  toggle_ = !toggle_;
  if (!last_segment_sent_) return request_download_segment();
  status_ = SdoStatus::kDone;
}

void SdoClient::request_download_segment() noexcept {
  const std::size_t count = std::min(size_ - at_, kSegmentBytes);
  last_segment_sent_ = at_ + count == size_;
  request(
      static_cast<std::uint8_t>(toggle_bit(toggle_) | ((kSegmentBytes - count) << 1) | (last_segment_sent_ ? 1U : 0U)));
  std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(at_), count, request_.data.begin() + 1);
  at_ += count;
}

void SdoClient::tick() noexcept {
  if (status_ != SdoStatus::kBusy) return;
  if (++waited_ticks_ < timeout_ticks_) return;
  if (pending_) {  // the bus never took the request: the server knows nothing of it
    pending_ = false;
    abort_code_ = kAbortTimeout;
  } else {
    late_answers_ = late_download_ == download_ ? late_answers_ + 1 : 1;
    late_download_ = download_;
    fail(kAbortTimeout);
  }
  status_ = SdoStatus::kTimeout;
}

// Tells the server too, so that it does not wait for the rest.
void SdoClient::fail(std::uint32_t code) noexcept {
  status_ = SdoStatus::kAborted;
  abort_code_ = code;
  abort_ = {kSdoRequestBase + node_, 8, {kAbortCommandByte}, 0};
  put_object(abort_);
  put_u32(&abort_.data[4], 4, code);
  abort_pending_ = true;
}

void SdoClient::put_object(bus::CanFrame& frame) const noexcept {
  put_u32(&frame.data[1], 2, index_);
  frame.data[3] = sub_;
}

std::uint32_t SdoClient::value() const noexcept { return get_u32(buffer_.data(), std::min<std::size_t>(size_, 4)); }

}  // namespace liana::canopen
