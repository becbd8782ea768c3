#include <cstdio>

#include "host/apps/cli/commands.hpp"
#include "host/apps/report/doctor.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

void print_text(const std::vector<report::Finding>& findings) {
  for (const report::Finding& one : findings) {
    std::printf("%s %-20s %s\n", one.good ? "yes" : " no", one.name.c_str(), one.found.c_str());
    std::printf("    what for: %s\n", one.meaning.c_str());
    if (!one.good) std::printf("    to do:    %s\n", one.action.c_str());
  }
  std::puts("Nothing of this is needed for: liana run slit_crossing (embedded bus, virtual time).");
}

}  // namespace

int doctor_command(const DoctorOptions& options) {
  const auto findings = report::examine_host();
  if (options.json) {
    std::puts(Json{{"findings", report::findings_json(findings)}}.dump().c_str());
  } else {
    print_text(findings);
  }
  return 0;
}

}  // namespace liana::cli
