#include "apps/command_line.hpp"

#include <charconv>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/show.hpp"
#include "common/error.hpp"

namespace swiftlet::apps {
namespace {

/// A finite number within the bounds. CLI11's own check accepts nan and shows the largest double in messages.
CLI::Validator numberWithin(Within bounds) {
  const std::string description = fmt::format("{} to {}", bounds.low, bounds.high);
  const auto check = [bounds, description](std::string& text) -> std::string {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool number = error == std::errc{} && end == text.data() + text.size();
    if (number && value >= bounds.low && value <= bounds.high) return "";
    return fmt::format("`{}` is not a number from {}", text, description);
  };
  return {check, description};
}

/// An empty text would count as an option that is not given.
CLI::Validator notEmpty() {
  return {[](std::string& text) { return text.empty() ? "is empty: give a text, or leave it out" : std::string(); },
          ""};
}

/// "swiftlet evaluate ate".
std::string fullName(const CLI::App& app) {
  const CLI::App* parent = app.get_parent();
  return (parent != nullptr ? fullName(*parent) + " " : "") + app.get_name();
}

bool isOption(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

std::vector<std::string> optionsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> commandsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// "`x` is no ...", with the most similar word.
std::string unknown(const std::string& what, const std::string& word, const std::vector<std::string>& known) {
  return toString(common::Problem{{}, "", what, common::didYouMean(word, known)});
}

/// A word that `app` cannot use. If several words remain, an option among them is the cause, because the word after it
/// is its value.
std::optional<std::string> unknownWord(const CLI::App& app) {
  const std::vector<std::string> left_over = app.remaining();
  for (const std::string& word : left_over) {
    if (!isOption(word)) continue;
    const std::string name = word.substr(0, word.find('='));
    return unknown(fmt::format("`{}` is not an option of `{}`", name, fullName(app)), name, optionsOf(app));
  }
  if (left_over.empty()) return std::nullopt;
  const std::vector<std::string> commands = commandsOf(app);
  const std::string& word = left_over.front();
  if (commands.empty()) return fmt::format("`{}` is one argument too many for `{}`", word, fullName(app));
  return unknown(fmt::format("`{}` is not a command of `{}`", word, fullName(app)), word, commands);
}

/// What was wrong with the arguments that `program` has just refused, and where help is.
std::string usageProblem(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App* app = &program;
  std::optional<std::string> problem;
  for (;;) {
    if (!problem) problem = unknownWord(*app);
    const std::vector<CLI::App*> chosen = app->get_subcommands();
    if (chosen.empty()) break;
    app = chosen.front();
  }
  return fmt::format("{}\nRun `{} --help` for more information.\n", problem.value_or(error.what()), fullName(*app));
}

}  // namespace

Command Command::command(const std::string& name, const std::string& description) {
  return {*app_->add_subcommand(name, description), *chosen_};
}

/// CLI11 would name a missing command before an unknown one; so none is required while it parses.
void Command::requireCommand(const std::string& what) {
  app_->require_subcommand(0, 1);
  app_->callback([app = app_, what] {
    if (app->get_subcommands().empty()) throw CLI::RequiredError(what);
  });
}

void Command::argument(const std::string& name, std::string& value, const std::string& description) {
  app_->add_option(name, value, description)->required();
}

void Command::arguments(const std::string& name, std::vector<std::string>& values, const std::string& description) {
  app_->add_option(name, values, description)->required();
}

void Command::optionalArguments(const std::string& name, std::vector<std::string>& values,
                                const std::string& description) {
  app_->add_option(name, values, description);
}

void Command::option(const std::string& name, std::string& value, const std::string& description) {
  CLI::Option* option = app_->add_option(name, value, description)->check(notEmpty());
  if (!value.empty()) option->capture_default_str();
}

void Command::option(const std::string& name, std::vector<std::string>& values, const std::string& description) {
  app_->add_option(name, values, description)->allow_extra_args(false);
}

template <typename Number>
CLI::Option& Command::number(const std::string& name, Number& value, Within bounds, const std::string& description) {
  return *app_->add_option(name, value, description)->check(numberWithin(bounds));
}

void Command::option(const std::string& name, int& value, Within bounds, const std::string& description) {
  number(name, value, bounds, description).capture_default_str();
}

void Command::option(const std::string& name, std::optional<int>& value, Within bounds,
                     const std::string& description) {
  number(name, value, bounds, description);
}

void Command::option(const std::string& name, std::optional<double>& value, Within bounds,
                     const std::string& description) {
  number(name, value, bounds, description);
}

void Command::option(const std::string& name, double& value, Within bounds, const std::string& description) {
  number(name, value, bounds, description).capture_default_str();
}

void Command::choice(const std::string& name, std::string& value, const std::vector<std::string>& choices,
                     const std::string& description) {
  CLI::Option* option = app_->add_option(name, value, description)->check(CLI::IsMember(choices));
  if (!value.empty()) option->capture_default_str();
}

void Command::flag(const std::string& name, bool& value, const std::string& description) {
  app_->add_flag(name, value, description);
}

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::runs(Run run) {
  app_->callback([chosen = chosen_, run = std::move(run)] { *chosen = run; });
}

Program::Program(const std::string& name, const std::string& version, const std::string& description)
    : app_(std::make_unique<CLI::App>(description, name)), top_(*app_, chosen_) {
  app_->set_version_flag("--version", name + " " + version, "Print the version.");
  top_.requireCommand("A subcommand");
}

Program::~Program() = default;

Program::Parsed Program::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
    return {chosen_, kDone};
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return {nullptr, app_->exit(e)};  // Help or the version was asked for.
    showError(usageProblem(*app_, e));
    return {nullptr, kBadInput};
  }
}

}  // namespace swiftlet::apps
