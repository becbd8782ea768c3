#include "host/cli/run_page.hpp"

#include <exception>

#include "host/view/run_folder.hpp"

namespace liana::cli {

void leave_page(const std::string& folder, std::FILE* out) {
  const std::string file = folder + "/page.html";
  try {
    if (view::is_page_built()) view::write_page(folder, file);
    std::fprintf(out, view::is_page_built() ? "page: %s\n" : "page: ./dev view makes one of %s\n",
                 view::is_page_built() ? file.c_str() : folder.c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana: this run has no page: %s\n", error.what());
  }
}

}  // namespace liana::cli
