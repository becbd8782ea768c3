#include "host/apps/launcher/operator_choice.hpp"

#include <stdexcept>

#include "host/apps/launcher/errors.hpp"
#include "host/operator/haptics/link.hpp"

namespace liana::launcher {

std::vector<std::string> operator_words(const OperatorChoice& choice) {
  std::vector<std::string> words{"--operator", choice.who.empty() ? "recorded" : choice.who};
  const auto add = [&](const char* option, const std::string& value) {
    if (value.empty()) return;
    if (choice.who != "model")
      throw BadInput(std::string(option) + ": '" + value +
                     "': recorded hands feel nothing and wait for nothing; allowed with --operator model");
    words.insert(words.end(), {option, value});
  };
  add("--delay", choice.delay);
  add("--feedback", choice.feedback);
  add("--passivity", choice.passivity);
  if (choice.who == "model") add("--fixtures", choice.fixtures);
  if (!choice.temper.empty()) words.insert(words.end(), {"--temper", choice.temper});
  try {
    if (!choice.delay.empty()) haptics::delays_of(choice.delay);
  } catch (const std::invalid_argument& error) {
    throw BadInput(std::string("--delay: ") + error.what());
  }
  return words;
}

}  // namespace liana::launcher
