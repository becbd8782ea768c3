// MCAP files (https://mcap.dev/spec): a writer of chunked, indexed and, where the build can, compressed files, and a
// reader of those, and of files without chunks.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "host/storage/recording/crc32.hpp"
#include "host/storage/recording/mcap_summary.hpp"

namespace liana::recording {

// A channel and the schema of its messages.
struct McapChannel {
  std::string topic, message_encoding, schema_encoding, schema;
  std::string schema_name{};  // empty: the topic's
  std::map<std::string, std::string> metadata{};
};

class McapWriter {
 public:
  // Creates the file; throws std::runtime_error with the system's reason.
  // `profile`: what readers may expect of all channels (https://mcap.dev/spec/registry).
  McapWriter(const std::string& path, const std::string& library, const std::string& profile = "liana");
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  // Declares a channel with a schema of its own; returns its id (1, 2, ...).
  std::uint16_t add_channel(const McapChannel& wanted);
  void add_metadata(const std::string& name, const std::map<std::string, std::string>& values);
  void write_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time_ns, std::string_view data);
  // Hands all that was written so far to the system: it outlives the process.
  void flush() { close_chunk(); }
  // The disk has refused a write since the file was made: what follows it is no use.
  bool has_failed() const { return failure_ != 0; }
  // Ends the file properly, with the checksums of the format (data section, summary); throws std::runtime_error when
  // the disk refused any write. A file without it can still be read.
  void finish();

 private:
  void note(bool good);
  std::uint64_t record(std::uint8_t opcode, std::string_view content);  // returns where it begins
  void close_chunk();
  void write(std::string_view bytes);

  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  std::string path_;
  std::string buffer_;
  Crc32 crc_;                  // of all that was written
  std::uint64_t written_ = 0;  // bytes
  mcap::OpenChunk chunk_;
  mcap::Summary summary_;
  std::uint16_t channels_ = 0;
  int failure_ = 0;  // errno of the first write that failed
};

// What a reader calls; unset members are skipped.
struct McapVisitor {
  std::function<void(const std::string& topic, std::uint32_t sequence, std::uint64_t time_ns, std::string_view data)>
      message;
  std::function<void(const std::string& name, const std::map<std::string, std::string>& values)> metadata;
};

enum class McapState : std::uint8_t {
  kWhole,     // finished properly, and every byte is as it was written
  kCutShort,  // ends before its end record: nothing vouches for what is there
  kDamaged,   // some byte is not as it was written
};

// Reads a whole file in order and visits what is there, damaged or not. Throws std::runtime_error when it cannot be
// opened, is no MCAP file, or is damaged so that its records cannot be told apart.
McapState read_mcap(const std::string& path, const McapVisitor& visitor);

}  // namespace liana::recording
