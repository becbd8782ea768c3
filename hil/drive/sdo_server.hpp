// SDO server: expedited and segmented transfers, one at a time. Block transfer is refused.
#pragma once

#include <functional>
#include <string>

#include "hil/drive/can_frame.hpp"
#include "hil/drive/object_dictionary.hpp"

namespace liana::bench {

class SdoServer {
 public:
  // May refuse a write that type and range allow: gets the object and the new value, gives an abort code or kNone.
  using Guard = std::function<std::uint32_t(const Object&, std::int64_t)>;
  // Told after every accepted write.
  using Written = std::function<void(const Object&)>;

  SdoServer(ObjectDictionary& objects, Guard guard, Written written);

  // Answers one 8-byte request; frames of another length are ignored (false).
  bool answer(const CanFrame& request, CanFrame& response);
  std::uint32_t abort_count() const { return aborts_; }

 private:
  enum class Transfer : std::uint8_t { kIdle, kUpload, kDownload };

  void start_upload(const CanFrame& request, CanFrame& response);
  void next_upload(const CanFrame& request, CanFrame& response);
  void start_download(const CanFrame& request, CanFrame& response);
  void next_download(const CanFrame& request, CanFrame& response);
  std::uint32_t write(const std::string& bytes);
  void abort(std::uint32_t code, CanFrame& response);

  ObjectDictionary& objects_;
  Guard guard_;
  Written written_;
  Transfer transfer_ = Transfer::kIdle;
  std::uint16_t index_ = 0;
  std::uint8_t sub_ = 0;
  bool toggle_ = false;
  std::string buffer_;
  std::uint32_t aborts_ = 0;
};

}  // namespace liana::bench
