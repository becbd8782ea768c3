// What the report of a run is made of: the session that watched it, and the files it left.
#pragma once

#include "host/apps/launcher/run_session.hpp"
#include "host/apps/launcher/system_layout.hpp"
#include "host/apps/report/run_report.hpp"

namespace liana::cli {

// Everything that `session`, which must outlive it, and the files of `plan` tell of a run that has ended.
report::ReportSources report_sources(const launcher::RunOptions& options, const launcher::SystemLayout& plan,
                                     const launcher::RunSession& session, const launcher::RunResult& end);

// Writes a report. What happened since its place was looked at must not lose the rest: false, with the reason on
// standard error, when it cannot be written.
bool write_report(const std::string& path, const Json& report);

}  // namespace liana::cli
