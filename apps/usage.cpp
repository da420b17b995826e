#include "apps/usage.hpp"

#include <optional>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "common/error.hpp"

namespace swiftlet::apps {
namespace {

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

}  // namespace

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

}  // namespace swiftlet::apps
