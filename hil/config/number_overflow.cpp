#include "hil/config/number_overflow.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace liana::bench {
namespace {

using nlohmann::json;

// Keeps no values, only the way from the whole to what comes next.
class Finder : public nlohmann::json_sax<json> {
 public:
  bool null() override { return passed(); }
  bool boolean(bool) override { return passed(); }
  bool number_integer(number_integer_t) override { return passed(); }
  bool number_unsigned(number_unsigned_t) override { return passed(); }
  bool number_float(number_float_t, const string_t&) override { return passed(); }
  bool string(string_t&) override { return passed(); }
  bool binary(binary_t&) override { return passed(); }
  bool start_object(std::size_t) override { return open(false); }
  bool key(string_t& name) override { return open_.back().name = name, true; }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string& token, const json::exception& error) override {
    if (dynamic_cast<const json::out_of_range*>(&error) == nullptr) return false;
    found.number = token;
    for (const Container& each : open_) found.field += "/" + (each.is_array ? std::to_string(each.entries) : each.name);
    return false;
  }

  NumberOverflow found;

 private:
  struct Container {
    bool is_array;
    std::size_t entries;
    std::string name;
  };

  bool passed() {
    if (!open_.empty()) ++open_.back().entries;
    return true;
  }
  bool open(bool is_array) {
    open_.push_back({is_array, 0, {}});
    return true;
  }
  bool close() {
    open_.pop_back();
    return passed();
  }

  std::vector<Container> open_;
};

}  // namespace

NumberOverflow first_overflow(const std::string& text) {
  Finder finder;
  json::sax_parse(text, &finder);
  return finder.found;
}

}  // namespace liana::bench
