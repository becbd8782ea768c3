#include "hil/drive/sdo_server.hpp"

#include <algorithm>
#include <utility>

namespace liana::bench {

namespace {

constexpr std::size_t kSegment = 7;       // data bytes of one segment
constexpr std::size_t kMaxDownload = 64;  // no object is longer

const std::uint8_t* bytes_of(const std::string& text) { return reinterpret_cast<const std::uint8_t*>(text.data()); }

std::string encode(const Object& object) {
  if (object.type == ObjectType::kText) return object.text;
  std::string bytes(size_of(object.type), '\0');
  put_little_endian(reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size(),
                    static_cast<std::uint64_t>(object.value));
  return bytes;
}

}  // namespace

SdoServer::SdoServer(ObjectDictionary& objects, Guard guard, Written written)
    : objects_(objects), guard_(std::move(guard)), written_(std::move(written)) {}

bool SdoServer::answer(const CanFrame& request, CanFrame& response) {
  if (request.length != 8) return false;
  response.length = 8;
  response.data = {};
  const unsigned command = request.data[0] >> 5;
  if (command == 4) {  // the client aborts; that has no answer
    transfer_ = Transfer::kIdle;
    return false;
  }
  if (command == 1 || command == 2) {
    index_ = static_cast<std::uint16_t>(get_little_endian(&request.data[1], 2));
    sub_ = request.data[3];
  }
  switch (command) {
    case 0:
      next_download(request, response);
      break;
    case 1:
      start_download(request, response);
      break;
    case 2:
      start_upload(request, response);
      break;
    case 3:
      next_upload(request, response);
      break;
    default:
      abort(abort_code::kCommand, response);
  }
  return true;
}

void SdoServer::start_upload(const CanFrame&, CanFrame& response) {
  const std::uint32_t refused = objects_.check_read(index_, sub_);
  if (refused != abort_code::kNone) return abort(refused, response);
  buffer_ = encode(*objects_.find_public(index_, sub_));
  put_little_endian(&response.data[1], 2, index_);
  response.data[3] = sub_;
  if (buffer_.size() <= 4) {
    transfer_ = Transfer::kIdle;
    response.data[0] = static_cast<std::uint8_t>(0x43U | ((4U - buffer_.size()) << 2U));
    std::copy(buffer_.begin(), buffer_.end(), response.data.begin() + 4);
    return;
  }
  transfer_ = Transfer::kUpload;
  toggle_ = false;
  response.data[0] = 0x41;
  put_little_endian(&response.data[4], 4, buffer_.size());
}

void SdoServer::next_upload(const CanFrame& request, CanFrame& response) {
  if (transfer_ != Transfer::kUpload) return abort(abort_code::kCommand, response);
  if (((request.data[0] & 0x10) != 0) != toggle_) return abort(abort_code::kToggle, response);
  const std::size_t count = std::min(buffer_.size(), kSegment);
  const bool last = count == buffer_.size();
  response.data[0] = static_cast<std::uint8_t>((toggle_ ? 0x10U : 0U) | ((kSegment - count) << 1U) | (last ? 1U : 0U));
  std::copy_n(buffer_.begin(), count, response.data.begin() + 1);
  buffer_.erase(0, count);
  toggle_ = !toggle_;
  if (last) transfer_ = Transfer::kIdle;
}

void SdoServer::start_download(const CanFrame& request, CanFrame& response) {
  const bool expedited = (request.data[0] & 2) != 0;
  const bool sized = (request.data[0] & 1) != 0;
  transfer_ = Transfer::kIdle;
  if (expedited) {
    const Object* object = objects_.find_public(index_, sub_);
    // Without a size the object's own is meant.
    const std::size_t unsized = object == nullptr ? 4 : std::min<std::size_t>(4, size_of(object->type));
    const std::size_t count = sized ? 4U - ((request.data[0] >> 2U) & 3U) : unsized;
    const std::uint32_t refused =
        write(std::string(request.data.begin() + 4, request.data.begin() + 4 + static_cast<std::ptrdiff_t>(count)));
    if (refused != abort_code::kNone) return abort(refused, response);
  } else {
    if (sized && get_little_endian(&request.data[4], 4) > kMaxDownload) return abort(abort_code::kTooLong, response);
    transfer_ = Transfer::kDownload;
    toggle_ = false;
    buffer_.clear();
  }
  response.data[0] = 0x60;
  put_little_endian(&response.data[1], 2, index_);
  response.data[3] = sub_;
}

void SdoServer::next_download(const CanFrame& request, CanFrame& response) {
  if (transfer_ != Transfer::kDownload) return abort(abort_code::kCommand, response);
  if (((request.data[0] & 0x10) != 0) != toggle_) return abort(abort_code::kToggle, response);
  const std::size_t count = kSegment - ((request.data[0] >> 1U) & 7U);
  buffer_.append(request.data.begin() + 1, request.data.begin() + 1 + static_cast<std::ptrdiff_t>(count));
  if (buffer_.size() > kMaxDownload) return abort(abort_code::kTooLong, response);
  response.data[0] = static_cast<std::uint8_t>(0x20U | (toggle_ ? 0x10U : 0U));
  toggle_ = !toggle_;
  if ((request.data[0] & 1) == 0) return;
  transfer_ = Transfer::kIdle;
  const std::uint32_t refused = write(buffer_);
  if (refused != abort_code::kNone) abort(refused, response);
}

std::uint32_t SdoServer::write(const std::string& bytes) {
  const std::uint32_t refused = objects_.check_write(index_, sub_, bytes_of(bytes), bytes.size());
  if (refused != abort_code::kNone) return refused;
  Object& object = *objects_.find_public(index_, sub_);
  const std::int64_t value = decode(object.type, bytes_of(bytes));
  const std::uint32_t guarded = guard_(object, value);
  if (guarded != abort_code::kNone) return guarded;
  object.value = value;
  written_(object);
  return abort_code::kNone;
}

void SdoServer::abort(std::uint32_t code, CanFrame& response) {
  ++aborts_;
  transfer_ = Transfer::kIdle;
  response.data = {};
  response.data[0] = 0x80;
  put_little_endian(&response.data[1], 2, index_);
  response.data[3] = sub_;
  put_little_endian(&response.data[4], 4, code);
}

}  // namespace liana::bench
