#include "apps/command_line.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/show.hpp"
#include "common/error.hpp"
#include "common/number_hint.hpp"
#include "common/text_parts.hpp"

namespace swiftlet::apps {
namespace {

constexpr std::string_view kValueMissing = "a value is missing behind it";

/// CLI11 takes the next option for the value of one that lacks its own.
bool isNextOption(const std::string& text) { return text.starts_with("--"); }

/// A finite number within the bounds. CLI11's own check accepts nan and shows the largest double in messages.
template <typename Number>
CLI::Validator numberWithin(Within bounds) {
  const std::string description = fmt::format("{} to {}", bounds.low, bounds.high);
  const auto check = [bounds, description](std::string& text) -> std::string {
    if (isNextOption(text)) return std::string(kValueMissing);
    Number value{};
    const std::string_view digits = common::withoutPlus(text);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool number = error == std::errc{} && end == text.data() + text.size();
    if (number && value >= bounds.low && value <= bounds.high) return "";
    const std::string hint = common::numberHint("", text, std::is_integral_v<Number>);
    return fmt::format("`{}` is not a {} from {}{}", text, std::is_integral_v<Number> ? "whole number" : "number",
                       description, hint.empty() ? "" : ", " + hint);
  };
  return {check, description};
}

/// An empty text would count as an option that is not given.
CLI::Validator notEmpty() {
  return {[](std::string& text) {
            if (isNextOption(text)) return std::string(kValueMissing);
            return text.empty() ? "is empty: give a text, or leave it out" : std::string();
          },
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

bool hasArguments(const CLI::App& app) {
  const std::vector<const CLI::Option*> options = app.get_options();
  return std::any_of(options.begin(), options.end(), [](const CLI::Option* one) { return one->get_positional(); });
}

std::vector<std::string> commandsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// The option of a command below, or of its own, that a word may mean: `seed=7`, `--seed` before `fly`; a dash of a
/// text editor counts as two.
std::string placeHint(const CLI::App& app, std::string name) {
  const auto has = [](const CLI::App& command, const std::string& option) {
    const std::vector<std::string> options = optionsOf(command);
    return std::find(options.begin(), options.end(), option) != options.end();
  };
  for (const std::string_view dash : {"\xE2\x80\x93", "\xE2\x80\x94"})
    while (name.starts_with(dash)) name.erase(0, dash.size());
  name = "--" + name.substr(std::min(name.find_first_not_of('-'), name.size()));
  if (has(app, name)) return fmt::format("did you mean `{}`?", name);
  for (const CLI::App* command : app.get_subcommands())
    if (has(*command, name)) return fmt::format("put it behind `{}`", command->get_name());
  return "";
}

/// What a word that is no command of `app` may be meant as.
std::string commandHint(const CLI::App& app, const std::string& word) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  if (word == "help") return fmt::format("`{} --help` helps", fullName(chosen.empty() ? app : *chosen.front()));
  const std::vector<std::string> known = commandsOf(app);
  for (const auto& [ending, command] : {std::pair{".xml", "fly"}, {".yaml", "trial"}})
    if (word.ends_with(ending) && std::find(known.begin(), known.end(), command) != known.end())
      return fmt::format("did you mean `{} {} {}`?", fullName(app), command, word);
  return common::didYouMean(word, known);
}

std::string unknown(const common::Message& what, const std::string& hint) {
  return toString(common::Problem{{}, "", what, hint});
}

std::string unknownOption(const CLI::App& app, const std::string& name) {
  std::string hint = placeHint(app, name);
  if (hint.empty()) hint = name == "-v" || name == "-V" ? "did you mean `--version`?" : "";
  if (hint.empty()) hint = common::didYouMean((name.starts_with("--") ? "" : "-") + name, optionsOf(app));
  return unknown(common::Message("option.unknown", "`{}` is not an option of `{}`", name, fullName(app)), hint);
}

/// A long option behind one dash, of which CLI11 would make several short ones: `-headless` would be `-h`, help.
/// Every option here has two dashes, apart from `-h`.
std::optional<std::string> oneDash(const CLI::App& program, const std::vector<std::string>& words) {
  const CLI::App* app = &program;
  for (const std::string& word : words) {
    if (word == "--") break;
    const std::vector<std::string> commands = commandsOf(*app);
    if (std::find(commands.begin(), commands.end(), word) != commands.end()) app = app->get_subcommand(word);
    const bool letters = word.size() > 2 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0;
    if (!letters) continue;
    return fmt::format("{}\nRun `{} --help` for more information.\n",
                       unknownOption(*app, word.substr(0, word.find('='))), fullName(*app));
  }
  return std::nullopt;
}

/// A word that `app` cannot use. If several words remain, an option among them is the cause, because the word after it
/// is its value.
std::optional<std::string> unknownWord(const CLI::App& app) {
  const std::vector<std::string> left_over = app.remaining();
  for (const std::string& word : left_over) {
    if (!isOption(word)) continue;
    const std::string name = word.substr(0, word.find('='));
    return unknownOption(app, name);
  }
  if (left_over.empty()) return std::nullopt;
  const std::string& word = left_over.front();
  if (commandsOf(app).empty()) {
    std::string hint = placeHint(app, word.substr(0, word.find('=')));
    const std::vector<std::string> options = optionsOf(app);
    // Of a command without arguments that reads a profile.
    const bool reads_profile = std::find(options.begin(), options.end(), "--system") != options.end();
    if (hint.empty() && reads_profile && !hasArguments(app)) hint = fmt::format("did you mean `--system {}`?", word);
    return unknown(common::Message("argument.too-many", "`{}` is one argument too many for `{}`", word, fullName(app)),
                   hint);
  }
  return unknown(common::Message("command.unknown", "`{}` is not a command of `{}`", word, fullName(app)),
                 commandHint(app, word));
}

/// Replaces CLI11's words for an option with too few or too many values.
std::string plainly(const CLI::ParseError& error) {
  const std::string text = error.what(), option = text.substr(0, text.find(':'));
  if (error.get_name() != "ArgumentMismatch" || !isOption(option)) return text;
  if (text.ends_with("missing")) return fmt::format("{}: {}", option, kValueMissing);
  return text.find("At Most 1") == std::string::npos ? text : fmt::format("{}: is given more than once", option);
}

/// What was wrong with the arguments that `program` has just refused, and where help is.
std::string usageProblem(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App* app = &program;
  std::optional<std::string> problem;
  // The words behind an option without its value have not been checked.
  if (const std::string plain = plainly(error); plain.ends_with(kValueMissing)) problem = plain;
  for (;;) {
    if (!problem) problem = unknownWord(*app);
    const std::vector<CLI::App*> chosen = app->get_subcommands();
    if (chosen.empty()) break;
    app = chosen.front();
  }
  return fmt::format("{}\nRun `{} --help` for more information.\n", problem.value_or(plainly(error)), fullName(*app));
}

}  // namespace

Command Command::command(const std::string& name, const std::string& description) {
  return {*app_->add_subcommand(name, description), *chosen_};
}

/// CLI11 would name a missing command before an unknown one; so no command is required while it parses.
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
  using Plain =
      std::conditional_t<std::is_same_v<Number, int> || std::is_same_v<Number, std::optional<int>>, int, double>;
  return *app_->add_option(name, value, description)->check(numberWithin<Plain>(bounds));
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

void Command::leavesOption(std::vector<std::string>& files) {
  option("--leaves", files, "Library (.so) with leaves of your own that missions may use; may be given several times.");
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
  if (const auto mistake = oneDash(*app_, {argv + std::min(argc, 1), argv + argc})) {
    showError(*mistake);
    return {nullptr, kBadInput};
  }
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
