// `liana`: the command line. Commands are done in files of their own, their options declared beside this file; here are
// the exit codes.
#include <CLI/CLI.hpp>

#include <cstdio>

#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/options/options.hpp"
#include "host/apps/cli/options/words.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/base/json/json.hpp"
#include "host/base/text/text_output.hpp"
#include "host/drives/commissioning/desk.hpp"

using namespace liana::cli;

namespace {

using liana::launcher::ExitCode;

// How a command ends that has no answer: one message on standard error, and with --json that as JSON in the answer's
// place. Returns the code.
class Refusal {
 public:
  Refusal(const CLI::App& app, const std::vector<std::string>& words) : app_(app), words_(words) {}
  int operator()(ExitCode code, std::string text) const {
    if (code == ExitCode::kExitBadInput) text += suggestion(app_, words_);
    std::fprintf(stderr, "liana: %s\n", text.c_str());
    if (prints_json(words_))
      std::printf("%s\n", liana::Json{{"error", {{"exit_code", int{code}}, {"text", text}}}}
                              .dump(-1, liana::Json::BadUtf8::kReplace)
                              .c_str());
    return code;
  }

 private:
  const CLI::App& app_;
  const std::vector<std::string>& words_;
};

int perform(const Action& action, const Refusal& refuse) {
  try {
    return action();
  } catch (const liana::launcher::BadInput& error) {
    return refuse(ExitCode::kExitBadInput, error.what());
  } catch (const liana::launcher::NothingStopped& error) {
    return refuse(ExitCode::kExitNothingStopped, error.what());
  } catch (const liana::launcher::Interrupted& error) {
    std::fprintf(stderr, "liana: %s\n", error.what());
    return ExitCode::kExitInterrupted;
  } catch (const liana::commissioning::CommissioningInterrupted& error) {
    std::fprintf(stderr, "liana: %s\n", error.what());
    return ExitCode::kExitInterrupted;
  } catch (const std::exception& error) {
    return refuse(ExitCode::kExitFailure, error.what());
  }
}

int run(int argc, char** argv) {
  CLI::App app("", "liana");
  Action action;
  declare_all(app, action);
  const std::vector<std::string> words(argv + 1, argv + argc);
  const Refusal refuse(app, words);
  try {
    app.parse(arguments_of(app, words));
  } catch (const CLI::ExtrasError&) {
    return refuse(ExitCode::kExitBadInput, extra_word_text(app));
  } catch (const CLI::ArgumentMismatch& error) {
    return refuse(ExitCode::kExitBadInput, missing_value_text(app, error.what()));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    return refuse(ExitCode::kExitBadInput, problem_text(app, error.what()));
  } catch (const std::runtime_error& error) {  // of our own checks
    return refuse(ExitCode::kExitBadInput, error.what());
  }
  return perform(action, refuse);
}

}  // namespace

int main(int argc, char** argv) {
  liana::launcher::end_on_interrupt();
  liana::text::print_only_text();
  return liana::launcher::after_standard_output(run(argc, argv));
}
