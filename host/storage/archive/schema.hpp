// The tables of both kinds of files; docs/reference/archive.md explains them to people who open them with other tools.
#pragma once

namespace liana::archive {

constexpr const char* kArchiveFile = "archive.db";  // life, event, command, gap, telemetry_file: never dropped
// `PRAGMA user_version` of both is 1.
extern const char* const kArchiveSchema;
extern const char* const kTelemetrySchema;

}  // namespace liana::archive
