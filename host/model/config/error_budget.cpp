#include "host/model/config/error_budget.hpp"

#include <algorithm>

#include "firmware_like/math/trig.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/field.hpp"

namespace liana::config {
namespace {

constexpr std::size_t kLongestName = 60;

std::string read_text(const Field& field) {
  const Json& value = field.json();
  if (!value.is_string() || value.text().empty() || value.text().size() > kLongestName)
    field.refuse("a text of 1 to " + std::to_string(kLongestName) + " bytes", "say what it is");
  return value.text();
}

double read_if_there(const Field& table, const char* key, double most) {
  return table.json().contains(key) ? table.at(key).number({0.0, most}) : 0.0;
}

ErrorSource read_error(const Field& field) {
  field.only({"name", "position_m", "angle_deg"});
  return {read_text(field.at("name")), read_if_there(field, "position_m", kMaxPosition_m),
          read_if_there(field, "angle_deg", kMaxAngle_deg) * kDegree};
}

std::vector<ErrorSource> read_errors(const Field& list) {
  std::vector<ErrorSource> errors;
  const std::size_t count = list.size(1, kMaxErrors, "name every part of the chain once");
  for (std::size_t i = 0; i < count; ++i) {
    ErrorSource error = read_error(list.element(i));
    const auto same = [&](const ErrorSource& other) { return other.name == error.name; };
    if (std::any_of(errors.begin(), errors.end(), same))
      list.element(i).at("name").refuse("a name that no other error has", "give it another name");
    errors.push_back(std::move(error));
  }
  return errors;
}

// Indices of errors by their names; none where the key is missing.
std::vector<std::size_t> read_names(const Field& term, const char* key, const std::vector<ErrorSource>& errors) {
  std::vector<std::size_t> found;
  if (!term.json().contains(key)) return found;
  const Field list = term.at(key);
  const std::size_t count =
      list.size(1, errors.size(), "name errors of this loop, or leave " + std::string(key) + " out");
  std::string known;
  for (const ErrorSource& error : errors) known += (known.empty() ? "" : ", ") + error.name;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = read_text(list.element(i));
    const auto at =
        std::find_if(errors.begin(), errors.end(), [&](const ErrorSource& error) { return error.name == name; });
    if (at == errors.end()) list.element(i).refuse(known, "name an error of this loop");
    const auto index = static_cast<std::size_t>(at - errors.begin());
    if (std::find(found.begin(), found.end(), index) != found.end())
      list.element(i).refuse("each error once", "leave out the second");
    found.push_back(index);
  }
  return found;
}

ErrorTerm read_term(const Field& field, const std::vector<ErrorSource>& errors) {
  field.only({"name", "positions", "angles", "lever_m"});
  ErrorTerm term{read_text(field.at("name")), read_names(field, "positions", errors),
                 read_names(field, "angles", errors), read_if_there(field, "lever_m", kMaxLever_m)};
  if (term.positions.empty() && term.angles.empty())
    field.refuse("positions, or angles with lever_m, or both", "say which errors it is made of");
  if (term.angles.empty() != (term.lever_m == 0.0))
    field.refuse("angles and lever_m together", "an angle moves something only over a length");
  return term;
}

ErrorLoop read_loop(const Field& field) {
  field.only({"errors", "terms"});
  ErrorLoop loop{read_errors(field.at("errors")), {}};
  const Field list = field.at("terms");
  const std::size_t count = list.size(1, kMaxTerms, "say what the errors do to the end of the chain");
  for (std::size_t i = 0; i < count; ++i) loop.terms.push_back(read_term(list.element(i), loop.errors));
  return loop;
}

}  // namespace

ErrorBudget parse_error_budget(const Json& table, const std::string& file) {
  const Field field(table, file, "");
  check_kind(field, "budget");
  field.only({"format", "kind", "name", "open_loop", "closed_loop"});
  return {field.at("name").name(40), read_loop(field.at("open_loop")), read_loop(field.at("closed_loop"))};
}

}  // namespace liana::config
