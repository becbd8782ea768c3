// `liana`: the command line. Commands are done in files of their own, their options declared in options/; here are the
// exit codes.
#include <CLI/CLI.hpp>

#include <cstdio>

#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/options/options.hpp"
#include "host/apps/cli/options/words.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/base/install_paths/places.hpp"
#include "host/base/json/json.hpp"
#include "host/drives/commissioning/desk.hpp"

using namespace liana::cli;

namespace {

using liana::launcher::ExitCode;

constexpr const char* kFooter =
    "Exit codes: 0 done, 1 failed, 2 bad input, 3 inverse kinematics did not converge or there is no plan,\n"
    "4 estop found nothing to stop, 130 interrupted; one message on standard error says what, with --json standard "
    "output has it, too.\n"
    "Angles are degrees where the option says deg, lengths metres, poses in the base frame.";

// What stands before the command: for every command the same.
void declare_global(CLI::App& app) {
  app.require_subcommand(1);
  app.footer(kFooter);
  app.set_version_flag("--version", "liana " LIANA_VERSION, "say which version");
  app.add_option_function<std::string>(
      kLuaDir, [](const std::string& folder) { liana::install_paths::search_first(kLuaDir, folder); },
      "before the command: a folder of tables and missions that is searched first (docs/how-to/install.md)");
}

// What tells of the host and of the commands themselves.
void declare_help(CLI::App& app, Action& action) {
  auto [doctor, options] = add<DoctorOptions>(
      app, action, "doctor", "what this host can and cannot do, and what to do about it", doctor_command);
  add_json(doctor, options.json);

  CLI::App* completion = app.add_subcommand("completion", "tab completion: source <(liana completion bash)");
  const auto shell = std::make_shared<std::string>("bash");
  completion->add_option("shell", *shell, "bash or zsh; or robots, scenes, buses, missions: the names that there are")
      ->capture_default_str();
  completion->callback(
      [&app, &action, shell] { action = [&app, shell] { return completion_command(*shell, help_of(app, "liana")); }; });
  app.add_subcommand("help", "this text, or `liana help COMMAND`");
}

// How a command ends that has no answer: one message on standard error, and with --json that as JSON in the answer's
// place. Returns the code.
class Refusal {
 public:
  explicit Refusal(bool as_json) : as_json_(as_json) {}
  int operator()(ExitCode code, const std::string& text) const {
    std::fprintf(stderr, "liana: %s\n", text.c_str());
    if (as_json_)
      std::printf("%s\n", liana::Json{{"error", {{"exit_code", int{code}}, {"text", text}}}}
                              .dump(-1, liana::Json::BadUtf8::kReplace)
                              .c_str());
    return code;
  }

 private:
  bool as_json_;
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
  CLI::App app("Liana: control of cable-driven snake arms", "liana");
  Action action;
  declare_global(app);
  declare_geometry(app, action);
  declare_missions(app, action);
  declare_seeing(app, action);
  declare_arm(app, action);
  declare_device(app, action);
  declare_drive(app, action);
  declare_robot(app, action);
  declare_help(app, action);
  const std::vector<std::string> words(argv + 1, argv + argc);
  const Refusal refuse(prints_json(words));
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
  return liana::launcher::after_standard_output(run(argc, argv));
}
