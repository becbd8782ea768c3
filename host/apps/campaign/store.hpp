// The database of a campaign: one SQLite file with a row for each run (docs/how-to/run-a-campaign.md).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "host/apps/campaign/result.hpp"
#include "host/apps/campaign/rows.hpp"
#include "host/base/net/socket.hpp"
#include "host/storage/archive/database.hpp"

namespace liana::campaign {

// A row as it is in the database.
struct StoredRow {
  RowResult result;
  std::uint64_t seed = 0;
  Json values;
  std::string command;
  std::string kept;  // folder of the repeated run, empty: none

  bool is_success() const { return result.outcome == "success"; }
};

// What a database is about.
struct Campaign {
  std::string name;
  Json table;              // without the folder that it was read from
  std::string programs;    // SHA-256 over the programs that carry out a run
  std::uint64_t rows = 0;  // that there are to be
};

// Writes rows; one process at a time.
class Store {
 public:
  // Opens or makes the file; `campaign` must be the one that it was made for. Throws launcher::BadInput with what is
  // different, when another process writes it, or when it is no database of a campaign.
  Store(const std::string& path, const Campaign& campaign);

  // Rows that are there: configuration hash by number.
  std::map<std::uint64_t, std::string> done() const;
  // Failed rows with the lowest numbers, at most `count`, that are not kept yet.
  std::vector<std::uint64_t> failed_not_kept(std::uint64_t count) const;

  void put(const Row& row, const std::string& command, const RowResult& result);
  // Notes where a repeated row is; false when its report differs from that of the first run.
  bool put_kept(const RowResult& repeated, const std::string& folder);
  // Leaves one plain file.
  void finish();

 private:
  api::UniqueFd lock_;
  archive::Database database_;
  archive::Statement insert_;
};

// What a database holds, for reading; it may still grow.
struct Stored {
  Campaign campaign;
  std::vector<StoredRow> rows;  // by number
};

// Throws launcher::BadInput for a file that is no database of a campaign.
Stored read_store(const std::string& path);

}  // namespace liana::campaign
