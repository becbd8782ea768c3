#include "host/storage/archive/schema.hpp"

namespace liana::archive {

const char* const kArchiveSchema = R"(
BEGIN IMMEDIATE;
CREATE TABLE IF NOT EXISTS life(id INTEGER PRIMARY KEY, started_utc TEXT, made_by TEXT, config_hash TEXT,
  time_mode TEXT, period_s REAL, robot TEXT, scene TEXT, buses TEXT, layout TEXT, finished INTEGER DEFAULT 0);
CREATE TABLE IF NOT EXISTS event(life INTEGER, sequence INTEGER, tick INTEGER, kind TEXT, number INTEGER, subject TEXT,
  values_json TEXT, text TEXT, PRIMARY KEY(life, sequence)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS command(life INTEGER, sequence INTEGER, tick INTEGER, released INTEGER, code INTEGER,
  share REAL, name TEXT, text TEXT, remedy TEXT, margin TEXT, PRIMARY KEY(life, sequence)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS gap(life INTEGER, first_tick INTEGER, last_tick INTEGER, what TEXT, count INTEGER,
  text TEXT);
CREATE TABLE IF NOT EXISTS telemetry_file(life INTEGER, first_tick INTEGER, PRIMARY KEY(life, first_tick))
  WITHOUT ROWID;
PRAGMA user_version=1;
COMMIT;
)";

const char* const kTelemetrySchema = R"(
BEGIN IMMEDIATE;
CREATE TABLE IF NOT EXISTS telemetry(first_tick INTEGER PRIMARY KEY, last_tick INTEGER, count INTEGER, records BLOB);
CREATE TABLE IF NOT EXISTS facts(tick INTEGER PRIMARY KEY, number INTEGER, whole INTEGER, state TEXT);
PRAGMA user_version=1;
COMMIT;
)";

}  // namespace liana::archive
