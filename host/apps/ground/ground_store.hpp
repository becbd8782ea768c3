// Telemetry on the ground, kept in one SQLite file: each packet once, gaps filled by asking again.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/apps/ground/gaps.hpp"
#include "host/base/json/json_fwd.hpp"
#include "host/base/net/internet_address.hpp"
#include "host/storage/archive/database.hpp"

namespace liana::ground {

// The file: table `packets` with apid, count, time_us (since 1970), service, subtype (null for time packets), packet.
class PacketFile {
 public:
  // Made when missing. Throws archive::DatabaseError.
  PacketFile(const std::string& path, archive::Database::Open how);

  // Keeps a packet; false where it is there already.
  bool add(const Telemetry& telemetry, const std::string& packet);
  // What was added since the last time is safe.
  void commit();
  // Removes what is older than `keep_s` before the newest.
  void remove_old(double keep_s);
  // Shows all packets to `gaps`, for what is missing between them.
  void begin(Gaps& gaps, double now_s) const;
  // All packets, in the order of their times.
  void read(const std::function<void(const std::string& packet)>& take) const;

 private:
  archive::Database database_;
  std::optional<archive::Statement> insert_;
  std::optional<archive::Transaction> transaction_;
};

struct StoreConfig {
  std::string file;
  api::InternetAddress telemetry, telecommand;  // of liana ground, or of a line to it
  double keep_s = 86400.0;
};

// Counts of one run.
struct StoreCounts {
  std::uint64_t packets = 0;                      // new in the file
  std::uint64_t again = 0;                        // that were there
  std::uint64_t unreadable = 0;                   // no telemetry, or a wrong checksum
  std::uint64_t found = 0, filled = 0, lost = 0;  // of gaps
  std::uint64_t questions = 0;
};

// Reads telemetry until `ended`, connecting again whenever it has to. `news` gets a line when a gap opens or is closed.
// Throws archive::DatabaseError.
StoreCounts keep_telemetry(const StoreConfig& config, const std::atomic<bool>& ended,
                           const std::function<void(const std::string& line)>& news);

}  // namespace liana::ground
