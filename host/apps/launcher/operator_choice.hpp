// Who steers a mission's steps, and over what: the options of `liana run` for liana-operator.
#pragma once

#include <string>
#include <vector>

namespace liana::launcher {

// Empty: nothing was said.
struct OperatorChoice {
  std::string who{};        // recorded (also when empty) or human
  std::string delay{};      // FORWARD_S,RETURN_S of the link between hand and arm
  std::string feedback{};   // a law's name, or off
  std::string passivity{};  // on or off
  std::string fixtures{};   // on or off; lianad's, too
  std::string temper{};     // gentle or lively; anybody's
};

// Words for liana-operator's command line. Throws BadInput for a delay that is none, and for what only a human has.
std::vector<std::string> operator_words(const OperatorChoice& choice);

}  // namespace liana::launcher
