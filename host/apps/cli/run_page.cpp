#include "host/apps/cli/run_page.hpp"

#include <exception>

#include "host/apps/run_page/run_folder.hpp"
#include "host/base/install_paths/places.hpp"

namespace liana::cli {

void leave_page(const std::string& folder, std::FILE* out) {
  const std::string file = folder + "/page.html";
  try {
    if (run_page::is_page_built()) run_page::write_page(folder, file);
    if (run_page::is_page_built()) {
      std::fprintf(out, "page: %s\n", file.c_str());
    } else {
      std::fprintf(out, "page: %s makes one of %s\n", install_paths::is_installed() ? "liana view" : "./dev view",
                   folder.c_str());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana: this run has no page: %s\n", error.what());
  }
}

}  // namespace liana::cli
