// Runs of this user that left a folder, as far as a browser may see them: their names and their pages.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "host/base/json/json_fwd.hpp"

namespace liana::gateway {

// [{"name":"liana-run-a1b2c3","changed_s":1700000000,"page":true}], the one that changed last first; `page`: it has
// one. With the client's `ticket` each run has its own, see run_ticket().
Json run_list(const std::string& folder, std::string_view ticket);

// The file with the page of a run; nothing for a run without one, for a link or pipe in its place, and for what is no
// name of letters, digits, _ - and . that begins with none of these signs but _.
std::optional<std::string> run_page(const std::string& folder, const std::string& name);

}  // namespace liana::gateway
